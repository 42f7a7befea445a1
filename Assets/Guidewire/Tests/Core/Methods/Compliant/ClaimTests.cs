using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What an xpbd run says of itself is true: random wires, loads, substeps and sweeps against the direct
    /// solver, which solves the same chain exactly. A few of 240 by default, a quarter of them where campaigns run in
    /// full, another one each day.</summary>
    public sealed class ClaimTests
    {
        private const double Gate = 0.02;    // of the largest displacement of a sphere
        private const int Cases = 240;
        private const double Settled = 14.0; // a critically damped motion is over after so many 1/omega: 15 exp(-14)

        [Test]
        public void RunThatClaimsConvergence_EndsInTheRestShape() => Campaign(11, 3, true, ErrorAtRest);

        [Test]
        public void RunThatClaimsConvergence_MovesAsImplicitEuler() => Campaign(12, 8, false, ErrorInMotion);

        private static void Campaign(int seed, int few, bool damped,
            Func<SimulationParameters, Simulation, double> go)
        {
            int count = Rods.InFull ? Cases / 4 : few;
            int first = Rods.InFull ? RandomGeometry.FirstOfTheDay(count, Cases) : 0;
            var random = new System.Random(seed);
            int claims = 0;
            int silent = 0;
            int lost = 0;
            double worst = 0.0;
            for (int i = 0; i < first + count; i++)
            {
                SimulationParameters parameters = Case(random, damped);
                if (i < first)
                {
                    continue;
                }
                Simulation run = Simulation.Create(parameters);
                double error = go(parameters, run);
                SolverReport report = run.Report()!;
                string name = "case " + i + ": " + run.Outcome + ", " + run.Reason;
                if (run.Outcome == Outcome.Diverged || run.Outcome == Outcome.Failed)
                {
                    lost++;
                    Assert.That(Wires.IsFinite(run.State), Is.True, name);
                    continue;
                }
                Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), name);
                bool claimed = report.LargestError <= ConvergenceRecord.Tolerance;
                Assert.That(report.StepsNotConverged == 0, Is.EqualTo(claimed), name);
                Assert.That(run.Reason.Contains("had not converged"), Is.EqualTo(!claimed), name);
                if (claimed)
                {
                    claims++;
                    worst = Math.Max(worst, error);
                    Assert.That(error, Is.LessThan(Gate), name);
                }
                else if (error < Gate)
                {
                    silent++;
                }
            }
            TestContext.Out.WriteLine("{0} runs: {1} claim convergence, the worst is {2:0.00} % off; {3} more are right"
                + " but do not claim it; {4} diverged or failed", count, claims, 100.0 * worst, silent, lost);
            Assert.That(claims, Is.GreaterThan(count / 5));
            Assert.That(claims + silent, Is.LessThan(count), "no run was hard enough");
        }

        /// <summary>A wire 60 to 150 times as long as it is thick, of some stiffness, under some load.</summary>
        private static SimulationParameters Case(System.Random random, bool damped)
        {
            double radius = Rods.Length / (60.0 + 90.0 * random.NextDouble());
            double young = 1e8 * Math.Pow(1e3, random.NextDouble());
            double shear = young * (0.3 + 0.2 * random.NextDouble());
            int n = random.Next(4, 11);
            double area = Math.PI * radius * radius;
            double bending = young * 0.25 * area * radius * radius;
            double force = bending / (Rods.Length * Rods.Length);
            double omega = 3.516 / (Rods.Length * Rods.Length) * Math.Sqrt(bending / (Rods.Density * area));
            double stable = radius / Math.Sqrt(shear / Rods.Density);
            double substep = 0.5 * Math.Pow(200.0, random.NextDouble()) * stable;
            int sweeps = new[] { 1, 2, 3, 6, 12, 30 }[random.Next(6)];
            double step = 0.04 / omega;
            int substeps = (int)Math.Ceiling(step / substep);
            SimulationParameters parameters = Rods.Clamped(n, Solver.Xpbd, step,
                (int)((damped ? Settled : 2.0 * Math.PI) / (omega * step)));
            parameters.Material.MassDamping = damped ? 2.0 * omega : 0.0;
            parameters.Method.ConstraintSolverSteps = sweeps;
            parameters.Material.WireRadius = radius;
            parameters.Material.YoungsModulus = young;
            parameters.Material.ShearModulus = shear;
            parameters.Method.Substeps = substeps;
            parameters.Material.MassRule = MassRule.Lumped;
            parameters.Material.RestCurvature = random.Next(2) == 0 ? Vector3d.Zero
                : 2.0 / Rods.Length * Wires.Any(random);
            double load = 0.1 * Math.Pow(20.0, random.NextDouble());
            int kind = random.Next(3);
            if (kind == 0)
            {
                // A jump of sphere 0 across the wire.
                parameters.Drive.DisplacementDirection = new Vector3d(random.NextDouble(), random.NextDouble(), 0.0);
                parameters.Drive.Displacement = 1e3 * 0.02 * random.NextDouble() * Rods.Length / n;
            }
            else if (kind == 1)
            {
                // A pull: near the load at which a thrust bends the wire, its motion has no end.
                Vector3d any = Vector3d.Normalize(Wires.Any(random));
                parameters.Scene.TipForce = load * force * new Vector3d(any.X, any.Y, Math.Abs(any.Z));
            }
            else
            {
                parameters.Scene.Gravity = 2.0 * load * force / (Rods.Density * area * Rods.Length)
                    * Vector3d.Normalize(Wires.Any(random));
            }
            return parameters;
        }

        // Farthest that a sphere is from where it belongs in the rest shape, over the largest displacement.
        private static double ErrorAtRest(SimulationParameters parameters, Simulation run)
        {
            Wires.Run(run);
            parameters.Method.Solver = Solver.Direct;
            parameters.Method.Integrator = Integrator.ImplicitEuler;
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Method.MaxSimulationSteps = 0;
            Simulation exact = Simulation.Create(parameters);
            Assert.That(exact.Outcome, Is.EqualTo(Outcome.Converged), exact.Reason);
            return Wires.Distance(exact.State, run.State)
                / Wires.Distance(exact.State, Wires.Straight(parameters));
        }

        // The same at any step against implicit Euler with time steps of one substep.
        private static double ErrorInMotion(SimulationParameters parameters, Simulation run)
        {
            int substeps = parameters.Method.Substeps;
            parameters.Method.Solver = Solver.Direct;
            parameters.Method.Integrator = Integrator.ImplicitEuler;
            parameters.Method.SolverTolerance = 1e-9;
            parameters.Method.TimeStep /= substeps;
            parameters.Method.MaxSimulationSteps = int.MaxValue;
            Simulation exact = Simulation.Create(parameters);
            RodState start = Wires.Straight(parameters);
            double error = 0.0;
            double moved = 0.0;
            while (run.Outcome == Outcome.Running)
            {
                run.Step();
                Wires.Step(exact, substeps);
                error = Math.Max(error, Wires.Distance(exact.State, run.State));
                moved = Math.Max(moved, Wires.Distance(exact.State, start));
            }
            Assert.That(exact.Outcome, Is.EqualTo(Outcome.Running), exact.Reason);
            return error / moved;
        }
    }
}

using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Loads at which a wire under xpbd or explicit steps leaves its shape: pushed off it a little, it comes
    /// back below them and goes on above. Of xpbd, pulls whose directions are wrong have no potential, and first show
    /// where a twist is about to leave its shape.</summary>
    public sealed class TwistedWireTests
    {
        private const double Margin = 0.02;  // of the critical twist: held below it, left above
        private const double Radius = 3e-3;

        [TestCase(Solver.Xpbd, 0.5, 1, Category = "Long")]
        [TestCase(Solver.Xpbd, 1.0, 1)]
        [TestCase(Solver.Xpbd, 1.0, 4, Category = "Long")]
        [TestCase(Solver.Xpbd, 2.0, 1, Category = "Long")]
        [TestCase(Solver.Explicit, 0.5, 1, Category = "Long")]
        [TestCase(Solver.Explicit, 1.0, 1)]
        [TestCase(Solver.Explicit, 2.0, 1, Category = "Long")]
        public void Ring_LeavesItsPlane_AtTheTwistOfMichellAndZajac(Solver solver, double ratio, int sweeps)
        {
            // Closed, straight when free: 2 pi sqrt(3) EI/GJ. Off its plane as far as its joints at the clamps turn.
            int n = ratio > 1.0 ? 40 : 20;
            double critical = 2.0 * Math.PI * Math.Sqrt(3.0) * ratio;
            Assert.That(Ring(n, solver, ratio, sweeps, (1.0 - Margin) * critical, 1e-3), Is.LessThan(1e-3));
            Assert.That(Ring(n, solver, ratio, sweeps, (1.0 + Margin) * critical, 1e-2), Is.GreaterThan(1e-2));
        }

        // T L^2/EI and M L/EI: without tension tan(M/2) = M/2.
        [TestCase(Solver.Xpbd, 0.0, 8.9868, Category = "Long")]
        [TestCase(Solver.Xpbd, 1.0, 9.1341, Category = "Long")]
        [TestCase(Solver.Xpbd, 10.0, 10.4288, Category = "Long")]
        [TestCase(Solver.Explicit, 0.0, 8.9868, Category = "Long")]
        [TestCase(Solver.Explicit, 1.0, 9.1341, Category = "Long")]
        [TestCase(Solver.Explicit, 10.0, 10.4288)]
        public void StraightWire_LeavesItsAxis_AtTheCoupleOfGreenhill(Solver solver, double tension, double couple)
        {
            // Between clamps, pulled apart for the tension. The ends do not come closer, so that beyond it the wire
            // only leans on its own tension: (a/L)^2 EA is of the order of what the couple is above its limit.
            const int N = 24;
            SimulationParameters parameters = Damped(N, solver, 2);
            parameters.Scene.DistalDisplacement = 1e3 * tension * 0.25 * Radius * Radius / Rods.Length;
            double critical = couple * Rods.Young / (2.0 * Rods.Shear);
            parameters.Scene.DistalRotation = (1.0 - Margin) * critical;
            Assert.That(Straight(parameters, 1e-4), Is.LessThan(1e-4));
            parameters.Scene.DistalRotation = (1.0 + Margin) * critical;
            Assert.That(Straight(parameters, 1e-3), Is.GreaterThan(1e-3));
        }

        [TestCase(Solver.Xpbd, Category = "Long")]
        [TestCase(Solver.Explicit)]
        public void Column_LeavesItsAxis_AtEulersLoad(Solver solver)
        {
            // Clamped below, free above: pi^2/4 EI/L^2.
            const double Within = 0.008;
            SimulationParameters parameters = Damped(24, solver, 2);
            parameters.Scene.DistalEnd = DistalEnd.Free;
            parameters.Material.ClampRule = ClampRule.FourthOrder;
            parameters.Material.MassDamping = 20.0;
            parameters.Method.MaxSimulationSteps = 10_000;
            double critical = 0.25 * Math.PI * Math.PI * Math.Pow(Radius / Rods.Radius, 4) * Rods.BendForce;
            parameters.Scene.TipForce = -(1.0 - Within) * critical * Vector3d.UnitZ;
            Assert.That(Straight(parameters, 1e-4), Is.LessThan(1e-4));
            parameters.Scene.TipForce = -(1.0 + Within) * critical * Vector3d.UnitZ;
            Assert.That(Straight(parameters, 1e-4), Is.GreaterThan(1e-4));
        }

        private static double Ring(int n, Solver solver, double ratio, int sweeps, double twist, double enough)
        {
            SimulationParameters parameters = Damped(n, solver, sweeps);
            parameters.Scene.DistalRotation = twist;
            parameters.Material.ShearModulus = 0.5 * Rods.Young / ratio;
            parameters.Scene.StartShape = StartShape.Ring;
            RodState ring = Simulation.Create(parameters).State;
            for (int i = 0; i <= n; i++)
            {
                double around = 2.0 * Math.PI * i / n;
                double push = 0.03 * Math.Sin(around) * Math.Sin(around) * Math.Sin(2.0 * around);
                ring.Positions[i] += new Vector3d(push, 0.0, 0.0);
            }
            return Farthest(parameters, ring, FromPlane, enough);
        }

        private static double Straight(SimulationParameters parameters, double enough)
        {
            RodState wire = Simulation.Create(parameters).State;
            int n = wire.ElementCount;
            double waves = parameters.Scene.DistalEnd == DistalEnd.Free ? 0.5 : 1.0;
            for (int i = 1; i <= n; i++)
            {
                wire.Positions[i] += new Vector3d(0.003 * Math.Pow(Math.Sin(waves * Math.PI * i / n), 2), 0.0, 0.0);
            }
            return Farthest(parameters, wire, FromAxis, enough);
        }

        // Over the whole run, or until it is farther than enough: a ring that has left its plane passes through itself
        // and comes back with fewer turns.
        private static double Farthest(SimulationParameters parameters, RodState start, Func<RodState, double> away,
            double enough)
        {
            parameters.Scene.Start = new RodStart(start.Positions, start.Orientations, start.Velocities,
                start.AngularVelocities)
            {
                ProximalFrame = Quaterniond.Identity,
                DistalFrame = Quaterniond.Identity,
            };
            double sound = Rods.Length / start.ElementCount / Math.Sqrt(Rods.Young / Rods.Density);
            double substep = parameters.Method.Solver == Solver.Xpbd
                ? 0.35 * Math.Sqrt(parameters.Method.ConstraintSolverSteps) * sound
                : 0.7 * Simulation.Create(parameters).Report()!.StableSubstep;
            parameters.Method.Substeps = (int)Math.Ceiling(parameters.Method.TimeStep / substep);
            Simulation run = Simulation.Create(parameters);
            double farthest = 0.0;
            while (run.Outcome == Outcome.Running && farthest <= enough)
            {
                run.Step();
                farthest = Math.Max(farthest, away(run.State));
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished).Or.EqualTo(Outcome.Running), run.Reason);
            return farthest;
        }

        private static SimulationParameters Damped(int n, Solver solver, int sweeps)
        {
            SimulationParameters parameters = Rods.Clamped(n, solver, 4e-5, 2000);
            parameters.Method.ConstraintSolverSteps = sweeps;
            parameters.Material.MassDamping = 3e-3 / parameters.Method.TimeStep;
            parameters.Material.WireRadius = Radius;
            parameters.Scene.DistalEnd = DistalEnd.Clamped;
            parameters.Material.ClampRule = ClampRule.HalfElement;
            parameters.Scene.DistalRampTime = 0.02;
            return parameters;
        }

        // Root mean square distance from the plane x = (b, y, z) . (1, y, z) that fits best, over L.
        private static double FromPlane(RodState state)
        {
            double a21 = 0.0, a22 = 0.0, a31 = 0.0, a32 = 0.0, a33 = 0.0;
            Vector3d right = Vector3d.Zero;
            foreach (Vector3d x in state.Positions)
            {
                a21 += x.Y;
                a22 += x.Y * x.Y;
                a31 += x.Z;
                a32 += x.Y * x.Z;
                a33 += x.Z * x.Z;
                right += x.X * new Vector3d(1.0, x.Y, x.Z);
            }
            Vector3d plane = new Symmetric3(state.SphereCount, a21, a22, a31, a32, a33).Solve(right);
            double sum = 0.0;
            foreach (Vector3d x in state.Positions)
            {
                double away = x.X - Vector3d.Dot(plane, new Vector3d(1.0, x.Y, x.Z));
                sum += away * away;
            }
            return Math.Sqrt(sum / state.SphereCount) / (1e3 * Rods.Length);
        }

        private static double FromAxis(RodState state)
        {
            double largest = 0.0;
            foreach (Vector3d x in state.Positions)
            {
                largest = Math.Max(largest, Math.Sqrt(x.X * x.X + x.Y * x.Y));
            }
            return largest / (1e3 * Rods.Length);
        }
    }
}

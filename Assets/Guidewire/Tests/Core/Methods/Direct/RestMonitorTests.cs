using System;
using System.Globalization;
using System.Text.RegularExpressions;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire with a material ends at rest where it is at rest, independent of the time step.</summary>
    public sealed class RestMonitorTests
    {
        private const double Threshold = 0.001;   // units: 1 um

        // Euler's load of a cantilever, pi^2 EI/(4 L^2): a straight wire stays straight on either side of it.
        [TestCase(0.98, true)]
        [TestCase(1.02, false)]
        [TestCase(3.0, false)]
        public void StraightMotionBeyondItsCriticalLoad_IsNotReliable(double share, bool isReliable)
        {
            SimulationParameters parameters = Rods.Clamped(30, Solver.Direct, 1e-3, 100);
            parameters.Material.MassDamping = 50.0;
            parameters.Scene.TipForce = new Vector3d(0.0, 0.0, -0.25 * share * Math.PI * Math.PI * Rods.BendForce);
            Simulation run = Wires.Finish(parameters);
            Assert.That(run.IsReliable, Is.EqualTo(isReliable), run.Reason);
            Assert.That(run.Reason, isReliable ? Does.Not.Contain("unstable") : Does.Contain("unstable"));
        }

        [TestCase(false)]
        [TestCase(true)]
        public void WireThatATurningLoadWillMove_IsNotAtRest(bool isForce)
        {
            SimulationParameters parameters = Rods.Clamped(10, Solver.Direct, 0.01, 60);
            parameters.Method.DeltaThreshold = Threshold;
            var late = new TimeTable(new[] { 0.0, 0.5, 0.51 }, new[] { 0.0, 0.0, 1.0 });
            if (isForce)
            {
                parameters.Scene.TipFollowerForce = new Vector3d(0.0, 0.01, 0.0);
                parameters.Scene.TipFollowerForceTable = late;
            }
            else
            {
                parameters.Scene.TipMoment = new Vector3d(0.001, 0.0, 0.0);
                parameters.Scene.TipMomentTable = late;
            }
            Simulation run = Wires.Run(parameters);
            Assert.That(run.StepCount, Is.GreaterThan(50), run.Reason);
        }

        // Far from any equilibrium: a thin wire that whips in a plane, and one that falls freely.
        [TestCase(false)]
        [TestCase(true)]
        public void ViolentMotion_IsNotCalledUnstable(bool falls)
        {
            SimulationParameters parameters = Rods.Clamped(30, Solver.Direct, falls ? 0.01 : 1e-4, falls ? 50 : 600);
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            parameters.Scene.ProximalEnd = falls ? ProximalEnd.Free : ProximalEnd.Clamped;
            parameters.Material.WireRadius = falls ? 5e-4 : 1e-4;
            parameters.Scene.TipForce = new Vector3d(0.0, falls ? 0.0 : 0.02, 0.0);
            parameters.Scene.TipForceReleaseTime = 3e-3;
            Assert.That(Wires.Finish(parameters).Reason, Does.Not.Contain("unstable"));
        }

        [TestCase(1e-4, ProximalEnd.Clamped, 0.02)]
        [TestCase(0.5e-3, ProximalEnd.Held, 0.5, Category = "Long")]
        public void SwingingWire_IsNotAtRest_InSmallSteps(double radius, ProximalEnd end, double force)
        {
            // A tip force, let go at 3 ms: in steps of 10 us the tip's prediction error is below 1 um all the time.
            SimulationParameters parameters = Swinging(Solver.Direct, 1e-5, 6000);
            parameters.Material.WireRadius = radius;
            parameters.Scene.ProximalEnd = end;
            parameters.Scene.TipForce = new Vector3d(0.0, force, 0.0);
            parameters.Scene.TipForceReleaseTime = 0.003;
            Assert.That(Wires.Run(parameters).Outcome, Is.EqualTo(Outcome.Finished));
        }

        [TestCase(Solver.Direct, 1e-7, 300)]
        [TestCase(Solver.Direct, 1e-4, 3000)]
        [TestCase(Solver.Xpbd, 1e-6, 300)]
        [TestCase(Solver.Explicit, 1e-7, 3000)]
        public void WireAtItsTurningPoint_IsNotAtRest(Solver solver, double step, int steps)
        {
            // Bent by its tip force, let go, at a turning point to begin with: at 1e-7 s slower than 1e-4 m/s in all
            // steps.
            SimulationParameters parameters = Swinging(solver, step, steps);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Scene.TipForce = new Vector3d(0.0, Rods.BendForce, 0.0);
            parameters.Scene.TipForceReleaseTime = 0.0;
            Assert.That(Wires.Run(parameters).Outcome, Is.EqualTo(Outcome.Finished));
        }

        [TestCase(Solver.Direct, 1e-3, 1, 50.0)]
        [TestCase(Solver.Direct, 1e-2, 1, 30.0)]
        [TestCase(Solver.Direct, 1.0, 1, 0.0)]
        [TestCase(Solver.Explicit, 1e-3, 5000, 50.0)]
        public void DampedWire_ComesToRest_WhereItsRestShapeIs(Solver solver, double step, int substeps,
            double massDamping)
        {
            if (solver == Solver.Explicit)
            {
                Rods.OnlyInFull("the monitor is one for both methods");
            }
            int n = solver == Solver.Explicit ? 5 : 10;
            SimulationParameters parameters = Swinging(solver, step, 4000);
            parameters.Scene.NumberRodElements = n;
            parameters.Material.MassDamping = massDamping;
            parameters.Method.Substeps = substeps;
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            Assert.That(run.SteadyStateStep, Is.EqualTo(run.StepCount));
            Assert.That(run.Reason, Does.Contain("from its rest shape").And.Contain("deltaThreshold = 0.001 units"));
            SimulationParameters atRest = Swinging(Solver.Direct, 1e-3, 0);
            atRest.Scene.NumberRodElements = n;
            atRest.Scene.InitialState = InitialState.Equilibrium;
            Simulation rest = Simulation.Create(atRest);
            Assert.That(rest.Outcome, Is.EqualTo(Outcome.Converged), rest.Reason);
            // Away from rest by what the threshold allows, and by as much in its swing.
            Assert.That(Wires.Distance(run.State, rest.State), Is.LessThan(2.0 * Threshold));
        }

        /// <summary>Near its critical load a straight wire swings by A = v/omega in the mode 1 - cos(pi z/2L), with
        /// omega^2 of Rayleigh's quotient; the largest turn times L is pi/2 of that.</summary>
        [Test]
        public void SwingOfAWireNearItsCriticalLoad_IsThatOfItsMode()
        {
            const double Share = 0.99;
            const double Speed = 1e-6;    // m/s, of the tip
            const int N = 40;
            SimulationParameters parameters = Rods.Clamped(N, Solver.Direct, 1e-9, 100);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Scene.TipForce = new Vector3d(0.0, 0.0, -0.25 * Share * Math.PI * Math.PI * Rods.BendForce);
            parameters.Method.DeltaThreshold = 1.0;
            MethodStart start = MethodBuilder.Build(parameters, new Scene(parameters));
            var run = (DirectStep)start.Stepper;
            double k = 0.5 * Math.PI / Rods.Length;
            for (int i = 0; i <= N; i++)
            {
                double z = Rods.Length * i / N;
                run.Dynamics.Velocities[i] = new Vector3d(0.0, Speed * (1.0 - Math.Cos(k * z)), 0.0);
                if (i < N)
                {
                    double middle = z + 0.5 * Rods.Length / N;
                    run.Dynamics.Spins[i] = new Vector3d(-Speed * k * Math.Sin(k * middle), 0.0, 0.0);
                }
            }
            run.Advance(start.State);
            CrossSection section = CrossSection.At(parameters.Material, 0.0);
            // Integrals of k^4 cos^2 and k^2 sin^2, and of (1 - cos)^2 = L (3/2 - 4/pi).
            double stiffness = 0.5 * section.BendStiffness1 * Math.Pow(k, 4.0) * (1.0 - Share) * Rods.Length;
            double mass = section.LineDensity * (1.5 - 4.0 / Math.PI) * Rods.Length;
            double swing = 1e3 * 0.5 * Math.PI * Speed / Math.Sqrt(stiffness / mass);
            Match said = Regex.Match(run.SteadyState ?? "", "swinging by ([^;]+);");
            Assert.That(said.Success, Is.True, run.SteadyState);
            Assert.That(double.Parse(said.Groups[1].Value, CultureInfo.InvariantCulture),
                Is.EqualTo(swing).Within(5.0).Percent);
        }

        [Test]
        public void HeavilyDampedWire_IsNotAtRest_WhileItCreeps()
        {
            // Its speed would be lost in 10 us: a free piece of it would creep at g/a = 0.1 mm/s, 1 nm a step.
            SimulationParameters parameters = Swinging(Solver.Direct, 1e-5, 200);
            parameters.Material.MassDamping = 1e5;
            Assert.That(Wires.Run(parameters).Outcome, Is.EqualTo(Outcome.Finished));
        }

        [Test]
        public void WireBeforeALoadIsReleased_IsNotAtRest()
        {
            SimulationParameters parameters = Swinging(Solver.Direct, 1e-3, 30);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Scene.TipForce = new Vector3d(0.0, Rods.BendForce, 0.0);
            parameters.Scene.TipForceReleaseTime = 0.02;
            Assert.That(Wires.Run(parameters).Outcome, Is.EqualTo(Outcome.Finished));
            parameters.Scene.TipForceReleaseTime = 1.0;
            Assert.That(Wires.Run(parameters).Outcome, Is.EqualTo(Outcome.Converged));
        }

        [TestCase(0.9, Outcome.Converged)]
        [TestCase(1.1, Outcome.Finished)]
        public void StraightWireUnderAThrust_IsAtRest_BelowItsCriticalLoadOnly(double fraction, Outcome outcome)
        {
            // Clamped at one end, guided at the other: 4 pi^2 EI/L^2; nothing disturbs it.
            SimulationParameters parameters = Swinging(Solver.Direct, 1e-3, 300);
            parameters.Scene.Gravity = Vector3d.Zero;
            parameters.Scene.DistalEnd = DistalEnd.Sliding;
            parameters.Scene.AxialForce = -fraction * 4.0 * Math.PI * Math.PI * Rods.BendForce;
            Assert.That(Wires.Run(parameters).Outcome, Is.EqualTo(outcome));
        }

        [Test]
        public void DrivenWire_IsNotAtRest_HoweverSlow()
        {
            SimulationParameters parameters = Swinging(Solver.Direct, 1e-3, 200);
            parameters.Scene.Gravity = Vector3d.Zero;
            parameters.Drive.Kind = Drive.Push;
            parameters.Drive.DisplacementPerStep = 1e-9;
            Assert.That(Wires.Run(parameters).Outcome, Is.EqualTo(Outcome.Finished));
        }

        private static SimulationParameters Swinging(Solver solver, double step, int steps)
        {
            SimulationParameters parameters = Rods.Clamped(30, solver, step, steps);
            parameters.Method.DeltaThreshold = Threshold;
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            return parameters;
        }
    }
}

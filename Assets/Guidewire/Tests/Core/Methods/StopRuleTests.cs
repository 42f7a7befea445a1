using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    public sealed class StopRuleTests
    {
        // Transversal motion breaks down at a stretch gain of 2, purely longitudinal motion at 2 (1 + 2 w_q l^2/w) =
        // 2.13, a bent wire at a bend gain of l = 10: thesis table 4.1.
        [TestCase(2.02, 0.1)]
        [TestCase(2.1, 0.1)]
        [TestCase(0.1, 10.2)]
        [TestCase(0.1, 11.0)]
        public void GainBeyondItsLimit_IsDiverged(double stretch, double bend)
        {
            Simulation run = RunOf(stretch, bend);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Diverged), run.Reason);
            Assert.That(run.Reason, Does.Contain("wrong in length"));
        }

        [TestCase(1.98, 0.1)]
        [TestCase(0.1, 10.0)]
        public void GainWithinItsLimit_IsNotDiverged(double stretch, double bend) =>
            Assert.That(RunOf(stretch, bend).Outcome, Is.EqualTo(Outcome.Finished));

        private static Simulation RunOf(double stretch, double bend)
        {
            SimulationParameters parameters = Wires.Transversal(1000);
            parameters.Pbd.StretchStiffness = stretch;
            parameters.Pbd.BendStiffness = bend;
            return Wires.Run(parameters);
        }

        [Test]
        public void VelocityBeyondAllNumbers_IsDiverged()
        {
            // A correction of units in the shortest step that a double can hold.
            SimulationParameters parameters = Wires.Transversal(10);
            parameters.Method.TimeStep = 2.3e-308;
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Diverged));
            Assert.That(run.Reason, Does.Contain("no finite velocity"));
        }

        [Test]
        public void LongitudinalMotion_BreaksDownBeyond213()
        {
            SimulationParameters held = Wires.Longitudinal(600);
            held.Pbd.StretchStiffness = 2.12;
            Assert.That(Wires.Run(held).Outcome, Is.EqualTo(Outcome.Finished));
            SimulationParameters lost = Wires.Longitudinal(600);
            lost.Pbd.StretchStiffness = 2.14;
            Assert.That(Wires.Run(lost).Outcome, Is.EqualTo(Outcome.Diverged));
        }

        // Few sweeps and a displacement of ten element lengths make a wire that swings for long, but recovers.
        [TestCase(500, 600, Category = "Long")]
        [TestCase(10, 4000)]
        [TestCase(3, 4000)]
        [TestCase(1, 4000)]
        public void LargeDisplacement_IsNotDiverged(int iterations, int steps)
        {
            foreach (Vector3d direction in new[] { Vector3d.UnitY, Vector3d.UnitZ })
            {
                SimulationParameters parameters = Wires.Transversal(steps);
                parameters.Drive.DisplacementDirection = direction;
                parameters.Drive.Displacement = 100.0;
                parameters.Method.ConstraintSolverSteps = iterations;
                Simulation run = Wires.Finish(parameters);
            }
        }

        [Test]
        public void WireThatHardlyMoves_IsNotCalledSteady_WhileItsElementsAreWrongInLength()
        {
            SimulationParameters parameters = Wires.Longitudinal(400);
            parameters.Method.DeltaThreshold = 0.001;
            parameters.Pbd.StretchStiffness = 1e-4;
            parameters.Method.ConstraintSolverSteps = 1;
            Assert.That(Wires.Run(parameters).Outcome, Is.Not.EqualTo(Outcome.Converged));
        }

        [Test]
        public void NumberThatIsNotFinite_IsDiverged()
        {
            Simulation run = Simulation.Create(Wires.Longitudinal(100));
            run.State.Velocities[7] = new Vector3d(double.NaN, 0.0, 0.0);
            run.Step();
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Diverged));
            Assert.That(run.Reason, Does.Contain("no finite position"));
        }

        [Test]
        public void EndedRun_TakesNoFurtherStep()
        {
            Simulation run = Wires.Run(Wires.Longitudinal(5));
            run.Step();
            Assert.That(run.StepCount, Is.EqualTo(5));
        }
    }
}

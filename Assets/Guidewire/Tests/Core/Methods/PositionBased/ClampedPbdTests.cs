using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Wires with gains whose ends are clamped: sphere and frame are held, and nothing else changes.</summary>
    [Category("Target")]
    public sealed class ClampedPbdTests
    {
        [TestCase(SweepOrder.Naive, 8)]
        [TestCase(SweepOrder.Bilateral, 12, Category = "Long")]
        public void TwistOfATurnedEnd_IsLinearAtRest(SweepOrder order, int n)
        {
            // At rest no element is turned by a sweep. An inner joint turns either element by half of g E, one at a
            // held frame its free element by all of it, g = 2 bendStiffness/l: so E is the same in all inner joints and
            // half of that in the first and the last. What a sweep changes under way is of the order of g.
            const double Turn = 0.5 * Math.PI;
            const double Gain = 0.004;
            SimulationParameters parameters = Clamped(n, Turn, 0.2, 1500);
            parameters.Method.ConstraintSolverSteps = 1000;
            parameters.Pbd.BendStiffness = 0.5 * Gain * parameters.Scene.GuidewireLength / n;
            parameters.Method.SweepOrder = order;
            RodState state = Wires.Run(parameters).State;
            for (int j = 1; j < n - 1; j++)
            {
                Quaterniond q = state.Orientations[j];
                double fraction = Turn / (n - 2);
                Assert.That(2.0 * Math.Atan2(q.Z, q.W), Is.EqualTo((j - 0.5) * fraction).Within(2.0 * Gain * fraction),
                    "element " + j);
                Assert.That(Vector3d.Distance(q.Director3, Vector3d.UnitZ), Is.LessThan(1e-9));
            }
        }

        [Test]
        public void ClampedEnds_AreWhereTheyArePrescribed_InEveryStep()
        {
            SimulationParameters parameters = Clamped(10, -2.0, 0.5, 120);
            parameters.Scene.Gravity = new Vector3d(0.0, -50.0, 0.0);
            parameters.Scene.DistalDisplacement = -8.0;
            Simulation run = Simulation.Create(parameters);
            while (run.Outcome == Outcome.Running)
            {
                run.Step();
                double part = Math.Min(1.0, run.Time / 0.5);
                var turn = Quaterniond.FromAxisAngle(Vector3d.UnitZ, -2.0 * part);
                RodState state = run.State;
                Assert.That(Vector3d.Distance(state.Positions[0], new Vector3d(0.0, 0.0, -120.0)), Is.Zero);
                Assert.That(state.Orientations[0], Is.EqualTo(Quaterniond.Identity));
                Assert.That(Vector3d.Distance(state.Positions[10], new Vector3d(0.0, 0.0, 180.0 - 8.0 * part)),
                    Is.LessThan(1e-12));
                Assert.That(RotationVector.Log(turn.Conjugate * state.Orientations[9]).Length, Is.LessThan(1e-12));
            }
            Assert.That(run.State.Positions[5].Y, Is.LessThan(-0.1), "the middle sags");
        }

        [Test]
        public void ClampedWire_IsStiffer_ThanOneThatIsHeldByItsSphere()
        {
            // Held by its sphere alone the wire turns about it like a pendulum and hangs down.
            SimulationParameters clamped = Clamped(10, 0.0, 0.0, 300);
            clamped.Scene.DistalEnd = DistalEnd.Free;
            clamped.Scene.Gravity = new Vector3d(0.0, -50.0, 0.0);
            SimulationParameters held = Clamped(10, 0.0, 0.0, 300);
            held.Scene.ProximalEnd = ProximalEnd.Held;
            held.Scene.DistalEnd = DistalEnd.Free;
            held.Scene.Gravity = clamped.Scene.Gravity;
            double stiff = Wires.Run(clamped).State.Positions[1].Y;
            double loose = Wires.Run(held).State.Positions[1].Y;
            Assert.That(stiff, Is.LessThan(0.0).And.GreaterThan(0.2 * loose));
        }

        [Test]
        public void OneElementBetweenTwoClamps_StaysAsItIs()
        {
            Simulation run = Wires.Run(Clamped(1, 0.5, 0.0, 20));
            Assert.That(Wires.IsFinite(run.State), Is.True);
            Assert.That(run.State.Positions[1], Is.EqualTo(new Vector3d(0.0, 0.0, 180.0)));
        }

        [Test]
        public void RunThatGoesOn_EndsWhereTheUnbrokenOneDoes()
        {
            SimulationParameters whole = Clamped(8, 1.5, 0.6, 90);
            RodState unbroken = Wires.Run(whole).State;
            Simulation first = Wires.Run(Clamped(8, 1.5, 0.6, 30));
            Simulation second = first.Continue(Clamped(8, 1.5, 0.6, 90));
            Wires.Run(second);
            for (int j = 0; j < 8; j++)
            {
                Quaterniond turn = unbroken.Orientations[j].Conjugate * second.State.Orientations[j];
                Assert.That(RotationVector.Log(turn).Length, Is.LessThan(1e-9), "element " + j);
            }
        }

        private static SimulationParameters Clamped(int n, double turn, double ramp, int steps)
        {
            SimulationParameters parameters = Wires.Longitudinal(steps);
            parameters.Scene.NumberRodElements = n;
            parameters.Drive.Displacement = 0.0;
            parameters.Method.ConstraintSolverSteps = 100;
            parameters.Pbd.BendStiffness = 0.5;
            parameters.Scene.ProximalEnd = ProximalEnd.Clamped;
            parameters.Scene.DistalEnd = DistalEnd.Clamped;
            parameters.Scene.DistalRotation = turn;
            parameters.Scene.DistalRampTime = ramp;
            return parameters;
        }
    }
}

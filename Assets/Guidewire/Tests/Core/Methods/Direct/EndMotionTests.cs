using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Ends that are moved in six degrees of freedom.</summary>
    public sealed class EndMotionTests
    {
        private const int Elements = 12;

        [TestCase(0.3, 0.2, -0.1)]
        [TestCase(2.0, -1.0, 2.5)]
        [TestCase(1e-5, 0.0, 2e-5)]
        public void AngularVelocity_IsTheRateOfTheRotation(double x, double y, double z)
        {
            var motion = new EndMotion(new[] { 0.0, 1.0, 2.0 }, new Vector3d[3],
                new[] { Vector3d.Zero, new Vector3d(x, y, z), new Vector3d(z, -x, 0.5 * y) });
            foreach (double time in new[] { 0.25, 1.5 })
            {
                const double H = 1e-5;
                Quaterniond change = motion.RotationAt(time + H) * motion.RotationAt(time - H).Conjugate;
                Vector3d rate = RotationVector.Log(change) / (2.0 * H);
                Assert.That((rate - motion.AngularVelocityAt(time)).Length, Is.LessThan(1e-8 * (1.0 + rate.Length)));
            }
        }

        [TestCase(Integrator.Esdirk3, 1e-3)]
        [TestCase(Integrator.Bdf2, 1e-3)]
        [TestCase(Integrator.ImplicitEuler, 4e-3)]
        public void BothEndsMovedAlike_MoveTheWireAsARigidBody(Integrator integrator, double timeStep)
        {
            // A rotation about the proximal end, then nothing: once it is at rest the wire is straight, turned and
            // displaced with its ends. The distal end goes (R - 1) L e3 farther.
            var rotation = new Vector3d(0.9, -0.5, 1.4);
            var shift = new Vector3d(0.03, -0.02, 0.05);
            SimulationParameters parameters = Base(integrator, timeStep, 0.8);
            parameters.Material.MassDamping = 60.0;
            const int Rows = 41;
            var times = new double[Rows];
            var first = new Vector3d[Rows];
            var last = new Vector3d[Rows];
            var turns = new Vector3d[Rows];
            for (int i = 0; i < Rows; i++)
            {
                double t = i / (Rows - 1.0);
                times[i] = 0.3 * t;
                turns[i] = t * rotation;
                first[i] = t * shift;
                last[i] = first[i] + 0.3 * (RotationVector.Exp(turns[i]).Director3 - Vector3d.UnitZ);
            }
            parameters.Scene.ProximalMotion = new EndMotion(times, first, turns);
            parameters.Scene.DistalMotion = new EndMotion(times, last, turns);
            parameters.Scene.DistalEnd = DistalEnd.Clamped;
            Simulation simulation = Wires.Finish(parameters);
            Quaterniond turned = RotationVector.Exp(rotation);
            for (int i = 0; i <= Elements; i++)
            {
                Vector3d expected = 1e3 * (shift + (0.3 * i / Elements) * turned.Director3);
                Assert.That(Vector3d.Distance(simulation.State.Positions[i], expected), Is.LessThan(0.01), "node " + i);
            }
            Quaterniond between = turned.Conjugate * simulation.State.Orientations[Elements / 2];
            Assert.That(between.Imaginary.Length, Is.LessThan(1e-4));
        }

        [Test]
        public void EndsMovedAsByKeys_GiveTheirMotion()
        {
            // distalDisplacement and distalRotation over a ramp are the same motion along the axis and about it.
            SimulationParameters byKeys = Base(Integrator.Esdirk3, 1e-3, 0.05);
            byKeys.Scene.DistalEnd = DistalEnd.Clamped;
            byKeys.Scene.DistalDisplacement = -3.0;
            byKeys.Scene.DistalRotation = 2.0;
            byKeys.Scene.DistalRampTime = 0.04;
            byKeys.Scene.Gravity = new Vector3d(1.0, -9.81, 0.0);
            SimulationParameters byMotion = byKeys.Copy();
            byMotion.Scene.DistalDisplacement = 0.0;
            byMotion.Scene.DistalRotation = 0.0;
            byMotion.Scene.DistalMotion = new EndMotion(new[] { 0.0, 0.04 },
                new[] { Vector3d.Zero, new Vector3d(0.0, 0.0, -3e-3) },
                new[] { Vector3d.Zero, new Vector3d(0.0, 0.0, 2.0) });
            Simulation one = Wires.Run(byKeys);
            Simulation other = Wires.Run(byMotion);
            Assert.That(one.Outcome, Is.EqualTo(Outcome.Finished), one.Reason);
            Assert.That(other.Outcome, Is.EqualTo(Outcome.Finished), other.Reason);
            Assert.That(Wires.Distance(one.State, other.State), Is.LessThan(1e-6));
        }

        [Test]
        public void ClampSwungSideways_SwingsTheWireAsItsAcceleration()
        {
            // In the frame of a clamp that is displaced by a t^2/2 sideways the wire has the weight -a: the same wire
            // under that weight, from rest, in 100 rows of even velocity, each a step.
            const double A = 5.0;
            SimulationParameters moved = Base(Integrator.Esdirk3, 5e-4, 0.05);
            const int Rows = 101;
            var times = new double[Rows];
            var x = new Vector3d[Rows];
            for (int i = 0; i < Rows; i++)
            {
                times[i] = 5e-4 * i;
                x[i] = new Vector3d(0.5 * A * times[i] * times[i], 0.0, 0.0);
            }
            moved.Scene.ProximalMotion = new EndMotion(times, x, new Vector3d[Rows]);
            SimulationParameters weighted = Base(Integrator.Esdirk3, 5e-4, 0.05);
            weighted.Scene.Gravity = new Vector3d(-A, 0.0, 0.0);
            Simulation one = Wires.Run(moved);
            Simulation other = Wires.Run(weighted);
            Assert.That(one.Outcome, Is.EqualTo(Outcome.Finished), one.Reason);
            double own = one.State.Positions[Elements].X - 1e3 * x[Rows - 1].X;
            Assert.That(own / other.State.Positions[Elements].X, Is.EqualTo(1.0).Within(0.01));
        }

        [Test]
        public void Motion_ThatHasNoEndToMove_IsRefused()
        {
            var motion = new EndMotion(new[] { 0.0, 1.0 }, new Vector3d[2], new[] { Vector3d.Zero, Vector3d.UnitX });
            SimulationParameters free = Base(Integrator.Esdirk3, 1e-3, 0.1);
            free.Scene.DistalMotion = motion;
            Assert.That(ParameterConflict.FindInScene(free)!.Key, Is.EqualTo("distalMotionFile"));
            free.Scene.DistalEnd = DistalEnd.Held;
            Assert.That(ParameterConflict.FindInScene(free)!.Needed, Does.Contain("rotations of 0"));
            free.Scene.DistalEnd = DistalEnd.Clamped;
            Assert.That(ParameterConflict.FindInScene(free), Is.Null);
            free.Method.Solver = Solver.Explicit;
            Assert.That(ParameterConflict.FindInScene(free)!.Key, Is.EqualTo("distalMotionFile"));
        }

        private static SimulationParameters Base(Integrator integrator, double timeStep, double duration)
        {
            SimulationParameters parameters = SimulationParameters.DefaultsOf(Solver.Direct);
            parameters.Scene.NumberRodElements = Elements;
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.ProximalEnd = ProximalEnd.Clamped;
            parameters.Method.Integrator = integrator;
            parameters.Method.TimeStep = timeStep;
            parameters.Method.DeltaThreshold = 0.0;
            parameters.Method.MaxSimulationSteps = (int)Math.Round(duration / timeStep);
            return parameters;
        }
    }
}

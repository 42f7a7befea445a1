using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Euler's and Verlet's formula for orientations.</summary>
    [Category("Target")]
    public sealed class OrientationPredictionTests
    {
        [TestCase(0.01)]
        [TestCase(0.1)]
        public void EvenSpin_IsContinued_WithTheFormulasOwnError(double turn)
        {
            // The last turn by the angle a: v = sin(a/2), w = cos(a/2). Euler goes on by 2 atan(v), Verlet by
            // 2 atan(v/(2 - w)); both miss a in third order.
            Quaterniond before = Quaterniond.FromAxisAngle(Vector3d.Normalize(new Vector3d(1.0, 2.0, -1.0)), 0.7);
            Quaterniond step = Quaterniond.FromAxisAngle(Vector3d.UnitX, turn);
            var state = new RodState(1, 1.0, 1.0, 0.0);
            var verlet = new OrientationVerletPrediction(1);
            state.Orientations[0] = before;
            verlet.Predict(state, 1.0);
            state.Orientations[0] = before * step;
            state.AngularVelocities[0] = 2.0 * Math.Sin(0.5 * turn) * Vector3d.UnitX;
            verlet.Predict(state, 1.0);
            double byVerlet = Turned(state);
            new OrientationEulerPrediction().Predict(state, 1.0);
            double byEuler = Turned(state);
            double v = Math.Sin(0.5 * turn);
            double w = Math.Cos(0.5 * turn);
            Assert.That(byEuler, Is.EqualTo(2.0 * Math.Atan(v)).Within(1e-12));
            Assert.That(byVerlet, Is.EqualTo(2.0 * Math.Atan(v / (2.0 - w))).Within(1e-12));
            Assert.That(Math.Abs(byVerlet - byEuler), Is.LessThan(0.13 * turn * turn * turn));
            Assert.That(Math.Abs(byVerlet - byEuler), Is.GreaterThan(0.1 * turn * turn * turn));
        }

        [Test]
        public void OppositeSigns_AreTheSameOrientation()
        {
            var state = new RodState(1, 1.0, 1.0, 0.0);
            var verlet = new OrientationVerletPrediction(1);
            Quaterniond first = Quaterniond.FromAxisAngle(Vector3d.UnitY, 0.3);
            Quaterniond second = Quaterniond.FromAxisAngle(Vector3d.UnitY, 0.31);
            state.Orientations[0] = first;
            verlet.Predict(state, 1.0);
            state.Orientations[0] = -1.0 * second;
            verlet.Predict(state, 1.0);
            Quaterniond expected = Quaterniond.FromAxisAngle(Vector3d.UnitY, 0.32);
            Assert.That(RotationVector.Log(expected.Conjugate * state.PredictedOrientations[0]).Length,
                Is.LessThan(1e-6));
        }

        [TestCase(Integrator.Verlet, Integrator.OrientationVerlet)]
        [TestCase(Integrator.Euler, Integrator.EulerOrientationVerlet)]
        public void DifferenceBetweenThem_IsOfThirdOrderInTheDisplacement(Integrator euler, Integrator verlet)
        {
            double small = Difference(euler, verlet, 0.5);
            double large = Difference(euler, verlet, 1.0);
            Assert.That(Math.Log(large / small) / Math.Log(2.0), Is.EqualTo(3.0).Within(0.1));
        }

        private static double Difference(Integrator euler, Integrator verlet, double displacement)
        {
            SimulationParameters a = Wires.Transversal(50);
            a.Method.Integrator = euler;
            a.Drive.Displacement = displacement;
            SimulationParameters b = Wires.Transversal(50);
            b.Method.Integrator = verlet;
            b.Drive.Displacement = displacement;
            return Wires.Distance(Wires.Run(a).State, Wires.Run(b).State);
        }

        private static double Turned(RodState state) =>
            RotationVector.Log(state.Orientations[0].Conjugate * state.PredictedOrientations[0]).X;
    }
}

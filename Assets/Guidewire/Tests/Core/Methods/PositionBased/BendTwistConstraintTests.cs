using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    [Category("Target")]
    public sealed class BendTwistConstraintTests
    {
        private const double Length = 10.0;
        private static readonly int[] OneJoint = { 0 };

        [TestCase(1.0)]
        [TestCase(0.1)]
        public void BendTwist_ActsWithTwiceItsGainOverTheLength(double gain)
        {
            // For a small angle phi one projection leaves phi (1 - 2 gain/l): at gain = l it is thrown to -phi.
            const double Angle = 1e-4;
            RodState state = Bent(Vector3d.Normalize(new Vector3d(1.0, 2.0, -3.0)), Angle);
            new BendTwistConstraint(state, gain).Iterate(state.Orientations, OneJoint);
            double left = Length * DarbouxVector(state).Length;
            Assert.That(left / Angle, Is.EqualTo(1.0 - 2.0 * gain / Length).Within(1e-7));
        }

        [Test]
        public void BendTwist_LeavesARestShapeAlone_ForEitherSignOfItsQuaternions()
        {
            RodState state = Bent(Vector3d.UnitY, 0.8);
            state.RestDarbouxVectors[0] = DarbouxVector(state);
            Quaterniond rest = state.Orientations[1];
            foreach (double sign in new[] { 1.0, -1.0 })
            {
                state.Orientations[1] = sign * rest;
                new BendTwistConstraint(state, 1.0).Iterate(state.Orientations, OneJoint);
                Quaterniond turn = state.Orientations[1].Conjugate * (sign * rest);
                Assert.That(turn.Imaginary.Length, Is.LessThan(1e-15), "sign " + sign);
            }
        }

        [Test]
        public void BendTwist_MovesOnlyTheFreeOrientation()
        {
            RodState state = Bent(Vector3d.UnitX, 0.3);
            state.OrientationWeights[0] = 0.0;
            new BendTwistConstraint(state, 0.5).Iterate(state.Orientations, OneJoint);
            Assert.That(state.Orientations[0], Is.EqualTo(Quaterniond.Identity));
            Assert.That(state.Orientations[1].X, Is.LessThan(Math.Sin(0.15)));
        }

        private static Vector3d DarbouxVector(RodState state) =>
            2.0 / Length * (state.Orientations[0].Conjugate * state.Orientations[1]).Imaginary;

        private static RodState Bent(in Vector3d axis, double angle)
        {
            var state = new RodState(2, 2.0 * Length, 1.0, 0.0);
            state.Orientations[1] = Quaterniond.FromAxisAngle(axis, angle);
            return state;
        }
    }
}

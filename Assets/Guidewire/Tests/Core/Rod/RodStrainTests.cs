using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    public sealed class RodStrainTests
    {
        private const int Elements = 20;
        private const double Length = 5.0;    // units, of an element

        /// <summary>A helix-like wire: turned by bend about x and by twist about z from element to element.</summary>
        private static RodState Turned(double bend, double twist)
        {
            var state = new RodState(Elements, Elements * Length, 1.0, 0.0);
            Quaterniond step = Quaterniond.FromAxisAngle(Vector3d.UnitX, bend)
                * Quaterniond.FromAxisAngle(Vector3d.UnitZ, twist);
            for (int j = 1; j < Elements; j++)
            {
                // Every other one with its sign turned: the same orientation.
                Quaterniond next = Quaterniond.Normalize(state.Orientations[j - 1] * step);
                state.Orientations[j] = j % 2 == 0 ? next : -1.0 * next;
            }
            return state;
        }

        [Test]
        public void BentWire_HasItsCurvatureAndNoTwist()
        {
            const double angle = 0.1;
            RodState state = Turned(angle, 0.0);
            for (int i = 1; i < Elements; i++)
            {
                Assert.That(RodStrain.Curvature(state, i),
                    Is.EqualTo(2.0 * Math.Sin(0.5 * angle) / Length).Within(1e-12));
                Assert.That(RodStrain.Twist(state, i), Is.EqualTo(0.0).Within(1e-12));
            }
        }

        [TestCase(0.1)]
        [TestCase(-0.1)]
        public void TwistedWire_HasItsTwistWithItsSign(double angle)
        {
            RodState state = Turned(0.0, angle);
            for (int i = 1; i < Elements; i++)
            {
                Assert.That(RodStrain.Twist(state, i), Is.EqualTo(2.0 * Math.Sin(0.5 * angle) / Length).Within(1e-12));
                Assert.That(RodStrain.Curvature(state, i), Is.EqualTo(0.0).Within(1e-12));
            }
        }

        [Test]
        public void BothEnds_HaveNeither()
        {
            RodState state = Turned(0.1, 0.1);
            foreach (int end in new[] { 0, Elements })
            {
                Assert.That(RodStrain.Curvature(state, end), Is.EqualTo(0.0));
                Assert.That(RodStrain.Twist(state, end), Is.EqualTo(0.0));
            }
        }

        [Test]
        public void StretchedElement_ShowsAtItsTwoSpheres()
        {
            RodState state = Turned(0.0, 0.0);
            for (int i = 6; i <= Elements; i++)
            {
                state.Place(i, state.Positions[i] + new Vector3d(0.0, 0.0, 0.5));
            }
            Assert.That(RodStrain.Stretch(state, 5), Is.EqualTo(0.05).Within(1e-12), "half of 0.5/5");
            Assert.That(RodStrain.Stretch(state, 6), Is.EqualTo(0.05).Within(1e-12));
            Assert.That(RodStrain.Stretch(state, 4), Is.EqualTo(0.0).Within(1e-12));
            Assert.That(RodStrain.Stretch(state, 0), Is.EqualTo(0.0).Within(1e-12));
        }
    }
}

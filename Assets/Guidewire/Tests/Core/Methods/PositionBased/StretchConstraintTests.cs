using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    [Category("Target")]
    public sealed class StretchConstraintTests
    {
        private static readonly int[] OneElement = { 0 };

        [Test]
        public void Stretch_RemovesItsErrorToFirstOrder_WithGainOne()
        {
            // A projection with gain 1 is one Newton step on C = 0: what remains is of second order in C. Across the
            // element only: along it the orientation's part of the correction is a change of |q|, which is taken out.
            var state = new RodState(1, 10.0, 2.0, 0.0);
            foreach (double size in new[] { 1e-2, 1e-3, 1e-4 })
            {
                state.Positions[0] = Vector3d.Zero;
                state.Positions[1] = new Vector3d(3.0 * size, -2.0 * size, 10.0);
                state.Orientations[0] = Quaterniond.Normalize(new Quaterniond(size, 0.0, -size, 1.0));
                new StretchConstraint(state, 1.0).Iterate(state.Positions, state.Orientations, OneElement);
                Assert.That(StretchConstraint.Residual(state, 0).Length, Is.LessThan(20.0 * size * size),
                    "size " + size);
            }
        }

        [Test]
        public void Stretch_KeepsCentreOfMass_WhenNoSphereIsHeld()
        {
            var state = new RodState(12, 300.0, 0.5, 0.0);
            Wires.Load(state, Wires.Random(12, 300.0, 5));
            Vector3d before = Sum(state.Positions);
            new StretchConstraint(state, 0.7).Iterate(state.Positions, state.Orientations,
                IterationOrders.Indices(SweepOrder.Naive, 12));
            Assert.That(Vector3d.Distance(before, Sum(state.Positions)), Is.LessThan(1e-10 * before.Length));
        }

        [Test]
        public void Stretch_SplitsItsCorrectionByWeight()
        {
            // Purely along the element nothing turns, and dx_0 : dx_1 = w_0 : -w_1, with D = w_0 + w_1 + 4 w_q l^2.
            var state = new RodState(1, 10.0, 2.0, 0.0);
            state.InverseMasses[0] = 3.0;
            state.InverseMasses[1] = 5.0;
            state.Positions[1] = new Vector3d(0.0, 0.0, 12.0);
            new StretchConstraint(state, 0.5).Iterate(state.Positions, state.Orientations, OneElement);
            double fraction = 0.5 * 10.0 * 0.2 / (3.0 + 5.0 + 400.0);
            Assert.That(state.Positions[0].Z, Is.EqualTo(3.0 * fraction).Within(1e-15));
            Assert.That(state.Positions[1].Z, Is.EqualTo(12.0 - 5.0 * fraction).Within(1e-14));
            Assert.That(state.Orientations[0], Is.EqualTo(Quaterniond.Identity));
        }

        [Test]
        public void Sweep_ReturnsUnitOrientations()
        {
            var state = new RodState(20, 300.0, 0.01, 0.0);
            Wires.Load(state, Wires.Random(20, 300.0, 9));
            new StretchConstraint(state, 0.9).Iterate(state.Positions, state.Orientations,
                IterationOrders.Indices(SweepOrder.Naive, 20));
            foreach (Quaterniond q in state.Orientations)
            {
                Assert.That(Math.Abs(q.LengthSquared - 1.0), Is.LessThan(1e-14));
            }
        }

        private static Vector3d Sum(Vector3d[] positions)
        {
            Vector3d sum = Vector3d.Zero;
            foreach (Vector3d x in positions)
            {
                sum += x;
            }
            return sum;
        }
    }
}

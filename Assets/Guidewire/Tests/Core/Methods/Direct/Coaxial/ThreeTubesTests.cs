using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Rest shapes of three coaxial instruments against closed forms and against two.</summary>
    public sealed class ThreeTubesTests
    {
        [TestCase(0.0, 0.0)]
        [TestCase(0.9, -1.4)]
        [TestCase(2.2, 0.7)]
        public void Curvature_IsTheMeanByStiffness_WhereTwistIsStiff(double second, double third)
        {
            // GJ/EI = 1e4: the angles are those of the hubs all along, to 1/2 c L^2 ~ 1e-4.
            double[] bends = { 1.0, 0.5, 0.25 };
            double[] curvatures = { 1.2, 0.8, 1.5 };
            CoaxialPair tubes = ThreeTubes.Even(10, -0.9999, bends, curvatures);
            double[] turns = { 0.0, second, third };
            tubes.Solve(turns);
            Vector3d mean = Vector3d.Zero;
            for (int i = 0; i < 3; i++)
            {
                mean += bends[i] * curvatures[i] / 1.75 * new Vector3d(Math.Cos(turns[i]), Math.Sin(turns[i]), 0.0);
            }
            for (int k = 1; k < 10; k++)
            {
                Vector3d found = 10.0 * tubes.Bending.TurnOf(tubes.Shape, k);
                Assert.That((found - mean).Length, Is.LessThan(5e-4 * 1.2), "joint " + k);
            }
        }

        [Test]
        public void RigidStraightTubeAround_KeepsBothInsideStraight()
        {
            // And its hub has the rest: each inner one's couple B_i kappa_i, which end at the tip.
            CoaxialPair tubes = ThreeTubes.Even(10, 0.3, new[] { 1e7, 1.0, 0.6 }, new[] { 0.0, 1.1, -0.7 });
            tubes.Solve(new[] { 0.0, 0.4, 1.9 });
            Vector3d tip = tubes.Shape.X[10];
            Assert.That(Math.Sqrt(tip.X * tip.X + tip.Y * tip.Y), Is.LessThan(2e-7));
            double held = 0.5 * (1.0 * 1.1 * 1.1 + 0.6 * 0.7 * 0.7);
            Assert.That(tubes.Bending.Value(tubes.Shape), Is.EqualTo(held).Within(1e-6 * held));
        }

        [Test]
        public void ThreeTubesOfOneKind_AreOneOfTripleStiffness()
        {
            var force = new Vector3d(0.3, -0.4, 0.1);
            CoaxialPair three = ThreeTubes.Even(12, 0.3, new[] { 0.4, 0.4, 0.4 }, new[] { 1.3, 1.3, 1.3 });
            three.TipForce = force;
            three.Solve(new double[3]);
            CoaxialPair.Piece[] half = { new CoaxialPair.Piece(1.0, 0.6, 1.3) };
            var two = new CoaxialPair(new[] { half, half }, new[] { 12, 12 }, 0.3, new double[2], new int[2],
                1.5 * CoaxialPair.Stretch) { TipForce = force };
            two.Solve(0.0);
            // Both to where the search for the rest shape ends.
            Assert.That(Wires.Distance(three.Shape.X, two.Shape.X), Is.LessThan(1e-8));
            Assert.That(three.Bending.InnerTorque(three.Shape, 2),
                Is.EqualTo(three.Bending.InnerTorque(three.Shape, 1)).Within(1e-8), "torques of both inside");
        }

        // Of three, one of no stiffness changes nothing: the others are as they are without it, with the same nodes.
        [TestCase(1)]
        [TestCase(2)]
        public void TubeWithoutStiffness_LeavesTheOtherTwoAsTheyAre(int soft)
        {
            double[] bends = { 1.0, 0.6, 0.35 };
            double[] curvatures = { 1.0, -0.7, 1.4 };
            double[] turns = { 0.0, 0.7, -1.1 };
            bends[soft] *= 1e-7;
            int inner = soft == 2 ? 1 : 2;
            CoaxialPair three = ThreeTubes.Even(12, 0.3, bends, curvatures);
            three.Solve(new[] { 0.0, turns[1], turns[2] });
            CoaxialPair two = Pair(12, 0.3, bends[0], curvatures[0], bends[inner], curvatures[inner]);
            two.Solve(turns[inner]);
            Assert.That(Wires.Distance(three.Shape.X, two.Shape.X), Is.LessThan(1e-6));
            double torque = three.Bending.InnerTorque(three.Shape, inner);
            Assert.That(torque, Is.EqualTo(two.Torque).Within(1e-6), "torque of the inner one");
        }

        // The same three in another order: they differ by what the elements' own frames make of a turn, which falls
        // with the square of their length.
        [Test]
        public void OrderOfTheTubes_ChangesNothing_ButInSecondOrder()
        {
            double coarse = DifferenceByOrder(10, out double torque);
            double fine = DifferenceByOrder(20, out double fineTorque);
            TestContext.WriteLine("{0:G3} {1:G3} of L, {2:G3} {3:G3} N m", coarse, fine, torque, fineTorque);
            Assert.That(fine, Is.LessThan(0.3 * coarse));
            Assert.That(Math.Max(torque, fineTorque), Is.LessThan(1e-12));
        }

        private static double DifferenceByOrder(int n, out double torque)
        {
            double[] bends = { 1.0, 0.6, 0.35 };
            double[] curvatures = { 1.0, -0.7, 1.4 };
            double[] turns = { 0.0, 0.9, -0.6 };
            CoaxialPair one = ThreeTubes.Even(n, 0.3, bends, curvatures);
            one.Solve(turns);
            int[] order = { 1, 2, 0 };
            CoaxialPair other = ThreeTubes.Even(n, 0.3, Array.ConvertAll(order, i => bends[i]),
                Array.ConvertAll(order, i => curvatures[i]));
            other.Solve(Array.ConvertAll(order, i => turns[i] - turns[1]));
            double worst = 0.0;
            double c = Math.Cos(turns[1]);
            double s = Math.Sin(turns[1]);
            for (int i = 0; i <= n; i++)
            {
                Vector3d x = other.Shape.X[i];
                var expected = new Vector3d(c * x.X - s * x.Y, s * x.X + c * x.Y, x.Z);
                worst = Math.Max(worst, (one.Shape.X[i] - expected).Length);
            }
            torque = Math.Abs(other.Bending.InnerTorque(other.Shape, 1) - one.Bending.InnerTorque(one.Shape, 2));
            return worst;
        }

        [TestCase(0)]
        [TestCase(1)]
        [TestCase(2)]
        public void Stability_EndsAtHalfPi_InSecondOrder_WithAThirdTubeStraight(int straight) =>
            // The straight one adds to the stiffness that both others have to bend: c = k^2 b1 b2/B (1/C1 + 1/C2).
            CoaxialPair.AssertSecondOrder(n => Threshold(n, straight) - 1.0);

        [TestCase(0)]
        [TestCase(1)]
        [TestCase(2)]
        [TestCase(3)]
        public void HubForcesAndTorques_AreTheDifferencesOfTheEnergy(int order)
        {
            // Of the energy at rest, where the shape does not count.
            double[] turns = { 0.0, 0.7, -0.5 };
            CoaxialPair tubes = ThreeTubes.Mixed(order);
            tubes.Solve(turns);
            double energy = tubes.Terms.Potential(tubes.Shape);
            for (int i = 1; i < 3; i++)
            {
                const double step = 1e-4;
                double torque = tubes.Bending.InnerTorque(tubes.Shape, i);
                double ahead = EnergyAt(order, turns, i, step, 0.0);
                double back = EnergyAt(order, turns, i, -step, 0.0);
                Assert.That((ahead - back) / (2.0 * step), Is.EqualTo(torque).Within(1e-5), "torque " + i);
                double force = tubes.Terms.Release!.InnerForce(tubes.Shape, tubes.Terms, i);
                double on = EnergyAt(order, turns, i, 0.0, 1e-5);
                double off = EnergyAt(order, turns, i, 0.0, -1e-5);
                Assert.That((on - off) / 2e-5, Is.EqualTo(force).Within(1e-3 * Math.Abs(force) + 1e-5), "force " + i);
            }
            Assert.That(energy, Is.GreaterThan(0.05));
        }

        private static double EnergyAt(int order, double[] turns, int instrument, double turn, double on)
        {
            CoaxialPair tubes = ThreeTubes.Mixed(order);
            double[] leads = { 0.0, tubes.Coaxial.Joints.LeadOf(1), tubes.Coaxial.Joints.LeadOf(2) };
            leads[instrument] -= on;
            tubes.Coaxial.SetHubs(leads, 0.0);
            var turned = (double[])turns.Clone();
            turned[instrument] += turn;
            tubes.Solve(turned);
            return tubes.Terms.Potential(tubes.Shape);
        }

        private static CoaxialPair Pair(int n, double nu, double outer, double outerCurvature, double inner,
            double innerCurvature)
        {
            return new CoaxialPair(new[] { new CoaxialPair.Piece(1.0, outer, outerCurvature) }, n,
                new[] { new CoaxialPair.Piece(1.0, inner, innerCurvature) }, n, nu, 0.0);
        }

        // L sqrt(c)/(pi/2) at which two tubes opposite to one another snap, the third one straight.
        private static double Threshold(int n, int straight)
        {
            double[] bends = { 1.0, 0.7, 0.5 };
            int outer = straight == 0 ? 1 : 0;
            int inner = straight == 2 ? 1 : 2;
            double sum = bends[0] + bends[1] + bends[2];
            double perSquare = bends[outer] * bends[inner] / sum * 1.3 * (1.0 / bends[outer] + 1.0 / bends[inner]);
            double limit = Bisection.Limit(0.5, 2.5, root =>    // sqrt(c)
            {
                double k = root / Math.Sqrt(perSquare);
                double[] curvatures = { k, k, k };
                curvatures[straight] = 0.0;
                double[] turns = new double[3];
                turns[inner] = Math.PI;
                return ThreeTubes.Even(n, 0.3, bends, curvatures).IsStable(turns);
            }, 40);
            return limit / (0.5 * Math.PI);
        }
    }
}

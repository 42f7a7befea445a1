using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Contact of a wire with itself: derivatives against differences, search against all pairs, motion
    /// against samples of the path.</summary>
    public sealed class SelfContactTests
    {
        private const int N = 14;
        private const double Radius = 0.1;
        private const double Range = 0.02;    // of the barrier

        // The first and the last element: where they meet, by the ends of the last relative to the middle of the first.
        private static readonly object[] Meetings =
        {
            new object[] { "crossing within both", new Vector3d(-0.4, 0.21, -0.3), new Vector3d(0.3, 0.212, 0.4) },
            new object[] { "at an angle of 0.02", new Vector3d(-0.008, 0.212, -0.4), new Vector3d(0.007, 0.21, 0.35) },
            new object[] { "parallel", new Vector3d(0.0, 0.211, -0.3), new Vector3d(0.0, 0.211, 0.45) },
            new object[] { "its node beside the first", new Vector3d(0.01, 0.212, 0.1), new Vector3d(0.2, 0.7, 0.3) },
            new object[] { "node at node", new Vector3d(0.08, 0.19, 0.53), new Vector3d(0.5, 0.6, 0.9) },
            new object[] { "the first's node within it", new Vector3d(-0.3, 0.2, 0.54), new Vector3d(0.4, 0.2, 0.55) },
        };

        [TestCaseSource(nameof(Meetings))]
        public void Gradient_IsTheSlope_AndColumnsAreTheSecondDerivative(string name, Vector3d a, Vector3d b)
        {
            SelfContact contact = Create(a, b, out MaterialRod rod, out RodShape shape);
            Assert.That(contact.ContactsOf(shape).Count, Is.Positive, name);
            double[,] second = Second(contact, rod, shape);
            double[] first = Gradient(contact, shape);
            const double H = 1e-6;
            double force = contact.ContactsOf(shape)[0].Force;
            double stiffness = contact.ContactsOf(shape)[0].Stiffness;
            foreach (int i in new[] { 0, 1, N - 1, N })
            {
                for (int axis = 0; axis < 3; axis++)
                {
                    Vector3d x = shape.X[i];
                    shape.X[i] = x + H * Axis(axis);
                    double more = contact.Value(shape);
                    double[] gradientMore = Gradient(contact, shape);
                    shape.X[i] = x - H * Axis(axis);
                    double less = contact.Value(shape);
                    double[] gradientLess = Gradient(contact, shape);
                    shape.X[i] = x;
                    int row = 6 * i + axis;
                    Assert.That(first[row], Is.EqualTo((more - less) / (2.0 * H)).Within(1e-7 * force), name);
                    for (int k = 0; k < first.Length; k++)
                    {
                        Assert.That(second[row, k], Is.EqualTo((gradientMore[k] - gradientLess[k]) / (2.0 * H))
                            .Within(1e-7 * Largest(second)), name);
                    }
                }
            }
            Assert.That(stiffness, Is.Positive);
        }

        [Test]
        public void Distance_IsThatOfTheSegments_ButForWhatRoundingAdds([Range(1, 50)] int seed)
        {
            var random = new System.Random(seed);
            Vector3d[] x = { Any(random), Any(random), Any(random), Any(random) };
            if (seed % 3 == 0)
            {
                x[3] = x[2] + x[1] - x[0];    // parallel
            }
            double exact = Math.Sqrt(ClosestPoints.SegmentSegment(x[0], x[1], x[2], x[3], out _, out _));
            double radii = 0.9 * exact;
            double rounded = new CapsulePair(x[0], x[1], x[2], x[3], radii).Distance;
            Assert.That(rounded, Is.GreaterThanOrEqualTo(exact * (1.0 - 1e-12)));
            Assert.That(rounded * rounded, Is.LessThanOrEqualTo(exact * exact + 0.005 * radii * radii + 1e-14));
            Assert.That(Math.Sqrt(0.005 * radii * radii + radii * radii), Is.EqualTo(CapsulePair.Contact(radii))
                .Within(1e-12));
        }

        [TestCase(0.0)]
        [TestCase(2.0)]
        public void FrictionForce_IsTheSlopeOfItsEnergy_AndSticksByItsColumns(double slip)
        {
            SelfContact contact = Create(new Vector3d(-0.4, 0.21, -0.3), new Vector3d(0.3, 0.212, 0.4),
                out MaterialRod rod, out RodShape shape);
            var friction = new SelfFriction(contact, rod, 0.3, 1e-3);
            friction.BeginStep(shape, 0.1);
            friction.Lag(shape);
            shape.X[N] += new Vector3d(slip * 1e-3, 0.0, 3e-4);
            shape.Q[0] = shape.Q[0] * RotationVector.Exp(new Vector3d(0.0, 0.0, 1e-4));
            double[] first = Gradient(friction, shape);
            double[,] second = Second(friction, rod, shape);
            double scale = 0.3 * contact.ContactsOf(shape)[0].Force;
            const double H = 1e-8;
            foreach (int i in new[] { 0, 1, N - 1, N })
            {
                for (int axis = 0; axis < 6 && (axis < 3 || i != N); axis++)
                {
                    Quaterniond q = axis < 3 ? default : shape.Q[i];
                    double Moved(double h, out double[] gradient)
                    {
                        Vector3d x = shape.X[i];
                        shape.X[i] = axis < 3 ? x + h * Axis(axis) : x;
                        if (axis >= 3)
                        {
                            shape.Q[i] = q * RotationVector.Exp(h * Axis(axis - 3));
                        }
                        double value = friction.Value(shape);
                        gradient = Gradient(friction, shape);
                        shape.X[i] = x;
                        if (axis >= 3)
                        {
                            shape.Q[i] = q;
                        }
                        return value;
                    }
                    double slope = (Moved(H, out double[] more) - Moved(-H, out double[] less)) / (2.0 * H);
                    Assert.That(first[6 * i + axis], Is.EqualTo(slope).Within(1e-6 * scale));
                    for (int k = 0; k < first.Length; k++)
                    {
                        // What the turn itself adds to the second derivative is left out; it is 1e-4 rad.
                        Assert.That(second[6 * i + axis, k], Is.EqualTo((more[k] - less[k]) / (2.0 * H))
                            .Within(2e-4 * Largest(second)));
                    }
                }
            }
        }

        [Test]
        public void Motion_KeepsItsDistance_AndEndsNearIt([Range(1, 40)] int seed)
        {
            var random = new System.Random(seed);
            var x = new Vector3d[4];
            var to = new Vector3d[4];
            for (int i = 0; i < 4; i++)
            {
                x[i] = Any(random) + (i < 2 ? 1.0 : -1.0) * Vector3d.UnitY;
                to[i] = Any(random) - (i < 2 ? 1.0 : -1.0) * Vector3d.UnitY;
            }
            const double Least = 0.2;
            const double Radii = 0.2;
            double distance = new CapsulePair(x[0], x[1], x[2], x[3], Radii).Distance;
            double most = CapsulePair.MaxMotion(x, to, 0, 2, Radii, distance, Least, 1.0, 1.0);
            double DistanceAt(double time)
            {
                Vector3d P(int i) => Vector3d.Lerp(x[i], to[i], time);
                return new CapsulePair(P(0), P(1), P(2), P(3), Radii).Distance;
            }
            for (int k = 0; k <= 1000; k++)
            {
                Assert.That(DistanceAt(most * k / 1000.0), Is.GreaterThan(Least));
            }
            // It ends where at most a twentieth of the way to the least distance is left.
            Assert.That(most == 1.0 || DistanceAt(most) < Least + 0.0501 * (distance - Least));
        }

        [Test]
        public void Pairs_AreAllThatAreNear_InEveryShapeForWhichTheListHolds([Range(1, 20)] int seed)
        {
            var random = new System.Random(seed);
            int n = 60 + random.Next(80);
            double radius = seed % 2 == 0 ? 0.1 : 0.6;
            MaterialRod rod = MaterialRod.Round(n, n, radius, 300.0, 130.0, 2.0);
            // A coil whose turns touch, of 6 to 40 elements each, or straight.
            RodShape shape = Rods.Straight(rod);
            double coil = seed % 5 == 0 ? 1e3 * n : 1.0 + 5.0 * random.NextDouble();
            for (int i = 0; i <= n; i++)
            {
                shape.X[i] = coil * new Vector3d(Math.Cos(i / coil), Math.Sin(i / coil), 0.0)
                    + (2.1 * radius * i / (2.0 * Math.PI * coil)) * Vector3d.UnitZ + 0.1 * radius * Any(random);
            }
            var pairs = new StrandPairs(rod.Length, rod.Radius, n, 0.25 * radius);
            int found = 0;
            for (int step = 0; step < 30; step++)
            {
                var to = new Vector3d[n + 1];
                Vector3d shift = 0.3 * random.NextDouble() * Any(random);
                for (int i = 0; i <= n; i++)
                {
                    to[i] = shape.X[i] + shift + 0.1 * radius * random.NextDouble() * Any(random);
                }
                if (step % 2 == 0)
                {
                    pairs.Follow(shape.X);
                    pairs.Follow(shape.X, to);
                    var middle = new Vector3d[n + 1];
                    for (int i = 0; i <= n; i++)
                    {
                        middle[i] = Vector3d.Lerp(shape.X[i], to[i], 0.7);
                    }
                    found += AssertHolds(pairs, rod, middle, radius);
                }
                else
                {
                    pairs.Follow(to);
                }
                found += AssertHolds(pairs, rod, to, radius);
                Array.Copy(to, shape.X, n + 1);
            }
            Assert.That(found, seed % 5 == 0 ? Is.Zero : Is.GreaterThan(0));
        }

        private static int AssertHolds(StrandPairs pairs, MaterialRod rod, Vector3d[] x, double radius)
        {
            int found = 0;
            int at = 0;
            for (int j = 0; j < rod.ElementCount; j++)
            {
                for (int k = j + 2; k < rod.ElementCount; k++)
                {
                    bool isListed = at < pairs.Pairs.Count && pairs.Pairs[at].First == j && pairs.Pairs[at].Second == k;
                    at += isListed ? 1 : 0;
                    bool isNear = pairs.IsPair(j, k)
                        && ClosestPoints.SegmentSegment(x[j], x[j + 1], x[k], x[k + 1], out _, out _)
                            < 2.25 * radius * 2.25 * radius;
                    Assert.That(isListed || !isNear, "elements " + j + " and " + k);
                    found += isNear ? 1 : 0;
                }
            }
            Assert.That(at, Is.EqualTo(pairs.Pairs.Count), "in order");
            return found;
        }

        // The first element along z about the origin, the last one where it is asked, the rest far away.
        private static SelfContact Create(in Vector3d a, in Vector3d b, out MaterialRod rod, out RodShape shape)
        {
            rod = MaterialRod.Round(N, N, Radius, 300.0, 130.0, 2.0);
            shape = Rods.Straight(rod);
            for (int i = 0; i <= N; i++)
            {
                shape.X[i] = new Vector3d(10.0 * Math.Sin(i), 10.0 * Math.Cos(i), 5.0 * i);
            }
            shape.X[0] = new Vector3d(0.0, 0.0, -0.5);
            shape.X[1] = new Vector3d(0.0, 0.0, 0.5);
            shape.X[N - 1] = a;
            shape.X[N] = b;
            return new SelfContact(rod, new Barrier(Range, 3.0), null);
        }

        private static double[] Gradient(EnergyTerm term, RodShape shape)
        {
            var gradient = new RodVector[N + 2];
            term.AddGradient(shape, gradient);
            return DenseMatrix.From(gradient, N + 1);
        }

        private static double[,] Second(EnergyTerm term, MaterialRod rod, RodShape shape)
        {
            var columns = new LowRank(N + 2);
            term.AddColumns(shape, columns);
            var second = new double[6 * (N + 1), 6 * (N + 1)];
            columns.ForEach((v, c) =>
            {
                double[] u = DenseMatrix.From(v, N + 1);
                for (int i = 0; i < u.Length; i++)
                {
                    for (int j = 0; j < u.Length; j++)
                    {
                        second[i, j] += c * u[i] * u[j];
                    }
                }
            });
            return second;
        }

        private static double Largest(double[,] matrix)
        {
            double largest = 0.0;
            foreach (double value in matrix)
            {
                largest = Math.Max(largest, Math.Abs(value));
            }
            return largest;
        }

        private static Vector3d Axis(int axis) =>
            axis == 0 ? Vector3d.UnitX : axis == 1 ? Vector3d.UnitY : Vector3d.UnitZ;

        private static Vector3d Any(System.Random random) => new Vector3d(random.NextDouble() - 0.5,
            random.NextDouble() - 0.5, random.NextDouble() - 0.5);
    }
}

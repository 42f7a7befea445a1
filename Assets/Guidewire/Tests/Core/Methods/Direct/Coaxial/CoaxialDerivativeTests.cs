using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The energy of coaxial instruments against differences of its own value, and its linear system against
    /// the dense one.</summary>
    public sealed class CoaxialDerivativeTests
    {
        // Fourth-order central differences: truncation Step^4, rounding 1e-16/Step of the energy.
        private const double Step = 1e-3;

        [TestCase(0.05, 2)]
        [TestCase(0.6, 2)]
        [TestCase(0.6, 0)]
        [TestCase(0.6, -1)]
        public void Gradient_IsTheDifferenceOfTheEnergy(double angle, int beyond)
        {
            CoaxialPair pair = Pair(angle, beyond);
            double[] exact = Gradient(pair);
            double largest = 0.0;
            double worst = 0.0;
            for (int i = 0; i < exact.Length; i++)
            {
                double difference = Difference(s => pair.Bending.Value(Moved(pair.Shape, i, s)));
                worst = Math.Max(worst, Math.Abs(difference - exact[i]));
                largest = Math.Max(largest, Math.Abs(difference));
            }
            Assert.That(worst, Is.LessThan(1e-9 * largest));
        }

        [TestCase(0.05, 2)]
        [TestCase(0.6, 2)]
        [TestCase(0.6, 0)]
        [TestCase(0.6, -1)]
        public void Blocks_AreTheDifferencesOfTheEnergy(double angle, int beyond)
        {
            CoaxialPair pair = Pair(angle, beyond);
            double[,] exact = Assembled(pair, new EnergyTerm[] { pair.Bending }, 0.0);
            int count = exact.GetLength(0);
            double largest = 0.0;
            double worst = 0.0;
            for (int i = 0; i < count; i++)
            {
                for (int k = 0; k <= i; k++)
                {
                    double difference = Difference(s => Difference(t =>
                        pair.Bending.Value(Moved(pair.Shape, i, s, k, t))));
                    worst = Math.Max(worst, Math.Abs(difference - exact[i, k]));
                    largest = Math.Max(largest, Math.Abs(difference));
                }
            }
            Assert.That(worst, Is.LessThan(1e-8 * largest));
        }

        [TestCase(2)]
        [TestCase(0)]
        [TestCase(-1)]
        public void Solution_IsTheDenseOne(int beyond)
        {
            CoaxialPair pair = Pair(0.3, beyond, 0.0);
            const double shift = 300.0;
            var system = new BlockTridiagonal(pair.Coaxial.Rod, pair.Supports);
            var gradient = new RodVector[system.VectorCount];
            var y = new RodVector[system.VectorCount];
            Assert.That(system.Factorise(pair.Terms.All, pair.Shape, gradient, y, shift), Is.Zero);
            system.Back(y);
            double[,] h = Assembled(pair, pair.Terms.All, shift);
            var right = new double[h.GetLength(0)];
            double[] all = Long(pair, gradient);
            for (int i = 0; i < right.Length; i++)
            {
                right[i] = i < 3 ? 0.0 : -all[i];
                for (int k = 0; k < right.Length && i < 3; k++)
                {
                    h[i, k] = h[k, i] = i == k ? 1.0 : 0.0;
                }
            }
            double[] expected = DenseMatrix.Solve(DenseMatrix.Cholesky(h), right);
            AssertEqual(Long(pair, y), expected);

            // The same by the factorisation that is kept.
            system.Gradient(pair.Terms.All, pair.Shape, gradient, y);
            system.Solve(y);
            AssertEqual(Long(pair, y), expected);
        }

        [Test]
        public void NegativePivots_CountTheNegativeEigenvalues()
        {
            // Hub turned by half a turn against curvatures well beyond the threshold: the straight twist is unstable.
            foreach (double shift in new[] { 0.0, 1.0, 10.0 })
            {
                CoaxialPair pair = Pair(0.8, 2);
                var system = new BlockTridiagonal(pair.Coaxial.Rod, pair.Supports);
                int negative = system.Factorise(new EnergyTerm[] { pair.Bending, pair.Terms.Stretch }, pair.Shape,
                    new RodVector[system.VectorCount], new RodVector[system.VectorCount], shift);
                double[,] h = Assembled(pair, new EnergyTerm[] { pair.Bending, pair.Terms.Stretch }, shift);
                for (int i = 0; i < 3; i++)
                {
                    for (int k = 0; k < h.GetLength(0); k++)
                    {
                        h[i, k] = h[k, i] = i == k ? 1.0 : 0.0;
                    }
                }
                int expected = 0;
                foreach (double value in DenseMatrix.Eigenvalues(h))
                {
                    expected += value < 0.0 ? 1 : 0;
                }
                Assert.That(negative, Is.EqualTo(expected), "shift " + shift);
                Assert.That(shift > 0.0 || expected > 0, "the case must have a negative eigenvalue");
            }
        }

        // Uneven pieces on both, borders within elements; beyond -1: the inner tip is inside.
        private static CoaxialPair Pair(double angle, int beyond, double strain = 0.2)
        {
            var outer = new[] { new CoaxialPair.Piece(0.55, 1.3, 0.0, 0.0, 0.4), new CoaxialPair.Piece(0.45, 0.7, 1.1,
                -0.4, 0.2) };
            var inner = new[] { new CoaxialPair.Piece(0.83, 0.5, 0.3, 0.1, 0.3), new CoaxialPair.Piece(0.52, 0.9, -1.4,
                0.8, -0.6) };
            double lead = beyond == 2 ? 0.15 : beyond == 0 ? 0.35 : 0.48;
            var pair = new CoaxialPair(outer, 4, inner, 10, 0.3, lead, Math.Max(beyond, 0));
            var random = new Random(7);
            pair.Bending.HubTwist = 0.7;
            RodShape bent = Rods.Random(pair.Coaxial.Rod, angle, strain, 5);
            Array.Copy(bent.X, pair.Shape.X, bent.X.Length);
            Array.Copy(bent.Q, pair.Shape.Q, bent.Q.Length);
            pair.Shape.ProximalFrame = bent.ProximalFrame;
            for (int j = 0; j < pair.Shape.Twist.Length; j++)
            {
                pair.Shape.Twist[j] = 0.7 + angle * (random.NextDouble() - 0.5) * 4.0;
            }
            return pair;
        }

        private static double[] Gradient(CoaxialPair pair)
        {
            var gradient = new RodVector[pair.Terms.VectorCount];
            var measured = default(GradientMeasures);
            pair.Bending.AddGradient(pair.Shape, gradient, 0, pair.Shape.ElementCount + 1, ref measured);
            return Long(pair, gradient);
        }

        // Positions and rotations of all nodes but the last rotation, then the active angles.
        private static double[] Long(CoaxialPair pair, RodVector[] v)
        {
            int n = pair.Shape.ElementCount;
            int active = pair.Coaxial.Joints.ActiveCount;
            double[] nodes = DenseMatrix.From(v, n + 1);
            Array.Resize(ref nodes, 6 * n + 3 + active);
            for (int j = 0; j < active; j++)
            {
                nodes[6 * n + 3 + j] = v[n + 2 + j].T3;
            }
            return nodes;
        }

        private static double[,] Assembled(CoaxialPair pair, EnergyTerm[] terms, double shift)
        {
            int n = pair.Shape.ElementCount;
            int active = pair.Coaxial.Joints.ActiveCount;
            var blocks = new RodBlock[n + 2];
            var rows = new TwistRow[n + 1];
            var gradient = new RodVector[pair.Terms.VectorCount];
            foreach (EnergyTerm term in terms)
            {
                term.AddBlocks(pair.Shape, blocks, gradient, 0, n + 1);
                term.AddTwistRows(pair.Shape, rows, 0, active);
            }
            double[,] nodes = DenseMatrix.From(blocks, n + 1);
            int first = 6 * n + 3;
            var h = new double[first + active, first + active];
            double[] length = pair.Coaxial.Rod.Length;
            double total = pair.Coaxial.Rod.TotalLength;
            for (int i = 0; i < first; i++)
            {
                for (int k = 0; k < first; k++)
                {
                    h[i, k] = nodes[i, k];
                }
                double weight = length[Math.Min(i / 6, n - 1)];
                h[i, i] += shift * weight * (i % 6 < 3 ? 1.0 / (total * total) : 1.0);
            }
            for (int j = 0; j < active; j++)
            {
                h[first + j, first + j] = rows[j].Diagonal + shift * length[j];
                Put(h, first + j, 6 * j + 3, rows[j].Turn);
                if (j + 1 < n)
                {
                    Put(h, first + j, 6 * j + 9, rows[j].NextTurn);
                }
                if (j + 1 < active)
                {
                    h[first + j, first + j + 1] = h[first + j + 1, first + j] = rows[j].NextTwist;
                    Put(h, first + j + 1, 6 * j + 3, rows[j].TurnOfNext);
                }
            }
            return h;
        }

        private static void Put(double[,] h, int i, int k, in Vector3d v)
        {
            h[i, k] = h[k, i] = v.X;
            h[i, k + 1] = h[k + 1, i] = v.Y;
            h[i, k + 2] = h[k + 2, i] = v.Z;
        }

        private static RodShape Moved(RodShape shape, int i, double s, int k = -1, double t = 0.0)
        {
            int n = shape.ElementCount;
            var direction = new RodVector[2 * n + 3];
            var v = new double[6 * n + 3 + n];
            if (i >= 0)
            {
                v[i] += s;
            }
            if (k >= 0)
            {
                v[k] += t;
            }
            var nodes = new double[6 * (n + 1)];
            Array.Copy(v, nodes, 6 * n + 3);
            RodVector[] part = DenseMatrix.ToRod(nodes);
            Array.Copy(part, direction, n + 1);
            for (int j = 0; j < n; j++)
            {
                direction[n + 2 + j].T3 = v[6 * n + 3 + j];
            }
            var to = new RodShape(n, true);
            RodStep.ApplyStraight(shape, direction, 1.0, to);
            return to;
        }

        private static double Difference(Func<double, double> f)
        {
            return (8.0 * (f(Step) - f(-Step)) - (f(2.0 * Step) - f(-2.0 * Step))) / (12.0 * Step);
        }

        private static void AssertEqual(double[] found, double[] expected)
        {
            double largest = 0.0;
            foreach (double value in expected)
            {
                largest = Math.Max(largest, Math.Abs(value));
            }
            for (int i = 0; i < expected.Length; i++)
            {
                Assert.That(found[i], Is.EqualTo(expected[i]).Within(1e-9 * largest), "component " + i);
            }
        }
    }
}

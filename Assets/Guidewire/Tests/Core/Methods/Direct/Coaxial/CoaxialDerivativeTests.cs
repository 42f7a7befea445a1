using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The energy of coaxial instruments against differences of its own value, and its linear system against
    /// the dense one.</summary>
    public sealed class CoaxialDerivativeTests
    {
        // From here on that of three instruments (ThreeTubes.Mixed).
        private const int Three = 10;

        // Angle, rad, and elements beyond the outer tip.
        private static readonly object[][] Shapes = { new object[] { 0.05, 2 }, new object[] { 0.6, 2 },
            new object[] { 0.6, 0 }, new object[] { 0.6, -1 }, new object[] { 0.6, Three },
            new object[] { 0.6, Three + 1 }, new object[] { 0.6, Three + 2 }, new object[] { 0.6, Three + 3 } };

        // Of three instruments one; the others run where all do.
        private static readonly TestCaseData[] FibreShapes = Array.ConvertAll(Shapes, shape =>
            (int)shape[1] >= Three && (int)shape[1] != Three + 2 ? new TestCaseData(shape).SetCategory("Long")
                : new TestCaseData(shape));

        [TestCaseSource(nameof(Shapes))]
        public void Gradient_IsTheDifferenceOfTheEnergy(double angle, int beyond)
        {
            CoaxialPair pair = Pair(angle, beyond);
            double[] gradient = Gradient(pair);
            EnergySlopes.AssertGradient(gradient, gradient.Length, (i, s) => pair.Bending.Value(Moved(pair, i, s)));
        }

        [TestCaseSource(nameof(Shapes))]
        public void Blocks_AreTheDifferencesOfTheEnergy(double angle, int beyond)
        {
            CoaxialPair pair = Pair(angle, beyond);
            double[,] second = Assembled(pair, new EnergyTerm[] { pair.Bending }, 0.0);
            EnergySlopes.AssertBlocks(second, second.GetLength(0),
                (i, s, k, t) => pair.Bending.Value(Moved(pair, i, s, k, t)));
        }

        /// <summary>Of cores that give way, with a memory. Where a fibre begins to flow the second derivative
        /// jumps: so steps are small.</summary>
        [TestCaseSource(nameof(FibreShapes))]
        public void CorrectionByFibres_HasTheDerivativesOfItsEnergy(double angle, int beyond)
        {
            foreach (bool isSteel in new[] { false, true })
            {
                CoaxialPair pair = Pair(angle, beyond);
                pair.GiveWay(0.4, isSteel);
                var bent = new RodShape(pair.Shape.ElementCount, pair.Shape.InnerCount);
                bent.CopyFrom(pair.Shape);
                for (int j = 0; j < bent.ElementCount; j++)
                {
                    bent.Q[j] *= RotationVector.Exp(0.3 * new Vector3d(Math.Sin(2.0 * j), Math.Cos(3.0 * j), 0.2));
                }
                pair.Terms.Fibres!.EndStep(bent);
                Assert.That(pair.Terms.Fibres.Loss, Is.GreaterThan(0.0));
                double[] gradient = Gradient(pair);
                EnergySlopes.AssertGradient(gradient, gradient.Length, (i, s) => pair.Bending.Value(Moved(pair, i, s)),
                    1e-6, 1e-8);
                double[,] second = Assembled(pair, new EnergyTerm[] { pair.Bending }, 0.0);
                EnergySlopes.AssertBlocks(second, second.GetLength(0),
                    (i, s, k, t) => pair.Bending.Value(Moved(pair, i, s, k, t)), 1e-5, 1e-4);
            }
        }

        [TestCase(2)]
        [TestCase(0)]
        [TestCase(-1)]
        [TestCase(Three)]
        [TestCase(Three + 1)]
        [TestCase(Three + 2)]
        [TestCase(Three + 3)]
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
            DenseMatrix.AssertEqual(Long(pair, y), expected);

            // The same by the factorisation that is kept.
            system.Gradient(pair.Terms.All, pair.Shape, gradient, y);
            system.Solve(y);
            DenseMatrix.AssertEqual(Long(pair, y), expected);
        }

        [Test]
        public void NegativePivots_CountTheNegativeEigenvalues()
        {
            // Hub turned by half a turn against curvatures well beyond the threshold: the straight twist is unstable.
            foreach ((double shift, int beyond) in new[] { (0.0, 2), (1.0, 2), (10.0, 2), (0.0, Three), (10.0, Three) })
            {
                CoaxialPair pair = Pair(0.8, beyond);
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
            CoaxialPair pair = beyond >= Three ? ThreeTubes.Mixed(beyond - Three)
                : new CoaxialPair(outer, 4, inner, 10, 0.3, lead, Math.Max(beyond, 0));
            var random = new Random(7);
            for (int i = 1; i < pair.Bending.HubTwist.Length; i++)
            {
                pair.Bending.HubTwist[i] = 1.4 / i - 0.7;
            }
            pair.Bending.HubTwist[1] = 0.7;
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
            pair.Bending.AddGradient(pair.Shape, gradient);
            return Long(pair, gradient);
        }

        // Positions and rotations of all nodes but the last rotation, then the active angles, those of the innermost of
        // three last.
        private static double[] Long(CoaxialPair pair, RodVector[] v)
        {
            int n = pair.Shape.ElementCount;
            var all = new List<double>(DenseMatrix.From(v, n + 1));
            all.RemoveRange(6 * n + 3, all.Count - 6 * n - 3);
            foreach ((int instrument, int j) in Angles(pair))
            {
                all.Add(instrument == 1 ? v[n + 2 + j].T3 : v[n + 2 + j].T2);
            }
            return all.ToArray();
        }

        private static List<(int Instrument, int Element)> Angles(CoaxialPair pair)
        {
            var angles = new List<(int, int)>();
            for (int i = 1; i < pair.Coaxial.Joints.Count; i++)
            {
                for (int j = 0; j < pair.Coaxial.Joints.ActiveCountOf(i); j++)
                {
                    angles.Add((i, j));
                }
            }
            return angles;
        }

        private static double[,] Assembled(CoaxialPair pair, EnergyTerm[] terms, double shift)
        {
            int n = pair.Shape.ElementCount;
            var blocks = new RodBlock[n + 2];
            var rows = new TwistRow[pair.Shape.InnerCount * (n + 1)];
            var gradient = new RodVector[pair.Terms.VectorCount];
            foreach (EnergyTerm term in terms)
            {
                term.AddBlocks(pair.Shape, blocks, gradient, 0, n + 1);
                term.AddTwistRows(pair.Shape, rows, 0, pair.Coaxial.Joints.ActiveCount);
            }
            double[,] nodes = DenseMatrix.From(blocks, n + 1);
            List<(int Instrument, int Element)> angles = Angles(pair);
            int first = 6 * n + 3;
            var h = new double[first + angles.Count, first + angles.Count];
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
            for (int at = 0; at < angles.Count; at++)
            {
                (int i, int j) = angles[at];
                TwistRow row = rows[(i - 1) * (n + 1) + j];
                h[first + at, first + at] = row.Diagonal + shift * length[j];
                Put(h, first + at, 6 * j + 3, row.Turn);
                if (j + 1 < n)
                {
                    Put(h, first + at, 6 * j + 9, row.NextTurn);
                }
                int next = angles.IndexOf((i, j + 1));
                if (next >= 0)
                {
                    h[first + at, first + next] = h[first + next, first + at] = row.NextTwist;
                    Put(h, first + next, 6 * j + 3, row.TurnOfNext);
                }
                int other = angles.IndexOf((3 - i, j));
                if (other >= 0 && i == 1)
                {
                    h[first + at, first + other] = h[first + other, first + at] = row.Other;
                }
                int nextOther = angles.IndexOf((3 - i, j + 1));
                if (nextOther >= 0)
                {
                    h[first + at, first + nextOther] = h[first + nextOther, first + at] = row.NextOther;
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

        private static RodShape Moved(CoaxialPair pair, int i, double s, int k = -1, double t = 0.0)
        {
            int n = pair.Shape.ElementCount;
            List<(int Instrument, int Element)> angles = Angles(pair);
            var direction = new RodVector[2 * n + 3];
            var v = new double[6 * n + 3 + angles.Count];
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
            for (int at = 0; at < angles.Count; at++)
            {
                (int instrument, int j) = angles[at];
                direction[n + 2 + j].T3 += instrument == 1 ? v[6 * n + 3 + at] : 0.0;
                direction[n + 2 + j].T2 += instrument == 2 ? v[6 * n + 3 + at] : 0.0;
            }
            var to = new RodShape(n, pair.Shape.InnerCount);
            RodStep.ApplyStraight(pair.Shape, direction, 1.0, to);
            return to;
        }
    }
}

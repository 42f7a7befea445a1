using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>One shared centreline against two rods with play in a plane, bent as far as they may be: each has
    /// angles of its own, and the inner one keeps within the play of the outer one's axis.</summary>
    /// <remarks>Rod o has angles a_j, rod i b_j, at the hub 0; E = 1/2 sum B (a_j - a_(j-1) - w k)^2/w with w = h, or
    /// h/2 at the hub. The distance across is u_j = n_j . (x_i - x_o) at node j, n_j normal to the outer one; |u| above
    /// the play is pushed back by a stiff spring. A force acts on the outer tip. Solved by the Gauss-Newton
    /// method.</remarks>
    public sealed class CoaxialTwoRodsTests
    {
        private const int Elements = 60;
        private const double Outer = 1.0;   // B, N m^2
        private const double Inner = 0.6;
        private const double Reduced = Outer * Inner / (Outer + Inner);

        // Rest curvatures of both, play and the force on the tip along y and z.
        [TestCase(1.5, 0.0, 1e-3, 0.0, 0.0)]
        [TestCase(2.0, 0.5, 1e-3, 0.4, -0.2)]
        [TestCase(-0.5, 1.5, 2e-3, -0.6, 0.0)]
        [TestCase(0.0, 2.5, 5e-4, -0.5, 0.3)]
        public void TipsAndForce_AreWithinWhatTheSummaryStates(double outer, double inner, double play, double y,
            double z)
        {
            var pair = new CoaxialPair(new[] { new CoaxialPair.Piece(1.0, Outer, outer) }, 40,
                new[] { new CoaxialPair.Piece(1.0, Inner, inner) }, 40, 0.3, 0.0)
            {
                TipForce = new Vector3d(0.0, y, z),
            };
            pair.Solve(0.0);
            var record = new CoaxialRecord(40, 1.0, 1e-3 + play, new LumenFriction(0.0, 1.0));
            record.TakePlay(pair.Coaxial.Joints, pair.Shape);
            Vector3d shared = pair.Shape.X[40];
            var rods = new TwoRods(1.0, outer, inner, play, y, z);
            double outerTip = rods.Distance(0, shared.Y, shared.Z);
            double innerTip = rods.Distance(1, shared.Y, shared.Z);
            TestContext.WriteLine("tips {0:G3} and {1:G3} of the play apart from the shared one, at {2:F3}, {3:F3}",
                outerTip / play, innerTip / play, shared.Y, shared.Z);
            Assert.That(Math.Abs(shared.Y), Is.GreaterThan(0.2), "it is bent");
            Assert.That(outerTip, Is.LessThan(1.02 * play));
            Assert.That(innerTip, Is.LessThan(1.02 * play));
            double perLength = 0.5 * Reduced * (outer - inner) * (outer - inner);
            double lost = pair.Terms.Potential(pair.Shape) - rods.Energy;
            Assert.That(lost / perLength / record.PlayLength, Is.EqualTo(0.66).Within(0.04), "length not coupled");
            // What is held against one another goes with the overlap: the force that drives the inner one out.
            const double more = 0.02;
            double free = (new TwoRods(1.0 + more, outer, inner, play, 0.0, 0.0).Energy
                - new TwoRods(1.0 - more, outer, inner, play, 0.0, 0.0).Energy) / (2.0 * more);
            Assert.That(free, Is.EqualTo(perLength).Within(5e-3 * perLength));
        }

        // In a plane: z along the rods, y across.
        private sealed class TwoRods
        {
            private const int Count = 2 * Elements;

            private readonly double _h;
            private readonly double[] _k;
            private readonly double _play;
            private readonly double _wall;    // stiffness, N/m
            private readonly double _y;       // force on the outer tip, N
            private readonly double _z;
            private readonly double[] _x = new double[2 * (Elements + 1)];     // z of both
            private readonly double[] _across = new double[2 * (Elements + 1)];
            private double[] _angle = new double[Count];

            public TwoRods(double length, double outer, double inner, double play, double y, double z)
            {
                _h = length / Elements;
                _k = new[] { outer, inner };
                _play = play;
                double mismatch = Math.Abs(outer - inner);
                _wall = Reduced * mismatch / Math.Sqrt(12.0 * play / mismatch) / (1e-3 * play);
                _y = y;
                _z = z;
                for (int j = 0; j < Count; j++)
                {
                    _angle[j] = (Outer * outer + Inner * inner) / (Outer + Inner) * _h * (j % Elements + 0.5);
                }
                Solve();
            }

            /// <summary>Without that of the walls, J.</summary>
            public double Energy { get; private set; }

            public double Distance(int rod, double y, double z)
            {
                int tip = rod * (Elements + 1) + Elements;
                return Math.Sqrt(Math.Pow(_across[tip] - y, 2.0) + Math.Pow(_x[tip] - z, 2.0));
            }

            private void Solve()
            {
                var gradient = new double[Count];
                var matrix = new double[Count, Count];
                double size = 1.0;
                for (int iteration = 0; size > 1e-10; iteration++)
                {
                    Assert.That(iteration, Is.LessThan(300), "no solution");
                    Array.Clear(gradient, 0, Count);
                    Array.Clear(matrix, 0, matrix.Length);
                    double energy = Assemble(gradient, matrix);
                    double[] step = (double[])gradient.Clone();
                    Divide(matrix, step);
                    double slope = 0.0;
                    size = 0.0;
                    for (int j = 0; j < Count; j++)
                    {
                        slope -= gradient[j] * step[j];
                        size = Math.Max(size, Math.Abs(step[j]));
                    }
                    double[] from = _angle;
                    double scale = 2.0;
                    do
                    {
                        scale *= 0.5;
                        _angle = Array.ConvertAll(from, a => a);
                        for (int j = 0; j < Count; j++)
                        {
                            _angle[j] -= scale * step[j];
                        }
                    }
                    while (scale > 1e-6 && Assemble(null, null) > energy + 1e-4 * scale * slope);
                }
                Assemble(null, null);
            }

            private double Assemble(double[]? gradient, double[,]? matrix)
            {
                double energy = 0.0;
                for (int rod = 0; rod < 2; rod++)
                {
                    energy += Bend(rod, gradient, matrix);
                }
                energy -= _y * _across[Elements] + _z * _x[Elements];
                for (int m = 0; m < Elements && gradient != null; m++)
                {
                    gradient[m] += _h * (_y * Math.Cos(_angle[m]) + _z * Math.Sin(_angle[m]));
                }
                Energy = energy;
                var row = new double[Count];
                for (int j = 1; j <= Elements; j++)
                {
                    energy += Touch(j, row, gradient, matrix);
                }
                return energy;
            }

            private double Bend(int rod, double[]? gradient, double[,]? matrix)
            {
                double energy = 0.0;
                double bend = rod == 0 ? Outer : Inner;
                int node = rod * (Elements + 1);
                for (int j = 0; j < Elements; j++)
                {
                    int at = rod * Elements + j;
                    double w = j == 0 ? 0.5 * _h : _h;
                    double left = _angle[at] - (j == 0 ? 0.0 : _angle[at - 1]) - w * _k[rod];
                    energy += 0.5 * bend / w * left * left;
                    _x[node + j + 1] = _x[node + j] + _h * Math.Cos(_angle[at]);
                    _across[node + j + 1] = _across[node + j] - _h * Math.Sin(_angle[at]);
                    if (gradient != null)
                    {
                        gradient[at] += bend / w * left;
                        matrix![at, at] += bend / w;
                        if (j > 0)
                        {
                            gradient[at - 1] -= bend / w * left;
                            matrix[at - 1, at - 1] += bend / w;
                            matrix[at, at - 1] -= bend / w;
                        }
                    }
                }
                return energy;
            }

            // Of node j; n = (sin, cos) and t = (cos, -sin) along z and y.
            private double Touch(int j, double[] row, double[]? gradient, double[,]? matrix)
            {
                int next = Math.Min(j, Elements - 1);
                double mean = 0.5 * (_angle[j - 1] + _angle[next]);
                double c = Math.Cos(mean);
                double s = Math.Sin(mean);
                double along = _x[Elements + 1 + j] - _x[j];
                double across = _across[Elements + 1 + j] - _across[j];
                double u = s * along + c * across;
                double over = Math.Abs(u) - _play;
                if (!(over > 0.0))
                {
                    return 0.0;
                }
                if (gradient != null)
                {
                    Array.Clear(row, 0, Count);
                    for (int m = 0; m < j; m++)
                    {
                        row[m] = _h * Math.Cos(_angle[m] - mean);
                        row[Elements + m] = -_h * Math.Cos(_angle[Elements + m] - mean);
                    }
                    row[j - 1] += 0.5 * (c * along - s * across);
                    row[next] += 0.5 * (c * along - s * across);
                    for (int m = 0; m < Count; m++)
                    {
                        gradient[m] += _wall * over * Math.Sign(u) * row[m];
                        for (int k = 0; k <= m; k++)
                        {
                            matrix![m, k] += _wall * row[m] * row[k];
                        }
                    }
                }
                return 0.5 * _wall * over * over;
            }

            // x := A^-1 x of a symmetric A, of which the lower half is given.
            private static void Divide(double[,] a, double[] x)
            {
                for (int k = 0; k < Count; k++)
                {
                    for (int i = k + 1; i < Count; i++)
                    {
                        double factor = a[i, k] / a[k, k];
                        for (int j = k + 1; j <= i && factor != 0.0; j++)
                        {
                            a[i, j] -= factor * a[j, k];
                        }
                        x[i] -= factor * x[k];
                    }
                }
                for (int k = Count - 1; k >= 0; k--)
                {
                    for (int i = k + 1; i < Count; i++)
                    {
                        x[k] -= a[i, k] * x[i];
                    }
                    x[k] /= a[k, k];
                }
            }
        }
    }
}

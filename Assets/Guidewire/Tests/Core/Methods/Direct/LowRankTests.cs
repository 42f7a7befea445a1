using System;
using System.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Columns between pieces that are not neighbours, against dense linear algebra.</summary>
    public sealed class LowRankTests
    {
        private const int N = 11;

        // Signs of c: both; more columns than are eliminated at once; the system alone is indefinite at a shift of 0.
        [TestCase(DistalEnd.Free, 50.0, 1, 1.0, 1, 0)]
        [TestCase(DistalEnd.Sliding, 50.0, 3, 1e3, 2, 0)]
        [TestCase(DistalEnd.Clamped, 50.0, 9, 30.0, 3, 0)]
        [TestCase(DistalEnd.Free, 0.0, 9, 30.0, 4, 0)]
        [TestCase(DistalEnd.Free, 0.0, 17, 1e4, 5, 0)]
        [TestCase(DistalEnd.Sliding, 0.0, 6, 1e-3, 6, 0)]
        [TestCase(DistalEnd.Free, 50.0, 0, 1.0, 7, 1)]
        [TestCase(DistalEnd.Sliding, 50.0, 3, 1e3, 8, 3)]
        [TestCase(DistalEnd.Clamped, 0.0, 9, 30.0, 9, 5)]
        [TestCase(DistalEnd.Free, 0.0, 2, 30.0, 10, 4)]
        public void SolutionAndInertia_AreTheDenseOnes(DistalEnd distal, double shift, int count, double stiffness,
            int seed, int border)
        {
            BlockTridiagonal system = Create(distal, count, stiffness, seed, out Coupling coupling,
                out EnergyTerm[] terms, out RodShape shape, out RodSupports supports, border);
            var gradient = new RodVector[system.VectorCount];
            var y = new RodVector[system.VectorCount];
            int negative = system.Factorise(terms, shape, gradient, y, shift);
            system.Back(y);

            double[,] basis = Bordered(BlockTridiagonalTests.FreeDirections(supports, N), 3 * border, 1.0);
            double[,] h = Bordered(BlockTridiagonalTests.Assembled(terms, shape, coupling.Rod, shift, N), 3 * border,
                0.0);
            coupling.AddTo(h);
            double[,] reduced = BlockTridiagonalTests.Congruent(h, basis);
            int expected = Array.FindAll(DenseMatrix.Eigenvalues(reduced), value => value < 0.0).Length;
            Assert.That(negative, Is.EqualTo(expected));
            AssertSolves(h, basis, y, gradient);

            // The same by the factorisation that is kept.
            system.Gradient(terms, shape, gradient, y);
            system.Solve(y);
            AssertSolves(h, basis, y, gradient);
        }

        [Test]
        public void ReflectedPivots_LeadDownhill_WhateverTheColumns([Values(1, 2, 3, 4, 5, 6, 7, 8)] int seed)
        {
            BlockTridiagonal system = Create(DistalEnd.Free, 2 * seed, 100.0, seed, out _, out EnergyTerm[] terms,
                out RodShape shape, out _);
            var gradient = new RodVector[system.VectorCount];
            var y = new RodVector[system.VectorCount];
            system.Factorise(terms, shape, gradient, y, 0.0);
            system.ReflectNegativePivots(y);
            system.Back(y);
            system.Project(gradient);
            Assert.That(RodVectors.Dot(gradient, y), Is.LessThan(0.0));
        }

        [Test]
        public void IndefiniteMatrix_CountsSignsAndSolves([Values(1, 2, 3, 5, 8, 20)] int size,
            [Values(1, 2, 3)] int seed)
        {
            var random = new System.Random(100 * size + seed);
            var matrix = new IndefiniteMatrix();
            matrix.Resize(size);
            var dense = new double[size, size];
            var right = new double[size];
            for (int i = 0; i < size; i++)
            {
                right[i] = random.NextDouble() - 0.5;
                for (int j = 0; j <= i; j++)
                {
                    // With zeros on the diagonal, so that pivots have two rows.
                    double value = i == j && seed == 2 ? 0.0 : random.NextDouble() - 0.5;
                    matrix[i, j] = dense[i, j] = dense[j, i] = size == 1 && value == 0.0 ? -1.0 : value;
                }
            }
            int positive = Array.FindAll(DenseMatrix.Eigenvalues(dense), value => value > 0.0).Length;
            var solution = (double[])right.Clone();
            Assert.That(matrix.Factorise(), Is.EqualTo(positive));
            matrix.Solve(solution);
            for (int i = 0; i < size; i++)
            {
                double sum = -right[i];
                for (int j = 0; j < size; j++)
                {
                    sum += dense[i, j] * solution[j];
                }
                Assert.That(sum, Is.Zero.Within(1e-10));
            }
        }

        private static void AssertSolves(double[,] h, double[,] basis, RodVector[] y, RodVector[] gradient)
        {
            double[] product = BlockTridiagonalTests.Project(basis, Times(h, Whole(y)), 1.0);
            double[] expected = BlockTridiagonalTests.Project(basis, Whole(gradient), -1.0);
            double scale = 0.0;
            foreach (double value in expected)
            {
                scale = Math.Max(scale, Math.Abs(value));
            }
            for (int i = 0; i < expected.Length; i++)
            {
                Assert.That(product[i], Is.EqualTo(expected[i]).Within(1e-9 * scale));
            }
        }

        // With what borders it.
        private static double[] Whole(RodVector[] v) => DenseMatrix.From(v, N + 1).Concat(v.Skip(N + 2)
            .SelectMany(own => new[] { own.X1, own.X2, own.X3 })).ToArray();

        private static double[,] Bordered(double[,] matrix, int count, double diagonal)
        {
            int rows = matrix.GetLength(0);
            int columns = matrix.GetLength(1);
            var bordered = new double[rows + count, columns + count];
            for (int i = 0; i < rows; i++)
            {
                for (int j = 0; j < columns; j++)
                {
                    bordered[i, j] = matrix[i, j];
                }
            }
            for (int k = 0; k < count; k++)
            {
                bordered[rows + k, columns + k] = diagonal;
            }
            return bordered;
        }

        private static double[] Times(double[,] h, double[] v)
        {
            var result = new double[v.Length];
            for (int i = 0; i < v.Length; i++)
            {
                for (int j = 0; j < v.Length; j++)
                {
                    result[i] += h[i, j] * v[j];
                }
            }
            return result;
        }

        private static BlockTridiagonal Create(DistalEnd distal, int count, double stiffness, int seed,
            out Coupling coupling, out EnergyTerm[] terms, out RodShape shape, out RodSupports supports,
            int border = 0)
        {
            MaterialRod rod = MaterialRod.Round(N, 1.0, 0.1, 300.0, 130.0, 2.0);
            Vector3d axis = Vector3d.Normalize(new Vector3d(1.0, 2.0, -1.0));
            supports = new RodSupports { Distal = distal, SlidingAxis = axis };
            var rodTerms = new RodTerms(rod, supports);
            rodTerms.Loads.Set(new Vector3d(0.1, 0.2, 0.3), new Vector3d(0.0, 0.1, 0.0));
            coupling = new Coupling(rod, count, stiffness, seed, border);
            terms = rodTerms.With(coupling);
            shape = Rods.Random(rod, 1.2, 0.1, 11 + seed);
            shape.FitVessel(border);
            return new BlockTridiagonal(rod, supports, border);
        }

        private sealed class Coupling : EnergyTerm
        {
            private readonly int[] _elements;
            private readonly RodVector[] _vectors;
            private readonly double[] _stiffness;
            private readonly int _border;
            private readonly int _seed;

            public Coupling(MaterialRod rod, int count, double stiffness, int seed, int border)
            {
                (_border, _seed) = (border, seed);
                Rod = rod;
                var random = new System.Random(seed);
                _elements = new int[2 * count];
                _vectors = new RodVector[4 * count];
                _stiffness = new double[count];
                for (int k = 0; k < count; k++)
                {
                    _elements[2 * k] = random.Next(N - 2);
                    _elements[2 * k + 1] = random.Next(_elements[2 * k] + 2, N);
                    _stiffness[k] = stiffness * (random.NextDouble() - 0.5);
                    for (int i = 0; i < 4; i++)
                    {
                        var turn = (i & 1) == 0 ? Any(random) : Vector3d.Zero;
                        _vectors[4 * k + i] = new RodVector(Any(random), turn);
                    }
                }
            }

            public MaterialRod Rod { get; }

            public override double Value(RodShape shape) => 0.0;

            public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
                ref GradientMeasures measured)
            {
                for (int j = 0; j < _border && to > N; j++)
                {
                    gradient[shape.VesselStart + j].AddX(new Vector3d(0.3, -0.2, 0.1 * j));
                }
            }

            public override void AddColumns(RodShape shape, LowRank columns)
            {
                for (int k = 0; k < _stiffness.Length; k++)
                {
                    columns.Add(_elements[2 * k], _elements[2 * k + 1], _vectors[4 * k], _vectors[4 * k + 1],
                        _vectors[4 * k + 2], _vectors[4 * k + 3], _stiffness[k]);
                }
                ForBorder((row, column, value) => columns.Border(row, column) += value, columns.AddCoupling);
            }

            private delegate void Take(int node, int j, in Matrix3 second, in Matrix3 turn);

            // Nodes and elements, both ends among them, against three unknowns each, not definite for odd seeds.
            private void ForBorder(Action<int, int, double> own, Take coupling)
            {
                var random = new System.Random(_seed);
                for (int j = 0; j < _border; j++)
                {
                    for (int k = 0; k < 5; k++)
                    {
                        int node = k == 0 ? 0 : k == 1 ? N : random.Next(N);
                        coupling(node, j, new Matrix3(Any(random), Any(random), Any(random)), node == N ? default
                            : new Matrix3(Any(random), Any(random), Any(random)));
                    }
                    for (int a = 0; a < 3; a++)
                    {
                        for (int column = 0; column <= 3 * j + a; column++)
                        {
                            own(3 * j + a, column, random.NextDouble() - 0.5
                                + (column == 3 * j + a && _seed % 2 == 0 ? 300.0 : 0.0));
                        }
                    }
                }
            }

            public void AddTo(double[,] h)
            {
                for (int k = 0; k < _stiffness.Length; k++)
                {
                    var u = new RodVector[N + 1];
                    for (int i = 0; i < 4; i++)
                    {
                        u[_elements[2 * k + i / 2] + i % 2].AddScaled(1.0, _vectors[4 * k + i]);
                    }
                    double[] dense = DenseMatrix.From(u, N + 1);
                    for (int i = 0; i < dense.Length; i++)
                    {
                        for (int j = 0; j < dense.Length; j++)
                        {
                            h[i, j] += _stiffness[k] * dense[i] * dense[j];
                        }
                    }
                }
                int start = 6 * (N + 1);
                ForBorder((row, column, value) =>
                {
                    h[start + row, start + column] = value;
                    h[start + column, start + row] = value;
                }, (int node, int j, in Matrix3 second, in Matrix3 turn) =>
                {
                    for (int a = 0; a < 6; a++)
                    {
                        for (int b = 0; b < 3; b++)
                        {
                            double value = a < 3 ? second[a, b] : turn[a - 3, b];
                            h[6 * node + a, start + 3 * j + b] += value;
                            h[start + 3 * j + b, 6 * node + a] += value;
                        }
                    }
                });
            }

            private static Vector3d Any(System.Random random) => new Vector3d(random.NextDouble() - 0.5,
                random.NextDouble() - 0.5, random.NextDouble() - 0.5);
        }
    }
}

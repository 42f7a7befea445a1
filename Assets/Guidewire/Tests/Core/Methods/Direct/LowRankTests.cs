using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Columns between pieces that are not neighbours, against dense linear algebra.</summary>
    public sealed class LowRankTests
    {
        private const int N = 11;

        // Signs of c: both; more columns than are eliminated at once; the system alone is indefinite at a shift of 0.
        [TestCase(DistalEnd.Free, 50.0, 1, 1.0, 1)]
        [TestCase(DistalEnd.Sliding, 50.0, 3, 1e3, 2)]
        [TestCase(DistalEnd.Clamped, 50.0, 9, 30.0, 3)]
        [TestCase(DistalEnd.Free, 0.0, 9, 30.0, 4)]
        [TestCase(DistalEnd.Free, 0.0, 17, 1e4, 5)]
        [TestCase(DistalEnd.Sliding, 0.0, 6, 1e-3, 6)]
        public void SolutionAndInertia_AreTheDenseOnes(DistalEnd distal, double shift, int count, double stiffness,
            int seed)
        {
            BlockTridiagonal system = Create(distal, count, stiffness, seed, out Coupling coupling,
                out EnergyTerm[] terms, out RodShape shape, out RodSupports supports);
            var gradient = new RodVector[system.VectorCount];
            var y = new RodVector[system.VectorCount];
            int negative = system.Factorise(terms, shape, gradient, y, shift);
            system.Back(y);

            double[,] basis = BlockTridiagonalTests.FreeDirections(supports, N);
            double[,] h = BlockTridiagonalTests.Assembled(terms, shape, coupling.Rod, shift, N);
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
            double[] full = DenseMatrix.From(y, N + 1);
            double[] product = BlockTridiagonalTests.Project(basis, Times(h, full), 1.0);
            double[] expected = BlockTridiagonalTests.Project(basis, DenseMatrix.From(gradient, N + 1), -1.0);
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
            out Coupling coupling, out EnergyTerm[] terms, out RodShape shape, out RodSupports supports)
        {
            MaterialRod rod = MaterialRod.Round(N, 1.0, 0.1, 300.0, 130.0, 2.0);
            Vector3d axis = Vector3d.Normalize(new Vector3d(1.0, 2.0, -1.0));
            supports = new RodSupports { Distal = distal, SlidingAxis = axis };
            var rodTerms = new RodTerms(rod, supports);
            rodTerms.Loads.Set(new Vector3d(0.1, 0.2, 0.3), new Vector3d(0.0, 0.1, 0.0));
            coupling = new Coupling(rod, count, stiffness, seed);
            terms = rodTerms.With(coupling);
            shape = Rods.Random(rod, 1.2, 0.1, 11 + seed);
            return new BlockTridiagonal(rod, supports);
        }

        private sealed class Coupling : EnergyTerm
        {
            private readonly int[] _elements;
            private readonly RodVector[] _vectors;
            private readonly double[] _stiffness;

            public Coupling(MaterialRod rod, int count, double stiffness, int seed)
            {
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
            }

            public override void AddColumns(RodShape shape, LowRank columns)
            {
                for (int k = 0; k < _stiffness.Length; k++)
                {
                    columns.Add(_elements[2 * k], _elements[2 * k + 1], _vectors[4 * k], _vectors[4 * k + 1],
                        _vectors[4 * k + 2], _vectors[4 * k + 3], _stiffness[k]);
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
            }

            private static Vector3d Any(System.Random random) => new Vector3d(random.NextDouble() - 0.5,
                random.NextDouble() - 0.5, random.NextDouble() - 0.5);
        }
    }
}

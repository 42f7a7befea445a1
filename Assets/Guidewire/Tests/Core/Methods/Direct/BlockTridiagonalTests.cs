using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The written-out elimination against dense linear algebra.</summary>
    public sealed class BlockTridiagonalTests
    {
        private const int N = 7;

        [TestCase(DistalEnd.Free)]
        [TestCase(DistalEnd.Clamped)]
        [TestCase(DistalEnd.Sliding)]
        public void Solution_IsTheDenseOne(DistalEnd distal)
        {
            RodSystem(distal, 0.2, out MaterialRod rod, out RodSupports supports, out EnergyTerm[] terms,
                out RodShape shape);
            var system = new BlockTridiagonal(rod, supports);
            var gradient = new RodVector[system.VectorCount];
            var y = new RodVector[system.VectorCount];
            int negative = system.Factorise(terms, shape, gradient, y, 50.0);
            system.Back(y);
            Assert.That(negative, Is.Zero, "the shift must make the matrix positive definite");

            double[,] h = Assembled(terms, shape, rod, 50.0);
            double[,] basis = FreeDirections(supports);
            double[,] reduced = Congruent(h, basis);
            double[] right = Project(basis, DenseMatrix.From(gradient, N + 1), -1.0);
            double[] free = DenseMatrix.Solve(DenseMatrix.Cholesky(reduced), right);
            double[] expected = Expand(basis, free);
            DenseMatrix.AssertEqual(DenseMatrix.From(y, N + 1), expected);

            // The same by the factorisation that is kept.
            system.Gradient(terms, shape, gradient, y);
            system.Solve(y);
            DenseMatrix.AssertEqual(DenseMatrix.From(y, N + 1), expected);
        }

        [TestCase(0.05)]
        [TestCase(0.6)]
        [TestCase(1.2)]
        public void NegativePivots_CountTheNegativeEigenvalues(double angle)
        {
            RodSystem(DistalEnd.Free, angle, out MaterialRod rod, out RodSupports supports, out EnergyTerm[] terms,
                out RodShape shape);
            var system = new BlockTridiagonal(rod, supports);
            var vectors = new RodVector[system.VectorCount];
            int negative = system.Factorise(terms, shape, new RodVector[system.VectorCount], vectors, 0.0);
            double[,] reduced = Congruent(Assembled(terms, shape, rod, 0.0), FreeDirections(supports));
            int expected = 0;
            foreach (double value in DenseMatrix.Eigenvalues(reduced))
            {
                expected += value < 0.0 ? 1 : 0;
            }
            Assert.That(negative, Is.EqualTo(expected));
        }

        [TestCase(0.05, 0.0)]
        [TestCase(0.6, 0.0)]
        [TestCase(1.2, 0.0)]
        [TestCase(1.2, 50.0)]
        public void ReflectedPivots_LeadDownhill_AndLeaveAPositiveMatrixAsItIs(double angle, double shift)
        {
            RodSystem(DistalEnd.Free, angle, out MaterialRod rod, out RodSupports supports, out EnergyTerm[] terms,
                out RodShape shape);
            var system = new BlockTridiagonal(rod, supports);
            var gradient = new RodVector[system.VectorCount];
            var plain = new RodVector[system.VectorCount];
            var reflected = new RodVector[system.VectorCount];
            int negative = system.Factorise(terms, shape, gradient, plain, shift);
            system.Back(plain);
            system.Factorise(terms, shape, gradient, reflected, shift);
            system.ReflectNegativePivots(reflected);
            system.Back(reflected);
            system.Project(gradient);
            Assert.That(RodVectors.Dot(gradient, reflected), Is.LessThan(0.0));
            // g^T (L |D| L^T)^-1 g - g^T (L D L^T)^-1 g is a sum of squares over the negative pivots.
            Assert.That(
                RodVectors.Dot(gradient, reflected), Is.LessThanOrEqualTo(RodVectors.Dot(gradient, plain)));
            if (negative == 0)
            {
                Assert.That(DenseMatrix.From(reflected, N + 1), Is.EqualTo(DenseMatrix.From(plain, N + 1)));
            }
            else
            {
                Assert.That(DenseMatrix.From(reflected, N + 1), Is.Not.EqualTo(DenseMatrix.From(plain, N + 1)));
            }

            // The same by the factorisation that is kept.
            var kept = new RodVector[system.VectorCount];
            system.Gradient(terms, shape, gradient, kept);
            system.Solve(kept);
            DenseMatrix.AssertEqual(DenseMatrix.From(kept, N + 1), DenseMatrix.From(reflected, N + 1));
        }

        [Test]
        public void LongRod_TakenInPieces_IsTheSameAsInOne()
        {
            // 100 blocks are assembled in pieces of 32; the sum of A y over all of them must return the gradient.
            MaterialRod rod = Rods.Wire(99);
            var supports = new RodSupports();
            var rodTerms = new RodTerms(rod, supports);
            rodTerms.Loads.Set(new Vector3d(0.0, -9.81, 0.0), Vector3d.Zero);
            EnergyTerm[] terms = rodTerms.All;
            RodShape shape = Rods.Straight(rod);
            var system = new BlockTridiagonal(rod, supports);
            var gradient = new RodVector[system.VectorCount];
            var y = new RodVector[system.VectorCount];
            Assert.That(system.Factorise(terms, shape, gradient, y, 0.0), Is.Zero);
            system.Back(y);
            // Linear theory: tip sag w L^4/(8 EI) + w L^2/(2 GA); the discretisation error is far below 1e-5 here.
            double w = Rods.Density * Rods.Area * 9.81;
            double sag = w * Math.Pow(Rods.Length, 4) / (8.0 * Rods.BendStiffness)
                + w * Rods.Length * Rods.Length / (2.0 * Rods.Shear * Rods.Area);
            Assert.That(y[99].X2, Is.EqualTo(-sag).Within(1e-5 * sag));
        }

        private static void RodSystem(DistalEnd distal, double angle, out MaterialRod rod, out RodSupports supports,
            out EnergyTerm[] terms, out RodShape shape)
        {
            rod = MaterialRod.Round(N, 1.0, 0.1, 300.0, 130.0, 2.0);
            Vector3d axis = Vector3d.Normalize(new Vector3d(1.0, 2.0, -1.0));
            supports = new RodSupports { Distal = distal, SlidingAxis = axis };
            var rodTerms = new RodTerms(rod, supports);
            rodTerms.Loads.Set(new Vector3d(0.1, 0.2, 0.3), new Vector3d(0.0, 0.1, 0.0));
            var inertia = new InertiaEnergy(rodTerms.Mass) { StageLength = 2.0 };
            terms = rodTerms.With(inertia);
            shape = Rods.Random(rod, angle, 0.1, 11);
            inertia.BeginStep(shape, 1.0);
        }

        internal static double[,] Assembled(EnergyTerm[] terms, RodShape shape, MaterialRod rod, double shift,
            int n = N)
        {
            var blocks = new RodBlock[n + 2];
            foreach (EnergyTerm term in terms)
            {
                term.AddBlocks(shape, blocks, new RodVector[n + 2 + shape.Vessel.Length], 0, n + 1);
            }
            double[,] h = DenseMatrix.From(blocks, n + 1);
            for (int i = 0; i < 6 * (n + 1); i++)
            {
                double l = rod.Length[Math.Min(i / 6, n - 1)];
                h[i, i] += shift * (i % 6 < 3 ? l / (rod.TotalLength * rod.TotalLength) : l);
            }
            return h;
        }

        /// <summary>Columns: the unit vectors of all unknowns that the supports leave free.</summary>
        internal static double[,] FreeDirections(RodSupports supports, int n = N)
        {
            int order = 6 * (n + 1);
            int end = supports.Distal == DistalEnd.Free ? 3 : supports.Distal == DistalEnd.Sliding ? 1 : 0;
            int inner = 6 * n - 3;
            var basis = new double[order, inner + end];
            for (int k = 0; k < inner; k++)
            {
                basis[k + 3, k] = 1.0;
            }
            if (end == 3)
            {
                for (int k = 0; k < 3; k++)
                {
                    basis[6 * n + k, inner + k] = 1.0;
                }
            }
            else if (end == 1)
            {
                basis[6 * n, inner] = supports.SlidingAxis.X;
                basis[6 * n + 1, inner] = supports.SlidingAxis.Y;
                basis[6 * n + 2, inner] = supports.SlidingAxis.Z;
            }
            return basis;
        }

        internal static double[,] Congruent(double[,] h, double[,] basis)
        {
            int order = basis.GetLength(0);
            int free = basis.GetLength(1);
            var half = new double[order, free];
            var result = new double[free, free];
            for (int i = 0; i < order; i++)
            {
                for (int j = 0; j < free; j++)
                {
                    for (int k = 0; k < order; k++)
                    {
                        half[i, j] += h[i, k] * basis[k, j];
                    }
                }
            }
            for (int i = 0; i < free; i++)
            {
                for (int j = 0; j < free; j++)
                {
                    for (int k = 0; k < order; k++)
                    {
                        result[i, j] += basis[k, i] * half[k, j];
                    }
                }
            }
            return result;
        }

        internal static double[] Project(double[,] basis, double[] v, double sign)
        {
            var result = new double[basis.GetLength(1)];
            for (int j = 0; j < result.Length; j++)
            {
                for (int k = 0; k < v.Length; k++)
                {
                    result[j] += sign * basis[k, j] * v[k];
                }
            }
            return result;
        }

        private static double[] Expand(double[,] basis, double[] v)
        {
            var result = new double[basis.GetLength(0)];
            for (int i = 0; i < result.Length; i++)
            {
                for (int j = 0; j < v.Length; j++)
                {
                    result[i] += basis[i, j] * v[j];
                }
            }
            return result;
        }
    }
}

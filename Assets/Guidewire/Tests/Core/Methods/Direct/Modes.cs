using System;

namespace Guidewire.Core.Tests
{
    /// <summary>Modes of a rod in one plane by dense inverse iteration on K^-1 M, the modes found taken out.</summary>
    internal sealed class Modes
    {
        private const int Iterations = 60;

        private readonly double[,] _factor;  // of K
        private readonly double[,] _mass;
        private readonly int[] _unknowns;
        private readonly int _order;

        private Modes(double[,] stiffness, double[,] mass, int[] unknowns, int order)
        {
            _factor = DenseMatrix.Cholesky(DenseMatrix.Take(stiffness, unknowns));
            _mass = DenseMatrix.Take(mass, unknowns);
            _unknowns = unknowns;
            _order = order;
        }

        /// <summary>The wire, straight, clamped and free, its bending in the y-z plane.</summary>
        public static Modes Cantilever(int n, MassRule mass, ClampRule clamp) =>
            Of(Rods.Wire(n), new RodSupports { Mass = mass, Clamp = clamp });

        /// <summary>A straight rod along z, clamped at node 0 and free: bending in the y-z plane.</summary>
        public static Modes Of(MaterialRod rod, RodSupports supports)
        {
            int n = rod.ElementCount;
            RodShape shape = Rods.Straight(rod);
            var rodTerms = new RodTerms(rod, supports);
            var stiffness = new RodBlock[n + 2];
            var gradient = new RodVector[n + 2];
            rodTerms.Stretch.AddBlocks(shape, stiffness, gradient, 0, n + 1);
            rodTerms.Bending.AddBlocks(shape, stiffness, gradient, 0, n + 1);
            var inertia = new InertiaEnergy(rodTerms.Mass) { StageLength = 1.0 };
            inertia.BeginStep(shape, 1.0);
            var mass = new RodBlock[n + 2];
            inertia.AddBlocks(shape, mass, gradient, 0, n + 1);
            // y of nodes 1..n, turn about x of elements 0..n-1.
            var unknowns = new int[2 * n];
            for (int j = 0; j < n; j++)
            {
                unknowns[2 * j] = 6 * j + 3;
                unknowns[2 * j + 1] = 6 * (j + 1) + 1;
            }
            return new Modes(DenseMatrix.From(stiffness, n + 1), DenseMatrix.From(mass, n + 1), unknowns, 6 * (n + 1));
        }

        /// <summary>The lowest frequencies, Hz.</summary>
        public double[] Frequencies(int count)
        {
            var frequencies = new double[count];
            for (int k = 0; k < count; k++)
            {
                frequencies[k] = Find(k + 1, out _) / (2.0 * Math.PI);
            }
            return frequencies;
        }

        /// <summary>The first mode as a direction whose largest entry is the tip's, 1; and its circular
        /// frequency.</summary>
        public RodVector[] First(out double omega) => Mode(1, out omega);

        /// <summary>The mode of this number, from 1, in the same way.</summary>
        public RodVector[] Mode(int number, out double omega)
        {
            omega = Find(number, out double[] mode);
            var whole = new double[_order];
            double tip = mode[mode.Length - 1];
            for (int i = 0; i < mode.Length; i++)
            {
                whole[_unknowns[i]] = mode[i] / tip;
            }
            return DenseMatrix.ToRod(whole);
        }

        private double Find(int number, out double[] mode)
        {
            int order = _unknowns.Length;
            var found = new double[number][];
            double omega = 0.0;
            for (int m = 0; m < number; m++)
            {
                var v = new double[order];
                for (int i = 0; i < order; i++)
                {
                    v[i] = Math.Sin(1.0 + i * (m + 1.7));
                }
                for (int k = 0; k < Iterations; k++)
                {
                    for (int f = 0; f < m; f++)
                    {
                        double fraction = DenseMatrix.Dot(found[f], DenseMatrix.Product(_mass, v));
                        for (int i = 0; i < order; i++)
                        {
                            v[i] -= fraction * found[f][i];
                        }
                    }
                    double norm = Math.Sqrt(DenseMatrix.Dot(v, DenseMatrix.Product(_mass, v)));
                    for (int i = 0; i < order; i++)
                    {
                        v[i] /= norm;
                    }
                    found[m] = v;
                    double[] next = DenseMatrix.Solve(_factor, DenseMatrix.Product(_mass, v));
                    omega = 1.0 / Math.Sqrt(DenseMatrix.Dot(v, DenseMatrix.Product(_mass, next)));
                    v = next;
                }
            }
            mode = found[number - 1];
            return omega;
        }
    }
}

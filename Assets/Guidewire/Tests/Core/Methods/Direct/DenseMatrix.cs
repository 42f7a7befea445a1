using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Plain dense linear algebra, the readable counterpart of the block-tridiagonal one.</summary>
    internal static class DenseMatrix
    {
        /// <summary>The whole symmetric matrix of order 6 (n + 1) that n+1 blocks stand for.</summary>
        public static double[,] From(RodBlock[] blocks, int count)
        {
            var h = new double[6 * count, 6 * count];
            for (int i = 0; i < count; i++)
            {
                RodBlock b = blocks[i];
                Put(h, 6 * i, 6 * i, b.A11, b.A21, b.A31, b.A21, b.A22, b.A32, b.A31, b.A32, b.A33);
                Put(h, 6 * i + 3, 6 * i, b.B11, b.B12, b.B13, b.B21, b.B22, b.B23, b.B31, b.B32, b.B33);
                Put(h, 6 * i + 3, 6 * i + 3, b.C11, b.C21, b.C31, b.C21, b.C22, b.C32, b.C31, b.C32, b.C33);
                if (i + 1 < count)
                {
                    Put(h, 6 * i + 6, 6 * i, b.D11, b.D12, b.D13, b.D21, b.D22, b.D23, b.D31, b.D32, b.D33);
                    Put(h, 6 * i + 6, 6 * i + 3, b.E11, b.E12, b.E13, b.E21, b.E22, b.E23, b.E31, b.E32, b.E33);
                    Put(h, 6 * i + 9, 6 * i + 3, b.F11, b.F12, b.F13, b.F21, b.F22, b.F23, b.F31, b.F32, b.F33);
                }
            }
            return h;
        }

        /// <summary>Of a square matrix and a vector.</summary>
        public static double[] Product(double[,] a, double[] x)
        {
            var y = new double[x.Length];
            for (int i = 0; i < x.Length; i++)
            {
                for (int j = 0; j < x.Length; j++)
                {
                    y[i] += a[i, j] * x[j];
                }
            }
            return y;
        }

        /// <summary>Of two vectors.</summary>
        public static double Dot(double[] x, double[] y)
        {
            double sum = 0.0;
            for (int i = 0; i < x.Length; i++)
            {
                sum += x[i] * y[i];
            }
            return sum;
        }

        /// <summary>Compares two vectors to 1e-9 of the largest component.</summary>
        public static void AssertEqual(double[] found, double[] expected)
        {
            double largest = 0.0;
            foreach (double value in expected)
            {
                largest = Math.Max(largest, Math.Abs(value));
            }
            Assert.That(found, Is.EqualTo(expected).Within(1e-9 * largest));
        }

        /// <summary>Gradient as one long vector.</summary>
        public static double[] From(RodVector[] vectors, int count)
        {
            var v = new double[6 * count];
            for (int i = 0; i < count; i++)
            {
                RodVector r = vectors[i];
                double[] parts = { r.X1, r.X2, r.X3, r.T1, r.T2, r.T3 };
                Array.Copy(parts, 0, v, 6 * i, 6);
            }
            return v;
        }

        /// <summary>One long vector as vectors of nodes.</summary>
        public static RodVector[] ToRod(double[] v)
        {
            var vectors = new RodVector[v.Length / 6 + 1];
            for (int i = 0; i < v.Length / 6; i++)
            {
                vectors[i] = new RodVector
                {
                    X1 = v[6 * i], X2 = v[6 * i + 1], X3 = v[6 * i + 2],
                    T1 = v[6 * i + 3], T2 = v[6 * i + 4], T3 = v[6 * i + 5],
                };
            }
            return vectors;
        }

        /// <summary>The rows and columns of the free unknowns.</summary>
        public static double[,] Take(double[,] a, int[] indices)
        {
            var part = new double[indices.Length, indices.Length];
            for (int i = 0; i < indices.Length; i++)
            {
                for (int j = 0; j < indices.Length; j++)
                {
                    part[i, j] = a[indices[i], indices[j]];
                }
            }
            return part;
        }

        /// <summary>L of A = L L^T.</summary>
        public static double[,] Cholesky(double[,] a)
        {
            int n = a.GetLength(0);
            var l = new double[n, n];
            for (int j = 0; j < n; j++)
            {
                for (int i = j; i < n; i++)
                {
                    double sum = a[i, j];
                    for (int k = 0; k < j; k++)
                    {
                        sum -= l[i, k] * l[j, k];
                    }
                    l[i, j] = i == j ? Math.Sqrt(sum) : sum / l[j, j];
                }
            }
            return l;
        }

        /// <summary>The solution of L L^T u = b.</summary>
        public static double[] Solve(double[,] l, double[] b)
        {
            int n = b.Length;
            var u = (double[])b.Clone();
            for (int i = 0; i < n; i++)
            {
                for (int k = 0; k < i; k++)
                {
                    u[i] -= l[i, k] * u[k];
                }
                u[i] /= l[i, i];
            }
            for (int i = n - 1; i >= 0; i--)
            {
                for (int k = i + 1; k < n; k++)
                {
                    u[i] -= l[k, i] * u[k];
                }
                u[i] /= l[i, i];
            }
            return u;
        }

        /// <summary>All eigenvalues of a symmetric matrix, by Jacobi's rotations.</summary>
        public static double[] Eigenvalues(double[,] matrix)
        {
            int n = matrix.GetLength(0);
            var a = (double[,])matrix.Clone();
            for (int sweep = 0; sweep < 60; sweep++)
            {
                for (int p = 0; p < n; p++)
                {
                    for (int q = p + 1; q < n; q++)
                    {
                        Rotate(a, p, q);
                    }
                }
            }
            var values = new double[n];
            for (int i = 0; i < n; i++)
            {
                values[i] = a[i, i];
            }
            return values;
        }

        private static void Rotate(double[,] a, int p, int q)
        {
            if (a[p, q] == 0.0)
            {
                return;
            }
            double theta = (a[q, q] - a[p, p]) / (2.0 * a[p, q]);
            double t = (theta >= 0.0 ? 1.0 : -1.0) / (Math.Abs(theta) + Math.Sqrt(theta * theta + 1.0));
            double c = 1.0 / Math.Sqrt(t * t + 1.0);
            double s = t * c;
            for (int k = 0; k < a.GetLength(0); k++)
            {
                double kp = a[k, p];
                double kq = a[k, q];
                a[k, p] = c * kp - s * kq;
                a[k, q] = s * kp + c * kq;
            }
            for (int k = 0; k < a.GetLength(0); k++)
            {
                double pk = a[p, k];
                double qk = a[q, k];
                a[p, k] = c * pk - s * qk;
                a[q, k] = s * pk + c * qk;
            }
        }

        private static void Put(double[,] h, int row, int column, params double[] entries)
        {
            for (int i = 0; i < 3; i++)
            {
                for (int j = 0; j < 3; j++)
                {
                    h[row + i, column + j] = entries[3 * i + j];
                    h[column + j, row + i] = entries[3 * i + j];
                }
            }
        }
    }
}

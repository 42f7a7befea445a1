using System;

namespace Guidewire.Core
{
    /// <summary>Eigenvalues and eigenvectors of a dense symmetric matrix, by Jacobi's rotations.</summary>
    internal static class SymmetricEigenvalues
    {
        private const int MaxSweeps = 30;
        private const double Rounding = 1e-15;    // of the largest entry on the diagonal

        /// <summary>Gives the eigenvalues of a matrix, which is overwritten.</summary>
        /// <param name="vectors">Their unit eigenvectors, by columns.</param>
        public static double[] Find(double[,] matrix, out double[,] vectors)
        {
            int n = matrix.GetLength(0);
            vectors = new double[n, n];
            var values = new double[n];
            for (int i = 0; i < n; i++)
            {
                vectors[i, i] = 1.0;
            }
            bool isDone = false;
            for (int sweep = 0; sweep < MaxSweeps && !isDone; sweep++)
            {
                isDone = true;
                for (int p = 0; p < n; p++)
                {
                    for (int q = p + 1; q < n; q++)
                    {
                        isDone &= !Rotate(matrix, vectors, p, q);
                    }
                }
            }
            for (int i = 0; i < n; i++)
            {
                values[i] = matrix[i, i];
            }
            return values;
        }

        // Makes the entry (p, q) 0; false where it is.
        private static bool Rotate(double[,] a, double[,] vectors, int p, int q)
        {
            double off = a[p, q];
            if (Math.Abs(off) <= Rounding * Math.Max(Math.Abs(a[p, p]), Math.Abs(a[q, q])))
            {
                return false;
            }
            double half = 0.5 * (a[q, q] - a[p, p]) / off;
            double tangent = (half < 0.0 ? -1.0 : 1.0) / (Math.Abs(half) + Math.Sqrt(half * half + 1.0));
            double cosine = 1.0 / Math.Sqrt(tangent * tangent + 1.0);
            double sine = tangent * cosine;
            int n = a.GetLength(0);
            for (int i = 0; i < n; i++)
            {
                (a[i, p], a[i, q]) = (cosine * a[i, p] - sine * a[i, q], sine * a[i, p] + cosine * a[i, q]);
                (vectors[i, p], vectors[i, q]) = (cosine * vectors[i, p] - sine * vectors[i, q],
                    sine * vectors[i, p] + cosine * vectors[i, q]);
            }
            for (int i = 0; i < n; i++)
            {
                (a[p, i], a[q, i]) = (cosine * a[p, i] - sine * a[q, i], sine * a[p, i] + cosine * a[q, i]);
            }
            return true;
        }
    }
}

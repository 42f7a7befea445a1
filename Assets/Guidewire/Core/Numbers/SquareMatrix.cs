using System;

namespace Guidewire.Core
{
    /// <summary>Small dense matrices without symmetry: inverse, and the number of eigenvalues on one side of a
    /// line.</summary>
    /// <remarks>The sign of a matrix has its eigenvectors and the eigenvalues +1 and -1, as the real parts are above or
    /// below 0 (Roberts 1980). Newton's iteration S := (S + S^-1)/2 finds it, and its trace is the difference of their
    /// numbers. Scaling S by |det S|^(-1/n) first prevents eigenvalues of unlike size from taking turns (Byers
    /// 1987).</remarks>
    internal static class SquareMatrix
    {
        private const int MaxSteps = 60;
        private const double TraceTolerance = 1e-6;

        /// <summary>a^-1, by Gauss and Jordan with row pivots; not finite where a is singular.</summary>
        /// <param name="logOfDeterminant">ln |det a|.</param>
        public static double[,] Inverse(double[,] a, out double logOfDeterminant)
        {
            int n = a.GetLength(0);
            double[,] rest = (double[,])a.Clone();
            double[,] inverse = new double[n, n];
            for (int i = 0; i < n; i++)
            {
                inverse[i, i] = 1.0;
            }
            logOfDeterminant = 0.0;
            for (int k = 0; k < n; k++)
            {
                int pivot = k;
                for (int i = k + 1; i < n; i++)
                {
                    pivot = Math.Abs(rest[i, k]) > Math.Abs(rest[pivot, k]) ? i : pivot;
                }
                double value = rest[pivot, k];
                logOfDeterminant += Math.Log(Math.Abs(value));
                for (int j = 0; j < n; j++)
                {
                    double r = rest[pivot, j] / value;
                    double v = inverse[pivot, j] / value;
                    rest[pivot, j] = rest[k, j];
                    inverse[pivot, j] = inverse[k, j];
                    rest[k, j] = r;
                    inverse[k, j] = v;
                }
                for (int i = 0; i < n; i++)
                {
                    double factor = i == k ? 0.0 : rest[i, k];
                    for (int j = 0; j < n && factor != 0.0; j++)
                    {
                        rest[i, j] -= factor * rest[k, j];
                        inverse[i, j] -= factor * inverse[k, j];
                    }
                }
            }
            return inverse;
        }

        /// <summary>Gives the number of eigenvalues of a with a real part below <paramref name="x"/>.</summary>
        public static int EigenvaluesLeftOf(double[,] a, double x)
        {
            int n = a.GetLength(0);
            double[,] sign = (double[,])a.Clone();
            for (int i = 0; i < n; i++)
            {
                sign[i, i] -= x;
            }
            double trace = double.PositiveInfinity;
            for (int step = 0; step < MaxSteps; step++)
            {
                double[,] inverse = Inverse(sign, out double logOfDeterminant);
                double scale = Math.Exp(-logOfDeterminant / n);
                double last = trace;
                trace = 0.0;
                for (int i = 0; i < n; i++)
                {
                    for (int j = 0; j < n; j++)
                    {
                        sign[i, j] = 0.5 * (scale * sign[i, j] + inverse[i, j] / scale);
                    }
                    trace += sign[i, i];
                }
                if (Math.Abs(trace - last) < TraceTolerance && Math.Abs(trace - Math.Round(trace)) < TraceTolerance)
                {
                    break;
                }
            }
            return (int)Math.Round(0.5 * (n - trace));
        }
    }

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

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
}

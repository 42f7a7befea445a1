using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Integral of the chord of a unit circle over the distance from its middle, F(u) = integral from 0 to u
    /// of 2 sqrt(1 - s^2) ds = u sqrt(1 - u^2) + asin u, constant beyond the circle; from a table, linear between its
    /// entries. The mean chord of a circle of radius r between the distances a and b is r^2 (F(b/r) - F(a/r))/(b - a).
    /// </summary>
    internal static class ChordIntegral
    {
        private const int Entries = 4096;
        private static readonly double[] Table = Create();

        /// <summary>Gives F(u), off by less than 4e-6.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static double At(double u)
        {
            if (u <= -1.0)
            {
                return -0.5 * Math.PI;
            }
            if (!(u < 1.0))
            {
                return 0.5 * Math.PI;
            }
            double at = 0.5 * Entries * (u + 1.0);
            int k = (int)at;
            double low = Table[k];
            return low + (at - k) * (Table[k + 1] - low);
        }

        private static double[] Create()
        {
            var table = new double[Entries + 2];
            for (int k = 0; k < table.Length; k++)
            {
                double u = Math.Min(1.0, 2.0 * k / Entries - 1.0);
                table[k] = u * Math.Sqrt(Math.Max(0.0, 1.0 - u * u)) + Math.Asin(u);
            }
            return table;
        }
    }
}

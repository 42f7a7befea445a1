using System;

namespace Guidewire.Core
{
    /// <summary>Points and weights of the quadrature of Gauss and Legendre on [-1, 1], exact for polynomials up to
    /// degree 2 n - 1.</summary>
    internal static class GaussLegendre
    {
        /// <summary>Gives one of n points, the largest first, and its weight, by Newton's method on Legendre's
        /// polynomial.</summary>
        public static (double Point, double Weight) At(int count, int index)
        {
            double x = Math.Cos(Math.PI * (index + 0.75) / (count + 0.5));
            double slope = 0.0;
            for (int k = 0; k < 20; k++)
            {
                double before = 1.0;
                double value = x;
                for (int n = 2; n <= count; n++)
                {
                    (before, value) = (value, ((2.0 * n - 1.0) * x * value - (n - 1.0) * before) / n);
                }
                slope = count * (x * value - before) / (x * x - 1.0);
                double next = x - value / slope;
                if (next == x)
                {
                    break;
                }
                x = next;
            }
            return (x, 2.0 / ((1.0 - x * x) * slope * slope));
        }
    }
}

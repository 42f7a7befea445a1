using System;

namespace Guidewire.Core.Tests
{
    /// <summary>Roots and limits by bisection.</summary>
    internal static class Bisection
    {
        /// <summary>The number between two others up to which a condition holds; 60 halvings are to rounding.</summary>
        public static double Limit(double low, double high, Func<double, bool> holds, int halvings = 60)
        {
            for (int k = 0; k < halvings; k++)
            {
                double middle = 0.5 * (low + high);
                if (holds(middle))
                {
                    low = middle;
                }
                else
                {
                    high = middle;
                }
            }
            return low;
        }
    }
}

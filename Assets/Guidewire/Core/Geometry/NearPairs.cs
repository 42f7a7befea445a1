using System;

namespace Guidewire.Core
{
    /// <summary>Elements of a chain of points that may be near another one.</summary>
    internal static class NearPairs
    {
        /// <summary>The next element, from one on, whose middle is no farther than a reach from that of another one;
        /// the number of elements where there is none.</summary>
        /// <remarks>From one element to the next the middle goes no farther than the longest element: what is far away
        /// stays so for a number of elements that need not be looked at. A straight chain takes O(log n).</remarks>
        /// <param name="x">The n + 1 points.</param>
        /// <param name="count">n.</param>
        /// <param name="element">The other one.</param>
        /// <param name="from">The first that counts.</param>
        /// <param name="longest">Length of the longest element.</param>
        public static int Next(Vector3d[] x, int count, int element, int from, double reach, double longest)
        {
            Vector3d middle = 0.5 * (x[element] + x[element + 1]);
            int j = from;
            while (j < count)
            {
                double apart = Vector3d.Distance(middle, 0.5 * (x[j] + x[j + 1])) - reach;
                if (apart <= 0.0)
                {
                    return j;
                }
                j += Math.Max(1, (int)Math.Min(count, apart / longest));
            }
            return count;
        }
    }
}

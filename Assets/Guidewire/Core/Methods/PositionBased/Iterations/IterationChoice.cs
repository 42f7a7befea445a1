namespace Guidewire.Core
{
    /// <summary>Chooses the implementation of the iterations, of those that give the same bits: the fastest on this
    /// processor.</summary>
    internal static class IterationChoice
    {
        private const int MaxLanes = 8;

        /// <summary>Gives the iterations of least cost.</summary>
        /// <param name="scalar">The iterations to do.</param>
        /// <param name="iterations">m, how many will be asked for at a time.</param>
        public static IIterations Fastest(ScalarIterations scalar, int iterations)
        {
            IIterations fastest = scalar;
            for (int lanes = MaxLanes; lanes > 1; lanes /= 2)
            {
                IIterations? candidate = WithLanes(scalar, lanes);
                if (candidate != null && candidate.Cost(iterations) < fastest.Cost(iterations))
                {
                    fastest = candidate;
                }
            }
            return fastest;
        }

        /// <summary>The iterations with 4 or 8 lanes whether they are faster or not, or null where there are none: on
        /// another processor, in Unity, in the bilateral order, whose two ends meet in the middle.</summary>
        public static IIterations? WithLanes(ScalarIterations scalar, int lanes)
        {
#if NET8_0_OR_GREATER
            if (scalar.Order == SweepOrder.Naive && lanes == Lanes4.Count && Lanes4.IsSupported)
            {
                return new PipelinedIterations<Lanes4>(scalar);
            }
            if (scalar.Order == SweepOrder.Naive && lanes == Lanes8.Count && Lanes8.IsSupported)
            {
                return new PipelinedIterations<Lanes8>(scalar);
            }
#endif
            return null;
        }
    }
}

namespace Guidewire.Core
{
    /// <summary>Which sweeps a run does, of those that give the same bits: the fastest on this processor.</summary>
    internal static class SweepChoice
    {
        private const int MostLanes = 8;

        /// <summary>The sweeps of least cost.</summary>
        /// <param name="scalar">The sweeps to do.</param>
        /// <param name="iterations">m, how many will be asked for at a time.</param>
        public static ISweeps Fastest(ScalarSweeps scalar, int iterations)
        {
            ISweeps fastest = scalar;
            for (int lanes = MostLanes; lanes > 1; lanes /= 2)
            {
                ISweeps? sweeps = WithLanes(scalar, lanes);
                if (sweeps != null && sweeps.Cost(iterations) < fastest.Cost(iterations))
                {
                    fastest = sweeps;
                }
            }
            return fastest;
        }

        /// <summary>The sweeps with 4 or 8 lanes whether they are faster or not, or null where there are none: on
        /// another processor, in Unity, in the bilateral order, whose two ends meet in the middle.</summary>
        public static ISweeps? WithLanes(ScalarSweeps scalar, int lanes)
        {
#if NET8_0_OR_GREATER
            if (scalar.Order == SweepOrder.Naive && lanes == Lanes4.Count && Lanes4.IsSupported)
            {
                return new PipelinedSweeps<Lanes4>(scalar);
            }
            if (scalar.Order == SweepOrder.Naive && lanes == Lanes8.Count && Lanes8.IsSupported)
            {
                return new PipelinedSweeps<Lanes8>(scalar);
            }
#endif
            return null;
        }
    }
}

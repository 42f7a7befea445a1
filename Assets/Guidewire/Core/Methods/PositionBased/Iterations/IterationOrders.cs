namespace Guidewire.Core
{
    /// <summary>The orders of one Gauss-Seidel iteration as index lists.</summary>
    internal static class IterationOrders
    {
        /// <summary>Gives the indices 0 .. count - 1 in the order of the iteration.</summary>
        /// <param name="order">Naive: 0, 1, 2, ...; bilateral: 0, count - 1, 1, count - 2, ...</param>
        /// <param name="count">Number of constraints, 0 or more.</param>
        public static int[] Indices(SweepOrder order, int count)
        {
            var indices = new int[count];
            for (int k = 0; k < count; k++)
            {
                bool fromTheEnd = order == SweepOrder.Bilateral && k % 2 == 1;
                int rank = order == SweepOrder.Bilateral ? k / 2 : k;
                indices[k] = fromTheEnd ? count - 1 - rank : rank;
            }
            return indices;
        }
    }
}

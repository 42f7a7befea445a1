namespace Guidewire.Core
{
    /// <summary>The iterations of position-and-orientation-based dynamics.</summary>
    internal interface IIterations
    {
        /// <summary>Does iterations, each all stretch constraints, then all bend-twist constraints, then all
        /// contacts.</summary>
        /// <param name="x">n + 1 positions in units, corrected in place.</param>
        /// <param name="q">n orientations, corrected in place and of unit length again.</param>
        /// <param name="iterations">How many, 0 or more.</param>
        /// <param name="contacts">Contacts, or null where there are none.</param>
        /// <returns>False, with nothing done, where these iterations cannot take these contacts.</returns>
        bool Iterate(Vector3d[] x, Quaterniond[] q, int iterations, IContactResponse? contacts);

        /// <summary>Says about how long so many iterations take, counted in elements of a scalar iteration.</summary>
        double Cost(int iterations);
    }

    /// <summary>One iteration after the other, one constraint after the other.</summary>
    internal sealed class ScalarIterations : IIterations
    {
        private readonly int[] _elements;
        private readonly int[] _joints;

        /// <param name="stretch">The elements' constraints.</param>
        /// <param name="bendTwist">The joints' constraints.</param>
        /// <param name="order">The order of each iteration.</param>
        public ScalarIterations(StretchConstraint stretch, BendTwistConstraint bendTwist, SweepOrder order)
        {
            Stretch = stretch;
            BendTwist = bendTwist;
            Order = order;
            _elements = IterationOrders.Indices(order, stretch.Count);
            _joints = IterationOrders.Indices(order, bendTwist.Count);
        }

        /// <summary>The elements' constraints.</summary>
        public StretchConstraint Stretch { get; }

        /// <summary>The joints' constraints.</summary>
        public BendTwistConstraint BendTwist { get; }

        /// <summary>The order of each iteration.</summary>
        public SweepOrder Order { get; }

        /// <inheritdoc/>
        public bool Iterate(Vector3d[] x, Quaterniond[] q, int iterations, IContactResponse? contacts)
        {
            for (int iteration = 0; iteration < iterations; iteration++)
            {
                Stretch.Iterate(x, q, _elements);
                BendTwist.Iterate(q, _joints);
                contacts?.Iterate(x);
            }
            return true;
        }

        /// <inheritdoc/>
        public double Cost(int iterations) => (double)_elements.Length * iterations;
    }

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

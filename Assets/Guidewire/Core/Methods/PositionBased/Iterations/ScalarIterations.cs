namespace Guidewire.Core
{
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
}

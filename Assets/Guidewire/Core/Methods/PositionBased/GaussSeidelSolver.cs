namespace Guidewire.Core
{
    /// <summary>Position-and-orientation-based dynamics (thesis 2.1.2): m iterations, each all stretch constraints,
    /// then all bend-twist constraints, then all contacts. The answer depends on m, because gains act per
    /// iteration.</summary>
    internal sealed class GaussSeidelSolver : IConstraintSolver
    {
        private readonly int _iterations;
        private readonly StretchConstraint _stretch;
        private readonly BendTwistConstraint _bendTwist;
        private readonly int[] _elements;
        private readonly int[] _joints;
        private readonly IContactResponse? _contacts;

        /// <param name="state">The wire, with its final masses and weights.</param>
        /// <param name="iterations">m, 0 or more.</param>
        /// <param name="stretchGain">k_A, dimensionless.</param>
        /// <param name="bendGain">k_B in units.</param>
        /// <param name="order">The order of each sweep.</param>
        /// <param name="contacts">Contacts, or null in a scene without walls.</param>
        public GaussSeidelSolver(RodState state, int iterations, double stretchGain, double bendGain, SweepOrder order,
            IContactResponse? contacts)
        {
            _iterations = iterations;
            _contacts = contacts;
            _stretch = new StretchConstraint(state, stretchGain);
            _bendTwist = new BendTwistConstraint(state, bendGain);
            _elements = SweepOrders.Indices(order, state.ElementCount);
            _joints = SweepOrders.Indices(order, state.ElementCount - 1);
        }

        /// <inheritdoc/>
        public void Solve(RodState state)
        {
            Vector3d[] x = state.PredictedPositions;
            Quaterniond[] q = state.PredictedOrientations;
            for (int iteration = 0; iteration < _iterations; iteration++)
            {
                _stretch.Sweep(x, q, _elements);
                _bendTwist.Sweep(q, _joints);
                _contacts?.Sweep(x);
            }
        }

        /// <inheritdoc/>
        public void Exchange(Snapshot snapshot)
        {
        }
    }
}

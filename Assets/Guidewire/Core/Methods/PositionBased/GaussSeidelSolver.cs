namespace Guidewire.Core
{
    /// <summary>Position-and-orientation-based dynamics (thesis 2.1.2): m iterations, each all stretch constraints,
    /// then all bend-twist constraints, then all contacts. The answer depends on m, because gains act per
    /// iteration.</summary>
    internal sealed class GaussSeidelSolver : IConstraintSolver
    {
        private readonly int _iterations;
        private readonly ScalarSweeps _scalar;
        private readonly ISweeps _sweeps;
        private readonly IContactResponse? _contacts;

        /// <param name="iterations">m, 0 or more.</param>
        /// <param name="scalar">What does them where the others cannot take the contacts.</param>
        /// <param name="sweeps">What does the iterations, bit for bit the same.</param>
        /// <param name="contacts">Contacts, or null in a scene without walls.</param>
        public GaussSeidelSolver(int iterations, ScalarSweeps scalar, ISweeps sweeps, IContactResponse? contacts)
        {
            _iterations = iterations;
            _scalar = scalar;
            _sweeps = sweeps;
            _contacts = contacts;
        }

        /// <inheritdoc/>
        public void Solve(RodState state)
        {
            if (!_sweeps.Iterate(state.PredictedPositions, state.PredictedOrientations, _iterations, _contacts))
            {
                _scalar.Iterate(state.PredictedPositions, state.PredictedOrientations, _iterations, _contacts);
            }
        }

        /// <inheritdoc/>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.OptionalSection(ContactSolver.SectionKey, null);
        }
    }
}

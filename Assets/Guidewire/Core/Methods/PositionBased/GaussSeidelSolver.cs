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
        private readonly IContactRule? _contacts;

        /// <param name="iterations">m, 0 or more.</param>
        /// <param name="scalar">What does each iteration where contacts follow it.</param>
        /// <param name="sweeps">What does all iterations where nothing comes between them, bit for bit the
        /// same.</param>
        /// <param name="contacts">Contacts, or null in a scene without walls.</param>
        public GaussSeidelSolver(int iterations, ScalarSweeps scalar, ISweeps sweeps, IContactRule? contacts)
        {
            _iterations = iterations;
            _scalar = scalar;
            _sweeps = sweeps;
            _contacts = contacts;
        }

        /// <inheritdoc/>
        public void Solve(RodState state)
        {
            Vector3d[] x = state.PredictedPositions;
            Quaterniond[] q = state.PredictedOrientations;
            if (_contacts == null || !_contacts.HasContacts)
            {
                _sweeps.Iterate(x, q, _iterations);
                return;
            }
            for (int iteration = 0; iteration < _iterations; iteration++)
            {
                _scalar.Iterate(x, q, 1);
                _contacts.Sweep(x);
            }
        }
    }
}

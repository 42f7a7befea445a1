namespace Guidewire.Core
{
    /// <summary>Corrects a predicted state towards its constraints.</summary>
    internal interface IConstraintSolver
    {
        /// <summary>Corrects <see cref="RodState.PredictedPositions"/> and
        /// <see cref="RodState.PredictedOrientations"/> in place.</summary>
        void Solve(RodState state);

        /// <summary>Writes into a snapshot, or restores from one, its state between steps.</summary>
        void Serialize(Snapshot snapshot);
    }

    /// <summary>Position-and-orientation-based dynamics (thesis 2.1.2): m iterations, each all stretch constraints,
    /// then all bend-twist constraints, then all contacts. The answer depends on m, because pbd stiffness acts per
    /// iteration.</summary>
    internal sealed class GaussSeidelSolver : IConstraintSolver
    {
        private readonly int _iterations;
        private readonly ScalarIterations _scalar;
        private readonly IIterations _fastest;
        private readonly IContactResponse? _contacts;

        /// <param name="iterations">m, 0 or more.</param>
        /// <param name="scalar">What does them where the others cannot take the contacts.</param>
        /// <param name="fastest">Performs the iterations, bit for bit the same.</param>
        /// <param name="contacts">Contacts, or null in a scene without walls.</param>
        public GaussSeidelSolver(int iterations, ScalarIterations scalar, IIterations fastest,
            IContactResponse? contacts)
        {
            _iterations = iterations;
            _scalar = scalar;
            _fastest = fastest;
            _contacts = contacts;
        }

        /// <inheritdoc/>
        public void Solve(RodState state)
        {
            if (!_fastest.Iterate(state.PredictedPositions, state.PredictedOrientations, _iterations, _contacts))
            {
                _scalar.Iterate(state.PredictedPositions, state.PredictedOrientations, _iterations, _contacts);
            }
        }

        /// <inheritdoc/>
        public void Serialize(Snapshot snapshot) => snapshot.OptionalSection(ContactSolver.SectionKey, null);
    }
}

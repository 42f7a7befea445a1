namespace Guidewire.Core
{
    /// <summary>p = (2 - d) x_k - (1 - d) x_{k-1} + dt^2 (w f + g) (thesis eq. 2.7 with damping d); the first step,
    /// which has no x_{k-1}, by Euler.</summary>
    internal sealed class VerletPrediction : IPositionPrediction
    {
        private readonly double _damping;
        private readonly Vector3d _gravity;
        private readonly EulerPrediction _firstStep;
        private bool _started;

        /// <param name="damping">d in [0, 1], dimensionless, a step.</param>
        /// <param name="gravity">g in unit/s^2.</param>
        public VerletPrediction(double damping, in Vector3d gravity)
        {
            _damping = damping;
            _gravity = gravity;
            _firstStep = new EulerPrediction(damping, gravity);
        }

        /// <inheritdoc/>
        public void Predict(RodState state, double timeStep)
        {
            if (!_started)
            {
                _started = true;
                _firstStep.Predict(state, timeStep);
                return;
            }
            for (int i = 0; i < state.SphereCount; i++)
            {
                double w = state.InverseMasses[i];
                state.PredictedPositions[i] = w == 0.0
                    ? state.Positions[i]
                    : (2.0 - _damping) * state.Positions[i] - (1.0 - _damping) * state.PreviousPositions[i]
                        + (timeStep * timeStep) * (w * state.Forces[i] + _gravity);
            }
        }

        /// <inheritdoc/>
        public void Serialize(Snapshot snapshot, double timeStep) =>
            snapshot.Section("Verlet", history => history.Serialize(ref _started), timeStep);
    }
}

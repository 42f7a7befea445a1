namespace Guidewire.Core
{
    /// <summary>v = (1 - d) v_k + dt (w f + g), p = x_k + dt v (thesis eqs. 2.5, 2.6, with the new velocity).</summary>
    /// <remarks>Because v_k = (x_k - x_{k-1})/dt after every step, this is Verlet's formula to rounding; the two differ
    /// where a velocity is not that quotient (at the start) or dt changes.</remarks>
    internal sealed class EulerPrediction : IPositionPrediction
    {
        private readonly double _damping;
        private readonly Vector3d _gravity;

        /// <param name="damping">d in [0, 1], dimensionless, a step.</param>
        /// <param name="gravity">g in unit/s^2.</param>
        public EulerPrediction(double damping, in Vector3d gravity)
        {
            _damping = damping;
            _gravity = gravity;
        }

        /// <inheritdoc/>
        public void Predict(RodState state, double timeStep)
        {
            for (int i = 0; i < state.SphereCount; i++)
            {
                double w = state.InverseMasses[i];
                if (w == 0.0)
                {
                    state.PredictedPositions[i] = state.Positions[i];
                    continue;
                }
                Vector3d v = (1.0 - _damping) * state.Velocities[i] + timeStep * (w * state.Forces[i] + _gravity);
                state.PredictedPositions[i] = state.Positions[i] + timeStep * v;
            }
        }

        /// <inheritdoc/>
        public void Serialize(Snapshot snapshot, double timeStep) => snapshot.Section("Euler", _ => { });
    }

    /// <summary>q = q_k + dt/2 q_k (0, omega), normalised, with omega in the element's own frame
    /// (Kugelstadt and Schoemer 2016, section 4). Orientations carry no torque of their own and no damping.</summary>
    internal sealed class OrientationEulerPrediction : IOrientationPrediction
    {
        /// <inheritdoc/>
        public void Predict(RodState state, double timeStep)
        {
            for (int j = 0; j < state.ElementCount; j++)
            {
                Quaterniond q = state.Orientations[j];
                Quaterniond spin = q * Quaterniond.Pure(state.AngularVelocities[j]);
                state.PredictedOrientations[j] = Quaterniond.Normalize(q + (0.5 * timeStep) * spin);
            }
        }

        /// <inheritdoc/>
        public void Serialize(Snapshot snapshot, double timeStep) => snapshot.Section("Euler, orientations", _ => { });
    }
}

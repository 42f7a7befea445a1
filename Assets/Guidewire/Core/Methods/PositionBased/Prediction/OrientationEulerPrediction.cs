namespace Guidewire.Core
{
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

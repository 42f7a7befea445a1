namespace Guidewire.Core
{
    /// <summary>v = (p - x)/dt (thesis eq. 2.4) and omega = (2/dt) Im(q_k* q_{k+1}); the corrected state becomes the
    /// current one.</summary>
    internal static class VelocityUpdate
    {
        /// <summary>Closes a step: velocities follow from the corrected positions.</summary>
        /// <param name="state">The wire; its predicted state has been corrected.</param>
        /// <param name="timeStep">dt in s.</param>
        public static void Apply(RodState state, double timeStep)
        {
            double rate = 1.0 / timeStep;
            for (int i = 0; i < state.SphereCount; i++)
            {
                state.Velocities[i] = rate * (state.PredictedPositions[i] - state.Positions[i]);
            }
            for (int j = 0; j < state.ElementCount; j++)
            {
                Quaterniond turn = state.Orientations[j].Conjugate * state.PredictedOrientations[j];
                state.AngularVelocities[j] = (2.0 * rate) * turn.Imaginary;
            }
            state.Advance();
        }
    }
}

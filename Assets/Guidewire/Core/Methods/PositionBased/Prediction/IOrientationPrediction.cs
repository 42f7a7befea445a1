namespace Guidewire.Core
{
    /// <summary>Where the orientations would go without constraints.</summary>
    internal interface IOrientationPrediction
    {
        /// <summary>Writes <see cref="RodState.PredictedOrientations"/>.</summary>
        /// <param name="state">Its orientations and angular velocities are read.</param>
        /// <param name="timeStep">dt in s.</param>
        void Predict(RodState state, double timeStep);
    }
}

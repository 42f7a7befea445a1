namespace Guidewire.Core
{
    /// <summary>Prediction of the orientations without constraints.</summary>
    internal interface IOrientationPrediction
    {
        /// <summary>Writes <see cref="RodState.PredictedOrientations"/>.</summary>
        /// <param name="state">Its orientations and angular velocities are read.</param>
        /// <param name="timeStep">dt in s.</param>
        void Predict(RodState state, double timeStep);

        /// <summary>Writes into a snapshot, or restores from one, what it remembers of earlier steps; from a
        /// prediction of its kind and the same step size only.</summary>
        void Serialize(Snapshot snapshot, double timeStep);
    }
}

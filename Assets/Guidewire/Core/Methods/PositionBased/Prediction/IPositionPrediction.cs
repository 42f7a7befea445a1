namespace Guidewire.Core
{
    /// <summary>Prediction of the positions without constraints: from x, v and forces to p. A sphere of inverse mass 0
    /// stays where it is (thesis 3.1.4); its drive moves it afterwards.</summary>
    internal interface IPositionPrediction
    {
        /// <summary>Writes <see cref="RodState.PredictedPositions"/>.</summary>
        /// <param name="state">Its positions, velocities and forces are read.</param>
        /// <param name="timeStep">dt in s.</param>
        void Predict(RodState state, double timeStep);

        /// <summary>Writes into a snapshot, or restores from one, what it remembers of earlier steps; from a
        /// prediction of its kind and the same step size only.</summary>
        void Serialize(Snapshot snapshot, double timeStep);
    }

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

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
}

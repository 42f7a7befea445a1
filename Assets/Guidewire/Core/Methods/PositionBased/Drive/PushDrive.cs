namespace Guidewire.Core
{
    /// <summary>Moves sphere 0 every step along the first element, d = (x_1 - x_0)/|x_1 - x_0| (thesis eq.
    /// 3.6).</summary>
    internal sealed class PushDrive : IDriveMotion
    {
        private readonly double _perStep;

        /// <param name="perStep">Units a step; negative values pull.</param>
        public PushDrive(double perStep)
        {
            _perStep = perStep;
        }

        /// <inheritdoc/>
        public void Move(RodState state)
        {
            Vector3d direction = Vector3d.Normalize(state.Positions[1] - state.Positions[0]);
            state.PredictedPositions[0] = state.Positions[0] + _perStep * direction;
        }
    }
}

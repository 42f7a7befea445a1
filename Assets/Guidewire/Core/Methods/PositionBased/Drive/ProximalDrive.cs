namespace Guidewire.Core
{
    /// <summary>Moves sphere 0 in every step by a given displacement in the direction of the scene's drive.</summary>
    internal sealed class ProximalDrive : IDriveMotion
    {
        private readonly IDriveDirection _direction;
        private readonly double _perStep;

        /// <param name="direction">The direction.</param>
        /// <param name="perStep">Units a step; negative values move backwards.</param>
        public ProximalDrive(IDriveDirection direction, double perStep)
        {
            _direction = direction;
            _perStep = perStep;
        }

        /// <inheritdoc/>
        public void Move(RodState state)
        {
            Vector3d[] x = state.Positions;
            state.PredictedPositions[0] = x[0] + _perStep * _direction.At(x[0], x[1]);
        }
    }
}

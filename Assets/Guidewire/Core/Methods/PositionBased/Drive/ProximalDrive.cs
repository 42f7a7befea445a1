namespace Guidewire.Core
{
    /// <summary>Moves sphere 0 every step, as far as it is told and in the direction that the scene's drive
    /// has.</summary>
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

namespace Guidewire.Core
{
    /// <summary>Moves sphere 0 along a fixed axis every step (Kreibich's control, thesis 3.1.5). In a bend it can pull
    /// the wire sideways through the vessel.</summary>
    internal sealed class FixedAxisDrive : IDriveMotion
    {
        private readonly Vector3d _motion;

        /// <param name="direction">A unit vector.</param>
        /// <param name="perStep">Units a step.</param>
        public FixedAxisDrive(in Vector3d direction, double perStep)
        {
            _motion = perStep * direction;
        }

        /// <inheritdoc/>
        public void Move(RodState state)
        {
            state.PredictedPositions[0] = state.Positions[0] + _motion;
        }
    }
}

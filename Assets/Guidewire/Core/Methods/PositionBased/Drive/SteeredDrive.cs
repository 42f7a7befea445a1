namespace Guidewire.Core
{
    /// <summary>Moves sphere 0 along the first element and turns that element about its axis, as the user
    /// steers.</summary>
    /// <remarks>The user holds the frame of element 0, also while steering asks for nothing: its orientation has weight
    /// 0.</remarks>
    internal sealed class SteeredDrive : IDriveMotion
    {
        private readonly Steering _steering;
        private readonly AlongFirstElement _direction = new AlongFirstElement();

        /// <param name="steering">What the user asks.</param>
        public SteeredDrive(Steering steering)
        {
            _steering = steering;
        }

        /// <inheritdoc/>
        public void Move(RodState state)
        {
            Vector3d[] x = state.Positions;
            state.PredictedPositions[0] = x[0] + _steering.Push * _direction.At(x[0], x[1]);
            Quaterniond turn = Quaterniond.FromAxisAngle(Vector3d.UnitZ, _steering.Turn);
            state.PredictedOrientations[0] = Quaterniond.Normalize(state.Orientations[0] * turn);
        }
    }
}

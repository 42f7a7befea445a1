namespace Guidewire.Core
{
    /// <summary>Turns element 0 about its own axis every step, in addition to another drive's motion of sphere 0, as
    /// physicians rotate a wire (thesis, outlook): q_0 -> q_0 (cos a/2 + e3 sin a/2). The bend-twist constraint carries
    /// it to the
    /// tip.</summary>
    /// <remarks>The drive holds the frame of element 0: its orientation has weight 0 and turns as asked, and no
    /// further.</remarks>
    internal sealed class TwistDrive : IDriveMotion
    {
        private readonly IDriveMotion? _motion;
        private readonly Quaterniond _turn;

        /// <param name="motion">What moves sphere 0, or null.</param>
        /// <param name="perStep">a in radians a step.</param>
        public TwistDrive(IDriveMotion? motion, double perStep)
        {
            _motion = motion;
            _turn = Quaterniond.FromAxisAngle(Vector3d.UnitZ, perStep);
        }

        /// <inheritdoc/>
        public void Move(RodState state)
        {
            _motion?.Move(state);
            state.PredictedOrientations[0] = Quaterniond.Normalize(state.Orientations[0] * _turn);
        }
    }
}

namespace Guidewire.Core
{
    /// <summary>Drives along a fixed axis (Kreibich's control, thesis 3.1.5). In a bend it can pull the wire sideways
    /// through the vessel.</summary>
    internal sealed class FixedAxis : IDriveDirection
    {
        private readonly Vector3d _axis;

        /// <param name="axis">Any length but 0.</param>
        public FixedAxis(in Vector3d axis)
        {
            _axis = Vector3d.Normalize(axis);
        }

        /// <inheritdoc/>
        public Vector3d At(in Vector3d first, in Vector3d second) => _axis;
    }
}

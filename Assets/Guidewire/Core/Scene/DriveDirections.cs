namespace Guidewire.Core
{
    /// <summary>The direction in which a drive moves sphere 0, independent of the method, which determines the
    /// displacement in its own units of length.</summary>
    internal interface IDriveDirection
    {
        /// <summary>Gives the drive's direction, a unit vector.</summary>
        /// <param name="first">Where sphere 0 is.</param>
        /// <param name="second">Where sphere 1 is.</param>
        Vector3d At(in Vector3d first, in Vector3d second);
    }

    /// <summary>Drives along the first element, d = (x_1 - x_0)/|x_1 - x_0| (thesis eq. 3.6).</summary>
    internal sealed class AlongFirstElement : IDriveDirection
    {
        /// <inheritdoc/>
        public Vector3d At(in Vector3d first, in Vector3d second) => Vector3d.Normalize(second - first);
    }

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

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
}

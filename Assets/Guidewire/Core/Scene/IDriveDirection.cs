namespace Guidewire.Core
{
    /// <summary>The direction in which a drive moves sphere 0, whatever the method: how far is the method's to say, in
    /// its own lengths.</summary>
    internal interface IDriveDirection
    {
        /// <summary>A unit vector.</summary>
        /// <param name="first">Where sphere 0 is.</param>
        /// <param name="second">Where sphere 1 is.</param>
        Vector3d At(in Vector3d first, in Vector3d second);
    }
}

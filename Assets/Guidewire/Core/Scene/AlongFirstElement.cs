namespace Guidewire.Core
{
    /// <summary>Drives along the first element, d = (x_1 - x_0)/|x_1 - x_0| (thesis eq. 3.6).</summary>
    internal sealed class AlongFirstElement : IDriveDirection
    {
        /// <inheritdoc/>
        public Vector3d At(in Vector3d first, in Vector3d second) => Vector3d.Normalize(second - first);
    }
}

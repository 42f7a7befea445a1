namespace Guidewire.Core
{
    /// <summary>A convex body at rest, seen from a segment. Implemented by structs only, so that the swept test
    /// compiles once per kind of body.</summary>
    internal interface IConvexBody
    {
        /// <summary>Closest points of segment a b (parameter s) and the body; the distance is returned, 0 or less
        /// where they overlap.</summary>
        double Closest(in Vector3d a, in Vector3d b, out double s, out Vector3d point);
    }
}

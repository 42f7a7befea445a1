namespace Guidewire.Core
{
    /// <summary>The closest points of a rod element (or a sphere, an element of zero length) and a wall.</summary>
    public readonly struct SurfaceContact
    {
        /// <summary>Position along the element, 0 at its first sphere, 1 at its second; 0 for a sphere.</summary>
        public readonly double Position;

        /// <summary>Nearest point c of the wall, units.</summary>
        public readonly Vector3d Point;

        /// <summary>Unit vector from the wall into the lumen: the gradient of the distance.</summary>
        public readonly Vector3d Normal;

        /// <summary>Distance of the element's core line from the wall in units, negative beyond the wall.</summary>
        public readonly double Distance;

        /// <summary>Makes a contact with these values.</summary>
        public SurfaceContact(double position, in Vector3d point, in Vector3d normal, double distance)
        {
            Position = position;
            Point = point;
            Normal = normal;
            Distance = distance;
        }
    }
}

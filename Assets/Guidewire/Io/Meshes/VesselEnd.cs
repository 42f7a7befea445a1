using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>An end of a vessel: an open rim, or where a branch is closed. Lengths in units of the scene.</summary>
    internal sealed class VesselEnd
    {
        public VesselEnd(int number, string name, in Vector3d centre, double radius, in Vector3d direction, int point)
        {
            Number = number;
            Name = name;
            Centre = centre;
            Radius = radius;
            Direction = direction;
            Point = point;
        }

        /// <summary>As reports and keys have it, from 1.</summary>
        public int Number { get; }

        /// <summary>As reports and keys have it.</summary>
        public string Name { get; }

        /// <summary>The end's middle.</summary>
        public Vector3d Centre { get; }

        /// <summary>The radius of the lumen there.</summary>
        public double Radius { get; }

        /// <summary>The direction of the centreline, into the lumen, of length 1.</summary>
        public Vector3d Direction { get; }

        /// <summary>The centreline's point there.</summary>
        public int Point { get; }
    }
}

using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Where an instrument has come to in its vessel: the last point of it, seen from the hub, up to which it
    /// has not left the lumen. Of a tip in the lumen that is the tip; of one that left by an end, a point near that
    /// end, wherever the tip goes outside.</summary>
    public readonly struct LumenPlace
    {
        internal LumenPlace(bool isInside, in Vector3d point, int near, int branch, double distance, double left,
            bool isAtTarget)
        {
            IsInside = isInside;
            Point = point;
            Near = near;
            Branch = branch;
            Distance = distance;
            Left = left;
            IsAtTarget = isAtTarget;
        }

        /// <summary>Whether the tip is in the lumen, and all of the instrument between the inlet and it.</summary>
        public bool IsInside { get; }

        /// <summary>The last point up to which it is, units.</summary>
        public Vector3d Point { get; }

        /// <summary>The point of the centreline to whose sphere that belongs.</summary>
        public int Near { get; }

        /// <summary>The branch there, from 0.</summary>
        public int Branch { get; }

        /// <summary>The distance from the inlet along the centreline, units.</summary>
        public double Distance { get; }

        /// <summary>The distance from there to the target along the centreline, units; not a number where there is
        /// no target.</summary>
        public double Left { get; }

        /// <summary>Whether that is within a radius of the target along the centreline, or beyond it.</summary>
        public bool IsAtTarget { get; }
    }
}

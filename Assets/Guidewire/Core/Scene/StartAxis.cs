using System;

namespace Guidewire.Core
{
    /// <summary>The line on which a straight wire starts, instead of z.</summary>
    public sealed class StartAxis
    {
        /// <summary>Makes the line through a point along a direction.</summary>
        /// <param name="origin">From which guidewireOffset is measured, units.</param>
        /// <param name="direction">Of the wire, of any length but 0.</param>
        public StartAxis(in Vector3d origin, in Vector3d direction)
        {
            Origin = origin;
            Direction = Vector3d.Normalize(direction);
        }

        /// <summary>The point from which guidewireOffset is measured, units.</summary>
        public Vector3d Origin { get; }

        /// <summary>The direction of the wire, of length 1.</summary>
        public Vector3d Direction { get; }

        /// <summary>The frame of every element: z turned into the direction by the smallest rotation, about x where
        /// that is half a turn.</summary>
        internal Quaterniond Frame
        {
            get
            {
                Vector3d axis = Vector3d.Cross(Vector3d.UnitZ, Direction);
                double sine = axis.Length;
                double angle = Math.Atan2(sine, Direction.Z);
                return Quaterniond.FromAxisAngle(sine > 0.0 ? (1.0 / sine) * axis : Vector3d.UnitX, angle);
            }
        }
    }
}

using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>A segment whose ends move in straight lines, from (a0, b0) to (a1, b1), and the test by which a search
    /// leaves out nodes of the hierarchy that it comes nowhere near.</summary>
    internal readonly struct SweptSegment
    {
        private const double RoundedUp = 1.0 + 1e-9;
        private readonly BvhNode _box;        // around all that the segment passes, and the distance

        /// <param name="distance">Units: what the segment does not come this near to is left out.</param>
        public SweptSegment(in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double distance)
        {
            A0 = a0;
            B0 = b0;
            A1 = a1;
            B1 = b1;
            Distance = distance;
            Motion = Math.Sqrt(Math.Max((a1 - a0).LengthSquared, (b1 - b0).LengthSquared));
            _box = new BvhNode();
            _box.EncloseSwept(a0, b0, a1, b1, distance);
        }

        /// <summary>First end before the motion.</summary>
        public Vector3d A0 { get; }

        /// <summary>Second end before the motion.</summary>
        public Vector3d B0 { get; }

        /// <summary>First end after the motion.</summary>
        public Vector3d A1 { get; }

        /// <summary>Second end after the motion.</summary>
        public Vector3d B1 { get; }

        /// <summary>The distance from the triangle, units.</summary>
        public double Distance { get; }

        /// <summary>No point of the segment goes farther, units.</summary>
        public double Motion { get; }

        /// <summary>Middle of the box around all that the segment passes and the distance.</summary>
        public Vector3d Centre => _box.Centre;

        /// <summary>Half the edges of that box, units.</summary>
        public Vector3d Extent => _box.Extent;

        /// <summary>The distance, rounded up, units.</summary>
        public double Border => RoundedUp * Distance;

        /// <summary>What is within the distance of the moving segment is within this of it where it starts,
        /// units.</summary>
        public double Range => RoundedUp * (Distance + Motion);

        /// <summary>False where nothing in a node comes within the distance: the boxes are apart, or all four corners
        /// of the motion, and so all that they span, are on one side of the node's slab.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public bool MayMeet(in BvhNode node) => _box.Overlaps(node) && !IsInRange(node.Normal, node.Low, node.High);

        /// <summary>Whether the motion stays, by more than the distance, on one side of all that lies between two
        /// parallel planes.</summary>
        /// <param name="normal">Of the planes, a unit vector; 0 where they are not known.</param>
        /// <param name="low">normal.x of the lower plane, units.</param>
        /// <param name="high">normal.x of the upper plane, units.</param>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public bool IsInRange(in Vector3d normal, double low, double high)
        {
            double w = Vector3d.Dot(normal, A0);
            double x = Vector3d.Dot(normal, B0);
            double y = Vector3d.Dot(normal, A1);
            double z = Vector3d.Dot(normal, B1);
            double border = Border;
            return Math.Min(Math.Min(w, x), Math.Min(y, z)) > high + border
                || Math.Max(Math.Max(w, x), Math.Max(y, z)) < low - border;
        }
    }
}

using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Continuous collision detection of a segment whose ends move in straight lines with a triangle, or with
    /// any other convex body.</summary>
    internal static class SegmentImpact
    {
        private const double RoundedUp = 1.0 + 1e-9;

        /// <summary>Lowers the fraction of the motion of segment a b during which it stays at least <paramref
        /// name="clearance"/> from a triangle, if the triangle requires it; returns the lower one, or <see
        /// cref="ContactShape.NoImpact"/>.</summary>
        /// <param name="motion">No end of the segment goes farther.</param>
        public static double WithTriangle(in Vector3d v0, in Vector3d v1, in Vector3d v2, in Vector3d a0,
            in Vector3d b0, in Vector3d a1, in Vector3d b1, double clearance, double resolution, double motion,
            ref double impact)
        {
            if (StaysOnOneSide(a0, b0, a1, b1, v0, v1, v2, clearance))
            {
                return ContactShape.NoImpact;
            }
            Vector3d middle = (1.0 / 3.0) * (v0 + v1 + v2);
            double ball = Math.Sqrt(Math.Max(
                (v0 - middle).LengthSquared, Math.Max((v1 - middle).LengthSquared, (v2 - middle).LengthSquared)));
            return WithBody(
                new TriangleBody(v0, v1, v2), middle, ball, a0, b0, a1, b1, clearance, resolution, motion, ref impact);
        }

        /// <summary>Gives the same for any convex body in a ball.</summary>
        public static double WithBody<TBody>(in TBody body, in Vector3d middle, double ball, in Vector3d a0,
            in Vector3d b0, in Vector3d a1, in Vector3d b1, double clearance, double resolution, double motion,
            ref double impact)
            where TBody : struct, IConvexBody
        {
            double limit = Math.Min(1.0, impact);
            double range = RoundedUp * (clearance + limit * motion);
            if (!PartWithin(a0, b0, range + ball, middle, out double from, out double to))
            {
                return ContactShape.NoImpact;
            }
            double time = SweptTest.Impact(
                body, Vector3d.Lerp(a0, b0, from), Vector3d.Lerp(a0, b0, to),
                Vector3d.Lerp(a1, b1, from), Vector3d.Lerp(a1, b1, to), clearance, resolution, limit);
            if (time < impact)
            {
                impact = time;
                return time;
            }
            return ContactShape.NoImpact;
        }

        /// <summary>Whether the moving segment stays on one side of a triangle's plane, by more than a distance,
        /// units.</summary>
        public static bool StaysOnOneSide(
            in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1,
            in Vector3d v0, in Vector3d v1, in Vector3d v2, double distance)
        {
            Vector3d n = Vector3d.Cross(v1 - v0, v2 - v0);
            double clearance = distance * n.Length;
            double w = Vector3d.Dot(n, a0 - v0);
            double x = Vector3d.Dot(n, b0 - v0);
            double y = Vector3d.Dot(n, a1 - v0);
            double z = Vector3d.Dot(n, b1 - v0);
            return (w > clearance && x > clearance && y > clearance && z > clearance)
                || (w < -clearance && x < -clearance && y < -clearance && z < -clearance);
        }

        // The part of the segment that may meet a body: what lies within the range of the centre of the ball around it.
        // Of a long segment that turns about its contact point, that part moves little.
        private static bool PartWithin(in Vector3d a, in Vector3d b, double range, in Vector3d middle, out double from,
            out double to)
        {
            from = 0.0;
            to = 1.0;
            Vector3d along = b - a;
            double lengthSquared = along.LengthSquared;
            double rangeSquared = range * range;
            if (!(lengthSquared > 0.0))
            {
                return (middle - a).LengthSquared <= rangeSquared;
            }
            double foot = Vector3d.Dot(middle - a, along) / lengthSquared;
            double left = rangeSquared - (middle - a - foot * along).LengthSquared;
            if (left < 0.0)
            {
                return false;
            }
            double half = Math.Sqrt(left / lengthSquared);
            from = Math.Max(0.0, foot - half);
            to = Math.Min(1.0, foot + half);
            return from <= to;
        }
    }

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

    /// <summary>What a search for the triangle nearest to a segment has found so far, and the test by which it skips
    /// nodes that cannot hold a nearer one.</summary>
    internal struct SegmentSearch
    {
        public readonly Vector3d A;
        public readonly Vector3d B;
        public double Squared;
        public int Slot;
        public double S;
        public Vector3d Point;
        public int Feature;
        private readonly Vector3d _along;
        private readonly Vector3d _middle;
        private readonly Vector3d _half;
        private readonly double _inverseLengthSquared;

        public SegmentSearch(in Vector3d a, in Vector3d b, double range)
        {
            A = a;
            B = b;
            _along = b - a;
            _middle = 0.5 * (a + b);
            _half = new Vector3d(
                0.5 * Math.Abs(_along.X), 0.5 * Math.Abs(_along.Y), 0.5 * Math.Abs(_along.Z));
            double lengthSquared = _along.LengthSquared;
            _inverseLengthSquared = lengthSquared > 0.0 ? 1.0 / lengthSquared : 0.0;
            Squared = Square(range);
            Slot = -1;
            S = 0.0;
            Point = a;
            Feature = 0;
        }

        /// <summary>The square of a range, a little larger: a search finds what is nearer than this, and so also a
        /// triangle exactly at the range.</summary>
        public static double Square(double range) => range * range * (1.0 + 1e-15);

        /// <summary>True for a segment of no length: a sphere's centre.</summary>
        public readonly bool IsPoint => _inverseLengthSquared == 0.0;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void Accept(double squared, int slot, double s, in Vector3d point, int feature)
        {
            Squared = squared;
            Slot = slot;
            S = s;
            Point = point;
            Feature = feature;
        }

        /// <summary>False when the node is farther than the best so far, by its box and the segment's box or by its
        /// slab and the segment. The bound is the larger squared distance of the two.</summary>
        /// <remarks>No branches except the result: which bound is larger cannot be predicted, and a mispredicted branch
        /// costs more than both.</remarks>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly bool MayHold(in BvhNode node, out double bound)
        {
            double gx = Math.Max(0.0, Math.Abs(_middle.X - node.Centre.X) - (node.Extent.X + _half.X));
            double gy = Math.Max(0.0, Math.Abs(_middle.Y - node.Centre.Y) - (node.Extent.Y + _half.Y));
            double gz = Math.Max(0.0, Math.Abs(_middle.Z - node.Centre.Z) - (node.Extent.Z + _half.Z));
            double middle = Vector3d.Dot(node.Normal, _middle);
            double half = 0.5 * Math.Abs(Vector3d.Dot(node.Normal, _along));
            double slab = Math.Max(0.0, Math.Max(middle - node.High, node.Low - middle) - half);
            bound = Math.Max(gx * gx + gy * gy + gz * gz, slab * slab);
            return bound < Squared;
        }

        /// <summary>Squared distance of the node's centre from the segment: decides which of two is searched
        /// first.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly double Order(in BvhNode node)
        {
            Vector3d offset = node.Centre - A;
            double t = Math.Min(1.0, Math.Max(0.0, Vector3d.Dot(offset, _along) * _inverseLengthSquared));
            return (offset - t * _along).LengthSquared;
        }
    }
}

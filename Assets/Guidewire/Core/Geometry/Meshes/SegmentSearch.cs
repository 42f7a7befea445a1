using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
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

using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>What a search for the triangle nearest to a segment has found so far, and the test by which it leaves
    /// out nodes that cannot hold a nearer one.</summary>
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
        private double _distance;

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

            // A triangle exactly at the range counts: the smallest step up keeps "less than" enough below.
            Squared = range * range * (1.0 + 1e-15);
            _distance = range;
            Slot = -1;
            S = 0.0;
            Point = a;
            Feature = 0;
        }

        /// <summary>True for a segment of no length: a sphere's centre.</summary>
        public readonly bool IsPoint => _inverseLengthSquared == 0.0;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void Accept(double squared, int slot, double s, in Vector3d point, int feature)
        {
            Squared = squared;
            _distance = Math.Sqrt(squared);
            Slot = slot;
            S = s;
            Point = point;
            Feature = feature;
        }

        /// <summary>False when the node is farther than the best so far, by its box against the segment's box, by its
        /// slab or by its ball against the segment. The bound is the larger squared distance of the first two, the
        /// order that of the centre.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public bool MayHold(in BvhNode node, out double bound, out double order)
        {
            double gx = Math.Max(0.0, Math.Abs(_middle.X - node.Centre.X) - (node.Extent.X + _half.X));
            double gy = Math.Max(0.0, Math.Abs(_middle.Y - node.Centre.Y) - (node.Extent.Y + _half.Y));
            double gz = Math.Max(0.0, Math.Abs(_middle.Z - node.Centre.Z) - (node.Extent.Z + _half.Z));
            bound = gx * gx + gy * gy + gz * gz;
            double ha = Vector3d.Dot(node.Normal, A);
            double hb = Vector3d.Dot(node.Normal, B);
            double slab = Math.Max(0.0, Math.Max(Math.Min(ha, hb) - node.High, node.Low - Math.Max(ha, hb)));
            bound = Math.Max(bound, slab * slab);
            Vector3d offset = node.Centre - A;
            double t = Math.Min(1.0, Math.Max(0.0, Vector3d.Dot(offset, _along) * _inverseLengthSquared));
            order = (offset - t * _along).LengthSquared;
            double reach = node.Radius + _distance;
            return bound < Squared && order < reach * reach;
        }
    }
}

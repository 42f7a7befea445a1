using System;

namespace Guidewire.Core
{
    /// <summary>One edge as a convex body.</summary>
    internal readonly struct EdgeBody : IConvexBody
    {
        private readonly Vector3d _start;
        private readonly Vector3d _end;

        /// <summary>Makes the body of an edge from one point to another.</summary>
        public EdgeBody(in Vector3d start, in Vector3d end)
        {
            _start = start;
            _end = end;
        }

        /// <inheritdoc/>
        public double Closest(in Vector3d a, in Vector3d b, out double s, out Vector3d point)
        {
            double squared = ClosestPoints.SegmentSegment(a, b, _start, _end, out s, out double t);
            point = Vector3d.Lerp(_start, _end, t);
            return Math.Sqrt(squared);
        }
    }
}

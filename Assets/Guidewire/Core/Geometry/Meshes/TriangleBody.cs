using System;

namespace Guidewire.Core
{
    /// <summary>One triangle as a convex body.</summary>
    internal readonly struct TriangleBody : IConvexBody
    {
        private readonly Vector3d _v0;
        private readonly Vector3d _v1;
        private readonly Vector3d _v2;

        public TriangleBody(in Vector3d v0, in Vector3d v1, in Vector3d v2)
        {
            _v0 = v0;
            _v1 = v1;
            _v2 = v2;
        }

        public double Closest(in Vector3d a, in Vector3d b, out double s, out Vector3d point)
        {
            return Math.Sqrt(ClosestPoints.SegmentTriangle(
                a, b, _v0, _v1, _v2, double.PositiveInfinity, out s, out point, out _));
        }
    }
}

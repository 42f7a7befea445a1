using System;

namespace Guidewire.Core
{
    /// <summary>A convex body at rest, seen from a segment. Implemented by structs only, so that the swept test
    /// compiles once per kind of body.</summary>
    internal interface IConvexBody
    {
        /// <summary>Closest points of segment a b (parameter s) and the body; the distance is returned, 0 or less
        /// where they overlap.</summary>
        double Closest(in Vector3d a, in Vector3d b, out double s, out Vector3d point);
    }

    /// <summary>A convex wall as the swept test needs it: by its own signed distance.</summary>
    internal readonly struct ConvexWall : IConvexBody
    {
        private readonly ContactShape _shape;

        public ConvexWall(ContactShape shape)
        {
            _shape = shape;
        }

        /// <inheritdoc/>
        public double Closest(in Vector3d a, in Vector3d b, out double s, out Vector3d point)
        {
            int hint = -1;
            _shape.Nearest(a, b, double.PositiveInfinity, ref hint, out SurfaceContact contact);
            s = contact.Position;
            point = contact.Point;
            return contact.Distance;
        }
    }

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

using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>A convex body in the wire's path: all points within a radius of the convex hull of some points. One
    /// point makes a sphere, two a capsule, eight corners a box, any number a hull.</summary>
    /// <remarks>Distances by GJK, depth by EPA. Holds scratch memory: one object serves one thread.</remarks>
    public sealed class ConvexObstacle : ContactShape
    {
        private const double RelativeFlatness = 1e-9;
        private const double GoldenFraction = 0.38196601125010515;    // 2 less the golden ratio
        private const int GoldenSections = 60;                     // to 3e-13 of the segment
        private readonly Vector3d[] _points;
        private readonly double _radius;
        private readonly Gjk _gjk = new Gjk();
        private HullEdges.Edge[]? _edges;
        private readonly double _flatness;    // height below which points lie in one plane, units

        /// <summary>The body of all points within <paramref name="radius"/> (0 or more, units) of the convex hull of
        /// <paramref name="points"/> (at least one).</summary>
        /// <exception cref="ArgumentException">No point, a value that is not finite, a negative radius.</exception>
        public ConvexObstacle(Vector3d[] points, double radius)
        {
            if (points.Length == 0 || !(radius >= 0.0) || double.IsInfinity(radius)
                || !Array.TrueForAll(points, point => point.IsFinite))
            {
                throw new ArgumentException("an obstacle needs at least one finite point and a radius of 0 or more");
            }
            _points = (Vector3d[])points.Clone();
            _radius = radius;
            foreach (Vector3d point in _points)
            {
                _flatness = Math.Max(_flatness, RelativeFlatness * Vector3d.Distance(point, _points[0]));
            }
        }

        /// <summary>Points whose hull, widened by the radius, is the body; units.</summary>
        internal Vector3d[] Points => _points;

        /// <summary>The radius by which the body is grown, units.</summary>
        internal double Radius => _radius;

        /// <summary>Makes a ball.</summary>
        public static ConvexObstacle Sphere(in Vector3d centre, double radius) =>
            new ConvexObstacle(new[] { centre }, radius);

        /// <summary>All points within a radius of the segment between two points.</summary>
        public static ConvexObstacle Capsule(in Vector3d from, in Vector3d to, double radius) =>
            new ConvexObstacle(new[] { from, to }, radius);

        /// <summary>A box with edges along the directors of <paramref name="orientation"/> and the lengths
        /// 2 <paramref name="halfSize"/>.</summary>
        public static ConvexObstacle Box(in Vector3d centre, in Vector3d halfSize, in Quaterniond orientation)
        {
            var corners = new Vector3d[8];
            for (int k = 0; k < 8; k++)
            {
                corners[k] = centre
                    + ((k & 1) == 0 ? -halfSize.X : halfSize.X) * orientation.Director1
                    + ((k & 2) == 0 ? -halfSize.Y : halfSize.Y) * orientation.Director2
                    + ((k & 4) == 0 ? -halfSize.Z : halfSize.Z) * orientation.Director3;
            }
            return new ConvexObstacle(corners, 0.0);
        }

        /// <inheritdoc/>
        public override bool Nearest(
            in Vector3d a, in Vector3d b, double range, ref int hint, out SurfaceContact contact)
        {
            double distance = _gjk.Distance(a, b, _points, out double s, out Vector3d point, out Vector3d normal);
            contact = new SurfaceContact(s, point + _radius * normal, normal, distance - _radius);
            return contact.Distance <= range;
        }

        /// <summary>The nearest point. Within the hull of the points itself the distance is a depth, and no curvature
        /// is stated.</summary>
        /// <remarks>The points that lie highest along the normal are the corner, the edge or the face of the hull on
        /// which the point lies; the curvature is that about them.</remarks>
        internal override double FindContactPoints(in Vector3d x, double range, FeatureRange features,
            StructList<ContactPoint> contactPoints)
        {
            int hint = -1;
            if (!Nearest(x, x, range, ref hint, out SurfaceContact contact))
            {
                return range;
            }
            double core = contact.Distance + _radius;
            int corner = Highest(contact.Normal);
            Vector3d along = Vector3d.Zero;
            bool isFlat = !(core > 0.0);
            foreach (Vector3d point in _points)
            {
                Vector3d offset = point - _points[corner];
                if (Vector3d.Dot(offset, contact.Normal) >= -_flatness && offset.Length > _flatness)
                {
                    isFlat |= Vector3d.Cross(along, offset).Length > _flatness;
                    along = along == Vector3d.Zero ? Vector3d.Normalize(offset) : along;
                }
            }
            contactPoints.Add(isFlat ? ContactPoint.Flat(contact, 1)
                : along == Vector3d.Zero ? ContactPoint.Corner(contact, 1, core)
                : ContactPoint.Edge(contact, 1, along, core));
            return range;
        }

        private int Highest(in Vector3d direction)
        {
            int highest = 0;
            for (int k = 1; k < _points.Length; k++)
            {
                highest = Vector3d.Dot(_points[k] - _points[highest], direction) > 0.0 ? k : highest;
            }
            return highest;
        }

        /// <inheritdoc/>
        public override bool Contains(in Vector3d point) =>
            _gjk.Distance(point, point, _points, out _, out _, out _) > _radius;

        private protected override double TimeOfImpact(in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1,
            double clearance, double resolution, int hint) =>
            SweptTest.Impact(new ConvexWall(this), a0, b0, a1, b1, clearance, resolution);

        /// <summary>That of the deepest point; the distance of a segment that cuts the body is the shortest
        /// displacement out of it, which may be longer.</summary>
        /// <remarks>A point's signed distance from a convex body is convex along a segment: golden sections.</remarks>
        internal override double MinAlong(in Vector3d a, in Vector3d b, double distance)
        {
            double from = 0.0;
            double to = 1.0;
            double lower = GoldenFraction;
            double upper = 1.0 - GoldenFraction;
            double atLower = DistanceOf(Vector3d.Lerp(a, b, lower));
            double atUpper = DistanceOf(Vector3d.Lerp(a, b, upper));
            double least = Math.Min(Math.Min(DistanceOf(a), DistanceOf(b)), Math.Min(atLower, atUpper));
            for (int k = 0; k < GoldenSections; k++)
            {
                if (atLower < atUpper)
                {
                    to = upper;
                    upper = lower;
                    atUpper = atLower;
                    lower = from + GoldenFraction * (to - from);
                    atLower = DistanceOf(Vector3d.Lerp(a, b, lower));
                    least = Math.Min(least, atLower);
                }
                else
                {
                    from = lower;
                    lower = upper;
                    atLower = atUpper;
                    upper = to - GoldenFraction * (to - from);
                    atUpper = DistanceOf(Vector3d.Lerp(a, b, upper));
                    least = Math.Min(least, atUpper);
                }
            }
            return least;
        }

        private double DistanceOf(in Vector3d point) =>
            _gjk.Distance(point, point, _points, out _, out _, out _) - _radius;

        /// <summary>The edges of the hull: over a face a segment is nearest with an end.</summary>
        internal override void FindEdgeContacts(in Vector3d a, in Vector3d b, double range, FeatureRange features,
            StructList<EdgeContact> edgeContacts)
        {
            _edges ??= HullEdges.Find(_points, _flatness);
            foreach (HullEdges.Edge edge in _edges)
            {
                ConvexEdge.Add(a, b, _points[edge.Start], _points[edge.End], _radius,
                    ConvexEdge.Weight(edge.Angle), edge.Angle, range, edgeContacts);
            }
        }
    }

    /// <summary>The edges of the convex hull of some points.</summary>
    internal static class HullEdges
    {
        private const double MinAngle = 1e-6;   // radians, by which the hull turns at an edge

        /// <summary>An edge between two of the points; of a hull that is one point, from it to itself.</summary>
        public readonly struct Edge
        {
            /// <summary>Makes the edge from one point to another.</summary>
            public Edge(int start, int end, double angle)
            {
                Start = start;
                End = end;
                Angle = angle;
            }

            /// <summary>Number of a point.</summary>
            public int Start { get; }

            /// <summary>Number of a point.</summary>
            public int End { get; }

            /// <summary>The angle by which the hull's surface turns there, radians, 0 to pi.</summary>
            public double Angle { get; }
        }

        /// <summary>Finds every edge once.</summary>
        /// <remarks>Seen along the line through two points, the hull is a flat one; the line is an edge where it is a
        /// corner of that, so that all other points lie in a sector of less than half a turn.</remarks>
        /// <param name="points">One or more.</param>
        /// <param name="flatness">Distance below which points are one, or on one line, units.</param>
        public static Edge[] Find(Vector3d[] points, double flatness)
        {
            var edges = new List<Edge>();
            for (int i = 0; i < points.Length; i++)
            {
                for (int j = i + 1; j < points.Length; j++)
                {
                    Vector3d along = points[j] - points[i];
                    if (along.Length > flatness && Sector(points, i, j, flatness) is double sector
                        && Math.PI - sector > MinAngle)
                    {
                        edges.Add(new Edge(i, j, Math.PI - sector));
                    }
                }
            }
            if (edges.Count == 0)
            {
                edges.Add(new Edge(0, 0, Math.PI));
            }
            return edges.ToArray();
        }

        // The angle of the sector, seen from the line through two points, that holds all others, if it is less than
        // half a turn; none if another point lies between the two or is one of them under a lower number.
        private static double? Sector(Vector3d[] points, int i, int j, double flatness)
        {
            Vector3d along = Vector3d.Normalize(points[j] - points[i]);
            double length = Vector3d.Distance(points[i], points[j]);
            Vector3d first = Vector3d.Zero;
            Vector3d last = Vector3d.Zero;
            for (int k = 0; k < points.Length; k++)
            {
                Vector3d offset = points[k] - points[i];
                double at = Vector3d.Dot(offset, along);
                Vector3d ray = offset - at * along;
                if (k == i || k == j)
                {
                    continue;
                }
                if (ray.Length <= flatness)
                {
                    bool isBetween = at > flatness && at < length - flatness;
                    bool isStart = Math.Abs(at) <= flatness && k < i;
                    bool isEnd = Math.Abs(at - length) <= flatness && k < j;
                    if (isBetween || isStart || isEnd)
                    {
                        return null;
                    }
                    continue;
                }
                ray = Vector3d.Normalize(ray);
                if (first == Vector3d.Zero)
                {
                    first = ray;
                    last = ray;
                    continue;
                }
                bool isAfterFirst = Turn(first, ray, along) >= 0.0;
                bool isBeforeLast = Turn(ray, last, along) >= 0.0;
                if (isAfterFirst && isBeforeLast)
                {
                    // Inside, or more than a quarter of the circle behind both.
                    if (Vector3d.Dot(ray, first + last) < 0.0)
                    {
                        return null;
                    }
                    continue;
                }
                if (!isAfterFirst && !isBeforeLast)
                {
                    return null;
                }
                first = isAfterFirst ? first : ray;
                last = isAfterFirst ? ray : last;
            }
            return Math.Atan2(Turn(first, last, along), Vector3d.Dot(first, last));
        }

        private static double Turn(in Vector3d from, in Vector3d to, in Vector3d axis) =>
            Vector3d.Dot(Vector3d.Cross(from, to), axis);
    }
}

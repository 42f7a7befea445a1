using System;

namespace Guidewire.Core
{
    /// <summary>A cone or a cylinder in the wire's path: all points within a radius of an axis that changes linearly
    /// along it. A cone has spherical ends of its two radii; a cylinder is infinite.</summary>
    /// <remarks>With z along the axis, h from it and the radius R(y) = R0 + k y, the distance is the least of
    /// sqrt(h^2 + (z - y)^2) - R(y) over the axis: y = z + k h/sqrt(1 - k^2), or the end of the axis nearest to it. The
    /// body is convex and so is the distance along a segment, whose least value is where its slope n.u changes
    /// sign.</remarks>
    public sealed class ConeShape : ContactShape
    {
        private const int Bisections = 60;        // to rounding
        private const double Level = 1e-12;       // slope of a segment along the body, over its length
        private readonly Vector3d _start;         // of the axis, units
        private readonly Vector3d _axis;          // unit vector
        private readonly double _radius;          // at the start, units
        private readonly double _slope;           // k
        private readonly double _first;           // y, units
        private readonly double _last;

        private ConeShape(in Vector3d start, in Vector3d axis, double radius, double slope, double first, double last)
        {
            _start = start;
            _axis = axis;
            _radius = radius;
            _slope = slope;
            _first = first;
            _last = last;
        }

        /// <summary>The hull of two balls.</summary>
        /// <param name="from">Centre of the first, units.</param>
        /// <param name="to">Centre of the second.</param>
        /// <param name="fromRadius">Radius of the first, 0 or more, units.</param>
        /// <param name="toRadius">Radius of the second, 0 or more.</param>
        /// <exception cref="ArgumentException">A value that is not finite, a negative radius, or a ball that is within
        /// the other.</exception>
        public static ConeShape Cone(in Vector3d from, in Vector3d to, double fromRadius, double toRadius)
        {
            double length = Vector3d.Distance(from, to);
            if (!(fromRadius >= 0.0) || !(toRadius >= 0.0) || !(Math.Abs(toRadius - fromRadius) < length)
                || double.IsInfinity(length))
            {
                throw new ArgumentException("a cone needs two radii of 0 or more that differ by less than its length");
            }
            return new ConeShape(from, (to - from) / length, fromRadius, (toRadius - fromRadius) / length, 0.0, length);
        }

        /// <summary>A round post without end.</summary>
        /// <param name="point">A point of its axis, units.</param>
        /// <param name="axis">Any length but 0.</param>
        /// <param name="radius">More than 0, units.</param>
        /// <exception cref="ArgumentException">No direction, no radius, or a value that is not finite.</exception>
        public static ConeShape Cylinder(in Vector3d point, in Vector3d axis, double radius)
        {
            if (!point.IsFinite || !axis.IsFinite || !(axis.Length > 0.0) || !(radius > 0.0)
                || double.IsInfinity(radius))
            {
                throw new ArgumentException("a cylinder needs an axis of length other than 0 and a radius > 0");
            }
            return new ConeShape(point, Vector3d.Normalize(axis), radius, 0.0, double.NegativeInfinity,
                double.PositiveInfinity);
        }

        /// <inheritdoc/>
        public override bool Nearest(
            in Vector3d a, in Vector3d b, double range, ref int hint, out SurfaceContact contact)
        {
            Vector3d u = b - a;
            double level = Level * u.Length;
            double atStart = Vector3d.Dot(At(a).Normal, u);
            double atEnd = Vector3d.Dot(At(b).Normal, u);
            double from = 0.0;
            double to = 1.0;
            if (Math.Abs(atStart) <= level && Math.Abs(atEnd) <= level)
            {
                from = 0.5;    // along the body: its middle represents it
                to = 0.5;
            }
            else if (atStart >= 0.0)
            {
                to = 0.0;
            }
            else if (atEnd <= 0.0)
            {
                from = 1.0;
            }
            for (int k = 0; k < Bisections && from < to; k++)
            {
                double middle = 0.5 * (from + to);
                bool falls = Vector3d.Dot(At(Vector3d.Lerp(a, b, middle)).Normal, u) < 0.0;
                from = falls ? middle : from;
                to = falls ? to : middle;
            }
            Vector3d x = Vector3d.Lerp(a, b, to);
            Foot foot = At(x);
            contact = new SurfaceContact(to, x - foot.Distance * foot.Normal, foot.Normal, foot.Distance);
            return contact.Distance <= range;
        }

        /// <summary>The nearest point: on the side, whose curvature is 1/(distance from the axis) around it, or on a
        /// ball.</summary>
        internal override double FindContactPoints(in Vector3d x, double range, FeatureRange features,
            StructList<ContactPoint> contactPoints)
        {
            int hint = -1;
            if (Nearest(x, x, range, ref hint, out SurfaceContact contact))
            {
                Foot foot = At(x);
                contactPoints.Add(foot.IsOnSide
                    ? ContactPoint.Edge(contact, 1, Generator(foot), foot.FromAxis)
                    : ContactPoint.Corner(contact, 1, foot.FromAxis));
            }
            return range;
        }

        /// <inheritdoc/>
        public override bool Contains(in Vector3d point) => At(point).Distance > 0.0;

        private protected override double TimeOfImpact(in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1,
            double clearance, double resolution, int hint) =>
            SweptTest.Impact(new ConvexWall(this), a0, b0, a1, b1, clearance, resolution);

        /// <summary>Where the segment is nearest, as at an edge. Its weight fades where that is not defined: along a
        /// generator of the cone, whose direction d has 1 - (d.axis)^2 = k^2.</summary>
        internal override void FindEdgeContacts(in Vector3d a, in Vector3d b, double range, FeatureRange features,
            StructList<EdgeContact> edgeContacts)
        {
            int hint = -1;
            Vector3d u = b - a;
            if (!Nearest(a, b, range, ref hint, out SurfaceContact nearest) || u == Vector3d.Zero)
            {
                return;
            }
            double weight = 1.0;
            Vector3d slope = ConvexEdge.Fade(u, _axis, _slope * _slope, ref weight);
            var contact = new EdgeContact(nearest.Position, nearest.Distance, nearest.Normal, weight, -slope, slope,
                Math.PI, _radius + (_last - _first <= double.MaxValue ? 0.5 * _slope * (_first + _last) : 0.0));
            Foot foot = At(Vector3d.Lerp(a, b, nearest.Position));
            edgeContacts.Add(nearest.Position > 0.0 && nearest.Position < 1.0 && foot.IsOnSide && weight > 0.0
                ? ConvexEdge.Sliding(contact, u, Generator(foot), foot.FromAxis) : contact);
        }

        /// <summary>The circles of the wall for pictures: centre, and radius across the axis, from one end to the
        /// other.</summary>
        /// <param name="middle">Near which a cylinder is drawn, units.</param>
        /// <param name="extent">How far from there, units.</param>
        /// <param name="count">Of circles, at least 2.</param>
        internal (Vector3d Centre, double Radius)[] Circles(in Vector3d middle, double extent, int count)
        {
            double at = Vector3d.Dot(middle - _start, _axis);
            bool isEndless = double.IsInfinity(_last);
            double low = isEndless ? at - extent : _first - RadiusAt(_first);
            double high = isEndless ? at + extent : _last + RadiusAt(_last);
            var circles = new (Vector3d, double)[count];
            for (int i = 0; i < count; i++)
            {
                double z = 0.5 * (low + high) - 0.5 * (high - low) * Math.Cos(Math.PI * i / (count - 1));
                // The ball's height over the axis where it is beyond the side, else that of the side.
                double y = z < _first - _slope * RadiusAt(_first) ? _first
                    : z > _last - _slope * RadiusAt(_last) ? _last : double.NaN;
                double height = double.IsNaN(y) ? RadiusAt(z) / Math.Sqrt(1.0 - _slope * _slope)
                    : Math.Sqrt(Math.Max(0.0, RadiusAt(y) * RadiusAt(y) - (z - y) * (z - y)));
                circles[i] = (_start + z * _axis, height);
            }
            return circles;
        }

        /// <summary>Unit vector along the axis.</summary>
        internal Vector3d Axis => _axis;

        private double RadiusAt(double y) => _radius + _slope * y;

        private Foot At(in Vector3d x)
        {
            Vector3d offset = x - _start;
            double z = Vector3d.Dot(offset, _axis);
            Vector3d aside = offset - z * _axis;
            double best = z + _slope * aside.Length / Math.Sqrt(1.0 - _slope * _slope);
            double y = Math.Min(Math.Max(best, _first), _last);
            Vector3d from = aside + (z - y) * _axis;
            double length = from.Length;
            Vector3d normal = length > 0.0 ? from / length : Vector3d.Perpendicular(_axis);
            return new Foot(length - RadiusAt(y), normal, length, best == y);
        }

        // Along the side, away from the start.
        private Vector3d Generator(in Foot foot) =>
            Vector3d.Normalize(_axis - Vector3d.Dot(_axis, foot.Normal) * foot.Normal);

        // The distance of a point, its gradient, the distance from the point of the axis that it belongs to, and
        // whether that is no end of it.
        private readonly struct Foot
        {
            public readonly double Distance;
            public readonly Vector3d Normal;
            public readonly double FromAxis;
            public readonly bool IsOnSide;

            public Foot(double distance, in Vector3d normal, double fromAxis, bool isOnSide)
            {
                Distance = distance;
                Normal = normal;
                FromAxis = fromAxis;
                IsOnSide = isOnSide;
            }
        }
    }
}

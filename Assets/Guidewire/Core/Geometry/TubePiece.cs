using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>A straight piece of a tube: all spheres whose centre runs from one knot to the next while their radius
    /// changes linearly. Lengths in units.</summary>
    internal readonly struct TubePiece
    {
        /// <summary>The first knot.</summary>
        public readonly Vector3d From;

        /// <summary>The last knot.</summary>
        public readonly Vector3d To;

        private readonly Vector3d _axis;      // unit vector
        private readonly double _length;
        private readonly double _radius;      // at the first knot
        private readonly double _slope;       // k, of the radius
        private readonly double _lean;        // k/sqrt(1 - k^2)
        private readonly Vector3d _middle;
        private readonly double _extent;      // no point of it is farther from the middle

        /// <summary>The piece between two knots that are farther apart than their radii differ.</summary>
        public TubePiece(in Vector3d from, in Vector3d to, double fromRadius, double toRadius)
        {
            From = from;
            To = to;
            _length = Vector3d.Distance(from, to);
            _axis = (to - from) / _length;
            _radius = fromRadius;
            _slope = (toRadius - fromRadius) / _length;
            _lean = _slope / Math.Sqrt(1.0 - _slope * _slope);
            _middle = Vector3d.Lerp(from, to, 0.5);
            _extent = (0.5 * _length + Math.Max(fromRadius, toRadius)) * (1.0 + 1e-12);
        }

        /// <summary>True where the distance at x is certainly less than this; cheaper than the distance.</summary>
        public bool IsBelow(in Vector3d x, double distance)
        {
            double limit = _extent - distance;
            return limit < 0.0 || (x - _middle).LengthSquared > limit * limit;
        }

        /// <summary>False where no point within a range of segment a b has a distance above 0.</summary>
        public bool MayHold(in Vector3d a, in Vector3d b, double limit)
        {
            double near = Math.Max(_radius, _radius + _slope * _length) + limit;
            return ClosestPoints.SegmentSegment(a, b, From, To, out _, out _) <= near * near;
        }

        /// <summary>Whether the centre that gives the distance is the last knot for all points within a distance of x.
        /// </summary>
        public bool IsPast(in Vector3d x, double distance) =>
            Free(x - From) > _length + (1.0 + Math.Abs(_lean)) * distance;

        /// <summary>Says the same for the first knot.</summary>
        public bool IsBefore(in Vector3d x, double distance) => Free(x - From) < -(1.0 + Math.Abs(_lean)) * distance;

        /// <summary>max over y in [0, length] of R(y) - |x - c(y)|: how deep x lies in the piece's lumen, negative
        /// outside. Concave, because the lumen is convex, and of slope 1 or less.</summary>
        public double Distance(in Vector3d x) => DistanceFrom(CentreAt(Free(x - From), out double y), y, x);

        /// <summary>The same with the centre that gives it, and where along the piece that centre would lie if the
        /// piece had no ends: from 0 to 1 between its knots.</summary>
        /// <remarks>With h the distance of x from the line, z its foot's arc length and k the slope of the radius,
        /// |k| &lt; 1, the maximum of R0 + k y - sqrt(h^2 + (z - y)^2) lies at y = z + k h/sqrt(1 - k^2).</remarks>
        public double Distance(in Vector3d x, out Vector3d centre, out double along)
        {
            double free = Free(x - From);
            along = free / _length;
            centre = CentreAt(free, out double y);
            return DistanceFrom(centre, y, x);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private Vector3d CentreAt(double free, out double y)
        {
            y = Math.Min(Math.Max(free, 0.0), _length);
            return y >= _length ? To : From + y * _axis;
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private double DistanceFrom(in Vector3d centre, double y, in Vector3d x) =>
            _radius + _slope * y - Vector3d.Distance(x, centre);

        // Arc length of the centre if the piece had no ends, for an offset from the first knot.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private double Free(in Vector3d offset)
        {
            double z = Vector3d.Dot(offset, _axis);
            return _slope == 0.0 ? z : z + _lean * (offset - z * _axis).Length;
        }
    }
}

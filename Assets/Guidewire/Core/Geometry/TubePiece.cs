using System;
using System.Collections.Generic;
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

    /// <summary>The bisecting planes at a tube's knots: points between two of them, and near their piece, belong to
    /// that piece.</summary>
    /// <remarks>In a tube whose radius does not change a bend's two pieces meet in the plane; in one that narrows or
    /// widens they meet near it.</remarks>
    internal sealed class TubePlanes
    {
        private readonly Vector3d[] _knots;
        private readonly Vector3d[] _across;   // by knot; 0 at the ends

        /// <summary>Makes the planes at these knots.</summary>
        public TubePlanes(Vector3d[] knots)
        {
            _knots = knots;
            _across = new Vector3d[knots.Length];
            for (int k = 1; k + 1 < knots.Length; k++)
            {
                Vector3d before = knots[k] - knots[k - 1];
                Vector3d after = knots[k + 1] - knots[k];
                _across[k] = Vector3d.Normalize(Vector3d.Normalize(before) + Vector3d.Normalize(after));
            }
        }

        /// <summary>Distance of x beyond the plane of knot k, units.</summary>
        public double Past(int k, in Vector3d x) => Vector3d.Dot(_across[k], x - _knots[k]);

        /// <summary>The piece between whose planes x lies, from a guess on, without looking across the tube.</summary>
        public int PieceAt(in Vector3d x, int guess)
        {
            int piece = guess;
            while (piece + 2 < _knots.Length && Past(piece + 1, x) > 0.0)
            {
                piece++;
            }
            while (piece > 0 && Past(piece, x) < 0.0)
            {
                piece--;
            }
            return piece;
        }

        /// <summary>When a point of a piece, which moves evenly, first crosses one of the piece's planes.</summary>
        /// <param name="x">Where it is, units.</param>
        /// <param name="move">Its displacement in a time of 1.</param>
        /// <param name="piece">In which it is.</param>
        /// <param name="limit">The answer where it crosses none before.</param>
        /// <param name="next">The piece behind that plane, or the same.</param>
        public double Crossing(in Vector3d x, in Vector3d move, int piece, double limit, out int next)
        {
            next = piece;
            double time = limit;
            if (piece + 2 < _knots.Length)
            {
                double speed = Vector3d.Dot(_across[piece + 1], move);
                double left = -Past(piece + 1, x);
                if (speed > 0.0 && left < speed * time)
                {
                    time = Math.Max(0.0, left / speed);
                    next = piece + 1;
                }
            }
            if (piece > 0)
            {
                double speed = -Vector3d.Dot(_across[piece], move);
                double left = Past(piece, x);
                if (speed > 0.0 && left < speed * time)
                {
                    time = Math.Max(0.0, left / speed);
                    next = piece - 1;
                }
            }
            return time;
        }

        /// <summary>Where the segment from a to a + u crosses the plane of knot k, from 0 to 1; NaN where it lies in
        /// it, or goes back.</summary>
        public double Cut(int k, in Vector3d a, in Vector3d u)
        {
            double along = Vector3d.Dot(_across[k], u);
            return along > 0.0 ? Math.Min(1.0, Math.Max(0.0, -Past(k, a) / along)) : double.NaN;
        }
    }

    /// <summary>A tube's line of knots with its corners rounded: each becomes an arc that touches the two pieces which
    /// meet there, in parts that turn by half a degree at most.</summary>
    /// <remarks>The arc begins half of the shorter piece before the knot and ends as far behind it: with t that length
    /// and theta the turn, its radius is t/tan(theta/2), and it passes the knot at t tan(theta/4). Knots at equal
    /// distances on a circle of radius R so become one arc, of radius R cos(theta/2).
    ///
    /// A wire's tip that a wall guides with a force P slides along a straight piece and turns at the next: the force on
    /// it varies by P theta about that of a smooth wall, over the length of a piece. Half a degree leaves less than a
    /// hundredth of P.</remarks>
    public static class RoundedCentreline
    {
        private const double LargestTurn = 0.5 * Math.PI / 180.0;
        private const double Fold = 3.0;         // radians; a line that folds back on itself has no arc
        private const double Resolution = 1e-9;  // of the shorter piece

        /// <summary>Replaces corners by arcs.</summary>
        /// <param name="knots">Centreline, units, no two neighbours at the same position.</param>
        /// <param name="radii">Radius at each, units; along an arc it changes evenly from the knot's to both
        /// ends'.</param>
        public static void Round(ref Vector3d[] knots, ref double[] radii)
        {
            var line = new List<Vector3d> { knots[0] };
            var widths = new List<double> { radii[0] };
            for (int k = 1; k + 1 < knots.Length; k++)
            {
                AddCorner(knots, radii, k, line, widths);
            }
            Add(knots[knots.Length - 1], radii[knots.Length - 1], 0.0, line, widths);
            knots = line.ToArray();
            radii = widths.ToArray();
        }

        private static void AddCorner(
            Vector3d[] knots, double[] radii, int k, List<Vector3d> line, List<double> widths)
        {
            double before = Vector3d.Distance(knots[k - 1], knots[k]);
            double after = Vector3d.Distance(knots[k], knots[k + 1]);
            Vector3d along = (1.0 / before) * (knots[k] - knots[k - 1]);
            Vector3d next = (1.0 / after) * (knots[k + 1] - knots[k]);
            double turn = Math.Atan2(Vector3d.Cross(along, next).Length, Vector3d.Dot(along, next));
            if (!(turn > LargestTurn && turn < Fold))
            {
                Add(knots[k], radii[k], 0.0, line, widths);
                return;
            }
            double limit = 0.5 * Math.Min(before, after);
            double radius = limit / Math.Tan(0.5 * turn);
            Vector3d start = knots[k] - limit * along;
            Vector3d inwards = Vector3d.Normalize(next - Math.Cos(turn) * along);
            double atStart = radii[k] + limit / before * (radii[k - 1] - radii[k]);
            double atEnd = radii[k] + limit / after * (radii[k + 1] - radii[k]);
            int parts = 2 * (int)Math.Ceiling(0.5 * turn / LargestTurn);
            for (int i = 0; i <= parts; i++)
            {
                double angle = turn * i / parts;
                double fromKnot = Math.Abs(2.0 * i / parts - 1.0);
                double width = radii[k] + fromKnot * ((2 * i < parts ? atStart : atEnd) - radii[k]);
                Add(start + radius * (Math.Sin(angle) * along + (1.0 - Math.Cos(angle)) * inwards), width,
                    Resolution * limit, line, widths);
            }
        }

        // Where one arc ends in another there is one knot.
        private static void Add(
            in Vector3d knot, double radius, double resolution, List<Vector3d> line, List<double> widths)
        {
            if (Vector3d.Distance(line[line.Count - 1], knot) > resolution)
            {
                line.Add(knot);
                widths.Add(radius);
            }
        }
    }
}

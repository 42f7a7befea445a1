using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>The creases of a tube: at a knot where it bends, or where its wall turns towards the axis and away
    /// again, the walls of two pieces meet in an edge that bulges into the lumen.</summary>
    /// <remarks>With f1 and f2 the pieces' terms of the distance, n1 and n2 their normals and m = n1 - n2, a segment
    /// crosses the crease at x(s) with f1 = f2: there is the least of max(f1, f2) along it. While the segment moves,
    /// ds = -(m . dx)/(m . u) with u = b - a, so the distance there has the derivative
    /// ((n1 . u) n2 - (n2 . u) n1)/(m . u), which is normal to u. The weight is |m|, the angle of the crease there: on
    /// the outer side of a bend, where both terms are that of the knot's ball, it is 0. It fades over a tenth of the
    /// segment at both ends.</remarks>
    internal sealed class TubeCreases
    {
        private const double Fade = 0.1;          // of the segment
        private const double MinAngle = 1e-9;   // radians
        private const int MaxIterations = 60;
        private readonly TubePiece[] _pieces;
        private readonly Vector3d[] _knots;
        private readonly double[] _radii;
        private readonly bool[] _isCrease;        // by knot
        private readonly TubePlanes _planes;
        private readonly double[] _slack;         // by knot: the crease is no farther from that plane, units
        private readonly double[] _extent;        // by knot: and no farther from the knot, units

        /// <summary>Finds the creases of this tube.</summary>
        public TubeCreases(TubeShape tube, TubePiece[] pieces, TubePlanes planes)
        {
            _planes = planes;
            _pieces = pieces;
            _knots = tube.Knots;
            _radii = tube.Radii;
            _isCrease = new bool[_knots.Length];
            _slack = new double[_knots.Length];
            _extent = new double[_knots.Length];
            for (int k = 1; k + 1 < _knots.Length; k++)
            {
                Vector3d before = _knots[k] - _knots[k - 1];
                Vector3d after = _knots[k + 1] - _knots[k];
                double turn = Math.Atan2(Vector3d.Cross(before, after).Length, Vector3d.Dot(before, after));
                double narrows = (_radii[k] - _radii[k - 1]) / before.Length;
                double widens = (_radii[k + 1] - _radii[k]) / after.Length;
                _isCrease[k] = turn + Math.Asin(widens) - Math.Asin(narrows) > MinAngle;
                // At the inner side of a sharp bend the walls of two cylinders meet at r/cos(turn/2).
                _extent[k] = _radii[k] * Math.Max(1.5, 1.5 / Math.Cos(0.5 * turn));
                _slack[k] = 2.0 * _radii[k] * (Math.Abs(narrows) + Math.Abs(widens) + 1e-9);
            }
        }

        /// <summary>Distance of segment a b from the wall where it crosses creases between pieces that are next to each
        /// other in a range; infinite where it crosses none.</summary>
        public double Nearest(in Vector3d a, in Vector3d b, FeatureRange pieces)
        {
            double nearest = double.PositiveInfinity;
            for (int i = pieces.From + 1; i < pieces.To; i++)
            {
                int k = pieces[i];
                if (k == pieces[i - 1] + 1 && _isCrease[k] && !IsBeside(k, a, b, out double pastA, out double pastB))
                {
                    nearest = Math.Min(nearest, DistanceAt(k, a, b, pastA, pastB));
                }
            }
            return nearest;
        }

        /// <summary>Adds the creases that segment a b crosses within <paramref name="range"/> of the wall.</summary>
        public void Find(in Vector3d a, in Vector3d b, double range, StructList<EdgeContact> edgeContacts)
        {
            for (int k = 1; k + 1 < _knots.Length; k++)
            {
                if (_isCrease[k] && !IsBeside(k, a, b, out double pastA, out double pastB))
                {
                    Find(k, a, b, pastA, pastB, range, edgeContacts);
                }
            }
        }

        /// <summary>The same between pieces that are next to each other in a range.</summary>
        public void Find(in Vector3d a, in Vector3d b, double range, FeatureRange pieces,
            StructList<EdgeContact> edgeContacts)
        {
            for (int i = pieces.From + 1; i < pieces.To; i++)
            {
                int k = pieces[i];
                if (k == pieces[i - 1] + 1 && _isCrease[k] && !IsBeside(k, a, b, out double pastA, out double pastB))
                {
                    Find(k, a, b, pastA, pastB, range, edgeContacts);
                }
            }
        }

        // Whether a segment is on one side of a knot's plane, farther than its crease; and how far its ends are beyond
        // that plane, units.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private bool IsBeside(int k, in Vector3d a, in Vector3d b, out double pastA, out double pastB)
        {
            double slack = _slack[k];
            pastA = _planes.Past(k, a);
            pastB = _planes.Past(k, b);
            return (pastA > slack && pastB > slack) || (pastA < -slack && pastB < -slack);
        }

        // In the direction of the tube, or against it where the wire has turned back.
        [MethodImpl(MethodImplOptions.NoInlining)]
        private void Find(int k, in Vector3d a, in Vector3d b, double pastA, double pastB, double range,
            StructList<EdgeContact> edgeContacts)
        {
            double size = Vector3d.Distance(a, b);
            if (MayCross(k, a, pastA, pastB, size) && Find(k, a, b, pastA, pastB, range, out EdgeContact contact))
            {
                edgeContacts.Add(contact);
            }
            else if (MayCross(k, b, pastB, pastA, size) && Find(k, b, a, pastB, pastA, range, out contact))
            {
                edgeContacts.Add(contact.Reversed());
            }
        }

        /// <summary>The contact where a segment goes from one piece to another, which need not be the next one; false
        /// where it does not, or beyond the range.</summary>
        /// <param name="s">Where it does so at least, about, and at most.</param>
        public bool FindBetween(int first, int second, in Vector3d a, in Vector3d b,
            (double Least, double About, double Most) s, double range, out EdgeContact contact)
        {
            contact = default;
            if (!Cross(first, second, a, b, s, out Crossing c) || c.Distance > range)
            {
                return false;
            }
            contact = ContactAt(first, second, b - a, c);
            return true;
        }

        private double DistanceAt(int k, in Vector3d a, in Vector3d b, double pastA, double pastB)
        {
            double size = Vector3d.Distance(a, b);
            return (MayCross(k, a, pastA, pastB, size)
                    && Cross(k - 1, k, a, b, AtPlane(pastA, pastB), out Crossing crossing))
                || (MayCross(k, b, pastB, pastA, size) && Cross(k - 1, k, b, a, AtPlane(pastB, pastA), out crossing))
                ? crossing.Distance : double.PositiveInfinity;
        }

        private bool Find(int k, in Vector3d a, in Vector3d b, double pastA, double pastB, double range,
            out EdgeContact contact)
        {
            contact = default;
            return !IsFar(k, a, b, pastA, pastB, range)
                && FindBetween(k - 1, k, a, b, AtPlane(pastA, pastB), range, out contact);
        }

        private EdgeContact ContactAt(int before, int after, in Vector3d u, in Crossing c)
        {
            Vector3d m = c.First - c.Second;
            double along = Vector3d.Dot(m, u);
            Vector3d normal = (1.0 / along) * (Vector3d.Dot(c.First, u) * c.Second
                - Vector3d.Dot(c.Second, u) * c.First);
            double s = c.Position;
            double weight = m.Length;
            Vector3d e = m / weight;
            Symmetric3 first = c.Curvature(_knots, before, c.First, c.FirstCentre, c.FirstIsRound);
            Symmetric3 second = c.Curvature(_knots, after, c.Second, c.SecondCentre, c.SecondIsRound);
            Vector3d turn = first.Times(e) - second.Times(e);
            // Along the crossing's own motion dx + u ds.
            Vector3d slope = turn - (Vector3d.Dot(turn, u) / along) * m;
            double toEnd = Math.Min(s, 1.0 - s) / Fade;
            if (toEnd < 1.0)
            {
                double sign = s < 0.5 ? 1.0 : -1.0;
                double left = toEnd * toEnd * (3.0 - 2.0 * toEnd);
                slope = left * slope
                    + (-weight * sign * 6.0 * toEnd * (1.0 - toEnd) / (Fade * along)) * m;
                weight *= left;
            }
            double fraction = Vector3d.Dot(c.First, u) / along;
            Vector3d slide = (-1.0 / along) * m;
            return new EdgeContact(s, c.Distance, normal, weight, (1.0 - s) * slope, s * slope, 1.0, 0.0).Sliding(
                (1.0 - s) * slide, s * slide, (1.0 - fraction) * first + fraction * second);
        }

        // No crossing is farther from the knot than its crease, nor from a than b is; and it goes from one side of the
        // knot's plane to the other, but for the slack. pastA and pastB: how far its ends are beyond that plane, units.
        private bool MayCross(int k, in Vector3d a, double pastA, double pastB, double size)
        {
            double limit = _extent[k] + size;
            return pastA <= _slack[k] && pastB >= -_slack[k] && (a - _knots[k]).LengthSquared <= limit * limit;
        }

        // Where f1 - f2 goes from positive to negative along the segment, by Newton's method between bounds.
        private bool Cross(int first, int second, in Vector3d a, in Vector3d b,
            (double Least, double About, double Most) within, out Crossing at)
        {
            at = default;
            (double low, double s, double high) = within;
            if (!(Difference(first, second, Vector3d.Lerp(a, b, low)) > 0.0
                && Difference(first, second, Vector3d.Lerp(a, b, high)) < 0.0))
            {
                return false;
            }
            Vector3d u = b - a;
            double resolution = 1e-15 * (_radii[second] + a.Length);
            for (int i = 0; i < MaxIterations; i++)
            {
                at = new Crossing(_pieces[first], _pieces[second], Vector3d.Lerp(a, b, s), s);
                if (Math.Abs(at.Difference) <= resolution)
                {
                    break;
                }
                if (at.Difference > 0.0)
                {
                    low = s;
                }
                else
                {
                    high = s;
                }
                s -= at.Difference / Vector3d.Dot(at.First - at.Second, u);
                s = s > low && s < high ? s : 0.5 * (low + high);
            }
            // In the ball of the knot there is no crease.
            Vector3d m = at.First - at.Second;
            return Vector3d.Dot(m, u) < 0.0 && m.Length > MinAngle && at.Distance > -_radii[second];
        }

        // Near the crossing: in the plane that halves the bend.
        private static (double, double, double) AtPlane(double pastA, double pastB) =>
            (0.0, pastA < 0.0 && pastB > 0.0 ? pastA / (pastA - pastB) : 0.5, 1.0);

        // Whether a segment that may cross certainly does so beyond the range, or in the ball of the knot, where there
        // is no crease: it crosses within the slack of the plane, and a piece's term has a slope of 1 at most.
        private bool IsFar(int k, in Vector3d a, in Vector3d b, double pastA, double pastB, double range)
        {
            if (!(pastA < 0.0 && pastB > 0.0))
            {
                return false;
            }
            double slack = Vector3d.Distance(a, b) * _slack[k] / (pastB - pastA);
            Vector3d x = Vector3d.Lerp(a, b, pastA / (pastA - pastB));
            return _pieces[k - 1].Distance(x) > range + slack
                || (_pieces[k - 1].IsPast(x, slack) && _pieces[k].IsBefore(x, slack));
        }

        private double Difference(int first, int second, in Vector3d x) =>
            _pieces[first].Distance(x) - _pieces[second].Distance(x);

        // Both pieces' terms at a point of the segment.
        private readonly struct Crossing
        {
            public readonly double Position;
            public readonly double Distance;
            public readonly double Difference;
            public readonly Vector3d First;
            public readonly Vector3d Second;
            public readonly Vector3d FirstCentre;
            public readonly Vector3d SecondCentre;
            public readonly bool FirstIsRound;
            public readonly bool SecondIsRound;
            private readonly Vector3d _x;

            public Crossing(in TubePiece first, in TubePiece second, in Vector3d x, double s)
            {
                Position = s;
                _x = x;
                double one = first.Distance(x, out FirstCentre, out double alongFirst);
                double two = second.Distance(x, out SecondCentre, out double alongSecond);
                Distance = Math.Max(one, two);
                Difference = one - two;
                First = Vector3d.Normalize(FirstCentre - x);
                Second = Vector3d.Normalize(SecondCentre - x);
                FirstIsRound = alongFirst <= 0.0 || alongFirst >= 1.0;
                SecondIsRound = alongSecond <= 0.0 || alongSecond >= 1.0;
            }

            /// <summary>How a piece's normal changes: across it by -1/r, r the distance from its centre; along the wall
            /// not at all, but where it is a ball.</summary>
            public Symmetric3 Curvature(Vector3d[] knots, int piece, in Vector3d normal, in Vector3d centre,
                bool isRound)
            {
                double curvature = -1.0 / Vector3d.Distance(_x, centre);
                if (isRound)
                {
                    return new Symmetric3(curvature, 0.0, curvature, 0.0, 0.0, curvature)
                        + Symmetric3.Outer(-curvature, normal);
                }
                Vector3d around = Vector3d.Normalize(Vector3d.Cross(knots[piece + 1] - knots[piece], normal));
                return Symmetric3.Outer(curvature, around);
            }
        }
    }
}

using System;

namespace Guidewire.Core
{
    /// <summary>A tube along a centreline of straight pieces: its lumen is the union of all spheres whose centre runs
    /// along the centreline while their radius changes linearly from knot to knot.</summary>
    /// <remarks>The distance of x is d(x) = max over pieces i and u in [0, 1] of R_i(u) - |x - c_i(u)|, its normal
    /// points from x to the centre c that gives the maximum. d is the exact distance outside a crease, has slope 1
    /// everywhere and is 0 on the wall; where two pieces meet at the inner side of a bend it may be smaller than the
    /// distance to their common edge, never larger. Each piece's term is concave, because its lumen is convex: an
    /// element therefore touches with its ends or where two pieces' terms cross. Cost grows with the number of
    /// pieces; a vessel of many is better given as a mesh.</remarks>
    public sealed class TubeShape : ContactShape
    {
        private const int MaxHalvings = 48;
        private const int MaxHandovers = 64;
        private const int MaxSplits = 20;
        private const double LeastAdvance = 1e-12;
        private readonly Vector3d[] _knots;
        private readonly double[] _radii;
        private readonly double _resolution;
        private readonly TubePiece[] _pieces;
        private int _last;    // the piece that the last query met: where the next one begins to look
        private TubePlaces? _places;
        private TubeRidges? _ridges;
        private TubeSweep? _sweep;

        /// <summary>The tube through <paramref name="knots"/> (at least 2, units) with a radius at each (positive,
        /// units). It ends in half spheres; an open end goes on straight, with the radius of its last knot.</summary>
        /// <exception cref="ArgumentException">Fewer than 2 knots, unequal counts, a value that is not finite, a radius
        /// that is not positive, or a piece that lies inside the sphere of one of its ends.</exception>
        public TubeShape(Vector3d[] knots, double[] radii, bool openStart, bool openEnd)
        {
            string? error = Check(knots, radii);
            if (error != null)
            {
                throw new ArgumentException(error);
            }
            int extra = (openStart ? 1 : 0) + (openEnd ? 1 : 0);
            int shift = openStart ? 1 : 0;
            int count = knots.Length;
            _knots = new Vector3d[count + extra];
            _radii = new double[count + extra];
            double length = 0.0;
            double widest = 0.0;
            for (int i = 0; i < count; i++)
            {
                _knots[i + shift] = knots[i];
                _radii[i + shift] = radii[i];
                widest = Math.Max(widest, radii[i]);
                length += i > 0 ? Vector3d.Distance(knots[i - 1], knots[i]) : 0.0;
            }

            // Far enough that no wire reaches the end of the extension, near enough to keep 12 digits of a radius.
            double far = 1000.0 * (length + widest);
            if (openStart)
            {
                _knots[0] = knots[0] + far * Vector3d.Normalize(knots[0] - knots[1]);
                _radii[0] = radii[0];
            }
            if (openEnd)
            {
                _knots[count + shift] = knots[count - 1]
                    + far * Vector3d.Normalize(knots[count - 1] - knots[count - 2]);
                _radii[count + shift] = radii[count - 1];
            }
            _resolution = 1e-12 * (length + widest);
            _pieces = new TubePiece[_knots.Length - 1];
            for (int i = 0; i < _pieces.Length; i++)
            {
                _pieces[i] = new TubePiece(_knots[i], _knots[i + 1], _radii[i], _radii[i + 1]);
            }
        }

        /// <summary>Knots of the centreline in units; an open end's last knot is far away.</summary>
        internal Vector3d[] Knots => _knots;

        /// <summary>Radius at each knot, units.</summary>
        internal double[] Radii => _radii;

        /// <summary>d(x), positive in the lumen, and the wall's normal there.</summary>
        /// <remarks>On the centreline of a piece the normal has no direction and is 0.</remarks>
        public double Distance(in Vector3d x, out Vector3d normal)
        {
            double best = Largest(x, out _, out Vector3d centre);
            normal = Vector3d.Normalize(centre - x);
            return best;
        }

        /// <summary>d(x), the piece that gives it, of equals the first, and the centre.</summary>
        internal double Largest(in Vector3d x, out int piece, out Vector3d centre)
        {
            piece = _last;
            double best = PieceDistance(piece, x, out centre);
            for (int i = 0; i < _pieces.Length; i++)
            {
                if (i == piece || _pieces[i].IsBelow(x, best))
                {
                    continue;
                }
                double value = PieceDistance(i, x, out Vector3d c);
                if (value > best || (value == best && i < piece))
                {
                    best = value;
                    centre = c;
                    piece = i;
                }
            }
            _last = piece;
            return best;
        }

        /// <inheritdoc/>
        public override bool Contains(in Vector3d point)
        {
            return Distance(point, out _) > 0.0;
        }

        /// <inheritdoc/>
        public override bool Nearest(
            in Vector3d a, in Vector3d b, double range, ref int hint, out SurfaceContact contact)
        {
            double da = Distance(a, out Vector3d na);
            double s = 0.0;
            double distance = da;
            Vector3d normal = na;
            double length = Vector3d.Distance(a, b);
            if (length > 0.0)
            {
                double db = Distance(b, out Vector3d nb);
                if (db < distance)
                {
                    s = 1.0;
                    distance = db;
                    normal = nb;
                }
                if (0.5 * (da + db - length) <= Math.Min(distance, range))
                {
                    Between(a, b, length, 0.0, da, 1.0, db, range, 0, ref s, ref distance, ref normal);
                }
            }
            contact = new SurfaceContact(s, Vector3d.Lerp(a, b, s) - distance * normal, normal, distance);
            return distance <= range;
        }

        /// <summary>The least and the largest distances along the segment, by turns: ends that it approaches the wall
        /// with, creases where two pieces meet at the inner side of a bend, and with weight -1 the places between that
        /// are farthest from the wall; see <see cref="TubePlaces"/>. A straight stretch parallel to the wall counts by
        /// its middle. At a crease normal and curvature are those of one of the pieces. On a piece's centreline the
        /// normal is 0 and no curvature is stated.</summary>
        internal override void FindPlaces(
            in Vector3d a, in Vector3d b, double range, StructList<WallPlace> places)
        {
            _places ??= new TubePlaces(this);
            _places.Find(a, b, range, places);
        }

        /// <inheritdoc/>
        public override double Sweep(
            in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double clearance,
            out SurfaceContact contact)
        {
            contact = default;
            int hint = -1;
            Nearest(a0, b0, double.PositiveInfinity, ref hint, out SurfaceContact start);
            double keep = Math.Min(clearance, 0.5 * start.Distance);
            double impact = SafeUntil(a0, b0, a1, b1, 0.0, NoImpact, keep, 0);
            if (impact < NoImpact)
            {
                Nearest(
                    Vector3d.Lerp(a0, a1, impact), Vector3d.Lerp(b0, b1, impact), double.PositiveInfinity, ref hint,
                    out contact);
            }
            return impact;
        }

        /// <inheritdoc/>
        internal override double SweepKeeping(
            in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double keep)
        {
            _sweep ??= new TubeSweep(_pieces);
            return _sweep.Keeping(a0, b0, a1, b1, keep);
        }

        /// <summary>At the ends of the segment and where it crosses creases.</summary>
        internal override double QuickDistance(in Vector3d a, in Vector3d b, double range, ref int hint)
        {
            double nearest = Math.Min(Largest(a, out _, out _), Largest(b, out _, out _));
            _ridges ??= new TubeRidges(this, _pieces);
            return Math.Min(nearest, _ridges.Nearest(a, b));
        }

        /// <summary>The creases at its knots; see <see cref="TubeRidges"/>.</summary>
        internal override void FindRidges(
            in Vector3d a, in Vector3d b, double range, StructList<WallRidge> ridges)
        {
            _ridges ??= new TubeRidges(this, _pieces);
            _ridges.Find(a, b, range, ridges);
        }

        /// <summary>That of the narrowest knot.</summary>
        internal override double NarrowestRadius(double above)
        {
            double narrowest = double.PositiveInfinity;
            foreach (double radius in _radii)
            {
                narrowest = radius > above ? Math.Min(narrowest, radius) : narrowest;
            }
            return narrowest;
        }

        // Smallest d on s0..s1, given its values at both ends: with slope at most 1 it is nowhere below
        // (d0 + d1 - length)/2, and where one piece serves both ends it is nowhere below the smaller of the two.
        private void Between(
            in Vector3d a, in Vector3d b, double length, double s0, double d0, double s1, double d1, double range,
            int depth, ref double s, ref double distance, ref Vector3d normal)
        {
            double bound = 0.5 * (d0 + d1 - length * (s1 - s0));
            if (bound > range || bound >= distance - _resolution || depth == MaxHalvings
                || HullClearance(Vector3d.Lerp(a, b, s0), Vector3d.Lerp(a, b, s1)) >= distance)
            {
                return;
            }
            double middle = 0.5 * (s0 + s1);
            double d = Distance(Vector3d.Lerp(a, b, middle), out Vector3d n);
            if (d < distance)
            {
                s = middle;
                distance = d;
                normal = n;
            }
            Between(a, b, length, s0, d0, middle, d, range, depth + 1, ref s, ref distance, ref normal);
            Between(a, b, length, middle, d, s1, d1, range, depth + 1, ref s, ref distance, ref normal);
        }

        // Largest value that one piece's term keeps on the whole segment: a lower bound of d on it.
        private double HullClearance(in Vector3d a, in Vector3d b)
        {
            double best = double.NegativeInfinity;
            for (int i = 0; i < _pieces.Length; i++)
            {
                if (!_pieces[i].IsBelow(a, best) && PieceDistance(i, a, out _) is double value && value > best)
                {
                    best = Math.Max(best, Math.Min(value, PieceDistance(i, b, out _)));
                }
            }
            return best;
        }

        // Largest time until which the segment is proven to keep its distance, from a time at which it does. While one
        // piece's lumen, being convex, holds both ends it holds all between them; where none does, each half is asked,
        // first the one whose end is nearer to the wall, which limits what is asked of the other.
        private double SafeUntil(
            in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double time, double limit, double keep,
            int depth)
        {
            for (int k = 0; k < MaxHandovers; k++)
            {
                double until = time;
                for (int i = 0; i + 1 < _knots.Length && until < 1.0; i++)
                {
                    until = Math.Max(until, LeavesPiece(i, a0, b0, a1, b1, time, keep));
                }
                if (until >= 1.0 || until >= limit)
                {
                    return NoImpact;
                }
                if (until - time <= LeastAdvance)
                {
                    break;
                }
                time = until;
            }
            if (depth == MaxSplits)
            {
                return time;
            }
            Vector3d m0 = Vector3d.Lerp(a0, b0, 0.5);
            Vector3d m1 = Vector3d.Lerp(a1, b1, 0.5);
            double atA = Distance(Vector3d.Lerp(a0, a1, time), out _);
            double atB = Distance(Vector3d.Lerp(b0, b1, time), out _);
            double nearer = atA <= atB
                ? SafeUntil(a0, m0, a1, m1, time, limit, keep, depth + 1)
                : SafeUntil(m0, b0, m1, b1, time, limit, keep, depth + 1);
            if (nearer <= time)
            {
                return nearer;
            }
            limit = Math.Min(limit, nearer);
            double farther = atA <= atB
                ? SafeUntil(m0, b0, m1, b1, time, limit, keep, depth + 1)
                : SafeUntil(a0, m0, a1, m1, time, limit, keep, depth + 1);
            return Math.Min(nearer, farther);
        }

        // When the first end leaves piece i's lumen, less the distance to keep; the time itself when it is not in it.
        // The piece's term is concave along each end's straight way, so it leaves once.
        private double LeavesPiece(
            int i, in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double time, double keep)
        {
            Vector3d a = Vector3d.Lerp(a0, a1, time);
            if (_pieces[i].IsBelow(a, keep) || !IsInPiece(i, a, Vector3d.Lerp(b0, b1, time), keep))
            {
                return time;
            }
            if (IsInPiece(i, a1, b1, keep))
            {
                return 1.0;
            }
            double inside = time;
            double outside = 1.0;
            while (outside - inside > LeastAdvance)
            {
                double middle = 0.5 * (inside + outside);
                if (IsInPiece(i, Vector3d.Lerp(a0, a1, middle), Vector3d.Lerp(b0, b1, middle), keep))
                {
                    inside = middle;
                }
                else
                {
                    outside = middle;
                }
            }
            return inside;
        }

        private bool IsInPiece(int i, in Vector3d a, in Vector3d b, double keep)
        {
            return PieceDistance(i, a, out _) >= keep && PieceDistance(i, b, out _) >= keep;
        }

        // max over u in [0, 1] of R(u) - |x - c(u)| for piece i, and the centre that gives it.
        private double PieceDistance(int i, in Vector3d x, out Vector3d centre)
        {
            return PieceDistance(i, x, out centre, out _);
        }

        /// <summary>The term of piece i at x with the centre that gives it, and where along the piece that centre would
        /// lie if the piece had no ends: from 0 to 1 between its knots.</summary>
        internal double PieceDistance(int i, in Vector3d x, out Vector3d centre, out double along)
        {
            return _pieces[i].Distance(x, out centre, out along);
        }

        private static string? Check(Vector3d[] knots, double[] radii)
        {
            if (knots.Length < 2 || knots.Length != radii.Length)
            {
                return "a tube needs at least 2 knots and one radius for each";
            }
            for (int i = 0; i < knots.Length; i++)
            {
                if (!knots[i].IsFinite || !(radii[i] > 0.0) || double.IsInfinity(radii[i]))
                {
                    return "knot " + i + " of the tube needs finite coordinates and a positive radius";
                }
                if (i > 0 && !(Vector3d.Distance(knots[i - 1], knots[i]) > Math.Abs(radii[i] - radii[i - 1])))
                {
                    return "knots " + (i - 1) + " and " + i + " of the tube are nearer than their radii differ";
                }
            }
            return null;
        }
    }
}

using System;

namespace Guidewire.Core
{
    /// <summary>Conservative continuous collision detection of a segment in a tube: a fraction of its motion that is
    /// proven to have a clearance.</summary>
    /// <remarks>A piece's lumen is convex, also when reduced by the clearance, and its term of the distance is concave.
    /// So the segment is divided where it crosses the planes that halve the tube's bends, and the motion where an end
    /// crosses one; in between, a part of the segment covers a patch that lies in its piece if the four corners do, and
    /// on the straight path of a corner the term is no less than the line between its values. The dividing points move
    /// along the segment, which bends their paths by up to a quarter of both changes. Where the pieces between the
    /// planes do not contain their corners at the start, pieces are searched: the patch of a part of the segment in a
    /// part of the time is free if one piece contains its corners, else its longer side is halved; if that decides
    /// nothing after some halvings, the motion counts as not free. Near a crease where the radius changes as well the
    /// planes are too far from where the pieces meet, and a gap may be smaller than any part: there the segment is
    /// divided where it is equally deep in both pieces, the least deep of its points.</remarks>
    internal sealed class TubeCcd
    {
        private const int MaxHalvings = 14;
        private const int TimeHalvings = 6;
        private const int MaxParts = 32;         // of the time, between crossings of planes
        private const int MaxPieces = 64;        // of the segment
        private const double MinPart = 1e-6;    // of the time
        private const double MinFraction = 0.05;   // of what is proven: the least gain for which the search continues
        private const double MinGrowth = 0.25;
        private const double SmallFraction = 0.01;   // below it, the segment is divided at the creases
        private const int CreaseIterations = 20;     // from the plane to the crease
        private readonly TubePiece[] _pieces;
        private readonly TubePlanes _planes;
        private readonly int[] _near;
        private int _count;
        private int _last;    // the piece that last contained all corners: tried first
        private Vector3d _a;
        private Vector3d _b;
        private Vector3d _moveA;
        private Vector3d _moveB;
        private double _clearance;
        private bool _isDividedAtCreases;

        /// <summary>Tests displacements in these pieces.</summary>
        public TubeCcd(TubePiece[] pieces, TubePlanes planes)
        {
            _pieces = pieces;
            _planes = planes;
            _near = new int[pieces.Length];
        }

        /// <summary>A fraction of the motion of segment a b from (a0, b0) to (a1, b1) during which it has at least a
        /// clearance, units; <see cref="ContactShape.NoImpact"/> for all of it, 0 where none can be proven.</summary>
        /// <param name="guess">A piece near the start of the first end.</param>
        public double SafeFraction(in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double clearance,
            int guess)
        {
            _a = a0;
            _b = b0;
            _moveA = a1 - a0;
            _moveB = b1 - b0;
            _clearance = clearance;
            _isDividedAtCreases = false;
            double fraction = BetweenPlanes(guess, out bool isTold);
            if (!isTold)
            {
                fraction = BySearch(a0, b0, a1, b1);
            }
            if (fraction < SmallFraction)
            {
                _isDividedAtCreases = true;
                fraction = Math.Max(fraction, BetweenCreases(guess));
            }
            return fraction;
        }

        // The fraction of the motion that is free by the pieces between the planes, one part after another in time: up
        // to the next plane that an end crosses, or shorter where that proves too little.
        private double BetweenPlanes(int guess, out bool isTold)
        {
            int first = _planes.PieceAt(_a, guess);
            int last = _planes.PieceAt(_b, first);
            TurnAlongTube(ref first, ref last);
            double time = 0.0;
            double longest = 1.0;
            isTold = true;
            for (int k = 0; k < MaxParts; k++)
            {
                double left = Math.Min(longest, 1.0 - time);
                double untilA = _planes.Crossing(_a + time * _moveA, _moveA, first, left, out int firstAfter);
                double untilB = _planes.Crossing(_b + time * _moveB, _moveB, last, left, out int lastAfter);
                double until = Math.Min(untilA, untilB);
                double fraction = PartFraction(first, last, time, time + until);
                time += fraction * until;
                if (fraction < 1.0)
                {
                    longest = until * Math.Max(MinGrowth, Math.Min(fraction, 0.5));
                    if (longest < MinFraction * time || longest < MinPart)
                    {
                        break;
                    }
                    continue;
                }
                if (time >= 1.0 - MinPart)
                {
                    return ContactShape.NoImpact;
                }
                first = untilA <= untilB ? firstAfter : first;
                last = untilB <= untilA ? lastAfter : last;
                longest = 2.0 * longest;
            }
            isTold = time > 0.0;
            return time;
        }

        // The fraction of the motion that is free by the pieces between the creases, one part after another in time.
        private double BetweenCreases(int guess)
        {
            int first = Deepest(_a, guess);
            int last = Deepest(_b, first);
            TurnAlongTube(ref first, ref last);
            double time = 0.0;
            double longest = 1.0;
            for (int k = 0; k < MaxParts && time < 1.0 - MinPart; k++)
            {
                first = Deepest(_a + time * _moveA, first);
                last = Deepest(_b + time * _moveB, last);
                double until = Math.Min(longest, 1.0 - time);
                double fraction = PartFraction(first, last, time, time + until);
                time += fraction * until;
                longest = fraction < 1.0 ? until * Math.Max(MinGrowth, Math.Min(fraction, 0.5)) : 2.0 * longest;
                if (longest < Math.Max(MinFraction * time, MinPart))
                {
                    return time;
                }
            }
            return time >= 1.0 - MinPart ? ContactShape.NoImpact : time;
        }

        // A segment that runs back in the tube, from its other end.
        private void TurnAlongTube(ref int first, ref int last)
        {
            if (last < first)
            {
                (_a, _b, _moveA, _moveB, first, last) = (_b, _a, _moveB, _moveA, last, first);
            }
        }

        // The piece in which a point is deeper than in its neighbours, from a guess on.
        private int Deepest(in Vector3d x, int guess)
        {
            int piece = guess;
            double depth = _pieces[piece].Distance(x);
            for (int way = 1; way >= -1; way -= 2)
            {
                for (int next = piece + way; next >= 0 && next < _pieces.Length; next += way)
                {
                    double there = _pieces[next].Distance(x);
                    if (!(there > depth))
                    {
                        break;
                    }
                    piece = next;
                    depth = there;
                }
            }
            return piece;
        }

        // The fraction of a part of the motion in which the ends stay in the same pieces.
        private double PartFraction(int first, int last, double from, double to)
        {
            if (last < first || last - first > MaxPieces)
            {
                return 0.0;
            }
            Vector3d a0 = _a + from * _moveA;
            Vector3d a1 = _a + to * _moveA;
            Vector3d u0 = _b + from * _moveB - a0;
            Vector3d u1 = _b + to * _moveB - a1;
            double turn = (u1 - u0).Length;
            double fraction = 1.0;
            double begin0 = 0.0;
            double begin1 = 0.0;
            Vector3d x0 = a0;
            Vector3d x1 = a1;
            for (int i = first; i <= last; i++)
            {
                // Planes of a short piece may cross: then nothing of the segment is left to it.
                double end0 = i < last ? Math.Max(begin0, Cut(i + 1, a0, u0, begin0)) : 1.0;
                double end1 = i < last ? Math.Max(begin1, Cut(i + 1, a1, u1, begin1)) : 1.0;
                if (!(end0 >= begin0 && end1 >= begin1))
                {
                    return 0.0;
                }
                Vector3d y0 = a0 + end0 * u0;
                Vector3d y1 = a1 + end1 * u1;
                if (end0 > begin0 || end1 > begin1)
                {
                    double need = _clearance + 0.25 * turn * Math.Max(Math.Abs(begin1 - begin0), Math.Abs(end1 - end0));
                    fraction = Math.Min(fraction, CornerFraction(_pieces[i], x0, x1, need));
                    fraction = fraction > 0.0 ? Math.Min(fraction, CornerFraction(_pieces[i], y0, y1, need)) : 0.0;
                    if (fraction == 0.0)
                    {
                        return 0.0;
                    }
                }
                begin0 = end0;
                begin1 = end1;
                x0 = y0;
                x1 = y1;
            }
            return fraction;
        }

        // Where the segment is divided: in the plane of a knot or, from there by Newton's method, at the crease. Any
        // point would do for the proof.
        private double Cut(int k, in Vector3d a, in Vector3d u, double from)
        {
            double s = _planes.Cut(k, a, u);
            if (!_isDividedAtCreases)
            {
                return s;
            }
            s = s >= from ? s : 0.5 * (from + 1.0);
            for (int i = 0; i < CreaseIterations; i++)
            {
                Vector3d x = a + s * u;
                double difference = _pieces[k - 1].Distance(x, out Vector3d before, out _)
                    - _pieces[k].Distance(x, out Vector3d after, out _);
                double slope = Vector3d.Dot(Vector3d.Normalize(before - x) - Vector3d.Normalize(after - x), u);
                double next = Math.Min(1.0, Math.Max(from, s - difference / slope));
                if (!(slope < 0.0) || next == s)
                {
                    break;
                }
                s = next;
            }
            return s;
        }

        private static double CornerFraction(in TubePiece piece, in Vector3d from, in Vector3d to, double need)
        {
            double before = piece.Distance(from);
            if (!(before >= need))
            {
                return 0.0;
            }
            double after = piece.Distance(to);
            return after >= need ? 1.0 : (before - need) / (before - after);
        }

        private double BySearch(in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1)
        {
            if (HoldsAll(_pieces[_last], a0, b0, a1, b1))
            {
                return ContactShape.NoImpact;
            }
            FindNear(a1, b1);
            if (IsSafe(0.0, 1.0, 0.0, 1.0, 0))
            {
                return ContactShape.NoImpact;
            }
            double safe = 0.0;
            double unsafeFrom = 1.0;
            for (int k = 0; k < TimeHalvings || (safe == 0.0 && k < 4 * TimeHalvings); k++)
            {
                double middle = 0.5 * (safe + unsafeFrom);
                if (IsSafe(0.0, 1.0, safe, middle, 0))
                {
                    safe = middle;
                }
                else
                {
                    unsafeFrom = middle;
                }
            }
            return safe;
        }

        // Pieces that may contain a corner.
        private void FindNear(in Vector3d a1, in Vector3d b1)
        {
            Vector3d middle = 0.25 * (_a + _b + a1 + b1);
            double size = Math.Max(Math.Max(Vector3d.Distance(middle, _a), Vector3d.Distance(middle, _b)),
                Math.Max(Vector3d.Distance(middle, a1), Vector3d.Distance(middle, b1)));
            _count = 0;
            for (int i = 0; i < _pieces.Length; i++)
            {
                if (!_pieces[i].IsBelow(middle, _clearance - size))
                {
                    _near[_count++] = i;
                }
            }
        }

        // Whether the part from s0 to s1 has the clearance from time t0 to t1.
        private bool IsSafe(double s0, double s1, double t0, double t1, int depth)
        {
            Vector3d c00 = At(s0, t0);
            Vector3d c10 = At(s1, t0);
            Vector3d c01 = At(s0, t1);
            Vector3d c11 = At(s1, t1);
            for (int k = 0; k < _count; k++)
            {
                ref readonly TubePiece piece = ref _pieces[_near[k]];
                if (HoldsAll(piece, c00, c10, c01, c11))
                {
                    _last = _near[k];
                    return true;
                }
            }
            if (depth == MaxHalvings || !IsHeld(c00) || !IsHeld(c10) || !IsHeld(c01) || !IsHeld(c11))
            {
                return false;
            }
            double along = Math.Max((c10 - c00).LengthSquared, (c11 - c01).LengthSquared);
            double motion = Math.Max((c01 - c00).LengthSquared, (c11 - c10).LengthSquared);
            if (along >= motion)
            {
                double s = 0.5 * (s0 + s1);
                return IsSafe(s0, s, t0, t1, depth + 1) && IsSafe(s, s1, t0, t1, depth + 1);
            }
            double t = 0.5 * (t0 + t1);
            return IsSafe(s0, s1, t0, t, depth + 1) && IsSafe(s0, s1, t, t1, depth + 1);
        }

        private bool IsHeld(in Vector3d x)
        {
            for (int k = 0; k < _count; k++)
            {
                if (Holds(_pieces[_near[k]], x))
                {
                    return true;
                }
            }
            return false;
        }

        private bool HoldsAll(in TubePiece piece, in Vector3d a, in Vector3d b, in Vector3d c, in Vector3d d) =>
            Holds(piece, a) && Holds(piece, d) && Holds(piece, b) && Holds(piece, c);

        private bool Holds(in TubePiece piece, in Vector3d x) =>
            !piece.IsBelow(x, _clearance) && piece.Distance(x, out _, out _) >= _clearance;

        private Vector3d At(double s, double t) => Vector3d.Lerp(_a + t * _moveA, _b + t * _moveB, s);
    }
}

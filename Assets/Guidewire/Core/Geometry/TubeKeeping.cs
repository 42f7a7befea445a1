using System;

namespace Guidewire.Core
{
    /// <summary>How far a segment may move in a tube so that it surely keeps a distance.</summary>
    /// <remarks>A piece's lumen is convex, less the distance to keep as well: what a part of the segment sweeps in a
    /// part of the time is in it where its four corners are. Where no piece holds all four, the longer side of the part
    /// is halved; where that does not tell after some halvings, the answer is no.</remarks>
    internal sealed class TubeKeeping
    {
        private const int MaxHalvings = 14;
        private const int TimeHalvings = 6;
        private readonly TubePiece[] _pieces;
        private readonly int[] _near;
        private int _count;
        private int _last;    // the piece that last held all corners: asked first
        private Vector3d _a;
        private Vector3d _b;
        private Vector3d _moveA;
        private Vector3d _moveB;
        private double _keep;

        /// <summary>In these pieces.</summary>
        public TubeKeeping(TubePiece[] pieces)
        {
            _pieces = pieces;
            _near = new int[pieces.Length];
        }

        /// <summary>See <see cref="ContactShape.SweepKeeping"/>.</summary>
        public double Keeping(in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double keep)
        {
            _a = a0;
            _b = b0;
            _moveA = a1 - a0;
            _moveB = b1 - b0;
            _keep = keep;
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

        // Pieces of which some point may hold a corner.
        private void FindNear(in Vector3d a1, in Vector3d b1)
        {
            Vector3d middle = 0.25 * (_a + _b + a1 + b1);
            double size = Math.Max(Math.Max(Vector3d.Distance(middle, _a), Vector3d.Distance(middle, _b)),
                Math.Max(Vector3d.Distance(middle, a1), Vector3d.Distance(middle, b1)));
            _count = 0;
            for (int i = 0; i < _pieces.Length; i++)
            {
                if (!_pieces[i].IsBelow(middle, _keep - size))
                {
                    _near[_count++] = i;
                }
            }
        }

        // Whether the part from s0 to s1 keeps the distance from time t0 to t1.
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

        private bool HoldsAll(in TubePiece piece, in Vector3d a, in Vector3d b, in Vector3d c, in Vector3d d)
        {
            return Holds(piece, a) && Holds(piece, d) && Holds(piece, b) && Holds(piece, c);
        }

        private bool Holds(in TubePiece piece, in Vector3d x)
        {
            return !piece.IsBelow(x, _keep) && piece.Distance(x, out _, out _) >= _keep;
        }

        private Vector3d At(double s, double t)
        {
            return Vector3d.Lerp(_a + t * _moveA, _b + t * _moveB, s);
        }
    }
}

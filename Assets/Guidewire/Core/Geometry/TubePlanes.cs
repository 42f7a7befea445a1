using System;

namespace Guidewire.Core
{
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
}

using System;

namespace Guidewire.Core
{
    /// <summary>Shortens a motion of the wire until it passes no wall, as the last resort: first that of the spheres
    /// that would, then of all alike, at the end to nothing.</summary>
    internal sealed class ShortenedMotion
    {
        private const int LocalRounds = 8;
        private const int GlobalRounds = 20;
        private const double SafePart = 0.9;
        private readonly SweptSearch _swept;
        private readonly double[] _share;
        private readonly Vector3d[] _whole;

        /// <param name="swept">Tells what would pass a wall.</param>
        /// <param name="sphereCount">n + 1.</param>
        public ShortenedMotion(SweptSearch swept, int sphereCount)
        {
            _swept = swept;
            _share = new double[sphereCount];
            _whole = new Vector3d[sphereCount];
        }

        /// <summary>Takes the ends of the motion back, in place.</summary>
        /// <param name="from">Where the n + 1 spheres are, clear of the walls; units.</param>
        /// <param name="to">Where they would go.</param>
        public void Shorten(Vector3d[] from, Vector3d[] to)
        {
            Array.Copy(to, _whole, to.Length);
            Array.Fill(_share, 1.0);
            for (int round = 0; round < LocalRounds; round++)
            {
                if (!Cut(from, to))
                {
                    return;
                }
                Apply(from, to);
            }
            double least = 1.0;
            foreach (double share in _share)
            {
                least = Math.Min(least, share);
            }
            for (int round = 0; round < GlobalRounds; round++)
            {
                Array.Fill(_share, least);
                Apply(from, to);
                if (!Cut(from, to))
                {
                    return;
                }
                least *= 0.5;
            }
            Array.Copy(from, to, to.Length);
        }

        private bool Cut(Vector3d[] from, Vector3d[] to)
        {
            bool any = false;
            for (int i = 0; i < to.Length; i++)
            {
                double own = _swept.SphereImpact(from, to, i, out _);
                if (own < ContactShape.NoImpact)
                {
                    any = true;
                    _share[i] *= SafePart * own;
                }
                double shared = i + 1 < to.Length ? _swept.ElementImpact(from, to, i, out _) : ContactShape.NoImpact;
                if (shared < ContactShape.NoImpact)
                {
                    any = true;
                    _share[i] *= SafePart * shared;
                    _share[i + 1] *= SafePart * shared;
                }
            }
            return any;
        }

        private void Apply(Vector3d[] from, Vector3d[] to)
        {
            for (int i = 0; i < to.Length; i++)
            {
                to[i] = Vector3d.Lerp(from[i], _whole[i], _share[i]);
            }
        }
    }
}

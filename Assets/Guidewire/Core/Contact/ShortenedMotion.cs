using System;

namespace Guidewire.Core
{
    /// <summary>Shortens a displacement of the wire until it passes no wall, as a last resort: that of the spheres that
    /// would pass, and of their elements, if necessary to zero.</summary>
    /// <remarks>First each is shortened to nine tenths of what is free. That turns elements, which may then pass
    /// elsewhere; so after <see cref="CutRounds"/> rounds the spheres of those that still would do not move. Each round
    /// leaves at least one more, and an element between two of them does not move. Only what a round changed is tested
    /// again, so all of them together cost no more than a few swept searches of the whole wire. A displacement that is
    /// not finite is left as it is: no part of it is free, and its wire is lost, which the end of the step says.
    /// </remarks>
    internal sealed class ShortenedMotion
    {
        private const int CutRounds = 2;
        private const double SafePart = 0.9;
        private readonly SweptSearch _swept;
        private readonly double[] _fraction;
        private readonly Vector3d[] _whole;
        private readonly bool[] _changed;    // since it was last tested
        private readonly bool[] _isCut;

        /// <param name="swept">Tells what would pass a wall.</param>
        /// <param name="sphereCount">n + 1.</param>
        public ShortenedMotion(SweptSearch swept, int sphereCount)
        {
            _swept = swept;
            _fraction = new double[sphereCount];
            _whole = new Vector3d[sphereCount];
            _changed = new bool[sphereCount];
            _isCut = new bool[sphereCount];
        }

        /// <summary>Shortens one sphere's displacement, in place, as far as the sphere itself requires.</summary>
        /// <param name="from">Where the n + 1 spheres are, clear of the walls; units.</param>
        /// <param name="to">Where they would go.</param>
        /// <param name="i">The sphere.</param>
        public void ShortenSphere(Vector3d[] from, Vector3d[] to, int i)
        {
            double free = _swept.SphereImpact(from, to, i, out _);
            if (free < ContactShape.NoImpact)
            {
                to[i] = Vector3d.Lerp(from[i], to[i], SafePart * free);
            }
        }

        /// <summary>Shortens the motion of all spheres, in place.</summary>
        /// <param name="from">Where the n + 1 spheres are, clear of the walls; units.</param>
        /// <param name="to">Where they would go.</param>
        public void Shorten(Vector3d[] from, Vector3d[] to)
        {
            Array.Copy(to, _whole, to.Length);
            Array.Fill(_fraction, 1.0);
            Array.Fill(_changed, true);
            for (int round = 0; Cut(from, to, round < CutRounds ? SafePart : 0.0); round++)
            {
                for (int i = 0; i < to.Length; i++)
                {
                    _changed[i] = _isCut[i];
                    to[i] = _isCut[i] ? Vector3d.Lerp(from[i], _whole[i], _fraction[i]) : to[i];
                }
            }
        }

        private bool Cut(Vector3d[] from, Vector3d[] to, double part)
        {
            bool any = false;
            Array.Clear(_isCut, 0, _isCut.Length);
            for (int i = 0; i < to.Length; i++)
            {
                if (_changed[i] && to[i].IsFinite)
                {
                    any |= CutBack(_swept.SphereImpact(from, to, i, out _), part, i, i);
                }
                if (i + 1 < to.Length && (_changed[i] || _changed[i + 1]) && to[i].IsFinite && to[i + 1].IsFinite)
                {
                    any |= CutBack(_swept.ElementImpact(from, to, i, out _), part, i, i + 1);
                }
            }
            return any;
        }

        private bool CutBack(double free, double part, int first, int last)
        {
            if (free >= ContactShape.NoImpact)
            {
                return false;
            }
            for (int i = first; i <= last; i++)
            {
                _fraction[i] *= part * free;
                _isCut[i] = true;
            }
            return true;
        }
    }
}

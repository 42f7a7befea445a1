using System;

namespace Guidewire.Core
{
    /// <summary>The distance d of two segments, a0 + s u and b0 + t v, with its first and second derivatives by their
    /// four ends.</summary>
    /// <remarks>With D between the closest points, n = D/d and w = (1 - s, s, t - 1, -t) by end, the gradient is n w.
    /// The second derivative is P (x) w w^T/d, with P = 1 - n n^T, less G H^-1 G^T for those of s and t that are free:
    /// g_s = (u/d) (x) w + n (x) w_s with w_s = (-1, 1, 0, 0), g_t = -(v/d) (x) w + n (x) w_t with w_t = (0, 0, 1, -1),
    /// H = [u.u, -u.v; -u.v, v.v]/d. At an end of a segment its parameter stays where it is.</remarks>
    internal readonly struct CapsulePair
    {
        private const double Parallel = 1e-10;    // sine squared of the angle, below which one parameter is free
        private const double Approach = 0.9;      // of what may be advanced at once
        private const double Remaining = 0.05;    // of the way to the least distance, at which an advance ends
        private const int MaxAdvances = 200;

        private readonly Vector3d _u;
        private readonly Vector3d _v;
        private readonly bool _isFreeA;
        private readonly bool _isFreeB;

        /// <summary>Of the segments a0 a1 and b0 b1.</summary>
        public CapsulePair(in Vector3d a0, in Vector3d a1, in Vector3d b0, in Vector3d b1)
        {
            _u = a1 - a0;
            _v = b1 - b0;
            Distance = Math.Sqrt(ClosestPoints.SegmentSegment(a0, a1, b0, b1, out double s, out double t));
            (S, T) = (s, t);
            Normal = (1.0 / Distance) * (a0 + s * _u - b0 - t * _v);
            _isFreeA = s > 0.0 && s < 1.0;
            _isFreeB = t > 0.0 && t < 1.0;
            double sine = Vector3d.Cross(_u, _v).LengthSquared;
            _isFreeB &= !_isFreeA || sine > Parallel * _u.LengthSquared * _v.LengthSquared;
        }

        /// <summary>d, in the segments' unit.</summary>
        public double Distance { get; }

        /// <summary>s, from 0 to 1.</summary>
        public double S { get; }

        /// <summary>t, from 0 to 1.</summary>
        public double T { get; }

        /// <summary>n, from the second segment to the first.</summary>
        public Vector3d Normal { get; }

        /// <summary>w of one of the ends a0, a1, b0, b1.</summary>
        public double Weight(int end) => end == 0 ? 1.0 - S : end == 1 ? S : end == 2 ? T - 1.0 : -T;

        /// <summary>Adds the second derivative of an energy of d, as columns.</summary>
        /// <param name="j">The first segment's element.</param>
        /// <param name="k">The second one's.</param>
        /// <param name="slope">The energy's first derivative, at most 0.</param>
        /// <param name="curvature">Its second one.</param>
        /// <param name="isHeld">Whether the end a0 does not move.</param>
        /// <param name="hasGeometric">Whether the part that is proportional to the slope counts.</param>
        public void AddColumns(LowRank columns, int j, int k, double slope, double curvature, bool isHeld,
            bool hasGeometric)
        {
            AddColumn(columns, j, k, Normal, default, default, curvature, isHeld);
            if (!hasGeometric || slope == 0.0)
            {
                return;
            }
            Vector3d across = Vector3d.Perpendicular(Normal);
            AddColumn(columns, j, k, across, default, default, slope / Distance, isHeld);
            AddColumn(columns, j, k, Vector3d.Cross(Normal, across), default, default, slope / Distance, isHeld);
            double perDistance = 1.0 / Distance;
            if (!_isFreeA && !_isFreeB)
            {
                return;
            }
            Vector3d first = _isFreeA ? perDistance * _u : -perDistance * _v;
            double own = perDistance * (_isFreeA ? _u.LengthSquared : _v.LengthSquared);
            AddColumn(columns, j, k, first, _isFreeA ? Normal : default, _isFreeA ? default : Normal, -slope / own,
                isHeld);
            if (_isFreeA && _isFreeB)
            {
                double ratio = Vector3d.Dot(_u, _v) / _u.LengthSquared;    // -H_st/H_ss
                double left = perDistance * Vector3d.Cross(_u, _v).LengthSquared / _u.LengthSquared;
                AddColumn(columns, j, k, perDistance * (ratio * _u - _v), ratio * Normal, Normal, -slope / left,
                    isHeld);
            }
        }

        // c u u^T with u = e (x) w + a (x) w_s + b (x) w_t.
        private void AddColumn(LowRank columns, int j, int k, in Vector3d e, in Vector3d a, in Vector3d b, double c,
            bool isHeld)
        {
            RodVector first = isHeld ? default : new RodVector(Weight(0) * e - a, default);
            columns.Add(j, k, first, new RodVector(Weight(1) * e + a, default),
                new RodVector(Weight(2) * e + b, default), new RodVector(Weight(3) * e - b, default), c);
        }

        /// <summary>The fraction of straight motions of the four ends on which the distance stays above a least one, by
        /// conservative advancement: a part of the motion changes the distance by no more than the ends move.</summary>
        /// <param name="x">Where they are.</param>
        /// <param name="to">Where they go.</param>
        /// <param name="j">The first segment's element.</param>
        /// <param name="k">The second one's.</param>
        /// <param name="distance">At the start, above the least one.</param>
        /// <param name="least">The least one.</param>
        /// <param name="most">A fraction beyond which is not asked.</param>
        public static double MaxMotion(Vector3d[] x, Vector3d[] to, int j, int k, double distance, double least,
            double most)
        {
            Vector3d a0 = to[j] - x[j];
            Vector3d a1 = to[j + 1] - x[j + 1];
            Vector3d b0 = to[k] - x[k];
            Vector3d b1 = to[k + 1] - x[k + 1];
            Vector3d mean = 0.25 * (a0 + a1 + b0 + b1);
            double speed = Math.Sqrt(Math.Max((a0 - mean).LengthSquared, (a1 - mean).LengthSquared))
                + Math.Sqrt(Math.Max((b0 - mean).LengthSquared, (b1 - mean).LengthSquared));
            double end = Remaining * (distance - least);
            double time = 0.0;
            for (int advance = 0; advance < MaxAdvances; advance++)
            {
                double left = distance - least;
                if (left >= speed * (most - time))
                {
                    return most;
                }
                if (!(left > end))
                {
                    break;
                }
                time += Approach * left / speed;
                distance = Math.Sqrt(ClosestPoints.SegmentSegment(x[j] + time * a0, x[j + 1] + time * a1,
                    x[k] + time * b0, x[k + 1] + time * b1, out _, out _));
            }
            return time;
        }
    }
}

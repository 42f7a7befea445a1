using System;

namespace Guidewire.Core
{
    /// <summary>The distance d of two segments, a0 + s u and b0 + t v, rounded where they are parallel, with its first
    /// and second derivatives by their four ends.</summary>
    /// <remarks>With D between two points, d^2 is the least of |D|^2 + p^2 ((s - 1/2)^2 + (t - 1/2)^2). Without p the
    /// closest points of two parallel elements would jump from one end to the other. The force would jump with them,
    /// and
    /// strands pressed flat together had no balance. p is a tenth of the sum of both radii; d exceeds the
    /// distance of the segments by at most p^2/(4 d), at the ends of both, which the radii take into account.
    ///
    /// With w = (1 - s, s, t - 1, -t) by end, the gradient is (D/d) w. The second derivative is (1 - D D^T/d^2) (x) w
    /// w^T/d, less G H^-1 G^T for those of s and t that are free: g_s = (u (x) w + D (x) w_s)/d with
    /// w_s = (-1, 1, 0, 0), g_t = (-v (x) w + D (x) w_t)/d with w_t = (0, 0, 1, -1),
    /// H = [u.u + p^2, -u.v; -u.v, v.v + p^2]/d. At an end of a segment its parameter stays where it is.</remarks>
    internal readonly struct CapsulePair
    {
        private const double Rounding = 0.1;      // p, of the sum of the radii
        private const double Approach = 0.9;      // of what may be advanced at once
        private const double Remaining = 0.05;    // of the way to the least distance, or of the range, at the end
        private const int MaxAdvances = 200;

        private readonly Vector3d _u;
        private readonly Vector3d _v;
        private readonly Vector3d _between;       // D
        private readonly double _uu;              // with p^2
        private readonly double _vv;
        private readonly bool _isFreeA;
        private readonly bool _isFreeB;

        /// <summary>Of the segments a0 a1 and b0 b1.</summary>
        /// <param name="radii">The sum of their radii.</param>
        public CapsulePair(in Vector3d a0, in Vector3d a1, in Vector3d b0, in Vector3d b1, double radii)
        {
            _u = a1 - a0;
            _v = b1 - b0;
            Vector3d start = a0 - b0;
            double rounding = Rounding * Rounding * radii * radii;
            _uu = _u.LengthSquared + rounding;
            _vv = _v.LengthSquared + rounding;
            double uv = Vector3d.Dot(_u, _v);
            double alongA = 0.5 * rounding - Vector3d.Dot(_u, start);
            double alongB = 0.5 * rounding + Vector3d.Dot(_v, start);
            double s = Clamp((alongA * _vv + alongB * uv) / (_uu * _vv - uv * uv));
            double t = (alongB + s * uv) / _vv;
            if (!(t > 0.0 && t < 1.0))
            {
                t = Clamp(t);
                s = Clamp((alongA + t * uv) / _uu);
            }
            (S, T) = (s, t);
            _isFreeA = s > 0.0 && s < 1.0;
            _isFreeB = t > 0.0 && t < 1.0;
            _between = start + s * _u - t * _v;
            Distance = Math.Sqrt(_between.LengthSquared
                + rounding * ((s - 0.5) * (s - 0.5) + (t - 0.5) * (t - 0.5)));
        }

        /// <summary>d, in the segments' unit.</summary>
        public double Distance { get; }

        /// <summary>s, from 0 to 1.</summary>
        public double S { get; }

        /// <summary>t, from 0 to 1.</summary>
        public double T { get; }

        /// <summary>The unit normal, from the second segment to the first.</summary>
        public Vector3d Normal => Vector3d.Normalize(_between);

        /// <summary>The derivative of d by a motion of the closest point on the first segment.</summary>
        public Vector3d Slope => (1.0 / Distance) * _between;

        /// <summary>d at which two capsules touch where d exceeds their distance most, at least where they
        /// touch.</summary>
        public static double Contact(double radii) => radii * Math.Sqrt(1.0 + 0.5 * Rounding * Rounding);

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
            Vector3d normal = Normal;
            double along = _between.LengthSquared / (Distance * Distance);
            double perDistance = 1.0 / Distance;
            slope = hasGeometric ? slope : 0.0;
            AddColumn(columns, j, k, normal, default, default,
                along * curvature + (1.0 - along) * perDistance * slope, isHeld);
            if (slope == 0.0)
            {
                return;
            }
            Vector3d across = Vector3d.Perpendicular(normal);
            AddColumn(columns, j, k, across, default, default, perDistance * slope, isHeld);
            AddColumn(columns, j, k, Vector3d.Cross(normal, across), default, default, perDistance * slope, isHeld);
            if (!_isFreeA && !_isFreeB)
            {
                return;
            }
            // H^-1 = h h^T/H_ss + k k^T/(H_tt - H_st^2/H_ss), h = (1, 0), k = (-H_st/H_ss, 1).
            double own = perDistance * (_isFreeA ? _uu : _vv);
            Vector3d slide = Slope;
            AddColumn(columns, j, k, _isFreeA ? perDistance * _u : -perDistance * _v, _isFreeA ? slide : default,
                _isFreeA ? default : slide, -slope / own, isHeld);
            if (_isFreeA && _isFreeB)
            {
                double uv = Vector3d.Dot(_u, _v);
                double left = perDistance * (_vv - uv * uv / _uu);
                AddColumn(columns, j, k, perDistance * (uv / _uu * _u - _v), uv / _uu * slide, slide, -slope / left,
                    isHeld);
            }
        }

        // c u u^T with u = e (x) w + a (x) w_s + b (x) w_t.
        private void AddColumn(LowRank columns, int j, int k, in Vector3d e, in Vector3d a, in Vector3d b, double c,
            bool isHeld)
        {
            if (c != 0.0)
            {
                RodVector first = isHeld ? default : new RodVector(Weight(0) * e - a, default);
                columns.Add(j, k, first, new RodVector(Weight(1) * e + a, default),
                    new RodVector(Weight(2) * e + b, default), new RodVector(Weight(3) * e - b, default), c);
            }
        }

        private static double Clamp(double value) => value > 0.0 ? Math.Min(value, 1.0) : 0.0;

        /// <summary>The fraction of straight motions of the four ends on which d stays above a least one, by
        /// conservative advancement: a part of the motion changes d by no more than the ends move.</summary>
        /// <param name="x">Where they are.</param>
        /// <param name="to">Where they go.</param>
        /// <param name="j">The first segment's element.</param>
        /// <param name="k">The second one's.</param>
        /// <param name="radii">The sum of their radii.</param>
        /// <param name="distance">d at the start, above the least one.</param>
        /// <param name="least">The least one.</param>
        /// <param name="range">Farther than a twentieth of it from the least one the motion goes on.</param>
        /// <param name="most">A fraction beyond which is not asked.</param>
        public static double MaxMotion(Vector3d[] x, Vector3d[] to, int j, int k, double radii, double distance,
            double least, double range, double most)
        {
            Vector3d a0 = to[j] - x[j];
            Vector3d a1 = to[j + 1] - x[j + 1];
            Vector3d b0 = to[k] - x[k];
            Vector3d b1 = to[k + 1] - x[k + 1];
            Vector3d mean = 0.25 * (a0 + a1 + b0 + b1);
            double speed = Math.Sqrt(Math.Max((a0 - mean).LengthSquared, (a1 - mean).LengthSquared))
                + Math.Sqrt(Math.Max((b0 - mean).LengthSquared, (b1 - mean).LengthSquared));
            double end = Remaining * Math.Min(distance - least, range);
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
                distance = new CapsulePair(x[j] + time * a0, x[j + 1] + time * a1, x[k] + time * b0,
                    x[k + 1] + time * b1, radii).Distance;
            }
            return time;
        }
    }
}

using System;

namespace Guidewire.Core
{
    /// <summary>The creases of a tube: at a knot where it bends, or where its wall turns towards the axis and away
    /// again, two pieces' walls meet in an edge that lies in the plane of the knot that halves the bend.</summary>
    /// <remarks>A segment meets the crease at x(s) in that plane, p . (x - c) = 0. Along the segment's motion dx there,
    /// ds = -(p . dx)/(p . u) with u = b - a, so of the tube's distance d with normal n the crossing's has the
    /// derivative n - (n . u)/(p . u) p, which is normal to u. The weight is the angle of the crease, faded over a
    /// tenth of the segment at both ends.</remarks>
    internal sealed class TubeRidges
    {
        private const double Fade = 0.1;          // of the segment
        private const double LeastAngle = 1e-6;   // radians
        private readonly TubeShape _tube;
        private readonly Vector3d[] _across;      // p by knot, unit vector
        private readonly double[] _angle;         // by knot, 0 where there is no crease

        /// <summary>For this tube.</summary>
        public TubeRidges(TubeShape tube)
        {
            Vector3d[] knots = tube.Knots;
            _tube = tube;
            _across = new Vector3d[knots.Length];
            _angle = new double[knots.Length];
            for (int k = 1; k + 1 < knots.Length; k++)
            {
                Vector3d before = knots[k] - knots[k - 1];
                Vector3d after = knots[k + 1] - knots[k];
                double turn = Math.Atan2(Vector3d.Cross(before, after).Length, Vector3d.Dot(before, after));
                double widening = Slope(tube.Radii[k + 1] - tube.Radii[k], after)
                    - Slope(tube.Radii[k] - tube.Radii[k - 1], before);
                double angle = Math.Max(0.0, turn + widening);
                _across[k] = Vector3d.Normalize(Vector3d.Normalize(before) + Vector3d.Normalize(after));
                _angle[k] = angle > LeastAngle ? angle : 0.0;
            }
        }

        /// <summary>Distance of segment a b from the wall where it crosses creases; infinite where it crosses
        /// none.</summary>
        public double Nearest(in Vector3d a, in Vector3d b)
        {
            double nearest = double.PositiveInfinity;
            double size = Vector3d.Distance(a, b);
            for (int k = 1; k + 1 < _angle.Length; k++)
            {
                if (Crosses(k, a, b, size, out double s, out _))
                {
                    double d = Distance(k, Vector3d.Lerp(a, b, s), out _);
                    nearest = d > -_tube.Radii[k] ? Math.Min(nearest, d) : nearest;
                }
            }
            return nearest;
        }

        // Whether segment a b, of this size, crosses the plane of crease k near it, and where.
        private bool Crosses(int k, in Vector3d a, in Vector3d b, double size, out double s, out double along)
        {
            // A crossing is no farther from the knot than the wall's radius there, nor from a than b is.
            double reach = _tube.Radii[k] + size;
            s = 0.0;
            along = 0.0;
            if (_angle[k] == 0.0 || (a - _tube.Knots[k]).LengthSquared > reach * reach)
            {
                return false;
            }
            double atA = Vector3d.Dot(_across[k], a - _tube.Knots[k]);
            double atB = Vector3d.Dot(_across[k], b - _tube.Knots[k]);
            if (atA * atB >= 0.0)
            {
                return false;
            }
            along = atB - atA;
            s = -atA / along;
            return true;
        }

        /// <summary>Adds the creases that segment a b crosses within <paramref name="range"/> of the wall.</summary>
        public void Find(in Vector3d a, in Vector3d b, double range, StructList<WallRidge> ridges)
        {
            double size = Vector3d.Distance(a, b);
            for (int k = 1; k + 1 < _angle.Length; k++)
            {
                if (!Crosses(k, a, b, size, out double s, out double along))
                {
                    continue;
                }
                Vector3d p = _across[k];
                Vector3d x = Vector3d.Lerp(a, b, s);
                double d = Distance(k, x, out Vector3d centre);
                if (d > range || d < -_tube.Radii[k])
                {
                    continue;
                }
                Vector3d n = Vector3d.Normalize(centre - x);
                Vector3d normal = n - (Vector3d.Dot(n, b - a) / along) * p;
                double toEnd = Math.Min(s, 1.0 - s) / Fade;
                double weight = _angle[k];
                Vector3d slope = Vector3d.Zero;
                if (toEnd < 1.0)
                {
                    double sign = s < 0.5 ? 1.0 : -1.0;
                    slope = (-weight * sign * 6.0 * toEnd * (1.0 - toEnd) / (Fade * along)) * p;
                    weight *= toEnd * toEnd * (3.0 - 2.0 * toEnd);
                }
                ridges.Add(new WallRidge(s, d, normal, weight, (1.0 - s) * slope, s * slope));
            }
        }

        // The tube's distance at a point in the plane of knot k, as its two pieces have it.
        private double Distance(int k, in Vector3d x, out Vector3d centre)
        {
            double first = _tube.PieceDistance(k - 1, x, out centre, out _);
            double second = _tube.PieceDistance(k, x, out Vector3d other, out _);
            centre = second > first ? other : centre;
            return Math.Max(first, second);
        }

        private static double Slope(double change, in Vector3d piece)
        {
            return Math.Asin(Math.Min(1.0, Math.Max(-1.0, change / piece.Length)));
        }
    }
}

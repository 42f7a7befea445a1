using System;

namespace Guidewire.Core
{
    /// <summary>Continuous collision detection of a segment whose ends move in straight lines with a triangle, or with
    /// any other convex body.</summary>
    internal static class SegmentImpact
    {
        private const double RoundedUp = 1.0 + 1e-9;

        /// <summary>Lowers the fraction of the motion of segment a b during which it stays at least <paramref
        /// name="clearance"/> from a triangle, if the triangle requires it; returns the lower one, or <see
        /// cref="ContactShape.NoImpact"/>.</summary>
        /// <param name="motion">No end of the segment goes farther.</param>
        public static double WithTriangle(in Vector3d v0, in Vector3d v1, in Vector3d v2, in Vector3d a0,
            in Vector3d b0, in Vector3d a1, in Vector3d b1, double clearance, double resolution, double motion,
            ref double impact)
        {
            if (StaysOnOneSide(a0, b0, a1, b1, v0, v1, v2, clearance))
            {
                return ContactShape.NoImpact;
            }
            Vector3d middle = (1.0 / 3.0) * (v0 + v1 + v2);
            double ball = Math.Sqrt(Math.Max(
                (v0 - middle).LengthSquared, Math.Max((v1 - middle).LengthSquared, (v2 - middle).LengthSquared)));
            return WithBody(
                new TriangleBody(v0, v1, v2), middle, ball, a0, b0, a1, b1, clearance, resolution, motion, ref impact);
        }

        /// <summary>Gives the same for any convex body in a ball.</summary>
        public static double WithBody<TBody>(in TBody body, in Vector3d middle, double ball, in Vector3d a0,
            in Vector3d b0, in Vector3d a1, in Vector3d b1, double clearance, double resolution, double motion,
            ref double impact)
            where TBody : struct, IConvexBody
        {
            double limit = Math.Min(1.0, impact);
            double range = RoundedUp * (clearance + limit * motion);
            if (!PartWithin(a0, b0, range + ball, middle, out double from, out double to))
            {
                return ContactShape.NoImpact;
            }
            double time = SweptTest.Impact(
                body, Vector3d.Lerp(a0, b0, from), Vector3d.Lerp(a0, b0, to),
                Vector3d.Lerp(a1, b1, from), Vector3d.Lerp(a1, b1, to), clearance, resolution, limit);
            if (time < impact)
            {
                impact = time;
                return time;
            }
            return ContactShape.NoImpact;
        }

        /// <summary>Whether the moving segment stays on one side of a triangle's plane, by more than a distance,
        /// units.</summary>
        public static bool StaysOnOneSide(
            in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1,
            in Vector3d v0, in Vector3d v1, in Vector3d v2, double distance)
        {
            Vector3d n = Vector3d.Cross(v1 - v0, v2 - v0);
            double clearance = distance * n.Length;
            double w = Vector3d.Dot(n, a0 - v0);
            double x = Vector3d.Dot(n, b0 - v0);
            double y = Vector3d.Dot(n, a1 - v0);
            double z = Vector3d.Dot(n, b1 - v0);
            return (w > clearance && x > clearance && y > clearance && z > clearance)
                || (w < -clearance && x < -clearance && y < -clearance && z < -clearance);
        }

        // The part of the segment that may meet a body: what lies within the range of the centre of the ball around it.
        // Of a long segment that turns about its contact point, that part moves little.
        private static bool PartWithin(in Vector3d a, in Vector3d b, double range, in Vector3d middle, out double from,
            out double to)
        {
            from = 0.0;
            to = 1.0;
            Vector3d along = b - a;
            double lengthSquared = along.LengthSquared;
            double rangeSquared = range * range;
            if (!(lengthSquared > 0.0))
            {
                return (middle - a).LengthSquared <= rangeSquared;
            }
            double foot = Vector3d.Dot(middle - a, along) / lengthSquared;
            double left = rangeSquared - (middle - a - foot * along).LengthSquared;
            if (left < 0.0)
            {
                return false;
            }
            double half = Math.Sqrt(left / lengthSquared);
            from = Math.Max(0.0, foot - half);
            to = Math.Min(1.0, foot + half);
            return from <= to;
        }
    }
}

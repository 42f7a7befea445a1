using System;

namespace Guidewire.Core
{
    /// <summary>Time of impact of a segment whose ends move along straight lines against a convex body at rest, by
    /// conservative advancement in the direction of the closest points (Mirtich 1996).</summary>
    /// <remarks>At a moment with closest points p (segment) and c (body), n = (p - c)/|p - c|, the body lies behind the
    /// plane through c with normal n, because it is convex. The segment cannot meet it before one of its ends does meet
    /// that plane. So time may advance to that moment, whatever the motion along the plane: sliding along a wall costs
    /// one query.</remarks>
    internal static class SweptTest
    {
        private const int MaxAdvances = 20;

        /// <summary>Fraction of the motion during which the clearance is at least <paramref name="clearance"/>, <see
        /// cref="ContactShape.NoImpact"/> for all of it. It must be larger at the start. If the advances run out first,
        /// the time proven safe so far is returned. Approaches below <paramref name="resolution"/> are ignored, and so
        /// is what comes after <paramref name="limit"/>.</summary>
        public static double Impact<TBody>(
            in TBody body, in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double clearance,
            double resolution, double limit = 1.0)
            where TBody : struct, IConvexBody
        {
            Vector3d va = a1 - a0;
            Vector3d vb = b1 - b0;
            double time = 0.0;
            double proven = 0.0;    // the last time at which the distance was evaluated
            for (int k = 0; k < MaxAdvances; k++)
            {
                Vector3d a = a0 + time * va;
                Vector3d b = b0 + time * vb;
                double distance = body.Closest(a, b, out double s, out Vector3d c);
                if (!(distance > 0.0))
                {
                    return proven;
                }
                proven = time;
                Vector3d n = (Vector3d.Lerp(a, b, s) - c) / distance;
                double advance = Math.Min(
                    TimeToPlane(a - c, va, n, clearance, time), TimeToPlane(b - c, vb, n, clearance, time));
                if (advance >= limit - time)
                {
                    return ContactShape.NoImpact;
                }

                // Both ends may have the clearance and still be approaching: then the plane has turned only a little
                // and the remaining approach is below the resolution.
                if (advance * Math.Max(va.Length, vb.Length) <= resolution && distance <= 1.01 * clearance)
                {
                    return time;
                }
                time += Math.Max(advance, 0.0);
            }
            return time;
        }

        private static double TimeToPlane(
            in Vector3d offset, in Vector3d velocity, in Vector3d n, double clearance, double time)
        {
            double approach = -Vector3d.Dot(velocity, n);
            if (!(approach > 0.0))
            {
                return 1.0 - time;
            }
            return (Vector3d.Dot(offset, n) - clearance) / approach;
        }
    }
}

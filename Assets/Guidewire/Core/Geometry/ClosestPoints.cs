using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Exact closest points between points, segments and triangles (cases after Ericson, Real-Time Collision
    /// Detection, chapter 5). A segment's parameter runs from 0 at its first end to 1 at its second.</summary>
    /// <remarks>The answer is the smallest of candidates that cover all cases. A needle's normal has few digits left,
    /// so there every candidate is made as a point of the triangle, its distance measured to that point: what rounding
    /// can spoil is which candidate is tried, and where that is in doubt two of them agree.</remarks>
    internal static class ClosestPoints
    {
        /// <summary>Feature of a triangle on which a closest point lies: inside it.</summary>
        public const int Face = 0;

        /// <summary>Edge k, from corner k to corner k + 1 mod 3, is feature Edge + k.</summary>
        public const int Edge = 1;

        /// <summary>Corner k is feature Corner + k.</summary>
        public const int Corner = 4;

        // Squared ratio of a triangle's height to its length below which it is a needle.
        private const double Needle = 1e-8;

        // Relative width in which a triangle at the limit is still tested: above the rounding of a triangle that is no
        // needle, and without cost.
        private const double LimitBorder = 1e-9;

        /// <summary>Gives the parameter in [0, 1] of the point of segment a b nearest to p; 0 for a segment of no
        /// length.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static double PointSegment(in Vector3d p, in Vector3d a, in Vector3d b)
        {
            Vector3d u = b - a;
            double t = Vector3d.Dot(p - a, u);
            if (!(t > 0.0))
            {
                return 0.0;
            }
            double uu = u.LengthSquared;
            return t < uu ? t / uu : 1.0;
        }

        /// <summary>Closest points of segments a + s u and c + t v; the squared distance is returned.</summary>
        public static double SegmentSegment(
            in Vector3d a, in Vector3d b, in Vector3d c, in Vector3d d, out double s, out double t)
        {
            Vector3d u = b - a;
            Vector3d v = d - c;
            Vector3d w = c - a;

            // The free minimum by cross products: for an angle theta between the lines their determinant has the
            // relative error eps/theta; u.u v.v - (u.v)^2 would have eps/theta^2.
            Vector3d n = Vector3d.Cross(u, v);
            double nn = n.LengthSquared;
            double sn = Vector3d.Dot(Vector3d.Cross(w, v), n);
            double tn = Vector3d.Dot(Vector3d.Cross(w, u), n);
            if (nn > 0.0 && sn >= 0.0 && sn <= nn && tn >= 0.0 && tn <= nn)
            {
                s = sn / nn;
                t = tn / nn;
                return (w + t * v - s * u).LengthSquared;
            }

            // The square 0 <= s, t <= 1 has its minimum on a side that the free minimum lies beyond.
            double best = double.PositiveInfinity;
            s = 0.0;
            t = 0.0;
            bool all = !(nn > 0.0);
            if (all || sn < 0.0)
            {
                Side(a, 0.0, c, d, ref best, ref s, ref t);
            }
            if (all || sn > nn)
            {
                Side(b, 1.0, c, d, ref best, ref s, ref t);
            }
            if (all || tn < 0.0)
            {
                OtherSide(c, 0.0, a, b, ref best, ref s, ref t);
            }
            if (all || tn > nn)
            {
                OtherSide(d, 1.0, a, b, ref best, ref s, ref t);
            }
            return best;
        }

        /// <summary>Point of triangle v0 v1 v2 nearest to p, with the feature on which it lies; the squared distance
        /// is returned.</summary>
        public static double PointTriangle(
            in Vector3d p, in Vector3d v0, in Vector3d v1, in Vector3d v2, out Vector3d point, out int feature)
        {
            Vector3d n = Vector3d.Cross(v1 - v0, v2 - v0);
            double nn = n.LengthSquared;
            if (IsNeedle(nn, v1 - v0, v2 - v0))
            {
                return PointNeedle(p, v0, v1, v2, out point, out feature);
            }
            bool beyond0 = !(Vector3d.Dot(Vector3d.Cross(n, v1 - v0), p - v0) >= 0.0);
            bool beyond1 = !(Vector3d.Dot(Vector3d.Cross(n, v2 - v1), p - v1) >= 0.0);
            bool beyond2 = !(Vector3d.Dot(Vector3d.Cross(n, v0 - v2), p - v2) >= 0.0);
            if (!beyond0 && !beyond1 && !beyond2)
            {
                double height = Vector3d.Dot(n, p - v0);
                feature = Face;
                point = p - (height / nn) * n;
                return height * height / nn;
            }

            // Only an edge that p lies beyond can hold the closest point of a convex figure.
            double best = double.PositiveInfinity;
            point = v0;
            feature = Corner;
            if (beyond0)
            {
                PointEdge(p, v0, v1, 0, ref best, ref point, ref feature);
            }
            if (beyond1)
            {
                PointEdge(p, v1, v2, 1, ref best, ref point, ref feature);
            }
            if (beyond2)
            {
                PointEdge(p, v2, v0, 2, ref best, ref point, ref feature);
            }
            return best;
        }

        /// <summary>Closest points of segment a b (parameter s) and triangle v0 v1 v2; the squared distance is
        /// returned, 0 where they cross. Above <paramref name="limit"/> squared the answer may be any larger
        /// number.</summary>
        public static double SegmentTriangle(
            in Vector3d a, in Vector3d b, in Vector3d v0, in Vector3d v1, in Vector3d v2, double limit,
            out double s, out Vector3d point, out int feature)
        {
            Vector3d e0 = v1 - v0;
            Vector3d e2 = v0 - v2;
            Vector3d n = Vector3d.Cross(e2, e0);
            double nn = n.LengthSquared;
            double ha = Vector3d.Dot(n, a - v0);
            double hb = Vector3d.Dot(n, b - v0);
            s = 0.0;
            point = v0;
            feature = Corner;
            bool crosses = (ha <= 0.0 && hb >= 0.0) || (ha >= 0.0 && hb <= 0.0);
            if (IsNeedle(nn, e0, e2))
            {
                return SegmentNeedle(a, b, v0, v1, v2, crosses && ha != hb ? ha / (ha - hb) : 0.0,
                    out s, out point, out feature);
            }

            // What is left of the limit for the distance along the plane, times n.n; rounding must not decide.
            double nearer = crosses ? 0.0 : Math.Min(Math.Abs(ha), Math.Abs(hb));
            double left = limit * nn * (1.0 + LimitBorder) - nearer * nearer;
            if (left < 0.0)
            {
                return double.PositiveInfinity;
            }
            Vector3d e1 = v2 - v1;
            var heightsA = new EdgeHeights(a, n, v0, v1, v2, e0, e1, e2);
            var heightsB = new EdgeHeights(b, n, v0, v1, v2, e0, e1, e2);
            if (IsBeyond(heightsA.First, heightsB.First, left * e0.LengthSquared)
                || IsBeyond(heightsA.Second, heightsB.Second, left * e1.LengthSquared)
                || IsBeyond(heightsA.Third, heightsB.Third, left * e2.LengthSquared))
            {
                return double.PositiveInfinity;
            }
            double best = double.PositiveInfinity;
            if (crosses && ha != hb)
            {
                double cut = ha / (ha - hb);
                Vector3d x = Vector3d.Lerp(a, b, cut);
                if (new EdgeHeights(x, n, v0, v1, v2, e0, e1, e2).AreInside)
                {
                    s = cut;
                    point = x;
                    feature = Face;
                    return 0.0;
                }
            }
            if (heightsA.AreInside)
            {
                best = ha * ha / nn;
                point = a - (ha / nn) * n;
                feature = Face;
            }
            if (hb * hb < best * nn && heightsB.AreInside)
            {
                best = hb * hb / nn;
                s = 1.0;
                point = b - (hb / nn) * n;
                feature = Face;
            }

            // The nearest point lies on an edge only if the segment comes beyond it.
            if (!(heightsA.First > 0.0 && heightsB.First > 0.0))
            {
                SegmentEdge(a, b, v0, v1, 0, ref best, ref s, ref point, ref feature);
            }
            if (!(heightsA.Second > 0.0 && heightsB.Second > 0.0))
            {
                SegmentEdge(a, b, v1, v2, 1, ref best, ref s, ref point, ref feature);
            }
            if (!(heightsA.Third > 0.0 && heightsB.Third > 0.0))
            {
                SegmentEdge(a, b, v2, v0, 2, ref best, ref s, ref point, ref feature);
            }
            return best;
        }

        /// <summary>Feature of the point with parameter t on edge k: the edge, or the corner at its end.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static int FeatureOfEdge(int edge, double t)
        {
            if (t <= 0.0)
            {
                return Corner + edge;
            }
            if (t >= 1.0)
            {
                return edge == 2 ? Corner : Corner + edge + 1;
            }
            return Edge + edge;
        }

        // True where both heights over an edge, times |n| |e|, are so negative that the limit is exceeded.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static bool IsBeyond(double heightA, double heightB, double limit)
        {
            double nearer = Math.Max(heightA, heightB);
            return nearer < 0.0 && nearer * nearer > limit;
        }

        /// <summary>Whether a triangle is so thin that its normal has few digits.</summary>
        /// <param name="areaSquared">Of the parallelogram of two of its edges.</param>
        /// <param name="edge">One of these edges.</param>
        /// <param name="other">The other.</param>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static bool IsNeedle(double areaSquared, in Vector3d edge, in Vector3d other)
        {
            double size = edge.LengthSquared + other.LengthSquared;
            return !(areaSquared > Needle * size * size);
        }

        private static double PointNeedle(
            in Vector3d p, in Vector3d v0, in Vector3d v1, in Vector3d v2, out Vector3d point, out int feature)
        {
            double best = double.PositiveInfinity;
            point = v0;
            feature = Corner;
            PointEdge(p, v0, v1, 0, ref best, ref point, ref feature);
            PointEdge(p, v1, v2, 1, ref best, ref point, ref feature);
            PointEdge(p, v2, v0, 2, ref best, ref point, ref feature);

            // Gram and Schmidt, modified: what lies along the first edge is taken out of p before its small part across
            // is requested, whose direction has few digits.
            Vector3d u = v1 - v0;
            double skew = Vector3d.Dot(v2 - v0, u) / u.LengthSquared;
            Vector3d across = v2 - v0 - skew * u;
            double along = Vector3d.Dot(p - v0, u) / u.LengthSquared;
            double weight2 = Vector3d.Dot(p - v0 - along * u, across) / across.LengthSquared;
            double weight1 = along - skew * weight2;
            if (weight1 >= 0.0 && weight2 >= 0.0 && weight1 + weight2 <= 1.0)
            {
                Vector3d x = v0 + weight1 * (v1 - v0) + weight2 * (v2 - v0);
                double squared = (p - x).LengthSquared;
                if (squared < best)
                {
                    best = squared;
                    point = x;
                    feature = Face;
                }
            }
            return best;
        }

        private static double SegmentNeedle(
            in Vector3d a, in Vector3d b, in Vector3d v0, in Vector3d v1, in Vector3d v2, double cut,
            out double s, out Vector3d point, out int feature)
        {
            double best = double.PositiveInfinity;
            s = 0.0;
            point = v0;
            feature = Corner;
            NeedleCandidate(a, 0.0, v0, v1, v2, ref best, ref s, ref point, ref feature);
            NeedleCandidate(b, 1.0, v0, v1, v2, ref best, ref s, ref point, ref feature);
            NeedleCandidate(Vector3d.Lerp(a, b, cut), cut, v0, v1, v2, ref best, ref s, ref point, ref feature);
            SegmentEdge(a, b, v0, v1, 0, ref best, ref s, ref point, ref feature);
            SegmentEdge(a, b, v1, v2, 1, ref best, ref s, ref point, ref feature);
            SegmentEdge(a, b, v2, v0, 2, ref best, ref s, ref point, ref feature);
            return best;
        }

        private static void NeedleCandidate(
            in Vector3d p, double sFixed, in Vector3d v0, in Vector3d v1, in Vector3d v2,
            ref double best, ref double s, ref Vector3d point, ref int feature)
        {
            double squared = PointNeedle(p, v0, v1, v2, out Vector3d x, out int at);
            if (squared < best)
            {
                best = squared;
                s = sFixed;
                point = x;
                feature = at;
            }
        }

        private static void PointEdge(
            in Vector3d p, in Vector3d from, in Vector3d to, int edge,
            ref double best, ref Vector3d point, ref int feature)
        {
            double t = PointSegment(p, from, to);
            Vector3d x = Vector3d.Lerp(from, to, t);
            double squared = (p - x).LengthSquared;
            if (squared < best)
            {
                best = squared;
                point = x;
                feature = FeatureOfEdge(edge, t);
            }
        }

        private static void SegmentEdge(
            in Vector3d a, in Vector3d b, in Vector3d from, in Vector3d to, int edge,
            ref double best, ref double s, ref Vector3d point, ref int feature)
        {
            double squared = SegmentSegment(a, b, from, to, out double sEdge, out double tEdge);
            if (squared < best)
            {
                best = squared;
                s = sEdge;
                point = Vector3d.Lerp(from, to, tEdge);
                feature = FeatureOfEdge(edge, tEdge);
            }
        }

        private static void Side(
            in Vector3d p, double sFixed, in Vector3d c, in Vector3d d, ref double best, ref double s, ref double t)
        {
            double tSide = PointSegment(p, c, d);
            double squared = (Vector3d.Lerp(c, d, tSide) - p).LengthSquared;
            if (squared < best)
            {
                best = squared;
                s = sFixed;
                t = tSide;
            }
        }

        private static void OtherSide(
            in Vector3d p, double tFixed, in Vector3d a, in Vector3d b, ref double best, ref double s, ref double t)
        {
            double sSide = PointSegment(p, a, b);
            double squared = (Vector3d.Lerp(a, b, sSide) - p).LengthSquared;
            if (squared < best)
            {
                best = squared;
                s = sSide;
                t = tFixed;
            }
        }
    }

    /// <summary>Heights of a point over the three edges of a triangle, in its plane and positive inside, each times
    /// |n| and the edge's length: (n x e).(p - v).</summary>
    internal readonly struct EdgeHeights
    {
        public readonly double First;
        public readonly double Second;
        public readonly double Third;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public EdgeHeights(
            in Vector3d p, in Vector3d n, in Vector3d v0, in Vector3d v1, in Vector3d v2,
            in Vector3d e0, in Vector3d e1, in Vector3d e2)
        {
            First = Vector3d.Dot(Vector3d.Cross(n, e0), p - v0);
            Second = Vector3d.Dot(Vector3d.Cross(n, e1), p - v1);
            Third = Vector3d.Dot(Vector3d.Cross(n, e2), p - v2);
        }

        /// <summary>True for a point above the triangle.</summary>
        public bool AreInside => First >= 0.0 && Second >= 0.0 && Third >= 0.0;
    }
}

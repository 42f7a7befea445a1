#if NET8_0_OR_GREATER
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;

namespace Guidewire.Core
{
    /// <summary><see cref="SweptSegment.MayMeet"/> for eight children of a node at once, and by the segment where it
    /// starts <see cref="SegmentSearch.MayHold"/>, with distances that make up for rounding.</summary>
    internal readonly struct SweptBoundsTest : IBoundsTest
    {
        private readonly SegmentBoundsTest _start;
        private readonly Point _a0;
        private readonly Point _b0;
        private readonly Point _a1;
        private readonly Point _b1;
        private readonly Point _centre;
        private readonly Point _extent;
        private readonly float _border;

        /// <summary>Tests for what a moving segment may come near to.</summary>
        public SweptBoundsTest(in SweptSegment swept, WideBvh tree)
        {
            _start = new SegmentBoundsTest(swept.A0, swept.B0, swept.Range, tree);
            _a0 = new Point(swept.A0 - tree.Origin);
            _b0 = new Point(swept.B0 - tree.Origin);
            _a1 = new Point(swept.A1 - tree.Origin);
            _b1 = new Point(swept.B1 - tree.Origin);
            Vector3d centre = swept.Centre - tree.Origin;
            double slack = tree.Slack(WideBvh.LengthBound(centre) + WideBvh.LengthBound(swept.Extent));
            _centre = new Point(centre);
            _extent = new Point(swept.Extent + new Vector3d(slack, slack, slack));
            _border = (float)(swept.Border + slack);
        }

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public uint MayHold(ref float bounds)
        {
            Vector256<float> overlaps =
                Overlaps(ref bounds, 0, _centre.X, _extent.X) & Overlaps(ref bounds, 1, _centre.Y, _extent.Y)
                & Overlaps(ref bounds, 2, _centre.Z, _extent.Z);
            uint hits = (uint)Avx.MoveMask(overlaps);
            return hits == 0 ? 0 : hits & _start.MayHold(ref bounds) & ~IsInRange(ref bounds);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private uint IsInRange(ref float bounds)
        {
            Vector256<float> w = Height(ref bounds, _a0);
            Vector256<float> x = Height(ref bounds, _b0);
            Vector256<float> y = Height(ref bounds, _a1);
            Vector256<float> z = Height(ref bounds, _b1);
            Vector256<float> border = Vector256.Create(_border);
            Vector256<float> least = Avx.Min(Avx.Min(w, x), Avx.Min(y, z));
            Vector256<float> most = Avx.Max(Avx.Max(w, x), Avx.Max(y, z));
            return (uint)Avx.MoveMask(Vector256.GreaterThan(least, SegmentBoundsTest.Bounds(ref bounds, 10) + border)
                | Vector256.LessThan(most, SegmentBoundsTest.Bounds(ref bounds, 9) - border));
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector256<float> Overlaps(ref float bounds, int axis, float centre, float extent)
        {
            return Vector256.LessThanOrEqual(
                Vector256.Abs(Vector256.Create(centre) - SegmentBoundsTest.Bounds(ref bounds, axis)),
                Vector256.Create(extent) + SegmentBoundsTest.Bounds(ref bounds, axis + 3));
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector256<float> Height(ref float bounds, in Point x)
        {
            return SegmentBoundsTest.Bounds(ref bounds, 6) * Vector256.Create(x.X)
                + SegmentBoundsTest.Bounds(ref bounds, 7) * Vector256.Create(x.Y)
                + SegmentBoundsTest.Bounds(ref bounds, 8) * Vector256.Create(x.Z);
        }

        private readonly struct Point
        {
            public readonly float X;
            public readonly float Y;
            public readonly float Z;

            public Point(in Vector3d x)
            {
                X = (float)x.X;
                Y = (float)x.Y;
                Z = (float)x.Z;
            }
        }
    }
}
#endif

#if NET8_0_OR_GREATER
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace Guidewire.Core
{
    /// <summary><see cref="SweptSegment.MayMeet"/> for four children of a node at once, and by the segment where it
    /// starts <see cref="SegmentSearch.MayHold"/>.</summary>
    internal readonly struct SweptBoundsTest : IBoundsTest
    {
        private readonly SweptSegment _swept;
        private readonly SegmentBoundsTest _start;

        /// <summary>For what a moving segment may come near to.</summary>
        public SweptBoundsTest(in SweptSegment swept, in SegmentSearch search)
        {
            _swept = swept;
            _start = new SegmentBoundsTest(search);
        }

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public uint MayHold(ref double bounds)
        {
            Vector3d centre = _swept.Centre;
            Vector3d extent = _swept.Extent;
            Vector256<double> overlaps =
                Overlaps(ref bounds, 0, centre.X, extent.X) & Overlaps(ref bounds, 1, centre.Y, extent.Y)
                & Overlaps(ref bounds, 2, centre.Z, extent.Z);
            uint hits = overlaps.ExtractMostSignificantBits();
            return hits == 0 ? 0 : hits & _start.MayHold(ref bounds) & ~IsBeside(ref bounds);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private uint IsBeside(ref double bounds)
        {
            Vector256<double> w = Height(ref bounds, _swept.A0);
            Vector256<double> x = Height(ref bounds, _swept.B0);
            Vector256<double> y = Height(ref bounds, _swept.A1);
            Vector256<double> z = Height(ref bounds, _swept.B1);
            Vector256<double> border = Vector256.Create(_swept.Border);
            Vector256<double> least = Vector256.MinNative(Vector256.MinNative(w, x), Vector256.MinNative(y, z));
            Vector256<double> most = Vector256.MaxNative(Vector256.MaxNative(w, x), Vector256.MaxNative(y, z));
            return (Vector256.GreaterThan(least, SegmentBoundsTest.Bounds(ref bounds, 10) + border)
                | Vector256.LessThan(most, SegmentBoundsTest.Bounds(ref bounds, 9) - border))
                .ExtractMostSignificantBits();
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector256<double> Overlaps(ref double bounds, int axis, double centre, double extent)
        {
            return Vector256.LessThanOrEqual(
                Vector256.Abs(Vector256.Create(centre) - SegmentBoundsTest.Bounds(ref bounds, axis)),
                Vector256.Create(extent) + SegmentBoundsTest.Bounds(ref bounds, axis + 3));
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector256<double> Height(ref double bounds, in Vector3d x)
        {
            return SegmentBoundsTest.Bounds(ref bounds, 6) * Vector256.Create(x.X)
                + SegmentBoundsTest.Bounds(ref bounds, 7) * Vector256.Create(x.Y)
                + SegmentBoundsTest.Bounds(ref bounds, 8) * Vector256.Create(x.Z);
        }
    }
}
#endif

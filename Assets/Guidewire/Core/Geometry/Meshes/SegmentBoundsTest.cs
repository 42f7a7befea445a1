#if NET8_0_OR_GREATER
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace Guidewire.Core
{
    /// <summary><see cref="SegmentSearch.MayHold"/> for four children of a node at once.</summary>
    internal readonly struct SegmentBoundsTest : IBoundsTest
    {
        private readonly Vector256<double> _middleX;
        private readonly Vector256<double> _middleY;
        private readonly Vector256<double> _middleZ;
        private readonly Vector256<double> _halfX;
        private readonly Vector256<double> _halfY;
        private readonly Vector256<double> _halfZ;
        private readonly Vector256<double> _alongX;
        private readonly Vector256<double> _alongY;
        private readonly Vector256<double> _alongZ;
        private readonly Vector256<double> _squared;

        /// <summary>For what is within the search's range of its segment.</summary>
        public SegmentBoundsTest(in SegmentSearch search)
        {
            Vector3d along = search.B - search.A;
            Vector3d middle = 0.5 * (search.A + search.B);
            _middleX = Vector256.Create(middle.X);
            _middleY = Vector256.Create(middle.Y);
            _middleZ = Vector256.Create(middle.Z);
            _alongX = Vector256.Create(along.X);
            _alongY = Vector256.Create(along.Y);
            _alongZ = Vector256.Create(along.Z);
            Vector256<double> half = Vector256.Create(0.5);
            _halfX = half * Vector256.Abs(_alongX);
            _halfY = half * Vector256.Abs(_alongY);
            _halfZ = half * Vector256.Abs(_alongZ);
            _squared = Vector256.Create(search.Squared);
        }

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public uint MayHold(ref double bounds)
        {
            Vector256<double> zero = Vector256<double>.Zero;
            Vector256<double> gapX = Vector256.MaxNative(zero, Vector256.Abs(_middleX - Bounds(ref bounds, 0))
                - (Bounds(ref bounds, 3) + _halfX));
            Vector256<double> gapY = Vector256.MaxNative(zero, Vector256.Abs(_middleY - Bounds(ref bounds, 1))
                - (Bounds(ref bounds, 4) + _halfY));
            Vector256<double> gapZ = Vector256.MaxNative(zero, Vector256.Abs(_middleZ - Bounds(ref bounds, 2))
                - (Bounds(ref bounds, 5) + _halfZ));
            Vector256<double> normalX = Bounds(ref bounds, 6);
            Vector256<double> normalY = Bounds(ref bounds, 7);
            Vector256<double> normalZ = Bounds(ref bounds, 8);
            Vector256<double> middle = normalX * _middleX + normalY * _middleY + normalZ * _middleZ;
            Vector256<double> half = Vector256.Create(0.5)
                * Vector256.Abs(normalX * _alongX + normalY * _alongY + normalZ * _alongZ);
            Vector256<double> slab = Vector256.MaxNative(zero, Vector256.MaxNative(
                middle - Bounds(ref bounds, 10), Bounds(ref bounds, 9) - middle) - half);
            Vector256<double> least = Vector256.MaxNative(gapX * gapX + gapY * gapY + gapZ * gapZ, slab * slab);
            return Vector256.LessThan(least, _squared).ExtractMostSignificantBits();
        }

        /// <summary>A field of four children.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector256<double> Bounds(ref double bounds, int field)
        {
            return Vector256.LoadUnsafe(ref Unsafe.Add(ref bounds, 4 * field));
        }
    }
}
#endif

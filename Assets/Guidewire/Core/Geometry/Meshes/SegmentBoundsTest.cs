#if NET8_0_OR_GREATER
using System;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace Guidewire.Core
{
    /// <summary><see cref="SegmentSearch.MayHold"/> for eight children of a node at once, with a range that makes up
    /// for rounding.</summary>
    internal readonly struct SegmentBoundsTest : IBoundsTest
    {
        private const double OfSquare = 1.0 + 1e-6;    // the rounding of a sum of three squares
        private readonly Vector256<float> _middleX;
        private readonly Vector256<float> _middleY;
        private readonly Vector256<float> _middleZ;
        private readonly Vector256<float> _halfX;
        private readonly Vector256<float> _halfY;
        private readonly Vector256<float> _halfZ;
        private readonly Vector256<float> _squared;

        /// <summary>For what is within the search's range of its segment.</summary>
        public SegmentBoundsTest(in SegmentSearch search, WideBvh tree)
        {
            Vector3d half = 0.5 * (search.B - search.A);
            Vector3d middle = 0.5 * (search.A + search.B) - tree.Origin;
            double range = Math.Sqrt(search.Squared) + tree.Slack(middle.Length + half.Length);
            _middleX = Vector256.Create((float)middle.X);
            _middleY = Vector256.Create((float)middle.Y);
            _middleZ = Vector256.Create((float)middle.Z);
            _halfX = Vector256.Create((float)half.X);
            _halfY = Vector256.Create((float)half.Y);
            _halfZ = Vector256.Create((float)half.Z);
            _squared = Vector256.Create((float)(OfSquare * range * range));
        }

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public uint MayHold(ref float bounds)
        {
            Vector256<float> zero = Vector256<float>.Zero;
            Vector256<float> gapX = Vector256.MaxNative(zero, Vector256.Abs(_middleX - Bounds(ref bounds, 0))
                - (Bounds(ref bounds, 3) + Vector256.Abs(_halfX)));
            Vector256<float> gapY = Vector256.MaxNative(zero, Vector256.Abs(_middleY - Bounds(ref bounds, 1))
                - (Bounds(ref bounds, 4) + Vector256.Abs(_halfY)));
            Vector256<float> gapZ = Vector256.MaxNative(zero, Vector256.Abs(_middleZ - Bounds(ref bounds, 2))
                - (Bounds(ref bounds, 5) + Vector256.Abs(_halfZ)));
            Vector256<float> normalX = Bounds(ref bounds, 6);
            Vector256<float> normalY = Bounds(ref bounds, 7);
            Vector256<float> normalZ = Bounds(ref bounds, 8);
            Vector256<float> middle = normalX * _middleX + normalY * _middleY + normalZ * _middleZ;
            Vector256<float> half = Vector256.Abs(normalX * _halfX + normalY * _halfY + normalZ * _halfZ);
            Vector256<float> slab = Vector256.MaxNative(zero, Vector256.MaxNative(
                middle - Bounds(ref bounds, 10), Bounds(ref bounds, 9) - middle) - half);
            Vector256<float> least = Vector256.MaxNative(gapX * gapX + gapY * gapY + gapZ * gapZ, slab * slab);
            return Vector256.LessThan(least, _squared).ExtractMostSignificantBits();
        }

        /// <summary>A field of eight children.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector256<float> Bounds(ref float bounds, int field)
        {
            return Vector256.LoadUnsafe(ref Unsafe.Add(ref bounds, 8 * field));
        }
    }
}
#endif

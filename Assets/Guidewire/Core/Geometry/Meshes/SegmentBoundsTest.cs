#if NET8_0_OR_GREATER
using System;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;

namespace Guidewire.Core
{
    /// <summary><see cref="SegmentSearch.MayHold"/> for eight children of a node at once, with a range that makes up
    /// for rounding.</summary>
    internal readonly struct SegmentBoundsTest : IBoundsTest
    {
        private const double OfSquare = 1.0 + 1e-6;    // the rounding of a sum of three squares
        private readonly float _middleX;
        private readonly float _middleY;
        private readonly float _middleZ;
        private readonly float _halfX;
        private readonly float _halfY;
        private readonly float _halfZ;
        private readonly float _squared;

        /// <summary>Tests for what is within a range of segment a b, units.</summary>
        public SegmentBoundsTest(in Vector3d a, in Vector3d b, double range, WideBvh tree)
        {
            Vector3d half = 0.5 * (b - a);
            Vector3d middle = 0.5 * (a + b) - tree.Origin;
            range += tree.Slack(WideBvh.LengthBound(middle) + WideBvh.LengthBound(half));
            _middleX = (float)middle.X;
            _middleY = (float)middle.Y;
            _middleZ = (float)middle.Z;
            _halfX = (float)half.X;
            _halfY = (float)half.Y;
            _halfZ = (float)half.Z;
            _squared = (float)(OfSquare * range * range);
        }

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public uint MayHold(ref float bounds)
        {
            Vector256<float> zero = Vector256<float>.Zero;
            Vector256<float> middleX = Vector256.Create(_middleX);
            Vector256<float> middleY = Vector256.Create(_middleY);
            Vector256<float> middleZ = Vector256.Create(_middleZ);
            Vector256<float> halfX = Vector256.Create(_halfX);
            Vector256<float> halfY = Vector256.Create(_halfY);
            Vector256<float> halfZ = Vector256.Create(_halfZ);
            Vector256<float> gapX = Avx.Max(zero, Vector256.Abs(middleX - Bounds(ref bounds, 0))
                - (Bounds(ref bounds, 3) + Vector256.Abs(halfX)));
            Vector256<float> gapY = Avx.Max(zero, Vector256.Abs(middleY - Bounds(ref bounds, 1))
                - (Bounds(ref bounds, 4) + Vector256.Abs(halfY)));
            Vector256<float> gapZ = Avx.Max(zero, Vector256.Abs(middleZ - Bounds(ref bounds, 2))
                - (Bounds(ref bounds, 5) + Vector256.Abs(halfZ)));
            Vector256<float> normalX = Bounds(ref bounds, 6);
            Vector256<float> normalY = Bounds(ref bounds, 7);
            Vector256<float> normalZ = Bounds(ref bounds, 8);
            Vector256<float> middle = normalX * middleX + normalY * middleY + normalZ * middleZ;
            Vector256<float> half = Vector256.Abs(normalX * halfX + normalY * halfY + normalZ * halfZ);
            Vector256<float> slab = Avx.Max(zero, Avx.Max(
                middle - Bounds(ref bounds, 10), Bounds(ref bounds, 9) - middle) - half);
            Vector256<float> least = Avx.Max(gapX * gapX + gapY * gapY + gapZ * gapZ, slab * slab);
            return (uint)Avx.MoveMask(Vector256.LessThan(least, Vector256.Create(_squared)));
        }

        /// <summary>Gives a field of eight children.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector256<float> Bounds(ref float bounds, int field) =>
            Vector256.LoadUnsafe(ref Unsafe.Add(ref bounds, 8 * field));
    }
}
#endif

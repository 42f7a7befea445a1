#if NET8_0_OR_GREATER
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;

namespace Guidewire.Core
{
    /// <summary>Between numbers in lanes, one structure a lane, and those structures in memory, a stride apart: rows of
    /// two or four successive numbers of each are read, written or added to.</summary>
    internal static class Rows4
    {
        /// <summary>Whether the processor computes with registers of four doubles.</summary>
        public static bool IsSupported => Avx2.IsSupported;

        /// <summary>What leaves every number as it is when it is added, also -0.</summary>
        public static Vector256<double> Nothing
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => Vector256.Create(-0.0);
        }

        /// <summary>Reads the four numbers that begin at one of the first structure, of each structure.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static void Load(ref double first, int stride, out Vector256<double> a, out Vector256<double> b,
            out Vector256<double> c, out Vector256<double> d)
        {
            Transpose(Vector256.LoadUnsafe(ref first), Vector256.LoadUnsafe(ref first, (nuint)stride),
                Vector256.LoadUnsafe(ref first, (nuint)(2 * stride)),
                Vector256.LoadUnsafe(ref first, (nuint)(3 * stride)), out a, out b, out c, out d);
        }

        /// <summary>Reads two numbers of each structure.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static void Load(ref double first, int stride, out Vector256<double> a, out Vector256<double> b)
        {
            Vector256<double> even = Avx.InsertVector128(Vector128.LoadUnsafe(ref first).ToVector256Unsafe(),
                Vector128.LoadUnsafe(ref first, (nuint)(2 * stride)), 1);
            Vector256<double> odd = Avx.InsertVector128(Vector128.LoadUnsafe(ref first, (nuint)stride)
                .ToVector256Unsafe(), Vector128.LoadUnsafe(ref first, (nuint)(3 * stride)), 1);
            a = Avx.UnpackLow(even, odd);
            b = Avx.UnpackHigh(even, odd);
        }

        /// <summary>Writes four numbers of each structure.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static void Store(ref double first, int stride, Vector256<double> a, Vector256<double> b,
            Vector256<double> c, Vector256<double> d)
        {
            Transpose(a, b, c, d, out Vector256<double> r0, out Vector256<double> r1, out Vector256<double> r2,
                out Vector256<double> r3);
            r0.StoreUnsafe(ref first);
            r1.StoreUnsafe(ref first, (nuint)stride);
            r2.StoreUnsafe(ref first, (nuint)(2 * stride));
            r3.StoreUnsafe(ref first, (nuint)(3 * stride));
        }

        /// <summary>Writes two numbers of each structure.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static void Store(ref double first, int stride, Vector256<double> a, Vector256<double> b)
        {
            Vector256<double> even = Avx.UnpackLow(a, b);
            Vector256<double> odd = Avx.UnpackHigh(a, b);
            even.GetLower().StoreUnsafe(ref first);
            odd.GetLower().StoreUnsafe(ref first, (nuint)stride);
            Avx.ExtractVector128(even, 1).StoreUnsafe(ref first, (nuint)(2 * stride));
            Avx.ExtractVector128(odd, 1).StoreUnsafe(ref first, (nuint)(3 * stride));
        }

        /// <summary>Adds to four numbers of each structure.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static void Add(ref double first, int stride, Vector256<double> a, Vector256<double> b,
            Vector256<double> c, Vector256<double> d)
        {
            Transpose(a, b, c, d, out Vector256<double> r0, out Vector256<double> r1, out Vector256<double> r2,
                out Vector256<double> r3);
            AddAt(ref first, 0, r0);
            AddAt(ref first, stride, r1);
            AddAt(ref first, 2 * stride, r2);
            AddAt(ref first, 3 * stride, r3);
        }

        /// <summary>Adds to two numbers of each structure.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static void Add(ref double first, int stride, Vector256<double> a, Vector256<double> b)
        {
            Vector256<double> even = Avx.UnpackLow(a, b);
            Vector256<double> odd = Avx.UnpackHigh(a, b);
            AddAt(ref first, 0, even.GetLower());
            AddAt(ref first, stride, odd.GetLower());
            AddAt(ref first, 2 * stride, Avx.ExtractVector128(even, 1));
            AddAt(ref first, 3 * stride, Avx.ExtractVector128(odd, 1));
        }

        /// <summary>Gives sum + a0 + a1 + a2 + a3, one after the other.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static double Sum(double sum, Vector256<double> a) =>
            sum + a.GetElement(0) + a.GetElement(1) + a.GetElement(2) + a.GetElement(3);

        /// <summary>Whether a comparison holds in every lane.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static bool All(Vector256<double> comparison) => Avx.MoveMask(comparison) == 15;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static void AddAt(ref double first, int offset, Vector256<double> a) =>
            (Vector256.LoadUnsafe(ref first, (nuint)offset) + a).StoreUnsafe(ref first, (nuint)offset);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static void AddAt(ref double first, int offset, Vector128<double> a) =>
            (Vector128.LoadUnsafe(ref first, (nuint)offset) + a).StoreUnsafe(ref first, (nuint)offset);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static void Transpose(Vector256<double> a, Vector256<double> b, Vector256<double> c,
            Vector256<double> d, out Vector256<double> r0, out Vector256<double> r1, out Vector256<double> r2,
            out Vector256<double> r3)
        {
            Vector256<double> ab02 = Avx.UnpackLow(a, b);
            Vector256<double> ab13 = Avx.UnpackHigh(a, b);
            Vector256<double> cd02 = Avx.UnpackLow(c, d);
            Vector256<double> cd13 = Avx.UnpackHigh(c, d);
            r0 = Avx.Permute2x128(ab02, cd02, 0x20);
            r1 = Avx.Permute2x128(ab13, cd13, 0x20);
            r2 = Avx.Permute2x128(ab02, cd02, 0x31);
            r3 = Avx.Permute2x128(ab13, cd13, 0x31);
        }
    }
}
#endif

using System.Runtime.CompilerServices;
#if NET8_0_OR_GREATER
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;
#endif

namespace Guidewire.Core
{
#if NET8_0_OR_GREATER
    /// <summary>Four vectors, one a lane. Every operation is that of <see cref="Vector3d"/> in the same order, rounded
    /// by itself, so that each lane holds the bits which plain doubles give.</summary>
    internal readonly struct Vector3d4
    {
        /// <summary>Components along the x axis.</summary>
        public readonly Vector256<double> X;

        /// <summary>Components along the y axis.</summary>
        public readonly Vector256<double> Y;

        /// <summary>Components along the z axis.</summary>
        public readonly Vector256<double> Z;

        /// <summary>Makes the vectors (x, y, z).</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Vector3d4(Vector256<double> x, Vector256<double> y, Vector256<double> z)
        {
            X = x;
            Y = y;
            Z = z;
        }

        /// <summary>Gives |v|^2.</summary>
        public Vector256<double> LengthSquared
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => X * X + Y * Y + Z * Z;
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d4 operator +(Vector3d4 a, Vector3d4 b) => new Vector3d4(a.X + b.X, a.Y + b.Y, a.Z + b.Z);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d4 operator -(Vector3d4 a, Vector3d4 b) => new Vector3d4(a.X - b.X, a.Y - b.Y, a.Z - b.Z);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d4 operator *(Vector256<double> s, Vector3d4 a) =>
            new Vector3d4(s * a.X, s * a.Y, s * a.Z);

        /// <summary>Takes the scalar products a . b.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector256<double> Dot(Vector3d4 a, Vector3d4 b) => a.X * b.X + a.Y * b.Y + a.Z * b.Z;

        /// <summary>Takes the cross products a x b.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d4 Cross(Vector3d4 a, Vector3d4 b) =>
            new Vector3d4(a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X);

        /// <summary>Gives v / |v|; a zero vector stays zero.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d4 Normalize(Vector3d4 a)
        {
            Vector256<double> length = Vector256.Sqrt(a.LengthSquared);
            Vector256<double> hasLength = Vector256.GreaterThan(length, Vector256<double>.Zero);
            return new Vector3d4(a.X / length & hasLength, a.Y / length & hasLength, a.Z / length & hasLength);
        }

        /// <summary>Gives four successive vectors in memory.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d4 Load(ref Vector3d first)
        {
            ref double numbers = ref Unsafe.As<Vector3d, double>(ref first);
            Vector256<double> a = Vector256.LoadUnsafe(ref numbers);       // x0 y0 z0 x1
            Vector256<double> b = Vector256.LoadUnsafe(ref numbers, 4);    // y1 z1 x2 y2
            Vector256<double> c = Vector256.LoadUnsafe(ref numbers, 8);    // z2 x3 y3 z3
            Vector256<double> xy = Avx.Blend(a, b, 0b1100);                // x0 y0 x2 y2
            Vector256<double> zx = Avx.Permute2x128(a, c, 0x21);           // z0 x1 z2 x3
            Vector256<double> yz = Avx.Blend(b, c, 0b1100);                // y1 z1 y3 z3
            return new Vector3d4(Avx.Shuffle(xy, zx, 0b1010), Avx.Shuffle(xy, yz, 0b0101),
                Avx.Shuffle(zx, yz, 0b1010));
        }

        /// <summary>Writes the vectors to successive positions in memory.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void Store(ref Vector3d first)
        {
            ref double numbers = ref Unsafe.As<Vector3d, double>(ref first);
            Vector256<double> xy = Avx.UnpackLow(X, Y);
            Vector256<double> zx = Avx.Shuffle(Z, X, 0b1010);
            Vector256<double> yz = Avx.UnpackHigh(Y, Z);
            Avx.Permute2x128(xy, zx, 0x20).StoreUnsafe(ref numbers);
            Avx.Blend(yz, xy, 0b1100).StoreUnsafe(ref numbers, 4);
            Avx.Permute2x128(zx, yz, 0x31).StoreUnsafe(ref numbers, 8);
        }
    }
#endif

    /// <summary>Four numbers that are computed with at once: in one register where the platform has such.</summary>
    internal readonly struct Double4
    {
#if NET8_0_OR_GREATER
        private readonly Vector256<double> _value;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private Double4(Vector256<double> value) => _value = value;

        /// <summary>Four different numbers.</summary>
        public static Double4 Of(double a, double b, double c, double d) => new Double4(Vector256.Create(a, b, c, d));

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Double4 operator +(Double4 a, Double4 b) => new Double4(a._value + b._value);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Double4 operator -(Double4 a, Double4 b) => new Double4(a._value - b._value);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Double4 operator *(double s, Double4 a) => new Double4(Vector256.Create(s) * a._value);

        /// <summary>The number in one lane.</summary>
        public double this[int lane] => _value.GetElement(lane);
#else
        private readonly double _a;
        private readonly double _b;
        private readonly double _c;
        private readonly double _d;

        private Double4(double a, double b, double c, double d) => (_a, _b, _c, _d) = (a, b, c, d);

        /// <summary>Four different numbers.</summary>
        public static Double4 Of(double a, double b, double c, double d) => new Double4(a, b, c, d);

        public static Double4 operator +(Double4 a, Double4 b) =>
            new Double4(a._a + b._a, a._b + b._b, a._c + b._c, a._d + b._d);

        public static Double4 operator -(Double4 a, Double4 b) =>
            new Double4(a._a - b._a, a._b - b._b, a._c - b._c, a._d - b._d);

        public static Double4 operator *(double s, Double4 a) => new Double4(s * a._a, s * a._b, s * a._c, s * a._d);

        /// <summary>The number in one lane.</summary>
        public double this[int lane] => lane == 0 ? _a : lane == 1 ? _b : lane == 2 ? _c : _d;
#endif
    }
}

using System.Runtime.CompilerServices;
#if NET8_0_OR_GREATER
using System.Runtime.Intrinsics;
#endif

namespace Guidewire.Core
{
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

#if NET8_0_OR_GREATER
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;

namespace Guidewire.Core
{
    /// <summary>Eight lanes: one register of 512 bits.</summary>
    internal readonly struct Lanes8 : ILanes<Lanes8>
    {
        private readonly Vector512<double> _value;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private Lanes8(Vector512<double> value)
        {
            _value = value;
        }

        /// <summary>Whether the processor computes with such registers.</summary>
        public static bool IsSupported => Vector512.IsHardwareAccelerated && Avx512F.IsSupported;

        /// <inheritdoc/>
        public static int Count => 8;

        /// <summary>1.8: 1.5 measured on a processor with AVX-512, the rest as a margin for others.</summary>
        public static double TickCost => 1.8;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes8 operator +(Lanes8 a, Lanes8 b) => new Lanes8(a._value + b._value);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes8 operator -(Lanes8 a, Lanes8 b) => new Lanes8(a._value - b._value);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes8 operator *(Lanes8 a, Lanes8 b) => new Lanes8(a._value * b._value);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes8 operator /(Lanes8 a, Lanes8 b) => new Lanes8(a._value / b._value);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes8 operator -(Lanes8 a) => new Lanes8(-a._value);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes8 operator <(Lanes8 a, Lanes8 b) => new Lanes8(Vector512.LessThan(a._value, b._value));

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes8 operator >(Lanes8 a, Lanes8 b) => new Lanes8(Vector512.GreaterThan(a._value, b._value));

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes8 operator &(Lanes8 a, Lanes8 b) => new Lanes8(a._value & b._value);

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes8 Sqrt(Lanes8 a) => new Lanes8(Vector512.Sqrt(a._value));

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes8 Select(Lanes8 mask, Lanes8 a, Lanes8 b) =>
            new Lanes8(Vector512.ConditionalSelect(mask._value, a._value, b._value));

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes8 Fill(double value) => new Lanes8(Vector512.Create(value));

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes8 Load(ref double first) => new Lanes8(Vector512.LoadUnsafe(ref first));

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static void Store(Lanes8 a, ref double first) => a._value.StoreUnsafe(ref first);

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes8 Shift(Lanes8 a, double entering)
        {
            return new Lanes8(Avx512F.AlignRight64(
                a._value.AsInt64(), Vector512.Create(entering).AsInt64(), 7).AsDouble());
        }

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static double Last(Lanes8 a) => a._value.GetElement(7);
    }
}
#endif

#if NET8_0_OR_GREATER
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;

namespace Guidewire.Core
{
    /// <summary>A vector register of doubles, one number per lane. Each operation is that of IEEE 754 in every lane,
    /// rounded by itself, so that a lane holds what the same operations on plain doubles give.</summary>
    internal interface ILanes<T>
        where T : struct, ILanes<T>
    {
        /// <summary>The number of lanes.</summary>
        static abstract int Count { get; }

        /// <summary>Says about how long an element and a joint in all lanes take, counted in elements of a scalar
        /// iteration.</summary>
        static abstract double TickCost { get; }

        static abstract T operator +(T a, T b);

        static abstract T operator -(T a, T b);

        static abstract T operator *(T a, T b);

        static abstract T operator /(T a, T b);

        static abstract T operator -(T a);

        /// <summary>All bits set where a &lt; b, none elsewhere, also where one is not a number.</summary>
        static abstract T operator <(T a, T b);

        /// <summary>All bits set where a &gt; b, none elsewhere, also where one is not a number.</summary>
        static abstract T operator >(T a, T b);

        /// <summary>Takes bitwise and.</summary>
        static abstract T operator &(T a, T b);

        /// <summary>Takes the square roots.</summary>
        static abstract T Sqrt(T a);

        /// <summary>a where all bits of the mask are set, b where none is.</summary>
        static abstract T Select(T mask, T a, T b);

        /// <summary>Gives one number in all lanes.</summary>
        static abstract T Fill(double value);

        /// <summary>Gives the successive numbers in memory, the first in lane 0.</summary>
        static abstract T Load(ref double first);

        /// <summary>Writes the numbers to successive positions in memory, lane 0's first.</summary>
        static abstract void Store(T a, ref double first);

        /// <summary>Gives each lane's number in the next lane; lane 0 gets the entering one.</summary>
        static abstract T Shift(T a, double entering);

        /// <summary>Gives the number in the last lane.</summary>
        static abstract double Last(T a);
    }

    /// <summary>Four lanes: one register of 256 bits.</summary>
    internal readonly struct Lanes4 : ILanes<Lanes4>
    {
        private readonly Vector256<double> _value;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private Lanes4(Vector256<double> value)
        {
            _value = value;
        }

        /// <summary>Whether the processor computes with such registers.</summary>
        public static bool IsSupported => Avx2.IsSupported;

        /// <inheritdoc/>
        public static int Count => 4;

        /// <summary>1.6: 1.3 measured on a processor with AVX-512, the rest as a margin for others.</summary>
        public static double TickCost => 1.6;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes4 operator +(Lanes4 a, Lanes4 b) => new Lanes4(a._value + b._value);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes4 operator -(Lanes4 a, Lanes4 b) => new Lanes4(a._value - b._value);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes4 operator *(Lanes4 a, Lanes4 b) => new Lanes4(a._value * b._value);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes4 operator /(Lanes4 a, Lanes4 b) => new Lanes4(a._value / b._value);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes4 operator -(Lanes4 a) => new Lanes4(-a._value);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes4 operator <(Lanes4 a, Lanes4 b) => new Lanes4(Vector256.LessThan(a._value, b._value));

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes4 operator >(Lanes4 a, Lanes4 b) => new Lanes4(Vector256.GreaterThan(a._value, b._value));

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes4 operator &(Lanes4 a, Lanes4 b) => new Lanes4(a._value & b._value);

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes4 Sqrt(Lanes4 a) => new Lanes4(Vector256.Sqrt(a._value));

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes4 Select(Lanes4 mask, Lanes4 a, Lanes4 b) =>
            new Lanes4(Vector256.ConditionalSelect(mask._value, a._value, b._value));

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes4 Fill(double value) => new Lanes4(Vector256.Create(value));

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes4 Load(ref double first) => new Lanes4(Vector256.LoadUnsafe(ref first));

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static void Store(Lanes4 a, ref double first) => a._value.StoreUnsafe(ref first);

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Lanes4 Shift(Lanes4 a, double entering) =>
            new Lanes4(Avx.Blend(Avx2.Permute4x64(a._value, 0b10_01_00_00), Vector256.Create(entering), 1));

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static double Last(Lanes4 a) => a._value.GetElement(3);
    }

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

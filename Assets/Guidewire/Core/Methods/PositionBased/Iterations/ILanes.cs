#if NET8_0_OR_GREATER
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
}
#endif

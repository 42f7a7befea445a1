using System.Collections.Generic;
using System.Runtime.CompilerServices;
using System;

namespace Guidewire.Core
{
    /// <summary>A list of structs that is refilled repeatedly: its memory grows as needed and is reused, so that
    /// refilling it to an earlier length allocates nothing.</summary>
    internal sealed class StructList<T>
        where T : struct
    {
        private const int MaxInserted = 16;    // items that are sorted by insertion
        private T[] _items;

        /// <param name="capacity">Items that fit before the list grows for the first time, 1 or more.</param>
        public StructList(int capacity)
        {
            _items = new T[capacity];
        }

        /// <summary>Counts the items at present.</summary>
        public int Count { get; private set; }

        /// <summary>Item k, from 0 to Count - 1, where it stands; it is lost with the next <see cref="Add"/> or
        /// <see cref="Clear"/>.</summary>
        public ref T this[int k] => ref _items[k];

        /// <summary>Removes all items; their memory stays.</summary>
        public void Clear() => Count = 0;

        /// <summary>Removes the items from index <paramref name="count"/> on.</summary>
        public void Truncate(int count) => Count = Math.Min(Count, count);

        /// <summary>Sorts the items from index <paramref name="from"/> on; allocates nothing where items say themselves
        /// which comes first.</summary>
        public void Sort(int from)
        {
            if (Count - from > MaxInserted)
            {
                Array.Sort(_items, from, Count - from);
                return;
            }
            Comparer<T> comparer = Comparer<T>.Default;
            for (int k = from + 1; k < Count; k++)
            {
                T item = _items[k];
                int i = k;
                for (; i > from && comparer.Compare(_items[i - 1], item) > 0; i--)
                {
                    _items[i] = _items[i - 1];
                }
                _items[i] = item;
            }
        }

        /// <summary>Puts an item at the end.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void Add(in T item)
        {
            if (Count == _items.Length)
            {
                Array.Resize(ref _items, 2 * Count);
            }
            _items[Count++] = item;
        }
    }
}

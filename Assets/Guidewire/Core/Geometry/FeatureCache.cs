using System;

namespace Guidewire.Core
{
    /// <summary>Caches the features of a wall near the points of a lattice. The successive nodes of a wire that is
    /// pushed pass the same positions.</summary>
    /// <remarks>One slot in the table for each hash: a new entry replaces the old one, and the whole table is cleared
    /// when the lists have grown long. Nothing is allocated after construction unless a wire needs longer
    /// lists.</remarks>
    internal sealed class FeatureCache
    {
        private const int Slots = 1 << 13;
        private const int MaxFeatures = 1 << 17;
        private const int LongestList = 1 << 13;    // expected
        private const int MaxLists = 8;            // of all that a wire asks for at once
        private const double HalfDiagonal = 0.8661;    // of a lattice's cell, rounded up
        private readonly ContactShape _wall;
        private readonly double _size;
        private readonly double _skin;    // from a point of the lattice
        private readonly Cell[] _cells = new Cell[Slots];
        private int _most = MaxFeatures;
        private int _before;    // features at the last trim

        /// <summary>Makes the cache of a wall that stays where it is.</summary>
        /// <param name="wall">A surface.</param>
        /// <param name="skin">Entries are valid within this distance of the query point at least, units.</param>
        public FeatureCache(ContactShape wall, double skin)
        {
            _wall = wall;
            Skin = skin;
            _size = 0.5 * skin;
            _skin = skin + HalfDiagonal * _size;
        }

        /// <summary>Entries are valid within this distance of the query point at least, units.</summary>
        public double Skin { get; }

        /// <summary>How often the cache was cleared; what was found before then is invalid.</summary>
        public int Version { get; private set; }

        /// <summary>The lists of features, one behind the other.</summary>
        public StructList<WallFeature> Features { get; } =
            new StructList<WallFeature>(MaxFeatures + LongestList);

        /// <summary>Clears the cache where the lists have grown too long, but not before they hold several times what
        /// was queried since the last call: a wire of many elements in a fine mesh needs long lists.</summary>
        public void Trim()
        {
            _most = Math.Max(_most, MaxLists * (Features.Count - _before));
            if (Features.Count > _most)
            {
                Features.Clear();
                Array.Clear(_cells, 0, _cells.Length);
                Version++;
            }
            _before = Features.Count;
        }

        /// <summary>Finds the wall about the lattice point next to a point.</summary>
        /// <param name="x">Units.</param>
        /// <param name="range">Of the features, beyond the skin, units.</param>
        /// <param name="neighbour">Receives it, with its features among <see cref="Features"/>.</param>
        public void Find(in Vector3d x, double range, ref Neighbour neighbour)
        {
            var centre = new Vector3d(
                _size * Math.Round(x.X / _size), _size * Math.Round(x.Y / _size), _size * Math.Round(x.Z / _size));
            double radius = _skin + range;
            ref Cell cell = ref _cells[SlotOf(centre, radius)];
            if (!cell.Is(centre, radius))
            {
                int from = Features.Count;
                int hint = -1;
                double distance = _wall.FindFeatures(centre, centre, radius, _skin, ref hint, Features);
                cell = new Cell(centre, radius, from, Features.Count, distance);
            }
            neighbour.Begin(centre, centre, _skin, cell.From);
            neighbour.End(cell.Distance, radius, cell.To);
        }

        private static int SlotOf(in Vector3d centre, double radius)
        {
            ulong hash = Mixed(Mixed(Mixed(Mixed(0UL, centre.X), centre.Y), centre.Z), radius);
            return (int)(hash >> 40) & (Slots - 1);
        }

        private static ulong Mixed(ulong hash, double value)
        {
            const ulong factor = 0x9E3779B97F4A7C15UL;    // 2^64 over the golden ratio
            hash ^= unchecked((ulong)BitConverter.DoubleToInt64Bits(value));
            return unchecked(factor * (hash ^ (hash >> 29)));
        }

        private readonly struct Cell
        {
            public readonly int From;
            public readonly int To;
            public readonly double Distance;
            private readonly Vector3d _centre;
            private readonly double _radius;    // 0: the slot is empty

            public Cell(in Vector3d centre, double radius, int from, int to, double distance)
            {
                _centre = centre;
                _radius = radius;
                From = from;
                To = to;
                Distance = distance;
            }

            public bool Is(in Vector3d centre, double radius) => _radius == radius && _centre == centre;
        }
    }
}

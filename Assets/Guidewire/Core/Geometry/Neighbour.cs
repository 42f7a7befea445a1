using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>The result of a neighbour query for a node or an element, and the position at which it was made.
    /// Lengths in
    /// units.</summary>
    internal struct Neighbour
    {
        private Vector3d _a;
        private Vector3d _b;
        private double _skin;        // below 0: no query was made
        private double _clearance;
        private int _from;
        private int _to;

        /// <summary>Whether the wall is within the range of the query.</summary>
        public bool IsNear { get; private set; }

        /// <summary>Marks the query as not made.</summary>
        public void Forget()
        {
            _skin = -1.0;
            IsNear = false;
        }

        /// <summary>Begins a query between a and b; features are added from an index of the list on.</summary>
        public void Begin(in Vector3d a, in Vector3d b, double skin, int from)
        {
            _a = a;
            _b = b;
            _skin = skin;
            _from = from;
        }

        /// <summary>Ends the query: the wall is at a distance, if that is within the range; features up to an index of
        /// the list belong to it.</summary>
        public void End(double distance, double range, int to)
        {
            IsNear = distance <= range;
            _clearance = Math.Min(distance, range);
            _to = to;
        }

        /// <summary>Whether the result is valid between a and b.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly bool Covers(in Vector3d a, in Vector3d b)
        {
            return _skin >= 0.0 && (a - _a).LengthSquared <= _skin * _skin
                && (b - _b).LengthSquared <= _skin * _skin;
        }

        /// <summary>Lower bound of the distance between the wall and segment a b; minus infinity where no query was
        /// made.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly double Clearance(in Vector3d a, in Vector3d b) =>
            _skin >= 0.0 ? _clearance - Moved(a, b) : double.NegativeInfinity;

        /// <summary>False where the wall is certainly farther from segment a b than a range.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly bool MayBeInRange(in Vector3d a, in Vector3d b, double range) =>
            MayBeInRange(Math.Max((a - _a).LengthSquared, (b - _b).LengthSquared), range);

        /// <summary>The same for its first end alone.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly bool FirstMayBeInRange(in Vector3d a, double range) =>
            MayBeInRange((a - _a).LengthSquared, range);

        /// <summary>The same for its second end.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly bool SecondMayBeInRange(in Vector3d b, double range) =>
            MayBeInRange((b - _b).LengthSquared, range);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private readonly bool MayBeInRange(double squaredMotion, double range)
        {
            double left = _clearance - range;
            return _skin < 0.0 || !(left > 0.0 && squaredMotion < left * left);
        }

        /// <summary>Its features, if the result is valid between a and b.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly FeatureRange Features(StructList<WallFeature> features, in Vector3d a, in Vector3d b) =>
            Covers(a, b) ? new FeatureRange(features, _from, _to, Moved(a, b)) : default;

        /// <summary>The same at its first end.</summary>
        public readonly FeatureRange FeaturesAtA(StructList<WallFeature> features, in Vector3d a) =>
            Features(features, a, _b);

        /// <summary>The same at its second end.</summary>
        public readonly FeatureRange FeaturesAtB(StructList<WallFeature> features, in Vector3d b) =>
            Features(features, _a, b);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private readonly double Moved(in Vector3d a, in Vector3d b) =>
            Math.Sqrt(Math.Max((a - _a).LengthSquared, (b - _b).LengthSquared));
    }

    /// <summary>A feature of a wall (whatever a shape takes for one) that was found near something.</summary>
    internal readonly struct WallFeature : IComparable<WallFeature>
    {
        /// <summary>Makes the feature number <paramref name="index"/>.</summary>
        /// <param name="index">As the shape counts.</param>
        /// <param name="distance">Units; the feature was no nearer.</param>
        public WallFeature(int index, double distance)
        {
            Index = index;
            Distance = distance;
        }

        /// <summary>The feature's number in the wall.</summary>
        public int Index { get; }

        /// <summary>A distance, units, than which it was no nearer where it was found.</summary>
        public double Distance { get; }

        /// <summary>Orders features by distance.</summary>
        public int CompareTo(WallFeature other)
        {
            int byDistance = Distance.CompareTo(other.Distance);
            return byDistance != 0 ? byDistance : Index.CompareTo(other.Index);
        }
    }

    /// <summary>Part of a list of features of a wall; see <see cref="ContactShape.FindFeatures"/>.</summary>
    internal readonly struct FeatureRange
    {
        private readonly StructList<WallFeature>? _features;

        /// <summary>Makes the part from one index (inclusive) to another (exclusive).</summary>
        /// <param name="features">The list.</param>
        /// <param name="from">First index.</param>
        /// <param name="to">Index behind the last.</param>
        /// <param name="moved">Units; nothing of what they were found for has gone farther since then.</param>
        public FeatureRange(StructList<WallFeature> features, int from, int to, double moved)
        {
            _features = features;
            From = from;
            To = to;
            Moved = moved;
        }

        /// <summary>Whether the features nearby are known; if not, the range is empty and meaningless.</summary>
        public bool IsKnown => _features != null;

        /// <summary>The first index of the range.</summary>
        public int From { get; }

        /// <summary>Index behind the last.</summary>
        public int To { get; }

        /// <summary>How far what they were found for has gone since then at most, units.</summary>
        public double Moved { get; }

        /// <summary>The feature at an index.</summary>
        public int this[int index] => _features![index].Index;

        /// <summary>Lower bound of the present distance of the feature at an index, units.</summary>
        public double MinDistance(int index) => _features![index].Distance - Moved;
    }

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

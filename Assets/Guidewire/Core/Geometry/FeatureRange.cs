using System;

namespace Guidewire.Core
{
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
}

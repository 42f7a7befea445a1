namespace Guidewire.Core
{
    /// <summary>Part of a list of features of a wall; see <see cref="ContactShape.FindFeatures"/>.</summary>
    internal readonly struct FeatureRange
    {
        private readonly StructList<int> _features;

        /// <summary>The part from one place (inclusive) to another (exclusive).</summary>
        public FeatureRange(StructList<int> features, int from, int to)
        {
            _features = features;
            From = from;
            To = to;
        }

        /// <summary>First place.</summary>
        public int From { get; }

        /// <summary>Place behind the last.</summary>
        public int To { get; }

        /// <summary>The feature at a place.</summary>
        public int this[int place] => _features[place];
    }
}

using System;

namespace Guidewire.Core
{
    /// <summary>Which walls the elements of a wire may come near while no node goes farther than a reach from where it
    /// was looked for them, and the walls' features there. Lengths in units.</summary>
    internal sealed class NearWalls
    {
        private const double SureOfQuick = 0.9;   // of a quick distance there is surely room
        private const double WithRoom = 1.25;     // to the way that is expected
        private readonly ContactShape[] _walls;
        private readonly double[] _range;         // by element: its radius and the barrier's distance
        private readonly double _leastReach;
        private readonly Vector3d[] _reference;   // where the wire was last looked for walls
        private readonly double[] _reach;         // by node, since then
        private readonly double[] _room;          // by wall and element: from the reference to the wall
        private readonly bool[] _isNear;
        private readonly int[] _hint;
        private readonly StructList<int> _features = new StructList<int>(256);
        private readonly int[] _firstFeature;     // by wall and element, and of none
        private bool _isKnown;

        /// <summary>For a wire that has not been looked for.</summary>
        /// <param name="walls">The walls.</param>
        /// <param name="range">By element: what is farther does not count.</param>
        /// <param name="leastReach">No node is looked for anew before it has gone this far.</param>
        public NearWalls(ContactShape[] walls, double[] range, double leastReach)
        {
            int n = range.Length;
            _walls = walls;
            _range = range;
            _leastReach = leastReach;
            _reference = new Vector3d[n + 1];
            _reach = new double[n + 1];
            _room = new double[walls.Length * n];
            _isNear = new bool[walls.Length * n];
            _firstFeature = new int[walls.Length * n + 1];
            _hint = new int[walls.Length * n];
            Array.Fill(_hint, -1);
        }

        /// <summary>Looks for a wire unless it is within reach of where it was looked for.</summary>
        /// <param name="x">Its n + 1 nodes.</param>
        public void Follow(Vector3d[] x)
        {
            bool isCovered = _isKnown;
            for (int i = 0; i < x.Length && isCovered; i++)
            {
                isCovered = (x[i] - _reference[i]).LengthSquared <= _reach[i] * _reach[i];
            }
            if (!isCovered)
            {
                Array.Fill(_reach, _leastReach);
                Find(x);
            }
        }

        /// <summary>The same before the wire moves, so that all of its way is within reach.</summary>
        /// <param name="x">Its n + 1 nodes.</param>
        /// <param name="to">Where they go to.</param>
        public void Cover(Vector3d[] x, Vector3d[] to)
        {
            bool isCovered = _isKnown;
            for (int i = 0; i < x.Length && isCovered; i++)
            {
                isCovered = (to[i] - _reference[i]).LengthSquared <= _reach[i] * _reach[i]
                    && (x[i] - _reference[i]).LengthSquared <= _reach[i] * _reach[i];
            }
            if (!isCovered)
            {
                for (int i = 0; i < x.Length; i++)
                {
                    _reach[i] = Math.Max(_leastReach, WithRoom * Vector3d.Distance(x[i], to[i]));
                }
                Find(x);
            }
        }

        /// <summary>Whether element j may come near wall w.</summary>
        public bool IsNear(int w, int j)
        {
            return _isNear[w * _range.Length + j];
        }

        /// <summary>Features of wall w about element j, where it is near.</summary>
        public FeatureRange FeaturesOf(int w, int j)
        {
            int k = w * _range.Length + j;
            return new FeatureRange(_features, _firstFeature[k], _firstFeature[k + 1]);
        }

        /// <summary>The same about node i: those of an element beside it that is near.</summary>
        public FeatureRange FeaturesOfNode(int w, int i)
        {
            return FeaturesOf(w, i < _range.Length && IsNear(w, i) ? i : i - 1);
        }

        /// <summary>Where element j was nearest to wall w, for <see cref="ContactShape.Nearest"/>.</summary>
        public ref int HintOf(int w, int j)
        {
            return ref _hint[w * _range.Length + j];
        }

        /// <summary>By how much element j of a wire within reach is farther from all walls than 0 at least.</summary>
        /// <param name="x">Nodes of the wire.</param>
        public double ClearanceOf(Vector3d[] x, int j)
        {
            double room = double.PositiveInfinity;
            for (int w = 0; w < _walls.Length; w++)
            {
                room = Math.Min(room, _room[w * _range.Length + j]);
            }
            return room - Math.Max(Vector3d.Distance(x[j], _reference[j]),
                Vector3d.Distance(x[j + 1], _reference[j + 1]));
        }

        private void Find(Vector3d[] x)
        {
            int n = _range.Length;
            _isKnown = true;
            Array.Copy(x, _reference, x.Length);
            _features.Clear();
            for (int w = 0; w < _walls.Length; w++)
            {
                for (int j = 0; j < n; j++)
                {
                    int k = w * n + j;
                    double reach = Math.Max(_reach[j], _reach[j + 1]);
                    double range = reach + _range[j];
                    _firstFeature[k] = _features.Count;
                    double distance = SureOfQuick * Math.Abs(_walls[w].FindFeatures(
                        x[j], x[j + 1], range / SureOfQuick, reach, ref _hint[k], _features));
                    _isNear[k] = distance <= range;
                    _room[k] = Math.Min(distance, range);
                }
            }
            _firstFeature[_isNear.Length] = _features.Count;
        }
    }
}

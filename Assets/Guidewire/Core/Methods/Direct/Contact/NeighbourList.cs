using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Neighbour list (Verlet list): the walls near each node and element of a wire, valid while it moves no
    /// farther than the skin from where the query was made, and the walls' features there. Lengths in units.</summary>
    /// <remarks>A node or element that has moved farther than the skin is queried again, alone: its features are added
    /// at the end of the list, which is rebuilt when it has grown too long. The query before the last one stays valid,
    /// too: a stage goes from the shape where it begins to a predicted one and back.</remarks>
    internal sealed class NeighbourList
    {
        private const double SureOfQuick = 0.9;   // of a quick distance: the part that is certain
        private const double SureOfNode = 1.0 - 1e-6;   // of a node's distance: more than rounding takes
        private const int MaxLists = 8;          // of the features of all, before the list is rebuilt
        private readonly ContactShape[] _walls;
        private readonly double[] _range;         // by element: its radius and the barrier's distance
        private readonly double _skin;
        private readonly Neighbour[] _element;    // by wall and element
        private readonly Neighbour[] _node;       // by wall and node: features of points, or where last asked for
        private readonly Neighbour[] _elementBefore;    // the queries before the last ones
        private readonly double[] _formerRange;   // of elements that were
        private int _count;                       // of elements
        private readonly Neighbour[] _nodeBefore;
        private readonly int[] _hint;             // by wall and element
        private readonly StructList<WallFeature> _features = new StructList<WallFeature>(1024);
        private readonly FeatureCache?[] _caches;  // of nodes, by wall
        private readonly int[] _version;          // of the caches when the nodes were queried
        private int _maxFeatures;

        /// <summary>A list without any query made.</summary>
        /// <param name="walls">The walls.</param>
        /// <param name="range">By element: what is farther does not count.</param>
        /// <param name="skin">The skin: nothing is queried again before it has moved this far.</param>
        public NeighbourList(ContactShape[] walls, double[] range, double skin)
        {
            int n = range.Length;    // room
            _walls = walls;
            _range = range;
            _skin = skin;
            _element = new Neighbour[walls.Length * n];
            _node = new Neighbour[walls.Length * (n + 1)];
            _elementBefore = new Neighbour[_element.Length];
            _nodeBefore = new Neighbour[_node.Length];
            _caches = Array.ConvertAll(walls, wall => wall.FeatureCacheFor(skin));
            _version = new int[walls.Length];
            _hint = new int[walls.Length * n];
            _formerRange = new double[n];
            Remesh(n, null);
        }

        /// <summary>Whether the entries are still valid where they were found: another user may have cleared a wall's
        /// cache.</summary>
        public bool IsCurrent
        {
            get
            {
                bool isCurrent = true;
                for (int w = 0; w < _caches.Length; w++)
                {
                    isCurrent &= _caches[w] == null || _caches[w]!.Version == _version[w];
                }
                return isCurrent;
            }
        }

        /// <summary>The wire has so many elements, at most those that this is made for, and their ranges are set. The
        /// queries of those that were there are kept where some came or went at the start.</summary>
        /// <param name="shift">Index of what was element 0; null: no query is kept.</param>
        public void Remesh(int count, int? shift)
        {
            int was = shift == null ? 0 : _count;    // of those whose queries are kept
            int by = shift ?? 0;
            _count = count;
            if (shift == null)
            {
                _features.Clear();
                _maxFeatures = 0;
                Array.Clear(_version, 0, _version.Length);
            }
            // From the end on that nothing is overwritten before it is read.
            bool grows = count > was;
            int sense = grows ? -1 : 1;
            for (int w = grows ? _walls.Length - 1 : 0; w >= 0 && w < _walls.Length; w += sense)
            {
                for (int j = grows ? count - 1 : 0; j >= 0 && j < count; j += sense)
                {
                    int from = j - by;
                    bool isKept = from >= 0 && from < was && _range[j] == _formerRange[from];
                    int to = w * count + j;
                    Move(_element, to, isKept ? w * was + from : -1);
                    Move(_elementBefore, to, isKept ? w * was + from : -1);
                    _hint[to] = isKept ? _hint[w * was + from] : -1;
                }
                for (int i = grows ? count : 0; i >= 0 && i <= count; i += sense)
                {
                    int from = i - by;
                    bool isKept = from >= 0 && from <= was && was > 0
                        && RangeOfNode(_range, i, count) == RangeOfNode(_formerRange, from, was);
                    int to = w * (count + 1) + i;
                    Move(_node, to, isKept ? w * (was + 1) + from : -1);
                    Move(_nodeBefore, to, isKept ? w * (was + 1) + from : -1);
                }
            }
        }

        /// <summary>Keeps the ranges, which are about to change.</summary>
        public void KeepRanges() => Array.Copy(_range, _formerRange, _count);

        private static void Move(Neighbour[] of, int to, int from)
        {
            if (from >= 0)
            {
                of[to] = of[from];
            }
            else
            {
                of[to].Forget();
            }
        }

        /// <summary>Repeats the queries of nodes and elements that have moved farther than the skin.</summary>
        /// <param name="nodes">The wire's n + 1 nodes, as each wall sees them.</param>
        public void Follow(Vector3d[][] nodes)
        {
            if (_features.Count > _maxFeatures)
            {
                _features.Clear();
                Forget(_element);
                Forget(_elementBefore);
            }
            bool isNew = _features.Count == 0;
            int n = _count;
            for (int w = 0; w < _walls.Length; w++)
            {
                Vector3d[] x = nodes[w];
                FollowNodes(w, x);
                for (int j = 0; j < n; j++)
                {
                    ref Neighbour element = ref _element[w * n + j];
                    if (!IsCovered(ref element, ref _elementBefore[w * n + j], x[j], x[j + 1]))
                    {
                        FindAtElement(w, j, x, ref element);
                    }
                }
            }
            if (isNew)
            {
                _maxFeatures = MaxLists * Math.Max(_features.Count, _count);
            }
        }

        /// <summary>Whether element j may come near wall w within the skin.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public bool IsNear(int w, int j)
        {
            return _element[w * _count + j].IsNear
                || (_caches[w] != null && (IsNodeNear(w, j) || IsNodeNear(w, j + 1)));
        }

        /// <summary>Whether node i may.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public bool IsNodeNear(int w, int i)
        {
            int n = _count;
            return _caches[w] != null ? _node[w * (n + 1) + i].IsNear
                : (i < n && _element[w * n + i].IsNear) || (i > 0 && _element[w * n + i - 1].IsNear);
        }

        /// <summary>Whether wall w may be within the range of element j.</summary>
        /// <param name="x">Nodes of the wire.</param>
        public bool MayBeInRange(int w, int j, Vector3d[] x) => IsNear(w, j) && MayBeInRange(w, j, x, _range[j]);

        /// <summary>Whether wall w may be within a range, units, of element j.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public bool MayBeInRange(int w, int j, Vector3d[] x, double range)
        {
            int n = _count;
            return _element[w * n + j].MayBeInRange(x[j], x[j + 1], range)
                || (_caches[w] != null && (_node[w * (n + 1) + j].FirstMayBeInRange(x[j], range)
                    || _node[w * (n + 1) + j + 1].FirstMayBeInRange(x[j + 1], range)));
        }

        /// <summary>The same for node i, by what is known of it or of an element beside it.</summary>
        public bool NodeMayBeInRange(int w, int i, Vector3d[] x)
        {
            int n = _count;
            if (!IsNodeNear(w, i))
            {
                return false;
            }
            double range = RangeOfNode(i);
            return NodeMayBeInRange(w, i, x[i], range) && (_caches[w] != null
                || ((i == n || _element[w * n + i].FirstMayBeInRange(x[i], range))
                    && (i == 0 || _element[w * n + i - 1].SecondMayBeInRange(x[i], range))));
        }

        /// <summary>Whether wall w may be within a range, units, of a position of node i, by where it was last asked
        /// for there.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public bool NodeMayBeInRange(int w, int i, in Vector3d x, double range) =>
            _node[w * (_count + 1) + i].FirstMayBeInRange(x, range);

        /// <summary>Takes note that wall w is not nearer to a position of node i than this, units.</summary>
        public void SetDistanceOfNode(int w, int i, in Vector3d x, double distance)
        {
            if (_caches[w] == null)
            {
                ref Neighbour node = ref _node[w * (_count + 1) + i];
                node.Begin(x, x, 0.0, 0);
                node.End(SureOfNode * distance, distance, 0);
            }
        }

        /// <summary>Features of wall w about element j, if they are known where its nodes are.</summary>
        public FeatureRange FeaturesOf(int w, int j, in Vector3d a, in Vector3d b) =>
            _element[w * _count + j].Features(_features, a, b);

        /// <summary>The same about node i; where the wall has none of points, those of an element beside it that is
        /// near.</summary>
        public FeatureRange FeaturesOfNode(int w, int i, in Vector3d x)
        {
            int n = _count;
            if (_caches[w] != null)
            {
                return _node[w * (n + 1) + i].Features(_caches[w]!.Features, x, x);
            }
            int j = w * n + i;
            return i < n && _element[j].IsNear ? _element[j].FeaturesAtA(_features, x)
                : _element[j - 1].FeaturesAtB(_features, x);
        }

        /// <summary>Features about a fraction of the motion of element j, where they are known for all of
        /// it.</summary>
        public FeatureRange FeaturesAlong(int w, int j, Vector3d[] x, Vector3d[] to, double fraction)
        {
            Vector3d a = Vector3d.Lerp(x[j], to[j], fraction);
            Vector3d b = Vector3d.Lerp(x[j + 1], to[j + 1], fraction);
            return _element[w * _count + j].Covers(a, b) ? FeaturesOf(w, j, x[j], x[j + 1]) : default;
        }

        /// <summary>The same for node i, where the wall has features of points.</summary>
        public FeatureRange FeaturesAlongNode(int w, int i, Vector3d[] x, Vector3d[] to, double fraction)
        {
            Vector3d end = Vector3d.Lerp(x[i], to[i], fraction);
            return _node[w * (_count + 1) + i].Covers(end, end) ? FeaturesOfNode(w, i, x[i]) : default;
        }

        /// <summary>Where element j was nearest to wall w, for <see cref="ContactShape.Nearest"/>.</summary>
        public ref int HintOf(int w, int j) => ref _hint[w * _count + j];

        /// <summary>Lower bound of the distance of element j from all walls.</summary>
        /// <param name="x">Nodes of the wire, as each wall sees them.</param>
        public double ClearanceOf(Vector3d[][] x, int j)
        {
            double clearance = double.PositiveInfinity;
            for (int w = 0; w < _walls.Length; w++)
            {
                clearance = Math.Min(clearance, ClearanceOf(w, x[w], j));
            }
            return clearance;
        }

        /// <summary>Gives the same from wall w.</summary>
        public double ClearanceOf(int w, Vector3d[] x, int j)
        {
            int n = _count;
            double clearance = _element[w * n + j].Clearance(x[j], x[j + 1]);
            return _caches[w] == null ? clearance
                : Math.Min(clearance, Math.Min(_node[w * (n + 1) + j].Clearance(x[j], x[j]),
                    _node[w * (n + 1) + j + 1].Clearance(x[j + 1], x[j + 1])));
        }

        private void FollowNodes(int w, Vector3d[] x)
        {
            FeatureCache? cells = _caches[w];
            if (cells == null)
            {
                return;
            }
            int n = _count;
            cells.Trim();
            bool isForgotten = cells.Version != _version[w];
            _version[w] = cells.Version;
            for (int i = 0; i <= n; i++)
            {
                ref Neighbour node = ref _node[w * (n + 1) + i];
                ref Neighbour before = ref _nodeBefore[w * (n + 1) + i];
                if (isForgotten)
                {
                    node.Forget();
                    before.Forget();
                }
                if (!IsCovered(ref node, ref before, x[i], x[i]))
                {
                    cells.Find(x[i], RangeOfNode(i), ref node);
                }
            }
        }

        private double RangeOfNode(int i) => RangeOfNode(_range, i, _count);

        private static double RangeOfNode(double[] range, int i, int count) =>
            Math.Max(range[Math.Max(i - 1, 0)], range[Math.Min(i, count - 1)]);

        // Whether one of two queries is valid between a and b: it is then the last; else the older one is, to be made
        // again.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static bool IsCovered(ref Neighbour last, ref Neighbour before, in Vector3d a, in Vector3d b)
        {
            if (last.Covers(a, b))
            {
                return true;
            }
            (last, before) = (before, last);
            return last.Covers(a, b);
        }

        private static void Forget(Neighbour[] neighbours)
        {
            for (int k = 0; k < neighbours.Length; k++)
            {
                neighbours[k].Forget();
            }
        }

        private void FindAtElement(int w, int j, Vector3d[] x, ref Neighbour element)
        {
            element.Begin(x[j], x[j + 1], _skin, _features.Count);
            double range = _skin + _range[j];
            // Predicted shapes may cross a wall, and then some part of the element is at it.
            double distance = SureOfQuick * Math.Max(0.0, _walls[w].FindFeatures(
                x[j], x[j + 1], range / SureOfQuick, _skin, ref _hint[w * _count + j], _features));
            element.End(distance, range, _features.Count);
        }
    }
}

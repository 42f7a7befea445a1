using System;

namespace Guidewire.Core
{
    /// <summary>Watches whether an instrument goes through itself, from the positions of its nodes alone: how near two
    /// of its stretches have come, and how often two of its elements crossed between one look and the next, every node
    /// on a straight line.</summary>
    /// <remarks>An arc that is bent no tighter than the instrument's own radius, r, has its ends a diameter apart or
    /// more from a length of pi r on (Schur's theorem: none of its length has nearer ends than the half circle). So the
    /// elements of <see cref="StrandPairs"/> are nearer than a diameter only where the instrument has come back to
    /// itself. A ring, whose ends are in one place, is closed there.
    ///
    /// Two elements a0 + s u and b0 + t v can meet only where (a0 - b0) . (u x v) is 0, a cubic in the time. With a
    /// method that keeps strands apart a straight line may still cut a strand round which the wire snapped: there the
    /// crossings of a passage have a sum that is not 0, and change the writhe by 2 (Fuller 1971); and where its
    /// strands may have moved farther against each other than the wire is long from the crossing to its tip, one may as
    /// well have gone round the tip.</remarks>
    internal sealed class StrandMonitor
    {
        private const double Touching = 1e-8;    // of the elements' lengths: a distance that is rounding
        private const double Jump = 1.4;         // of the writhe, 2 less what a motion of some diameters may take away
        private const int Halvings = 60;

        private readonly double[] _radius;       // of elements
        private readonly bool _keepsApart;
        private readonly StrandPairs _pairs;
        private readonly Vector3d[] _from;       // at the last look
        private int _count;                      // of elements
        private double _share = 1.0;             // least distance over the diameter
        private double _first;                   // from the proximal end
        private double _second;
        private double _time;                    // s

        /// <summary>Makes the monitor of an instrument, all lengths in one unit.</summary>
        /// <param name="length">Lengths of its elements at rest; with those radii they may change.</param>
        /// <param name="radius">Radii of its elements.</param>
        /// <param name="keepsApart">Whether the method keeps strands apart.</param>
        public StrandMonitor(double[] length, double[] radius, int count, bool keepsApart = false)
        {
            _radius = radius;
            _keepsApart = keepsApart;
            _pairs = new StrandPairs(length, radius, count, 0.0);
            _from = new Vector3d[length.Length + 1];
            _count = count;
        }

        /// <summary>How many elements the instrument has.</summary>
        public int ElementCount => _count;

        /// <summary>Counts the passages so far.</summary>
        public long Passages { get; set; }

        /// <summary>The warning of where the instrument overlapped itself most; null where it did not.</summary>
        /// <param name="instrument">Its name.</param>
        public RunWarning? WarningOf(string instrument) => _share >= 1.0 ? (RunWarning?)null
            : WarningTable.SelfOverlap.With(instrument, _time, _first, _second, _share);

        /// <summary>The instrument has so many elements, which may be others.</summary>
        public void Remesh(int count)
        {
            _count = count;
            _pairs.Remesh(count);
        }

        /// <summary>Takes where the nodes are, as those from which the next motion begins.</summary>
        public void Begin(Vector3d[] x) => Array.Copy(x, _from, _count + 1);

        /// <summary>Takes where the nodes are, and what lies between that and the last look.</summary>
        /// <param name="time">s.</param>
        public void Follow(Vector3d[] x, double time)
        {
            _pairs.FollowLengths();
            _pairs.Follow(_from);
            _pairs.Follow(_from, x);
            double around = Vector3d.Distance(x[0], x[_count]) < _radius[0] ? _pairs.ArcOf(_count)
                : double.PositiveInfinity;
            long crossed = 0;
            int sum = 0;
            int last = 0;
            for (int k = 0; k < _pairs.Pairs.Count; k++)
            {
                (int i, int j) = (_pairs.Pairs[k].First, _pairs.Pairs[k].Second);
                int crossing = Crosses(_from, x, i, j);
                if (crossing % 2 != 0)
                {
                    crossed++;
                    sum += crossing;
                    last = Math.Max(last, j);
                }
                if (around - _pairs.ArcOf(j + 1) + _pairs.ArcOf(i) < Math.PI * _radius[i])
                {
                    continue;
                }
                double share = Math.Sqrt(ClosestPoints.SegmentSegment(x[i], x[i + 1], x[j], x[j + 1], out double s,
                    out double t)) / (_radius[i] + _radius[j]);
                if (share < _share)
                {
                    (_share, _time) = (share, time);
                    _first = _pairs.ArcOf(i) + s * (_pairs.ArcOf(i + 1) - _pairs.ArcOf(i));
                    _second = _pairs.ArcOf(j) + t * (_pairs.ArcOf(j + 1) - _pairs.ArcOf(j));
                }
            }
            if (crossed > 0 && _keepsApart)
            {
                crossed = sum != 0 && !IsRoundTip(x, last) && Math.Abs(Writhe(x) - Writhe(_from)) > Jump ? 1 : 0;
            }
            Passages += crossed;
            Begin(x);
        }

        /// <summary>Writes or restores what was seen, but for the nodes of the last look.</summary>
        public void Serialize(Snapshot snapshot)
        {
            Passages = snapshot.Serialize(Passages);
            snapshot.Serialize(ref _share);
            snapshot.Serialize(ref _time);
            snapshot.Serialize(ref _first);
            snapshot.Serialize(ref _second);
        }

        // Whether two strands may have moved farther against each other than the wire is long from this element to its
        // tip.
        private bool IsRoundTip(Vector3d[] x, int element)
        {
            double moved = 0.0;
            for (int i = 0; i <= _count; i++)
            {
                moved = Math.Max(moved, Vector3d.Distance(_from[i], x[i]));
            }
            return 2.0 * moved > _pairs.ArcOf(_count) - _pairs.ArcOf(element);
        }

        // The double integral of Gauss over the polyline: the signed solid angles of all pairs of its elements.
        private double Writhe(Vector3d[] x)
        {
            double sum = 0.0;
            for (int i = 0; i < _count; i++)
            {
                for (int j = i + 2; j < _count; j++)
                {
                    Vector3d a = Vector3d.Normalize(x[j] - x[i]);
                    Vector3d c = Vector3d.Normalize(x[j + 1] - x[i + 1]);
                    sum -= HalfAngle(a, Vector3d.Normalize(x[j + 1] - x[i]), c)
                        + HalfAngle(a, c, Vector3d.Normalize(x[j] - x[i + 1]));
                }
            }
            return sum / Math.PI;
        }

        // Half the signed solid angle of three unit vectors (Van Oosterom and Strackee 1983).
        private static double HalfAngle(in Vector3d a, in Vector3d b, in Vector3d c) => Math.Atan2(
            Vector3d.Dot(a, Vector3d.Cross(b, c)), 1.0 + Vector3d.Dot(a, b) + Vector3d.Dot(b, c) + Vector3d.Dot(c, a));

        // How often elements j and k cross from one side, less how often from the other.
        private static int Crosses(Vector3d[] from, Vector3d[] to, int j, int k)
        {
            Vector3d d = from[j] - from[k];
            Vector3d u = from[j + 1] - from[j];
            Vector3d v = from[k + 1] - from[k];
            Vector3d dMove = to[j] - to[k] - d;
            Vector3d uMove = to[j + 1] - to[j] - u;
            Vector3d vMove = to[k + 1] - to[k] - v;
            Vector3d n0 = Vector3d.Cross(u, v);
            Vector3d n1 = Vector3d.Cross(u, vMove) + Vector3d.Cross(uMove, v);
            Vector3d n2 = Vector3d.Cross(uMove, vMove);
            double c0 = Vector3d.Dot(d, n0);
            double c1 = Vector3d.Dot(d, n1) + Vector3d.Dot(dMove, n0);
            double c2 = Vector3d.Dot(d, n2) + Vector3d.Dot(dMove, n1);
            double c3 = Vector3d.Dot(dMove, n2);
            double At(double time) => c0 + time * (c1 + time * (c2 + time * c3));
            int crosses = 0;
            double begin = 0.0;
            double root = Math.Sqrt(Math.Max(0.0, c2 * c2 - 3.0 * c1 * c3));
            double q = -(c2 + (c2 < 0.0 ? -root : root));
            double one = q / (3.0 * c3);
            double two = c1 / q;
            foreach (double turning in new[] { Math.Min(one, two), Math.Max(one, two), 1.0 })
            {
                double end = turning > begin && turning < 1.0 ? turning : 1.0;
                if (end > begin && At(begin) < 0.0 != At(end) < 0.0)
                {
                    double low = begin;
                    double high = end;
                    for (int halving = 0; halving < Halvings; halving++)
                    {
                        double middle = 0.5 * (low + high);
                        (low, high) = At(middle) < 0.0 == At(begin) < 0.0 ? (middle, high) : (low, middle);
                    }
                    crosses += !Touch(from, to, j, k, high) ? 0 : At(end) < 0.0 ? -1 : 1;
                }
                begin = turning > begin && turning < 1.0 ? turning : begin;
            }
            return crosses;
        }

        private static bool Touch(Vector3d[] from, Vector3d[] to, int j, int k, double time)
        {
            Vector3d a0 = Vector3d.Lerp(from[j], to[j], time);
            Vector3d a1 = Vector3d.Lerp(from[j + 1], to[j + 1], time);
            Vector3d b0 = Vector3d.Lerp(from[k], to[k], time);
            Vector3d b1 = Vector3d.Lerp(from[k + 1], to[k + 1], time);
            double near = Touching * (Vector3d.Distance(a0, a1) + Vector3d.Distance(b0, b1));
            return ClosestPoints.SegmentSegment(a0, a1, b0, b1, out _, out _) <= near * near;
        }
    }

    /// <summary>The pairs of a wire's elements that may come within range of each other: a list that holds while the
    /// nodes stay near where they were when it was made.</summary>
    /// <remarks>A piece of a curve of length s that turns by less than pi has a chord of at least s cos(turn/2)
    /// (Schur). So most of a wire needs no look: neither neighbouring blocks of elements that turn little, nor those
    /// farther apart between which it does not turn back. Whether a whole wire turns by less than pi says little: its
    /// tip may be a J. Other blocks have their boxes compared. With d the displacement of a node since the list was
    /// made, two elements with k others between them come nearer by no more than 2 max|d|, nor by more than k + 2 times
    /// the largest difference of d between neighbouring nodes: a wire that slides along itself has the latter
    /// small.</remarks>
    internal sealed class StrandPairs
    {
        private const int BlockSize = 8;           // elements
        private const double WindowTurn = 2.0;     // radians, of a window between blocks
        private const double ExcludedArc = 1.15 * Math.PI;    // radii between facing ends, of no pair
        private const double Skin = 2.0;           // of the thickest radius
        private const double Stretch = 0.2;        // of the thinnest radius or the shortest element, between neighbours
        private const double LongSkin = 20.0;      // of the thickest radius, more, of a list without pairs
        private const double LongStretch = 0.2;    // of the shortest element, the same
        private const double Wide = 4.0;           // times the skin, of a list that serves one motion alone

        private readonly double[] _ownLength;      // of elements at rest, m
        private readonly double[] _radius;
        private int _count;                        // of elements
        private readonly double _range;            // of the barrier, m
        private readonly Vector3d[] _origin;       // the nodes when the list was made, m
        private readonly double[] _turn;           // of elements, summed up from the first on, bounds, radians
        private readonly double[] _arc;            // of nodes, from the first on, m
        private readonly double[] _length;         // as they were taken last
        private readonly double[] _restArc;        // of these, or of those before where they were shorter
        private readonly (Vector3d Low, Vector3d High)[] _box;     // of blocks
        private readonly StructList<Pair> _pairs = new StructList<Pair>(64);
        private double _thickest;
        private double _thinnest;
        private double _shortest;                  // element when the list was made
        private int _between;                      // elements of no pair, at least
        private double _skin;                      // of this list, m
        private double _stretch;
        private bool _isKnown;

        /// <summary>Makes an empty list of pairs of a wire.</summary>
        /// <param name="length">Lengths of its elements at rest, m; they may change.</param>
        /// <param name="radius">Radii of its elements, m; they may change.</param>
        /// <param name="count">How many elements there are.</param>
        public StrandPairs(double[] length, double[] radius, int count, double range)
        {
            _ownLength = length;
            _radius = radius;
            _range = range;
            int n = length.Length;
            _origin = new Vector3d[n + 1];
            _turn = new double[n];
            _arc = new double[n + 1];
            _length = new double[n];
            _restArc = new double[n + 1];
            _box = new (Vector3d, Vector3d)[(n + BlockSize - 1) / BlockSize];
            Remesh(count);
        }

        /// <summary>The pairs in order, the lower element first.</summary>
        public StructList<Pair> Pairs => _pairs;

        /// <summary>The wire has so many elements, which may be others.</summary>
        public void Remesh(int count)
        {
            _count = count;
            Array.Copy(_ownLength, _length, _count);
            Measure();
        }

        private void Measure()
        {
            (_thickest, _thinnest) = (0.0, double.PositiveInfinity);
            double longest = 0.0;
            for (int j = 0; j < _count; j++)
            {
                _thickest = Math.Max(_thickest, _radius[j]);
                _thinnest = Math.Min(_thinnest, _radius[j]);
                double length = Math.Min(_length[j], _ownLength[j]);
                longest = Math.Max(longest, length);
                _restArc[j + 1] = _restArc[j] + length;
                _length[j] = _ownLength[j];
            }
            _between = Math.Max(1, (int)(ExcludedArc * _thinnest / longest));
            _isKnown = false;
        }

        /// <summary>Follows the lengths of elements, which slide over the tips of instruments.</summary>
        /// <returns>Whether any has changed.</returns>
        public bool FollowLengths()
        {
            for (int j = 0; j < _count; j++)
            {
                if (_length[j] != _ownLength[j])
                {
                    Measure();
                    return true;
                }
            }
            return false;
        }

        /// <summary>Length at rest from the first node to another one.</summary>
        public double ArcOf(int node) => _restArc[node];

        /// <summary>Whether two elements are far enough from each other along the wire to count as a pair.</summary>
        public bool IsPair(int j, int k) =>
            k > j + 1 && _restArc[k] - _restArc[j + 1] >= 0.5 * ExcludedArc * (_radius[j] + _radius[k]);

        /// <summary>Makes the list anew where it does not hold for a shape.</summary>
        public void Follow(Vector3d[] x)
        {
            if (!_isKnown || (_pairs.Count > 0 && _skin > Wide * Skin * _thickest) || !Holds(x))
            {
                Array.Copy(x, _origin, _count + 1);
                // Where nothing is near, the list is to hold long.
                bool isNear = _pairs.Count > 0;
                if (!isNear)
                {
                    Find(LongSkin * _thickest, LongStretch);
                }
                if (isNear || _pairs.Count > 0)
                {
                    Find(0.0, 0.0);
                }
            }
        }

        /// <summary>Updates the list for nodes that move on straight lines from a shape for which it holds.</summary>
        public void Follow(Vector3d[] x, Vector3d[] to)
        {
            if (Holds(to))
            {
                return;
            }
            if (_pairs.Count == 0)
            {
                Array.Copy(x, _origin, _count + 1);
                Find(LongSkin * _thickest, LongStretch);
            }
            if (_pairs.Count > 0 || !Holds(to))
            {
                Find(x, to);
            }
        }

        /// <summary>Makes the list of a motion on straight lines.</summary>
        public void Find(Vector3d[] x, Vector3d[] to)
        {
            double moved = 0.0;
            double stretch = 0.0;
            Vector3d before = to[0] - x[0];
            for (int i = 0; i <= _count; i++)
            {
                Vector3d move = to[i] - x[i];
                moved = Math.Max(moved, move.LengthSquared);
                stretch = Math.Max(stretch, (move - before).LengthSquared);
                before = move;
                _origin[i] = Vector3d.Lerp(x[i], to[i], 0.5);
            }
            Find(Math.Sqrt(moved), 0.0, 0.5 * Math.Sqrt(stretch));
        }

        // Along a straight path both displacements are largest at its ends.
        private bool Holds(Vector3d[] x)
        {
            double moved = 0.0;
            double stretch = 0.0;
            Vector3d before = x[0] - _origin[0];
            for (int i = 0; i <= _count; i++)
            {
                Vector3d move = x[i] - _origin[i];
                moved = Math.Max(moved, move.LengthSquared);
                stretch = Math.Max(stretch, (move - before).LengthSquared);
                before = move;
            }
            return 4.0 * moved <= _skin * _skin && stretch <= _stretch * _stretch;
        }

        // With a skin and a stretch, as a fraction of the shortest element, more than the least.
        private void Find(double skin, double stretch, double moved = 0.0)
        {
            _isKnown = true;
            SetTurns();
            _skin = Skin * _thickest + skin;
            _stretch = Stretch * Math.Min(_thinnest, _shortest) + stretch * _shortest + moved;
            _pairs.Clear();
            int blocks = (_count + BlockSize - 1) / BlockSize;
            double reach = 2.0 * _thickest + _range + _skin;
            double window = Math.Cos(0.5 * WindowTurn);
            for (int a = 0; a < blocks; a++)
            {
                if (MayBend(a))
                {
                    AddPairs(a, a);
                    AddPairs(a, a + 1);
                }
                int b = a + 2;
                for (; b < blocks && _turn[LastOf(b)] - _turn[BlockSize * a] <= WindowTurn; b++)
                {
                    if ((_arc[BlockSize * b] - _arc[LastOf(a) + 1]) * window < reach)
                    {
                        AddPairs(a, b);
                    }
                }
                for (; b < blocks; b++)
                {
                    if (AreNear(_box[a], _box[b], reach))
                    {
                        AddPairs(a, b);
                    }
                }
            }
            _pairs.Sort(0);
        }

        private int LastOf(int block) => Math.Min(BlockSize * (block + 1), _count) - 1;

        // Of an angle, |e - e'| (1 + 0.143 |e - e'|^2) is a bound: the angle itself at 0 and at pi.
        private void SetTurns()
        {
            _shortest = double.PositiveInfinity;
            Vector3d before = default;
            for (int j = 0; j < _count; j++)
            {
                Vector3d chord = _origin[j + 1] - _origin[j];
                double length = chord.Length;
                Vector3d along = (1.0 / length) * chord;
                double squared = j == 0 ? 0.0 : (along - before).LengthSquared;
                _turn[j] = (j == 0 ? 0.0 : _turn[j - 1]) + Math.Sqrt(squared) * (1.0 + 0.143 * squared);
                _arc[j + 1] = _arc[j] + length;
                _shortest = Math.Min(_shortest, length);
                before = along;
                ref (Vector3d Low, Vector3d High) box = ref _box[j / BlockSize];
                if (j % BlockSize == 0)
                {
                    box = (_origin[j], _origin[j]);
                }
                box = (Min(box.Low, _origin[j + 1]), Max(box.High, _origin[j + 1]));
            }
        }

        private static Vector3d Min(in Vector3d a, in Vector3d b) =>
            new Vector3d(Math.Min(a.X, b.X), Math.Min(a.Y, b.Y), Math.Min(a.Z, b.Z));

        private static Vector3d Max(in Vector3d a, in Vector3d b) =>
            new Vector3d(Math.Max(a.X, b.X), Math.Max(a.Y, b.Y), Math.Max(a.Z, b.Z));

        private static bool AreNear(in (Vector3d Low, Vector3d High) a, in (Vector3d Low, Vector3d High) b,
            double reach) =>
            a.Low.X - b.High.X < reach && b.Low.X - a.High.X < reach && a.Low.Y - b.High.Y < reach
            && b.Low.Y - a.High.Y < reach && a.Low.Z - b.High.Z < reach && b.Low.Z - a.High.Z < reach;

        // Whether a block and the next may turn so much that two of their elements meet.
        private bool MayBend(int block)
        {
            double turn = _turn[LastOf(Math.Min(block + 1, (_count - 1) / BlockSize))]
                - _turn[BlockSize * block];
            double chord = turn < Math.PI ? _shortest * Math.Cos(0.5 * turn) - _stretch : 0.0;
            return !(chord > 0.0 && _between * chord >= 2.0 * _thickest + _range + 2.0 * _stretch);
        }

        private void AddPairs(int a, int b)
        {
            if (BlockSize * b >= _count)
            {
                return;
            }
            for (int j = BlockSize * a; j <= LastOf(a); j++)
            {
                Vector3d middle = Vector3d.Lerp(_origin[j], _origin[j + 1], 0.5);
                double half = 0.5 * (_arc[j + 1] - _arc[j]);
                for (int k = Math.Max(BlockSize * b, j + 2); k <= LastOf(b); k++)
                {
                    double reach = _radius[j] + _radius[k] + _range
                        + Math.Min(_skin, (k - j + 1) * _stretch);
                    double near = reach + half + 0.5 * (_arc[k + 1] - _arc[k]);
                    if ((middle - Vector3d.Lerp(_origin[k], _origin[k + 1], 0.5)).LengthSquared < near * near
                        && IsPair(j, k) && ClosestPoints.SegmentSegment(_origin[j], _origin[j + 1], _origin[k],
                            _origin[k + 1], out _, out _) < reach * reach)
                    {
                        _pairs.Add(new Pair(j, k));
                    }
                }
            }
        }

        /// <summary>Two elements.</summary>
        internal readonly struct Pair : IComparable<Pair>
        {
            /// <summary>The lower one.</summary>
            public readonly int First;

            /// <summary>The higher one.</summary>
            public readonly int Second;

            /// <summary>Makes a pair.</summary>
            public Pair(int first, int second) => (First, Second) = (first, second);

            /// <inheritdoc/>
            public int CompareTo(Pair other) =>
                First != other.First ? First.CompareTo(other.First) : Second.CompareTo(other.Second);
        }
    }
}

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
}

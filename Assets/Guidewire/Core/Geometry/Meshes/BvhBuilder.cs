using System;

namespace Guidewire.Core
{
    /// <summary>Builds the hierarchy from the top: each node is cut where the sum over both sides of (surface of the
    /// box) times (number of triangles), an estimate of the cost of a search (surface area heuristic), is least among
    /// <see cref="Bins"/> - 1 planes across its longest edge.</summary>
    internal sealed class BvhBuilder
    {
        private const int LeafSize = 2;
        private const int Bins = 16;
        private readonly Vector3d[] _low;
        private readonly Vector3d[] _high;
        private readonly Vector3d[] _middle;
        private readonly int[] _order;
        private readonly BvhNode[] _nodes;
        private int _nodeCount = 1;

        private BvhBuilder(Vector3d[] corners)
        {
            int count = corners.Length / 3;
            _low = new Vector3d[count];
            _high = new Vector3d[count];
            _middle = new Vector3d[count];
            _order = new int[count];
            _nodes = new BvhNode[2 * count];
            for (int k = 0; k < count; k++)
            {
                _low[k] = BvhNode.Min(corners[3 * k], BvhNode.Min(corners[3 * k + 1], corners[3 * k + 2]));
                _high[k] = BvhNode.Max(corners[3 * k], BvhNode.Max(corners[3 * k + 1], corners[3 * k + 2]));
                _middle[k] = 0.5 * (_low[k] + _high[k]);
                _order[k] = k;
            }
        }

        /// <summary>The nodes, their boxes still unset, and the triangles in the order of the leaves.</summary>
        /// <exception cref="ArgumentException">There is no triangle.</exception>
        public static BvhNode[] Build(Vector3d[] corners, out int[] order)
        {
            if (corners.Length < 3)
            {
                throw new ArgumentException("a hierarchy needs at least one triangle");
            }
            var builder = new BvhBuilder(corners);
            builder.Divide(0, 0, corners.Length / 3);
            order = builder._order;
            var nodes = new BvhNode[builder._nodeCount];
            Array.Copy(builder._nodes, nodes, nodes.Length);
            return nodes;
        }

        // Recursion follows the smaller part and loops over the larger, so that its depth stays logarithmic.
        private void Divide(int node, int first, int count)
        {
            while (count > LeafSize)
            {
                int leftCount = Cut(first, count) - first;
                int children = _nodeCount;
                _nodeCount += 2;
                _nodes[node].First = children;
                _nodes[node].Count = 0;
                if (leftCount <= count - leftCount)
                {
                    Divide(children, first, leftCount);
                    node = children + 1;
                    first += leftCount;
                    count -= leftCount;
                }
                else
                {
                    Divide(children + 1, first + leftCount, count - leftCount);
                    node = children;
                    count = leftCount;
                }
            }
            _nodes[node].First = first;
            _nodes[node].Count = count;
        }

        private int Cut(int first, int count)
        {
            Vector3d low = _middle[_order[first]];
            Vector3d high = low;
            for (int k = first; k < first + count; k++)
            {
                low = BvhNode.Min(low, _middle[_order[k]]);
                high = BvhNode.Max(high, _middle[_order[k]]);
            }
            Vector3d size = high - low;
            int axis = size.X >= size.Y && size.X >= size.Z ? 0 : size.Y >= size.Z ? 1 : 2;
            double from = Component(low, axis);
            double width = Component(size, axis);
            int cut = width > 0.0 ? Partition(first, count, axis, from, width) : first;

            // Halves do where no plane divides them (all middles equal) and where a lopsided cut would let the tree
            // grow deeper than log(count)/log(4/3), for which the stack of a search is sized.
            int least = count / 4;
            return cut > first + least && cut < first + count - least ? cut : SplitHalf(first, count, axis);
        }

        private int Partition(int first, int count, int axis, double from, double width)
        {
            Span<int> counts = stackalloc int[Bins];
            var lows = new Vector3d[Bins];
            var highs = new Vector3d[Bins];
            for (int k = first; k < first + count; k++)
            {
                int t = _order[k];
                int bin = Bin(t, axis, from, width);
                lows[bin] = counts[bin] == 0 ? _low[t] : BvhNode.Min(lows[bin], _low[t]);
                highs[bin] = counts[bin] == 0 ? _high[t] : BvhNode.Max(highs[bin], _high[t]);
                counts[bin]++;
            }
            Span<double> costs = stackalloc double[Bins];
            AddCosts(counts, lows, highs, costs, forward: true);
            AddCosts(counts, lows, highs, costs, forward: false);
            int best = 1;
            for (int bin = 2; bin < Bins; bin++)
            {
                best = costs[bin] < costs[best] ? bin : best;
            }
            int next = first;
            for (int k = first; k < first + count; k++)
            {
                if (Bin(_order[k], axis, from, width) < best)
                {
                    (_order[next], _order[k]) = (_order[k], _order[next]);
                    next++;
                }
            }
            return next;
        }

        // costs[bin] is the cost of a cut between bin - 1 and bin: forward adds the part below, backward that above.
        private static void AddCosts(
            Span<int> counts, Vector3d[] lows, Vector3d[] highs, Span<double> costs, bool forward)
        {
            int total = 0;
            Vector3d low = default;
            Vector3d high = default;
            for (int i = 0; i < Bins - 1; i++)
            {
                int bin = forward ? i : Bins - 1 - i;
                if (counts[bin] > 0)
                {
                    low = total == 0 ? lows[bin] : BvhNode.Min(low, lows[bin]);
                    high = total == 0 ? highs[bin] : BvhNode.Max(high, highs[bin]);
                    total += counts[bin];
                }
                Vector3d e = high - low;
                costs[forward ? bin + 1 : bin] += total * (e.X * e.Y + e.Y * e.Z + e.Z * e.X);
            }
        }

        private int SplitHalf(int first, int count, int axis)
        {
            var keys = new double[count];
            for (int k = 0; k < count; k++)
            {
                keys[k] = Component(_middle[_order[first + k]], axis);
            }
            var part = new int[count];
            Array.Copy(_order, first, part, 0, count);
            Array.Sort(keys, part);
            Array.Copy(part, 0, _order, first, count);
            return first + count / 2;
        }

        private int Bin(int triangle, int axis, double from, double width)
        {
            return Math.Min(Bins - 1, (int)(Bins * ((Component(_middle[triangle], axis) - from) / width)));
        }

        private static double Component(in Vector3d v, int axis)
        {
            return axis == 0 ? v.X : axis == 1 ? v.Y : v.Z;
        }
    }
}

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
        private readonly Box[] _boxes; // moved as nodes are cut, so that those of a node stand side by side
        private readonly Vector3d[] _lows = new Vector3d[Bins];
        private readonly Vector3d[] _highs = new Vector3d[Bins];
        private readonly int[] _firstOf; // triangle or child, per node
        private readonly int[] _countOf; // triangles of a leaf, per node
        private int _nodeCount = 1;

        private BvhBuilder(Vector3d[] corners)
        {
            int count = corners.Length / 3;
            _boxes = new Box[count];
            _firstOf = new int[2 * count];
            _countOf = new int[2 * count];
            for (int k = 0; k < count; k++)
            {
                _boxes[k].Low = BvhNode.Min(corners[3 * k], BvhNode.Min(corners[3 * k + 1], corners[3 * k + 2]));
                _boxes[k].High = BvhNode.Max(corners[3 * k], BvhNode.Max(corners[3 * k + 1], corners[3 * k + 2]));
                _boxes[k].Triangle = k;
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
            order = Array.ConvertAll(builder._boxes, box => box.Triangle);
            var nodes = new BvhNode[builder._nodeCount];
            for (int i = 0; i < nodes.Length; i++)
            {
                nodes[i].First = builder._firstOf[i];
                nodes[i].Count = builder._countOf[i];
            }
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
                _firstOf[node] = children;
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
            _firstOf[node] = first;
            _countOf[node] = count;
        }

        private int Cut(int first, int count)
        {
            Vector3d low = _boxes[first].Middle;
            Vector3d high = low;
            for (int k = first; k < first + count; k++)
            {
                Vector3d middle = _boxes[k].Middle;
                low = BvhNode.Min(low, middle);
                high = BvhNode.Max(high, middle);
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
            for (int k = first; k < first + count; k++)
            {
                ref readonly Box box = ref _boxes[k];
                int bin = Bin(box, axis, from, width);
                _lows[bin] = counts[bin] == 0 ? box.Low : BvhNode.Min(_lows[bin], box.Low);
                _highs[bin] = counts[bin] == 0 ? box.High : BvhNode.Max(_highs[bin], box.High);
                counts[bin]++;
            }
            Span<double> costs = stackalloc double[Bins];
            AddCosts(counts, costs, forward: true);
            AddCosts(counts, costs, forward: false);
            int best = 1;
            for (int bin = 2; bin < Bins; bin++)
            {
                best = costs[bin] < costs[best] ? bin : best;
            }
            int next = first;
            for (int k = first; k < first + count; k++)
            {
                if (Bin(_boxes[k], axis, from, width) < best)
                {
                    (_boxes[next], _boxes[k]) = (_boxes[k], _boxes[next]);
                    next++;
                }
            }
            return next;
        }

        // costs[bin] is the cost of a cut between bin - 1 and bin: forward adds the part below, backward that above.
        private void AddCosts(Span<int> counts, Span<double> costs, bool forward)
        {
            int total = 0;
            Vector3d low = default;
            Vector3d high = default;
            for (int i = 0; i < Bins - 1; i++)
            {
                int bin = forward ? i : Bins - 1 - i;
                if (counts[bin] > 0)
                {
                    low = total == 0 ? _lows[bin] : BvhNode.Min(low, _lows[bin]);
                    high = total == 0 ? _highs[bin] : BvhNode.Max(high, _highs[bin]);
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
                keys[k] = Component(_boxes[first + k].Middle, axis);
            }
            var part = new Box[count];
            Array.Copy(_boxes, first, part, 0, count);
            Array.Sort(keys, part);
            Array.Copy(part, 0, _boxes, first, count);
            return first + count / 2;
        }

        private static int Bin(in Box box, int axis, double from, double width) =>
            Math.Min(Bins - 1, (int)(Bins * ((Component(box.Middle, axis) - from) / width)));

        private static double Component(in Vector3d v, int axis) => axis == 0 ? v.X : axis == 1 ? v.Y : v.Z;

        // Around a triangle, units.
        private struct Box
        {
            public Vector3d Low;
            public Vector3d High;
            public int Triangle;

            public readonly Vector3d Middle => 0.5 * (Low + High);
        }
    }
}

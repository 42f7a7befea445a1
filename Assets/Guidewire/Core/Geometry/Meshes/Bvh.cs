using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Bounding volume hierarchy over triangles: a binary tree of boxes, built once and refitted when the
    /// triangles move. Flat arrays; a query allocates nothing.</summary>
    internal sealed class Bvh
    {
        private const int StackSize = 96;
        private const int LargestPatch = 64;   // triangles: more of them are not flat enough for a slab of their own
        private const double RoundedUp = 1.0 + 1e-9;
        private readonly BvhNode[] _nodes;
        private readonly int[] _order;
        private readonly int[] _leaf;          // node that holds a triangle, per triangle
        private readonly Vector3d[] _corners;
        private readonly Vector3d[]? _givenNormals;
        private readonly Vector3d[] _normals;  // sum of its triangles' area vectors, per node
        private readonly int[] _from;          // first of its triangles, per node
        private readonly int[] _count;         // number of its triangles, per node
        private readonly StructList<int> _found = new StructList<int>(64);    // leaves
#if NET8_0_OR_GREATER
        private WideBvh? _wide;
#endif

        /// <summary>The tree over triangles 0 to corners.Length/3 - 1, three corners each, in units.</summary>
        /// <param name="normals">One a triangle, whose sums the slabs lie across; null: the triangles' own. Those of no
        /// area, such as edges, have none.</param>
        public Bvh(Vector3d[] corners, Vector3d[]? normals = null)
        {
            _givenNormals = normals;
            _nodes = BvhBuilder.Build(corners, out _order);
            _corners = new Vector3d[corners.Length];
            _normals = new Vector3d[_nodes.Length];
            _from = new int[_nodes.Length];
            _count = new int[_nodes.Length];
            _leaf = new int[_order.Length];
            for (int i = 0; i < _nodes.Length; i++)
            {
                BvhNode node = _nodes[i];
                if (node.Count > 0)
                {
                    for (int k = node.First; k < node.First + node.Count; k++)
                    {
                        _leaf[_order[k]] = i;
                    }
                }
                else
                {
                    _nodes[node.First].Parent = i;
                    _nodes[node.First + 1].Parent = i;
                }
            }
            Refit(corners);
        }

        private Bvh(Bvh other, Vector3d[] corners, Vector3d[]? normals)
        {
            _givenNormals = normals;
            _nodes = (BvhNode[])other._nodes.Clone();
            (_order, _leaf) = (other._order, other._leaf);
            _corners = new Vector3d[corners.Length];
            _normals = new Vector3d[_nodes.Length];
            _from = new int[_nodes.Length];
            _count = new int[_nodes.Length];
            Refit(corners);
#if NET8_0_OR_GREATER
            _wide = WideBvh.IsSupported ? new WideBvh(other.Wide, _nodes) : null;
#endif
        }

        /// <summary>A tree of the same topology over the same triangles elsewhere; both may be queried at
        /// once.</summary>
        /// <param name="corners">Three a triangle, units.</param>
        /// <param name="normals">As of the constructor.</param>
        public Bvh Over(Vector3d[] corners, Vector3d[]? normals = null) => new Bvh(this, corners, normals);

        /// <summary>All triangles, those of a node one after another.</summary>
        public int[] Order => _order;

        /// <summary>Takes over new corners of the same triangles; the topology of the tree stays.</summary>
        public void Refit(Vector3d[] corners)
        {
            for (int k = 0; k < _order.Length; k++)
            {
                Array.Copy(corners, 3 * _order[k], _corners, 3 * k, 3);
            }

            // Children stand behind their parent, so the last node comes first.
            for (int i = _nodes.Length - 1; i >= 0; i--)
            {
                ref BvhNode node = ref _nodes[i];
                if (node.Count > 0)
                {
                    node.Enclose(_corners, 3 * node.First, 3 * node.Count);
                    _from[i] = node.First;
                    _count[i] = node.Count;
                    _normals[i] = SumOfAreas(node.First, node.Count);
                }
                else
                {
                    int left = node.First;
                    node.Enclose(_nodes[left], _nodes[left + 1]);
                    _from[i] = Math.Min(_from[left], _from[left + 1]);
                    _count[i] = _count[left] + _count[left + 1];
                    _normals[i] = _normals[left] + _normals[left + 1];
                }
                if (_count[i] <= LargestPatch)
                {
                    node.EncloseSlab(_normals[i], _corners, 3 * _from[i], 3 * _count[i]);
                }
                else
                {
                    node.EncloseSlabOfBox(_normals[i]);
                }
            }
#if NET8_0_OR_GREATER
            _wide?.Refit(_nodes);
#endif
        }

        /// <summary>Whether a point lies in the box around all triangles.</summary>
        public bool Encloses(in Vector3d point)
        {
            ref readonly BvhNode all = ref _nodes[0];
            return Math.Abs(point.X - all.Centre.X) <= all.Extent.X && Math.Abs(point.Y - all.Centre.Y) <= all.Extent.Y
                && Math.Abs(point.Z - all.Centre.Z) <= all.Extent.Z;
        }

        /// <summary>Triangle nearest to segment a b among those within <paramref name="range"/>, -1 if there is none,
        /// with the closest points and the squared distance. <paramref name="hint"/>: a triangle that may be near,
        /// -1 for none.</summary>
        public int Nearest(
            in Vector3d a, in Vector3d b, double range, int hint,
            out double squared, out double s, out Vector3d point, out int feature)
        {
            var search = new SegmentSearch(a, b, range);
            if (hint < 0)
            {
                Descend(0, ref search);
            }
            else
            {
                // From the hint's leaf up: what is nearest is found first, and each level costs one test of the branch
                // that is not yet searched.
                int node = _leaf[hint];
                TestLeaf(_nodes[node], ref search);
                while (node > 0)
                {
                    int sibling = ((node - 1) ^ 1) + 1;
                    ref readonly BvhNode other = ref _nodes[sibling];
                    if (search.MayHold(other, out _))
                    {
                        Descend(sibling, ref search);
                    }
                    node = other.Parent;
                }
            }
            squared = search.Squared;
            s = search.S;
            point = search.Point;
            feature = search.Feature;
            return search.Slot < 0 ? -1 : _order[search.Slot];
        }

        /// <summary>Adds every triangle within <paramref name="range"/> of segment a b, and perhaps some that are a
        /// little farther.</summary>
        public void Within(in Vector3d a, in Vector3d b, double range, StructList<int> triangles)
        {
            FindLeaves(a, b, range);
            AddTriangles(triangles);
        }

        /// <summary>Adds every triangle that a moving segment may come near to, and perhaps some others.</summary>
        public void Within(in SweptSegment swept, StructList<int> triangles)
        {
            FindLeaves(swept);
            AddTriangles(triangles);
        }

        /// <summary>False where surely no triangle comes within the distance of a moving segment.</summary>
        public bool MayMeet(in SweptSegment swept)
        {
            FindLeaves(swept);
            double squared = SegmentSearch.Square(swept.Range);
            for (int i = 0; i < _found.Count; i++)
            {
                ref readonly BvhNode leaf = ref _nodes[_found[i]];
                for (int k = leaf.First; k < leaf.First + leaf.Count; k++)
                {
                    if (MayMeet(swept, k, squared))
                    {
                        return true;
                    }
                }
            }
            return false;
        }

        private void AddTriangles(StructList<int> triangles)
        {
            for (int i = 0; i < _found.Count; i++)
            {
                ref readonly BvhNode leaf = ref _nodes[_found[i]];
                for (int k = leaf.First; k < leaf.First + leaf.Count; k++)
                {
                    triangles.Add(_order[k]);
                }
            }
        }

        // The leaves that may hold what is within a range of a segment.
        private void FindLeaves(in Vector3d a, in Vector3d b, double range)
        {
            _found.Clear();
#if NET8_0_OR_GREATER
            if (WideBvh.IsSupported)
            {
                Wide.Collect(new SegmentBoundsTest(a, b, range, Wide), _found);
                return;
            }
#endif
            FindLeaves(new SegmentSearch(a, b, range));
        }

        // The same for what a moving segment may come near to.
        private void FindLeaves(in SweptSegment swept)
        {
            _found.Clear();
#if NET8_0_OR_GREATER
            if (WideBvh.IsSupported)
            {
                Wide.Collect(new SweptBoundsTest(swept, Wide), _found);
                return;
            }
#endif
            FindLeaves(swept, new SegmentSearch(swept.A0, swept.B0, swept.Range));
        }

        private void FindLeaves(in SegmentSearch search)
        {
            Span<int> stack = stackalloc int[StackSize];
            int depth = 0;
            stack[depth++] = 0;
            while (depth > 0)
            {
                int current = stack[--depth];
                ref readonly BvhNode node = ref _nodes[current];
                if (search.MayHold(node, out _))
                {
                    Push(current, node, stack, ref depth);
                }
            }
        }

        private void FindLeaves(in SweptSegment swept, in SegmentSearch search)
        {
            Span<int> stack = stackalloc int[StackSize];
            int depth = 0;
            stack[depth++] = 0;
            while (depth > 0)
            {
                int current = stack[--depth];
                ref readonly BvhNode node = ref _nodes[current];
                if (swept.MayMeet(node) && search.MayHold(node, out _))
                {
                    Push(current, node, stack, ref depth);
                }
            }
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private void Push(int current, in BvhNode node, Span<int> stack, ref int depth)
        {
            if (node.Count > 0)
            {
                _found.Add(current);
                return;
            }
            stack[depth++] = node.First;
            stack[depth++] = node.First + 1;
        }

#if NET8_0_OR_GREATER
        private WideBvh Wide => _wide ??= new WideBvh(_nodes);
#endif

        private bool MayMeet(in SweptSegment swept, int slot, double squaredRange)
        {
            ref readonly Vector3d v0 = ref _corners[3 * slot];
            ref readonly Vector3d v1 = ref _corners[3 * slot + 1];
            ref readonly Vector3d v2 = ref _corners[3 * slot + 2];
            return !SegmentImpact.StaysOnOneSide(
                    swept.A0, swept.B0, swept.A1, swept.B1, v0, v1, v2, swept.Border)
                && ClosestPoints.SegmentTriangle(swept.A0, swept.B0, v0, v1, v2, squaredRange, out _, out _, out _)
                    <= squaredRange;
        }

        // The call goes to the nearer child, the loop to the other: no list of what is left to do has to be cleared
        // for a search that mostly ends after a few nodes.
        private void Descend(int current, ref SegmentSearch search)
        {
            while (true)
            {
                ref readonly BvhNode node = ref _nodes[current];
                if (node.Count > 0)
                {
                    TestLeaf(node, ref search);
                    return;
                }
                int left = node.First;
                bool goLeft = search.MayHold(_nodes[left], out double boundLeft);
                bool goRight = search.MayHold(_nodes[left + 1], out double boundRight);
                if (goLeft && goRight)
                {
                    bool leftFirst = search.Order(_nodes[left]) <= search.Order(_nodes[left + 1]);
                    Descend(leftFirst ? left : left + 1, ref search);
                    if ((leftFirst ? boundRight : boundLeft) > search.Squared)
                    {
                        return;
                    }
                    current = leftFirst ? left + 1 : left;
                }
                else if (goLeft || goRight)
                {
                    current = goLeft ? left : left + 1;
                }
                else
                {
                    return;
                }
            }
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private void TestLeaf(in BvhNode leaf, ref SegmentSearch search)
        {
            for (int k = leaf.First; k < leaf.First + leaf.Count; k++)
            {
                TestTriangle(k, ref search);
            }
        }

        /// <summary>Fraction of the motion of segment a b during which it stays at least <paramref name="clearance"/>
        /// from every triangle, <see cref="ContactShape.NoImpact"/> for all of it. <paramref name="hint"/>: a triangle
        /// that may be near, -1 for none.</summary>
        /// <remarks>After an impact is found, only what the segment may meet before then is tested.</remarks>
        public double TimeOfImpact(
            in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double clearance, double resolution,
            int hint)
        {
            var swept = new SweptSegment(a0, b0, a1, b1, clearance);
            double impact = ContactShape.NoImpact;
            double motion = swept.Motion;
            var search = new SegmentSearch(a0, b0, swept.Range);
            if (hint >= 0)
            {
                ImpactWithLeaf(_nodes[_leaf[hint]], a0, b0, a1, b1, clearance, resolution, motion, ref search,
                    ref impact);
            }
            Span<int> stack = stackalloc int[StackSize];
            int depth = 0;
            stack[depth++] = 0;
            while (depth > 0)
            {
                ref readonly BvhNode node = ref _nodes[stack[--depth]];
                if (!swept.MayMeet(node) || !search.MayHold(node, out _))
                {
                    continue;
                }
                if (node.Count == 0)
                {
                    stack[depth++] = node.First;
                    stack[depth++] = node.First + 1;
                    continue;
                }
                ImpactWithLeaf(node, a0, b0, a1, b1, clearance, resolution, motion, ref search, ref impact);
            }
            return impact;
        }

        private void ImpactWithLeaf(
            in BvhNode leaf, in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double clearance,
            double resolution, double motion, ref SegmentSearch search, ref double impact)
        {
            for (int k = leaf.First; k < leaf.First + leaf.Count; k++)
            {
                double time = SegmentImpact.WithTriangle(_corners[3 * k], _corners[3 * k + 1], _corners[3 * k + 2],
                    a0, b0, a1, b1, clearance, resolution, motion, ref impact);
                if (time < ContactShape.NoImpact)
                {
                    double range = RoundedUp * (clearance + time * motion);
                    search.Squared = range * range;
                }
            }
        }

        private Vector3d SumOfAreas(int first, int count)
        {
            Vector3d sum = Vector3d.Zero;
            if (_givenNormals != null)
            {
                for (int k = first; k < first + count; k++)
                {
                    sum += _givenNormals[_order[k]];
                }
                return sum;
            }
            for (int k = 3 * first; k < 3 * (first + count); k += 3)
            {
                sum += Vector3d.Cross(_corners[k + 1] - _corners[k], _corners[k + 2] - _corners[k]);
            }
            return sum;
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private void TestTriangle(int slot, ref SegmentSearch search)
        {
            double s = 0.0;
            double squared = search.IsPoint
                ? ClosestPoints.PointTriangle(
                    search.A, _corners[3 * slot], _corners[3 * slot + 1], _corners[3 * slot + 2],
                    out Vector3d point, out int feature)
                : ClosestPoints.SegmentTriangle(
                    search.A, search.B, _corners[3 * slot], _corners[3 * slot + 1], _corners[3 * slot + 2],
                    search.Squared, out s, out point, out feature);
            if (squared < search.Squared)
            {
                search.Accept(squared, slot, s, point, feature);
            }
        }
    }

    /// <summary>A box of the hierarchy, with the slab between two planes across the mean normal of its triangles: a
    /// patch of wall is nearly flat, so the slab is thinner than any box or ball around it.</summary>
    internal struct BvhNode
    {
        /// <summary>Middle of the box.</summary>
        public Vector3d Centre;

        /// <summary>Half the box's edges.</summary>
        public Vector3d Extent;

        /// <summary>Mean normal of the triangles, 0 where they have none.</summary>
        public Vector3d Normal;

        /// <summary>Least Normal.x over the triangles.</summary>
        public double Low;

        /// <summary>Largest Normal.x over the triangles.</summary>
        public double High;

        /// <summary>First triangle of a leaf; else the first of two children, which stand side by side.</summary>
        public int First;

        /// <summary>Triangles of a leaf; 0 for a node with children.</summary>
        public int Count;

        /// <summary>The node that this one is a child of; 0 for the first node itself.</summary>
        public int Parent;

        /// <summary>Makes the box hold <paramref name="count"/> points.</summary>
        public void Enclose(Vector3d[] points, int first, int count)
        {
            Vector3d low = points[first];
            Vector3d high = low;
            for (int k = first + 1; k < first + count; k++)
            {
                low = Min(low, points[k]);
                high = Max(high, points[k]);
            }
            Set(low, high);
        }

        /// <summary>Makes the box hold two others.</summary>
        public void Enclose(in BvhNode left, in BvhNode right)
        {
            Set(
                Min(left.Centre - left.Extent, right.Centre - right.Extent),
                Max(left.Centre + left.Extent, right.Centre + right.Extent));
        }

        /// <summary>Makes the box hold a moving segment and all within a distance of it.</summary>
        public void EncloseSwept(
            in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double distance)
        {
            var border = new Vector3d(distance, distance, distance);
            Set(Min(Min(a0, b0), Min(a1, b1)) - border, Max(Max(a0, b0), Max(a1, b1)) + border);
        }

        /// <summary>Makes the slab hold <paramref name="count"/> points.</summary>
        public void EncloseSlab(in Vector3d normal, Vector3d[] points, int first, int count)
        {
            Normal = Vector3d.Normalize(normal);
            Low = double.PositiveInfinity;
            High = double.NegativeInfinity;
            for (int k = first; k < first + count; k++)
            {
                double height = Vector3d.Dot(Normal, points[k]);
                Low = Math.Min(Low, height);
                High = Math.Max(High, height);
            }
            double border = 1e-15 * (Centre.Length + Extent.Length);
            Low -= border;
            High += border;
        }

        /// <summary>Makes the slab hold all of the box.</summary>
        public void EncloseSlabOfBox(in Vector3d normal)
        {
            Normal = Vector3d.Normalize(normal);
            double middle = Vector3d.Dot(Normal, Centre);
            double half = Math.Abs(Normal.X) * Extent.X + Math.Abs(Normal.Y) * Extent.Y
                + Math.Abs(Normal.Z) * Extent.Z + 1e-15 * (Centre.Length + Extent.Length);
            Low = middle - half;
            High = middle + half;
        }

        /// <summary>Is true where two boxes share a point.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly bool Overlaps(in BvhNode other)
        {
            return Math.Abs(Centre.X - other.Centre.X) <= Extent.X + other.Extent.X
                && Math.Abs(Centre.Y - other.Centre.Y) <= Extent.Y + other.Extent.Y
                && Math.Abs(Centre.Z - other.Centre.Z) <= Extent.Z + other.Extent.Z;
        }

        public static Vector3d Min(in Vector3d a, in Vector3d b) =>
            new Vector3d(Math.Min(a.X, b.X), Math.Min(a.Y, b.Y), Math.Min(a.Z, b.Z));

        public static Vector3d Max(in Vector3d a, in Vector3d b) =>
            new Vector3d(Math.Max(a.X, b.X), Math.Max(a.Y, b.Y), Math.Max(a.Z, b.Z));

        // Middle and half edge round; the border of some units in the last place makes up for it, or a triangle that
        // fills its box could be left out of a search.
        private void Set(in Vector3d low, in Vector3d high)
        {
            Centre = 0.5 * (low + high);
            Vector3d size = Max(Max(low, high), Max(-low, -high));
            Extent = 0.5 * (high - low) + 1e-15 * size;
        }
    }
}

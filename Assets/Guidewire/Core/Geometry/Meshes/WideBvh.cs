#if NET8_0_OR_GREATER
using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;

namespace Guidewire.Core
{
    /// <summary>A test by which a search leaves out children of a <see cref="WideBvh"/>, eight at a time.</summary>
    internal interface IBoundsTest
    {
        /// <summary>Which of eight children may hold what is sought, one bit each.</summary>
        /// <param name="bounds">The first of the numbers of their common node: centre, extent, normal, low, high, of
        /// each eight.</param>
        uint MayHold(ref float bounds);
    }

    /// <summary>The hierarchy of a <see cref="Bvh"/> with eight children a node, whose boxes and slabs are tested at
    /// once, in single precision: of three levels of the binary tree two are left out.</summary>
    /// <remarks>Leaves are met in the order of the binary tree. Of two slabs, one within the other's triangles, neither
    /// lies in the other: so a search may also meet leaves that the levels left out would have excluded, and those that
    /// are farther by what is rounded, never fewer. Coordinates count from the middle of all, which keeps their
    /// digits.</remarks>
    internal sealed class WideBvh
    {
        private const int Lanes = 8;
        private const int Levels = 3;               // of the binary tree, from a node to its children
        private const int Fields = 11;              // centre, extent, normal, low, high
        private const int Stride = Lanes * Fields;
        private const int StackSize = 256;

        // A gap or a height is a sum of less than 30 terms and roundings, each of half a unit in the last place, 2^-24
        // of the largest length in it.
        private const double Rounding = 4e-6;
        private const double OfOrigin = 1e-14;
        private readonly float[] _bounds;           // by node, field and child
        private readonly int[] _child;              // by node and child: a node, or -1 - the binary leaf
        private readonly int[] _source;             // by node and child: the binary node, -1 where there is none
        private readonly int[] _stack = new int[StackSize];    // of a search: a local one would be cleared each time
        private double _slack;                      // of what is at the origin, units

        /// <summary>Makes the same tree as that of binary nodes, children side by side behind their parent.</summary>
        public WideBvh(BvhNode[] nodes)
        {
            int most = nodes.Length / 2 + 1; // binary nodes with children, at least the root
            var source = new int[Lanes * most];
            var child = new int[Lanes * most];
            var root = new int[most];    // the binary node of a node
            Span<int> children = stackalloc int[Lanes];
            int count = 1;
            for (int node = 0; node < count; node++)
            {
                int filled = Children(nodes, root[node], children);
                for (int k = 0; k < Lanes; k++)
                {
                    int binary = k < filled ? children[k] : -1;
                    source[Lanes * node + k] = binary;
                    if (binary >= 0 && nodes[binary].Count == 0)
                    {
                        root[count] = binary;
                        child[Lanes * node + k] = count++;
                    }
                    else
                    {
                        child[Lanes * node + k] = -1 - binary;
                    }
                }
            }
            _source = source.AsSpan(0, Lanes * count).ToArray();
            _child = child.AsSpan(0, Lanes * count).ToArray();
            _bounds = new float[Stride * count];
            Refit(nodes);
        }

        /// <summary>Makes the tree of binary nodes that stand elsewhere, of the same topology as another
        /// one's.</summary>
        public WideBvh(WideBvh other, BvhNode[] nodes)
        {
            (_source, _child) = (other._source, other._child);
            _bounds = new float[other._bounds.Length];
            Refit(nodes);
        }

        /// <summary>Whether the processor computes with such registers.</summary>
        public static bool IsSupported => Avx2.IsSupported;

        /// <summary>The point from which coordinates count, the middle of all, units.</summary>
        public Vector3d Origin { get; private set; }

        /// <summary>What sums of lengths may be off by, units.</summary>
        /// <param name="distance">The largest of what is compared with nodes, from the origin, units.</param>
        public double Slack(double distance) => Rounding * distance + _slack;

        /// <summary>Gives the upper bound of a vector's length, without a square root.</summary>
        public static double LengthBound(in Vector3d of) => Math.Abs(of.X) + Math.Abs(of.Y) + Math.Abs(of.Z);

        /// <summary>Takes over the boxes and slabs of the binary nodes.</summary>
        public void Refit(BvhNode[] nodes)
        {
            Origin = nodes[0].Centre;
            _slack = Rounding * nodes[0].Extent.Length + OfOrigin * Origin.Length;
            for (int k = 0; k < _source.Length; k++)
            {
                Span<float> lane = _bounds.AsSpan(Stride * (k / Lanes) + k % Lanes);
                BvhNode node = _source[k] >= 0 ? nodes[_source[k]]
                    : new BvhNode { Centre = Origin, Low = double.PositiveInfinity, High = double.NegativeInfinity };
                double middle = Vector3d.Dot(node.Normal, Origin);
                Put(lane, 0, node.Centre - Origin);
                Put(lane, 3, node.Extent);
                Put(lane, 6, node.Normal);
                lane[9 * Lanes] = (float)(node.Low - middle);
                lane[10 * Lanes] = (float)(node.High - middle);
            }
        }

        /// <summary>Adds the numbers of all binary leaves that a test does not exclude.</summary>
        public void Collect<TTest>(in TTest test, StructList<int> leaves)
            where TTest : struct, IBoundsTest
        {
            int[] stack = _stack;
            int[] children = _child;
            int depth = 0;
            stack[depth++] = 0;
            ref float bounds = ref MemoryMarshal.GetArrayDataReference(_bounds);
            while (depth > 0)
            {
                int node = stack[--depth];
                if (node < 0)
                {
                    leaves.Add(-1 - node);
                    continue;
                }
                uint hits = test.MayHold(ref Unsafe.Add(ref bounds, Stride * node));
                for (; hits != 0; hits &= hits - 1)
                {
                    stack[depth++] = children[Lanes * node + BitOperations.TrailingZeroCount(hits)];
                }
            }
        }

        // Up to eight descendants of a binary node that together hold all its triangles, in the order of the tree.
        private static int Children(BvhNode[] nodes, int binary, Span<int> children)
        {
            Span<int> above = stackalloc int[Lanes];
            children[0] = binary;
            int filled = 1;
            for (int level = 0; level < Levels; level++)
            {
                children.Slice(0, filled).CopyTo(above);
                int count = filled;
                filled = 0;
                for (int k = 0; k < count; k++)
                {
                    BvhNode node = nodes[above[k]];
                    children[filled++] = node.Count > 0 ? above[k] : node.First;
                    if (node.Count == 0)
                    {
                        children[filled++] = node.First + 1;
                    }
                }
            }
            return filled;
        }

        private static void Put(Span<float> lane, int field, in Vector3d value)
        {
            lane[field * Lanes] = (float)value.X;
            lane[(field + 1) * Lanes] = (float)value.Y;
            lane[(field + 2) * Lanes] = (float)value.Z;
        }
    }

    /// <summary><see cref="SegmentSearch.MayHold"/> for eight children of a node at once, with a range that makes up
    /// for rounding.</summary>
    internal readonly struct SegmentBoundsTest : IBoundsTest
    {
        private const double OfSquare = 1.0 + 1e-6;    // the rounding of a sum of three squares
        private readonly float _middleX;
        private readonly float _middleY;
        private readonly float _middleZ;
        private readonly float _halfX;
        private readonly float _halfY;
        private readonly float _halfZ;
        private readonly float _squared;

        /// <summary>Tests for what is within a range of segment a b, units.</summary>
        public SegmentBoundsTest(in Vector3d a, in Vector3d b, double range, WideBvh tree)
        {
            Vector3d half = 0.5 * (b - a);
            Vector3d middle = 0.5 * (a + b) - tree.Origin;
            range += tree.Slack(WideBvh.LengthBound(middle) + WideBvh.LengthBound(half));
            _middleX = (float)middle.X;
            _middleY = (float)middle.Y;
            _middleZ = (float)middle.Z;
            _halfX = (float)half.X;
            _halfY = (float)half.Y;
            _halfZ = (float)half.Z;
            _squared = (float)(OfSquare * range * range);
        }

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public uint MayHold(ref float bounds)
        {
            Vector256<float> zero = Vector256<float>.Zero;
            Vector256<float> middleX = Vector256.Create(_middleX);
            Vector256<float> middleY = Vector256.Create(_middleY);
            Vector256<float> middleZ = Vector256.Create(_middleZ);
            Vector256<float> halfX = Vector256.Create(_halfX);
            Vector256<float> halfY = Vector256.Create(_halfY);
            Vector256<float> halfZ = Vector256.Create(_halfZ);
            Vector256<float> gapX = Avx.Max(zero, Vector256.Abs(middleX - Bounds(ref bounds, 0))
                - (Bounds(ref bounds, 3) + Vector256.Abs(halfX)));
            Vector256<float> gapY = Avx.Max(zero, Vector256.Abs(middleY - Bounds(ref bounds, 1))
                - (Bounds(ref bounds, 4) + Vector256.Abs(halfY)));
            Vector256<float> gapZ = Avx.Max(zero, Vector256.Abs(middleZ - Bounds(ref bounds, 2))
                - (Bounds(ref bounds, 5) + Vector256.Abs(halfZ)));
            Vector256<float> normalX = Bounds(ref bounds, 6);
            Vector256<float> normalY = Bounds(ref bounds, 7);
            Vector256<float> normalZ = Bounds(ref bounds, 8);
            Vector256<float> middle = normalX * middleX + normalY * middleY + normalZ * middleZ;
            Vector256<float> half = Vector256.Abs(normalX * halfX + normalY * halfY + normalZ * halfZ);
            Vector256<float> slab = Avx.Max(zero, Avx.Max(
                middle - Bounds(ref bounds, 10), Bounds(ref bounds, 9) - middle) - half);
            Vector256<float> least = Avx.Max(gapX * gapX + gapY * gapY + gapZ * gapZ, slab * slab);
            return (uint)Avx.MoveMask(Vector256.LessThan(least, Vector256.Create(_squared)));
        }

        /// <summary>Gives a field of eight children.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector256<float> Bounds(ref float bounds, int field) =>
            Vector256.LoadUnsafe(ref Unsafe.Add(ref bounds, 8 * field));
    }

    /// <summary><see cref="SweptSegment.MayMeet"/> for eight children of a node at once, and by the segment where it
    /// starts <see cref="SegmentSearch.MayHold"/>, with distances that make up for rounding.</summary>
    internal readonly struct SweptBoundsTest : IBoundsTest
    {
        private readonly SegmentBoundsTest _start;
        private readonly Point _a0;
        private readonly Point _b0;
        private readonly Point _a1;
        private readonly Point _b1;
        private readonly Point _centre;
        private readonly Point _extent;
        private readonly float _border;

        /// <summary>Tests for what a moving segment may come near to.</summary>
        public SweptBoundsTest(in SweptSegment swept, WideBvh tree)
        {
            _start = new SegmentBoundsTest(swept.A0, swept.B0, swept.Range, tree);
            _a0 = new Point(swept.A0 - tree.Origin);
            _b0 = new Point(swept.B0 - tree.Origin);
            _a1 = new Point(swept.A1 - tree.Origin);
            _b1 = new Point(swept.B1 - tree.Origin);
            Vector3d centre = swept.Centre - tree.Origin;
            double slack = tree.Slack(WideBvh.LengthBound(centre) + WideBvh.LengthBound(swept.Extent));
            _centre = new Point(centre);
            _extent = new Point(swept.Extent + new Vector3d(slack, slack, slack));
            _border = (float)(swept.Border + slack);
        }

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public uint MayHold(ref float bounds)
        {
            Vector256<float> overlaps =
                Overlaps(ref bounds, 0, _centre.X, _extent.X) & Overlaps(ref bounds, 1, _centre.Y, _extent.Y)
                & Overlaps(ref bounds, 2, _centre.Z, _extent.Z);
            uint hits = (uint)Avx.MoveMask(overlaps);
            return hits == 0 ? 0 : hits & _start.MayHold(ref bounds) & ~IsInRange(ref bounds);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private uint IsInRange(ref float bounds)
        {
            Vector256<float> w = Height(ref bounds, _a0);
            Vector256<float> x = Height(ref bounds, _b0);
            Vector256<float> y = Height(ref bounds, _a1);
            Vector256<float> z = Height(ref bounds, _b1);
            Vector256<float> border = Vector256.Create(_border);
            Vector256<float> least = Avx.Min(Avx.Min(w, x), Avx.Min(y, z));
            Vector256<float> most = Avx.Max(Avx.Max(w, x), Avx.Max(y, z));
            return (uint)Avx.MoveMask(Vector256.GreaterThan(least, SegmentBoundsTest.Bounds(ref bounds, 10) + border)
                | Vector256.LessThan(most, SegmentBoundsTest.Bounds(ref bounds, 9) - border));
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector256<float> Overlaps(ref float bounds, int axis, float centre, float extent)
        {
            return Vector256.LessThanOrEqual(
                Vector256.Abs(Vector256.Create(centre) - SegmentBoundsTest.Bounds(ref bounds, axis)),
                Vector256.Create(extent) + SegmentBoundsTest.Bounds(ref bounds, axis + 3));
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector256<float> Height(ref float bounds, in Point x)
        {
            return SegmentBoundsTest.Bounds(ref bounds, 6) * Vector256.Create(x.X)
                + SegmentBoundsTest.Bounds(ref bounds, 7) * Vector256.Create(x.Y)
                + SegmentBoundsTest.Bounds(ref bounds, 8) * Vector256.Create(x.Z);
        }

        private readonly struct Point
        {
            public readonly float X;
            public readonly float Y;
            public readonly float Z;

            public Point(in Vector3d x)
            {
                X = (float)x.X;
                Y = (float)x.Y;
                Z = (float)x.Z;
            }
        }
    }
}
#endif

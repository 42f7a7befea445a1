#if NET8_0_OR_GREATER
using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;

namespace Guidewire.Core
{
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
}
#endif

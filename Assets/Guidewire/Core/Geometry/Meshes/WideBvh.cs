#if NET8_0_OR_GREATER
using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;

namespace Guidewire.Core
{
    /// <summary>The hierarchy of a <see cref="Bvh"/> with four children a node, whose boxes and slabs are tested at
    /// once: every other level of the binary tree is left out.</summary>
    /// <remarks>Leaves are met in the order of the binary tree. Of two slabs, one within the other's triangles, neither
    /// lies in the other: so a search may also meet leaves that the levels left out would have excluded, never
    /// fewer.</remarks>
    internal sealed class WideBvh
    {
        private const int Lanes = 4;
        private const int Fields = 11;              // centre, extent, normal, low, high
        private const int Stride = Lanes * Fields;
        private const int StackSize = 192;
        private readonly double[] _bounds;          // by node, field and child
        private readonly int[] _child;              // by node and child: a node, or -1 - the binary leaf
        private readonly int[] _source;             // by node and child: the binary node, -1 where there is none

        /// <summary>The same tree as that of binary nodes, children side by side behind their parent.</summary>
        public WideBvh(BvhNode[] nodes)
        {
            int most = nodes.Length;
            var source = new int[Lanes * most];
            var child = new int[Lanes * most];
            var root = new int[most];    // the binary node of a node
            Span<int> four = stackalloc int[Lanes];
            int count = 1;
            for (int node = 0; node < count; node++)
            {
                int filled = Children(nodes, root[node], four);
                for (int k = 0; k < Lanes; k++)
                {
                    int binary = k < filled ? four[k] : -1;
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
            _bounds = new double[Stride * count];
            Refit(nodes);
        }

        /// <summary>Whether the processor computes with such registers.</summary>
        public static bool IsSupported => Avx2.IsSupported;

        /// <summary>Takes over the boxes and slabs of the binary nodes.</summary>
        public void Refit(BvhNode[] nodes)
        {
            for (int k = 0; k < _source.Length; k++)
            {
                Span<double> lane = _bounds.AsSpan(Stride * (k / Lanes) + k % Lanes);
                BvhNode node = _source[k] >= 0 ? nodes[_source[k]]
                    : new BvhNode { Low = double.PositiveInfinity, High = double.NegativeInfinity };
                Put(lane, 0, node.Centre);
                Put(lane, 3, node.Extent);
                Put(lane, 6, node.Normal);
                lane[9 * Lanes] = node.Low;
                lane[10 * Lanes] = node.High;
            }
        }

        /// <summary>Adds the numbers of all binary leaves that a test does not exclude.</summary>
        public void Collect<TTest>(in TTest test, StructList<int> leaves)
            where TTest : struct, IBoundsTest
        {
            Span<int> stack = stackalloc int[StackSize];
            int depth = 0;
            stack[depth++] = 0;
            ref double bounds = ref MemoryMarshal.GetArrayDataReference(_bounds);
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
                    stack[depth++] = _child[Lanes * node + BitOperations.TrailingZeroCount(hits)];
                }
            }
        }

        // Up to four descendants of a binary node that together hold all its triangles, in the order of the tree.
        private static int Children(BvhNode[] nodes, int binary, Span<int> four)
        {
            if (nodes[binary].Count > 0)
            {
                four[0] = binary;
                return 1;
            }
            int filled = 0;
            for (int child = nodes[binary].First; child < nodes[binary].First + 2; child++)
            {
                four[filled++] = nodes[child].Count > 0 ? child : nodes[child].First;
                if (nodes[child].Count == 0)
                {
                    four[filled++] = nodes[child].First + 1;
                }
            }
            return filled;
        }

        private static void Put(Span<double> lane, int field, in Vector3d value)
        {
            lane[field * Lanes] = value.X;
            lane[(field + 1) * Lanes] = value.Y;
            lane[(field + 2) * Lanes] = value.Z;
        }
    }
}
#endif

using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Merges vertices that a file states more than once: equal ones, and ones that differ by rounding
    /// only.</summary>
    internal static class VertexWeld
    {
        /// <summary>Distance within which two vertices are merged, over the largest side of the box around
        /// all.</summary>
        /// <remarks>Programs that write each triangle's corners anew agree to some 1e-9 of the mesh's size where
        /// they print 9 to 10 digits. Single precision, 6e-8, makes equal numbers of equal ones: no more is
        /// needed.</remarks>
        public const double RelativeTolerance = 1e-8;

        // A direction along which hardly any two vertices of a regular mesh are level.
        private static readonly Vector3d SortDirection =
            Vector3d.Normalize(new Vector3d(0.6180339887, 0.3819660113, 1.0));

        /// <summary>The index of the remaining vertex for each; the earliest of those merged represents all, with its
        /// own coordinates.</summary>
        public static int[] Join(Vector3d[] vertices, out Vector3d[] kept)
        {
            int[] index = JoinEqual(vertices, out kept);
            int[] group = JoinNear(kept);
            if (Array.TrueForAll(group, first => first < 0))
            {
                return index;
            }
            var merged = new int[kept.Length];
            var different = new List<Vector3d>(kept.Length);
            for (int i = 0; i < kept.Length; i++)
            {
                merged[i] = group[i] < 0 ? different.Count : merged[First(group, i)];
                if (group[i] < 0)
                {
                    different.Add(kept[i]);
                }
            }
            kept = different.ToArray();
            return Array.ConvertAll(index, i => merged[i]);
        }

        private static int[] JoinEqual(Vector3d[] vertices, out Vector3d[] kept)
        {
            var first = new Dictionary<Vector3d, int>(vertices.Length);
            var different = new List<Vector3d>(vertices.Length);
            var index = new int[vertices.Length];
            for (int i = 0; i < vertices.Length; i++)
            {
                // Adding 0 makes -0 a 0: the two are equal but differ in their bits.
                Vector3d vertex = vertices[i] + Vector3d.Zero;
                if (!first.TryGetValue(vertex, out index[i]))
                {
                    index[i] = different.Count;
                    first.Add(vertex, different.Count);
                    different.Add(vertex);
                }
            }
            kept = different.ToArray();
            return index;
        }

        // For each vertex an earlier one that it is merged with, -1 for none. Vertices within the tolerance of each
        // other are within it along the sort direction too.
        private static int[] JoinNear(Vector3d[] vertices)
        {
            double tolerance = RelativeTolerance * Extents.Of(vertices).LargestSide;
            var along = new double[vertices.Length];
            var order = new int[vertices.Length];
            for (int i = 0; i < order.Length; i++)
            {
                along[i] = Vector3d.Dot(SortDirection, vertices[i]);
                order[i] = i;
            }
            Array.Sort(along, order);
            var group = new int[vertices.Length];
            Array.Fill(group, -1);
            for (int a = 0; a < order.Length; a++)
            {
                for (int b = a + 1; b < order.Length && along[b] - along[a] <= tolerance; b++)
                {
                    if (Vector3d.Distance(vertices[order[a]], vertices[order[b]]) <= tolerance)
                    {
                        int i = First(group, order[a]);
                        int j = First(group, order[b]);
                        if (i != j)
                        {
                            group[Math.Max(i, j)] = Math.Min(i, j);
                        }
                    }
                }
            }
            return group;
        }

        private static int First(int[] group, int i)
        {
            while (group[i] >= 0)
            {
                i = group[i];
            }
            return i;
        }
    }
}

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
            int[] group = FindNear(vertices);
            var index = new int[vertices.Length];
            var different = new List<Vector3d>(vertices.Length);
            for (int i = 0; i < vertices.Length; i++)
            {
                index[i] = group[i] < 0 ? different.Count : index[First(group, i)];
                if (group[i] < 0)
                {
                    different.Add(vertices[i] + Vector3d.Zero); // makes -0 a 0
                }
            }
            kept = different.ToArray();
            return index;
        }

        // For each vertex an earlier one that it is merged with, -1 for none. Vertices within the tolerance of each
        // other are within it along the sort direction too.
        private static int[] FindNear(Vector3d[] vertices)
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
            int[] group = HalfEdges.Unset(vertices.Length);
            for (int a = 0; a < order.Length; a++)
            {
                bool isRepeated = false; // an equal vertex b finds all further neighbours of a
                for (int b = a + 1; b < order.Length && along[b] - along[a] <= tolerance && !isRepeated; b++)
                {
                    if (Vector3d.Distance(vertices[order[a]], vertices[order[b]]) <= tolerance)
                    {
                        Unite(group, order[a], order[b]);
                        isRepeated = vertices[order[a]].Equals(vertices[order[b]]);
                    }
                }
            }
            return group;
        }

        private static void Unite(int[] group, int one, int other)
        {
            int i = First(group, one);
            int j = First(group, other);
            if (i != j)
            {
                group[Math.Max(i, j)] = Math.Min(i, j);
            }
        }

        // Union-find with path halving.
        private static int First(int[] group, int i)
        {
            while (group[i] >= 0)
            {
                int next = group[i];
                group[i] = group[next] >= 0 ? group[next] : next;
                i = next;
            }
            return i;
        }
    }
}

using System;

namespace Guidewire.Core
{
    /// <summary>Half-edges of triangles: half-edge 3 t + k goes from corner k of triangle t to the next corner. Those
    /// with the same two ends are one edge.</summary>
    internal static class HalfEdges
    {
        /// <summary>The half-edge after another around their triangle.</summary>
        public static int Next(int halfEdge)
        {
            return halfEdge % 3 == 2 ? halfEdge - 2 : halfEdge + 1;
        }

        /// <summary>For each half-edge the other one of its edge, -1 where there is none.</summary>
        /// <param name="triangles">Three vertices a triangle.</param>
        /// <param name="vertexCount">Number of vertices.</param>
        /// <param name="crowded">Number of half-edges beyond two an edge; 0 in a surface.</param>
        /// <remarks>An edge is looked up among those of the end that has fewer triangles, which takes a time linear in
        /// their number for a surface of any genus, even with a vertex that all triangles share (Chiba and Nishizeki
        /// 1985, Arboricity and subgraph listing algorithms).</remarks>
        public static int[] Pair(int[] triangles, int vertexCount, out int crowded)
        {
            int[] use = CountUse(triangles, vertexCount);
            var others = Unset(triangles.Length);
            var next = new int[triangles.Length]; // in the list of edges of one vertex
            int[] first = Unset(vertexCount);
            crowded = 0;
            for (int halfEdge = 0; halfEdge < triangles.Length; halfEdge++)
            {
                int from = triangles[halfEdge];
                int to = triangles[Next(halfEdge)];
                int vertex = Rarer(use, from, to);
                int known = first[vertex];
                while (known >= 0 && triangles[known] + triangles[Next(known)] != from + to)
                {
                    known = next[known];
                }
                if (known < 0)
                {
                    next[halfEdge] = first[vertex];
                    first[vertex] = halfEdge;
                }
                else if (others[known] < 0)
                {
                    others[known] = halfEdge;
                    others[halfEdge] = known;
                }
                else
                {
                    crowded++;
                }
            }
            return others;
        }

        /// <summary>How many corners lie at each vertex.</summary>
        public static int[] CountUse(int[] triangles, int vertexCount)
        {
            var use = new int[vertexCount];
            foreach (int vertex in triangles)
            {
                use[vertex]++;
            }
            return use;
        }

        /// <summary>Of two vertices the one with fewer corners, of equal ones the lower.</summary>
        public static int Rarer(int[] use, int i, int j)
        {
            return use[i] < use[j] || (use[i] == use[j] && i < j) ? i : j;
        }

        /// <summary>So many times -1.</summary>
        public static int[] Unset(int count)
        {
            var values = new int[count];
            Array.Fill(values, -1);
            return values;
        }
    }
}

using System;

namespace Guidewire.Core
{
    /// <summary>Half-edges of triangles: half-edge 3 t + k goes from corner k of triangle t to the next corner. Those
    /// with the same two ends are one edge.</summary>
    internal static class HalfEdges
    {
        /// <summary>Gives the next half-edge around the same triangle.</summary>
        public static int Next(int halfEdge) => halfEdge % 3 == 2 ? halfEdge - 2 : halfEdge + 1;

        /// <summary>Gives for each half-edge the other one of its edge, -1 where there is none.</summary>
        /// <param name="triangles">Three vertices a triangle.</param>
        /// <param name="vertexCount">Number of vertices.</param>
        /// <param name="crowded">Number of half-edges beyond the second of an edge; 0 in a manifold.</param>
        /// <remarks>An edge is looked up among those stored at its end of lower valence. For the triangles of a surface
        /// of bounded genus the time is linear in their number, even where all share one vertex (Chiba and Nishizeki
        /// 1985, Arboricity and subgraph listing algorithms).</remarks>
        public static int[] Pair(int[] triangles, int vertexCount, out int crowded)
        {
            int[] valence = Valences(triangles, vertexCount);
            int[] others = Unset(triangles.Length);
            var next = new int[triangles.Length]; // in the list of half-edges stored at a vertex
            int[] first = Unset(vertexCount);
            crowded = 0;
            for (int halfEdge = 0; halfEdge < triangles.Length; halfEdge++)
            {
                int from = triangles[halfEdge];
                int to = triangles[Next(halfEdge)];
                int vertex = LowerValence(valence, from, to);
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

        /// <summary>Number of triangles at each vertex.</summary>
        public static int[] Valences(int[] triangles, int vertexCount)
        {
            var valences = new int[vertexCount];
            foreach (int vertex in triangles)
            {
                valences[vertex]++;
            }
            return valences;
        }

        /// <summary>The vertex of lower valence of two, the lower index where they are equal.</summary>
        public static int LowerValence(int[] valence, int i, int j) =>
            valence[i] < valence[j] || (valence[i] == valence[j] && i < j) ? i : j;

        /// <summary>Gives an array of -1.</summary>
        public static int[] Unset(int count)
        {
            var values = new int[count];
            Array.Fill(values, -1);
            return values;
        }
    }
}

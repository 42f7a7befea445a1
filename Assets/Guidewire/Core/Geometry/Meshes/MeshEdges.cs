using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>The convex edges of a mesh: edges at which its two faces turn towards the free side, and edges of open
    /// rims.</summary>
    /// <remarks>The weight of an edge goes with the angle between its faces, and is 1 at a rim.</remarks>
    internal sealed class MeshEdges
    {
        private const double MinAngle = 1e-6;   // radians
        private const double RimWeight = 1.0;
        private readonly MeshGeometry _mesh;
        private readonly double[] _weight;        // of the edge that a half-edge represents, else 0
        private readonly double[] _angle;         // by which the wall turns there, radians
        private readonly StructList<int> _edges = new StructList<int>(64);

        /// <summary>Finds the edges of this mesh where it stands.</summary>
        public MeshEdges(MeshGeometry mesh)
        {
            _mesh = mesh;
            _weight = new double[mesh.Corners.Length];
            _angle = new double[mesh.Corners.Length];
            for (int halfEdge = 0; halfEdge < _weight.Length; halfEdge++)
            {
                int edge = mesh.EdgeOf(halfEdge);
                if (mesh.IsRimEdge(edge))
                {
                    _weight[edge] = RimWeight;
                    _angle[edge] = Math.PI;
                }
                else if (halfEdge != edge)
                {
                    _angle[edge] = Angle(edge, halfEdge);
                    _weight[edge] = ConvexEdge.Weight(_angle[edge]);
                }
            }
        }

        /// <summary>Gives the half-edges of the convex edges.</summary>
        public int[] Edges()
        {
            var edges = new List<int>();
            for (int halfEdge = 0; halfEdge < _weight.Length; halfEdge++)
            {
                if (_weight[halfEdge] > 0.0)
                {
                    edges.Add(halfEdge);
                }
            }
            return edges.ToArray();
        }

        /// <summary>Adds the edge contacts within <paramref name="range"/> of segment a b, in the order of the
        /// half-edges.</summary>
        public void Find(in Vector3d a, in Vector3d b, double range, MeshNearby nearby, FeatureRange among,
            StructList<EdgeContact> edgeContacts)
        {
            _edges.Clear();
            if (!among.IsKnown)
            {
                nearby.ChooseEdges(a, b, range, _edges);
            }
            for (int k = among.From; k < among.To && among.MinDistance(k) <= range; k++)
            {
                _edges.Add(among[k]);
            }
            _edges.Sort(0);
            for (int k = 0; k < _edges.Count; k++)
            {
                _mesh.EndsOf(_edges[k], out int from, out int to);
                ConvexEdge.Add(a, b, _mesh.Corners[from], _mesh.Corners[to], 0.0, _weight[_edges[k]],
                    _angle[_edges[k]], range, edgeContacts);
            }
        }

        // By which the faces on both sides of an edge turn towards the free side; 0 in a valley.
        private double Angle(int edge, int twin)
        {
            Vector3d first = _mesh.FaceNormals[edge / 3];
            Vector3d second = _mesh.FaceNormals[twin / 3];
            int opposite = 3 * (twin / 3) + (twin % 3 + 2) % 3;
            if (!(Vector3d.Dot(_mesh.Corners[opposite] - _mesh.Corners[edge], first) < 0.0))
            {
                return 0.0;
            }
            double angle = Math.Atan2(Vector3d.Cross(first, second).Length, Vector3d.Dot(first, second));
            return angle > MinAngle ? angle : 0.0;
        }
    }

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

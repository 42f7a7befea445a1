using System;
using System.Collections.Generic;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Makes one oriented surface of a file's triangles: vertices that are equal up to rounding are merged
    /// (see <see cref="VertexWeld"/>), degenerate and repeated triangles are removed, neighbours are oriented
    /// consistently, open rims are found. What is ambiguous is refused: an edge of three triangles, a surface of one
    /// side only, several surfaces, a hole that is not declared.</summary>
    internal sealed class MeshTopology
    {
        // Beyond it squares and volumes lose digits, and no vessel is that large; units.
        private const double FarthestCoordinate = 1e9;

        // Of an edge's length: a corner this near to an edge lies on it.
        private const double OnEdge = 1e-6;

        private MeshTopology(Vector3d[] vertices, int[] triangles)
        {
            Vertices = vertices;
            Triangles = triangles;
        }

        /// <summary>Each different vertex once.</summary>
        public Vector3d[] Vertices { get; private set; }

        /// <summary>Three vertices a triangle, consistently oriented.</summary>
        public int[] Triangles { get; private set; }

        /// <summary>Open rims, each a closed chain of vertices in the direction of its triangles' edges.</summary>
        public List<int[]> Rims { get; } = new List<int[]>();

        /// <summary>Says what was found in the mesh.</summary>
        public MeshReport Report { get; } = new MeshReport();

        /// <summary>The surface of these triangles.</summary>
        /// <exception cref="MeshException">It cannot be one oriented surface.</exception>
        public static MeshTopology Create(Vector3d[] vertices, int[] triangles)
        {
            CheckNumbers(vertices, triangles);
            var topology = new MeshTopology(vertices, triangles);
            topology.Weld();
            topology.DropTriangles();
            topology.TurnAlike();
            topology.FindRims();
            topology.Report.Vertices = topology.Vertices.Length;
            topology.Report.Triangles = topology.Triangles.Length / 3;
            return topology;
        }

        /// <summary>Reverses every triangle and rim.</summary>
        public void TurnAll()
        {
            for (int t = 0; t < Triangles.Length; t += 3)
            {
                Turn(t);
            }
            foreach (int[] rim in Rims)
            {
                Array.Reverse(rim);
            }
        }

        private static void CheckNumbers(Vector3d[] vertices, int[] triangles)
        {
            int bad = 0;
            foreach (Vector3d vertex in vertices)
            {
                bad += vertex.IsFinite ? 0 : 1;
            }
            int far = Array.FindIndex(vertices, vertex => LargestCoordinate(vertex) > FarthestCoordinate);
            int wild = 0;
            foreach (int index in triangles)
            {
                wild += index >= 0 && index < vertices.Length ? 0 : 1;
            }
            if (bad > 0 || wild > 0 || far >= 0 || triangles.Length == 0 || triangles.Length % 3 != 0)
            {
                throw new MeshException(
                    triangles.Length == 0 ? "the mesh has no triangles"
                    : bad > 0 ? bad + " vertices have a coordinate that is not finite"
                    : far >= 0 ? string.Format(
                        CultureInfo.InvariantCulture, "vertex {0} of {1} is at {2}: coordinates go up to 1e9 units",
                        far + 1, vertices.Length, vertices[far])
                    : wild + " corners name a vertex that does not exist (there are " + vertices.Length + ")");
            }
        }

        private static double LargestCoordinate(in Vector3d vertex) =>
            Math.Max(Math.Abs(vertex.X), Math.Max(Math.Abs(vertex.Y), Math.Abs(vertex.Z)));

        private void Weld()
        {
            int[] index = VertexWeld.Join(Vertices, out Vector3d[] kept);
            Report.WeldedVertices = Vertices.Length - kept.Length;
            Vertices = kept;
            Triangles = Array.ConvertAll(Triangles, corner => index[corner]);
        }

        private void DropTriangles()
        {
            var kept = new List<int>(Triangles.Length);
            int[] valence = HalfEdges.Valences(Triangles, Vertices.Length);
            var next = new int[Triangles.Length / 3]; // in the list of kept triangles stored at a vertex
            int[] first = HalfEdges.Unset(Vertices.Length);
            for (int t = 0; t < Triangles.Length; t += 3)
            {
                int i = Triangles[t];
                int j = Triangles[t + 1];
                int k = Triangles[t + 2];
                if (i == j || j == k || k == i)
                {
                    Report.CollapsedTriangles++;
                    continue;
                }
                int vertex = HalfEdges.LowerValence(valence, i, HalfEdges.LowerValence(valence, j, k));
                int known = first[vertex];
                while (known >= 0 && !AreCorners(kept, 3 * known, i, j, k))
                {
                    known = next[known];
                }
                if (known >= 0)
                {
                    Report.RepeatedTriangles++;
                    continue;
                }
                next[kept.Count / 3] = first[vertex];
                first[vertex] = kept.Count / 3;
                Vector3d area = Vector3d.Cross(Vertices[j] - Vertices[i], Vertices[k] - Vertices[i]);
                Report.FlatTriangles += area.LengthSquared > 0.0 ? 0 : 1;
                kept.Add(i);
                kept.Add(j);
                kept.Add(k);
            }
            Triangles = kept.ToArray();
            if (Triangles.Length == 0)
            {
                throw new MeshException("the mesh has no triangle with three different corners");
            }
        }

        private static bool AreCorners(List<int> triangles, int at, int i, int j, int k) =>
            Has(triangles, at, i) && Has(triangles, at, j) && Has(triangles, at, k);

        private static bool Has(List<int> triangles, int at, int vertex) =>
            triangles[at] == vertex || triangles[at + 1] == vertex || triangles[at + 2] == vertex;

        private int[] JoinEdges()
        {
            int[] others = HalfEdges.Pair(Triangles, Vertices.Length, out int crowded);
            return crowded == 0
                ? others : throw new MeshException(crowded + " edges belong to more than two triangles");
        }

        private void TurnAlike()
        {
            int[] others = JoinEdges();
            int count = Triangles.Length / 3;
            var turned = new bool[count];
            var seen = new bool[count];
            var queue = new Queue<int>();
            int surfaces = 0;
            int turnedCount = 0;
            int clashes = 0;
            for (int start = 0; start < count; start++)
            {
                if (seen[start])
                {
                    continue;
                }
                surfaces++;
                seen[start] = true;
                queue.Enqueue(start);
                while (queue.Count > 0)
                {
                    int t = queue.Dequeue();
                    for (int e = 0; e < 3; e++)
                    {
                        int other = others[3 * t + e];
                        if (other < 0)
                        {
                            continue;
                        }

                        // Neighbours agree when they run through their common edge in opposite directions.
                        bool turn = turned[t] ^ (Triangles[3 * t + e] == Triangles[other]);
                        int neighbour = other / 3;
                        if (seen[neighbour])
                        {
                            clashes += turned[neighbour] == turn ? 0 : 1;
                            continue;
                        }
                        seen[neighbour] = true;
                        turned[neighbour] = turn;
                        turnedCount += turn ? 1 : 0;
                        queue.Enqueue(neighbour);
                    }
                }
            }
            if (clashes > 0 || surfaces > 1)
            {
                throw new MeshException(
                    clashes > 0 ? "the surface is not orientable (" + clashes + " edges cannot be oriented "
                        + "consistently)"
                    : (FindTJunction(others) is string torn ? torn + "; " : "")
                        + "the mesh has " + surfaces + " separate surfaces; a vessel must be one");
            }
            Report.TurnedTriangles = Math.Min(turnedCount, count - turnedCount);
            for (int t = 0; t < count; t++)
            {
                if (turned[t])
                {
                    Turn(3 * t);
                }
            }
        }

        private void FindRims()
        {
            int[] others = JoinEdges();
            var next = new Dictionary<int, int>();
            int pinched = 0;
            int first = -1;
            for (int halfEdge = 0; halfEdge < Triangles.Length; halfEdge++)
            {
                if (others[halfEdge] < 0)
                {
                    bool isFirst = next.TryAdd(Triangles[halfEdge], Triangles[HalfEdges.Next(halfEdge)]);
                    pinched += isFirst ? 0 : 1;
                    first = isFirst || first >= 0 ? first : Triangles[halfEdge];
                }
            }
            if (pinched > 0)
            {
                throw new MeshException(FindTJunction(others) ?? pinched
                    + " open rims touch themselves or each other, the first at " + At(Vertices[first]));
            }
            while (next.Count > 0)
            {
                var rim = new List<int>();
                int vertex = FirstKey(next);
                while (next.Remove(vertex, out int following))
                {
                    rim.Add(vertex);
                    vertex = following;
                }
                Rims.Add(rim.ToArray());
            }
        }

        // A vertex within an edge that has a triangle on one side only: there the surface is torn open.
        private string? FindTJunction(int[] others)
        {
            int count = 0;
            int first = -1;
            var rims = new List<int>();
            for (int halfEdge = 0; halfEdge < Triangles.Length; halfEdge++)
            {
                if (others[halfEdge] < 0)
                {
                    rims.Add(halfEdge);
                }
            }
            foreach (int halfEdge in rims)
            {
                Vector3d from = Vertices[Triangles[halfEdge]];
                Vector3d along = Vertices[Triangles[HalfEdges.Next(halfEdge)]] - from;
                double length = along.Length;
                foreach (int other in rims)
                {
                    Vector3d beside = Vertices[Triangles[other]] - from;
                    double fraction = Vector3d.Dot(beside, along) / (length * length);
                    if (fraction > OnEdge && fraction < 1.0 - OnEdge
                        && (beside - fraction * along).Length < OnEdge * length)
                    {
                        count++;
                        first = first < 0 ? Triangles[other] : first;
                    }
                }
            }
            return count == 0 ? null : count + (count == 1 ? " T-junction, " : " T-junctions, the first ") + "at "
                + At(Vertices[first]) + ": a corner lies within the edge of a triangle that does not have it, which "
                + "tears the surface open; 'anatomy FILE' mends such a mesh";
        }

        private static string At(in Vector3d place) => string.Format(CultureInfo.InvariantCulture,
            "({0:G6}, {1:G6}, {2:G6})", place.X, place.Y, place.Z);

        private static int FirstKey(Dictionary<int, int> next)
        {
            int least = int.MaxValue;
            foreach (int key in next.Keys)
            {
                least = Math.Min(least, key);
            }
            return least;
        }

        private void Turn(int triangle) =>
            (Triangles[triangle + 1], Triangles[triangle + 2]) = (Triangles[triangle + 2], Triangles[triangle + 1]);
    }

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

    /// <summary>Self-intersections of a mesh: edges that pierce triangles with which they share no vertex. Mere
    /// contact, to <see cref="RelativeDepth"/>, does not count.</summary>
    internal static class SelfIntersection
    {
        // How far both ends of an edge lie off a triangle's plane at least, over the mesh's size.
        private const double RelativeDepth = 1e-9;

        /// <summary>How many times an edge pierces a triangle, and where the first such edge does.</summary>
        public static int Count(MeshGeometry wall, out Vector3d position)
        {
            position = Vector3d.Zero;
            double depth = RelativeDepth * Extents.Of(wall.Corners).LargestSide;
            var near = new StructList<int>(64);
            int first = int.MaxValue;
            int count = 0;
            foreach (int triangle in wall.Tree.Order) // so that each search is near the last one
            {
                for (int edge = 3 * triangle; edge < 3 * triangle + 3; edge++)
                {
                    if (wall.EdgeOf(edge) != edge)
                    {
                        continue;
                    }
                    wall.EndsOf(edge, out int from, out int to);
                    near.Clear();
                    wall.Tree.Within(wall.Corners[from], wall.Corners[to], depth, near);
                    for (int k = 0; k < near.Count; k++)
                    {
                        if (Pierces(wall, wall.Corners[from], wall.Corners[to], near[k], depth, out Vector3d point)
                            && !SharesVertex(wall, from, to, near[k]))
                        {
                            position = edge < first ? point : position;
                            first = Math.Min(first, edge);
                            count++;
                        }
                    }
                }
            }
            return count;
        }

        private static bool SharesVertex(MeshGeometry wall, int from, int to, int triangle)
        {
            for (int k = 3 * triangle; k < 3 * triangle + 3; k++)
            {
                if (wall.VertexAt(k) == wall.VertexAt(from) || wall.VertexAt(k) == wall.VertexAt(to))
                {
                    return true;
                }
            }
            return false;
        }

        private static bool Pierces(
            MeshGeometry wall, in Vector3d a, in Vector3d b, int triangle, double depth, out Vector3d point)
        {
            Vector3d n = wall.FaceNormals[triangle];
            Vector3d corner = wall.Corners[3 * triangle];
            double above = Vector3d.Dot(n, a - corner);
            double below = Vector3d.Dot(n, b - corner);
            point = corner;
            if (!(Math.Min(above, below) < -depth && Math.Max(above, below) > depth))
            {
                return false;
            }
            point = Vector3d.Lerp(a, b, above / (above - below));
            double least = double.PositiveInfinity;
            double largest = double.NegativeInfinity;
            for (int k = 0; k < 3; k++)
            {
                Vector3d start = wall.Corners[3 * triangle + k];
                Vector3d side = wall.Corners[3 * triangle + (k + 1) % 3] - start;
                double inward = Vector3d.Dot(n, Vector3d.Cross(side, point - start)) / side.Length;
                least = Math.Min(least, inward);
                largest = Math.Max(largest, inward);
            }
            return least >= -depth || largest <= depth;
        }
    }

    /// <summary>What was found in a vessel's mesh and what of it was repaired, by count.</summary>
    public sealed class MeshReport
    {
        /// <summary>Vertices after those that are one up to rounding became one.</summary>
        public int Vertices { get; internal set; }

        /// <summary>Triangles that are used.</summary>
        public int Triangles { get; internal set; }

        /// <summary>Vertices that were taken for an earlier one: no farther from it than
        /// <see cref="VertexWeld.RelativeTolerance"/> of the mesh's size.</summary>
        public int WeldedVertices { get; internal set; }

        /// <summary>Triangles left out because two of their corners are one vertex.</summary>
        public int CollapsedTriangles { get; internal set; }

        /// <summary>Triangles left out because they repeat an earlier one.</summary>
        public int RepeatedTriangles { get; internal set; }

        /// <summary>Triangles of no area between three different vertices. They are kept: they close the surface, and
        /// the distance from them is exact.</summary>
        public int FlatTriangles { get; internal set; }

        /// <summary>Triangles turned round so that neighbours agree.</summary>
        public int TurnedTriangles { get; internal set; }

        /// <summary>True when the whole surface was turned, so that its normals point into the lumen.</summary>
        public bool TurnedInward { get; internal set; }

        /// <summary>Open rims, all of them named.</summary>
        public int OpenRims { get; internal set; }

        /// <summary>Volume of the lumen, open rims closed by a fan, units^3.</summary>
        public double Volume { get; internal set; }

        /// <summary>Gives one line with every count.</summary>
        public override string ToString()
        {
            return string.Format(
                CultureInfo.InvariantCulture,
                "{0} triangles, {1} vertices, {2} open rims; welded {3}, collapsed {4}, repeated {5}, flat {6}, "
                + "turned {7}{8}",
                Triangles, Vertices, OpenRims, WeldedVertices, CollapsedTriangles, RepeatedTriangles, FlatTriangles,
                TurnedTriangles, TurnedInward ? ", all turned inward" : "");
        }
    }
}

using System;

namespace Guidewire.Core
{
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
}

using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Length inside a vessel of the ray through each pixel's centre: the sum over the triangles that it
    /// crosses of their depths, those of the far wall negative. Open rims are closed by a fan of triangles about their
    /// centre; otherwise a ray that enters through one would be counted from infinity.</summary>
    internal sealed class LumenThickness
    {
        private readonly Vector3d[] _vertices;
        private readonly int[] _triangles;
        private readonly double[] _sum;
        private readonly Vector3d[] _projected;
        private List<(int Pixel, double Depth, bool IsIn)>? _crossings;

        /// <param name="wall">The vessel.</param>
        /// <param name="pixels">Of a side.</param>
        public LumenThickness(WallSurface wall, int pixels)
        {
            var vertices = new List<Vector3d>(wall.Vertices);
            var triangles = new List<int>(wall.Triangles);
            CloseRims(vertices, triangles);
            _vertices = vertices.ToArray();
            _triangles = triangles.ToArray();
            _projected = new Vector3d[_vertices.Length];
            _sum = new double[pixels * pixels];
        }

        /// <summary>Takes where its vertices are, if they were moved; the middles of rims stay.</summary>
        public void MoveVertices(Vector3d[]? vertices) => vertices?.CopyTo(_vertices, 0);

        /// <summary>Adds the vessel's thickness to that of others, in pixels' sides.</summary>
        /// <param name="arm">Where it is seen from.</param>
        /// <param name="thickness">Row by row; grows.</param>
        public void Add(CArm arm, float[] thickness)
        {
            Array.Clear(_sum, 0, _sum.Length);
            Project(arm);
            for (int i = 0; i < _sum.Length; i++)
            {
                thickness[i] += (float)Math.Max(0.0, _sum[i]);
            }
        }

        private void Project(CArm arm)
        {
            for (int i = 0; i < _vertices.Length; i++)
            {
                _projected[i] = arm.ToDetector(_vertices[i]);
            }
            for (int t = 0; t < _triangles.Length; t += 3)
            {
                AddTriangle(_projected[_triangles[t]], _projected[_triangles[t + 1]], _projected[_triangles[t + 2]],
                    arm.Pixels);
            }
        }

        /// <summary>Notes where rays pass the wall: in which pixel, how deep (pixels' sides, towards the detector),
        /// and whether
        /// a ray from the detector goes in there.</summary>
        /// <param name="arm">Where it is seen from.</param>
        /// <param name="crossings">Grows.</param>
        public void Cross(CArm arm, List<(int Pixel, double Depth, bool IsIn)> crossings)
        {
            _crossings = crossings;
            Project(arm);
            _crossings = null;
        }

        // Rows are cut at their middles. A side between two triangles is computed from its upper end for both, so each
        // pixel belongs to one of them.
        private void AddTriangle(Vector3d a, Vector3d b, Vector3d c, int pixels)
        {
            double area = (b.X - a.X) * (c.Y - a.Y) - (c.X - a.X) * (b.Y - a.Y);
            if (area == 0.0)
            {
                return;
            }
            double slopeX = ((b.Z - a.Z) * (c.Y - a.Y) - (c.Z - a.Z) * (b.Y - a.Y)) / area;
            double slopeY = ((c.Z - a.Z) * (b.X - a.X) - (b.Z - a.Z) * (c.X - a.X)) / area;
            // Seen from the lumen corners run counter-clockwise; the picture's y axis points down. The wall nearer to
            // the detector, whose inside is seen from behind, counts positive.
            double sign = area < 0.0 ? -1.0 : 1.0;
            Vector3d anchor = a;
            Order(ref a, ref b);
            Order(ref b, ref c);
            Order(ref a, ref b);
            int firstRow = (int)Math.Max(0.0, Math.Ceiling(a.Y - 0.5));
            int endRow = (int)Math.Min(pixels, Math.Ceiling(c.Y - 0.5));
            for (int row = firstRow; row < endRow; row++)
            {
                double y = row + 0.5;
                double one = Crossing(a, c, y);
                double other = y < b.Y ? Crossing(a, b, y) : Crossing(b, c, y);
                int first = (int)Math.Max(0.0, Math.Ceiling(Math.Min(one, other) - 0.5));
                int end = (int)Math.Min(pixels, Math.Ceiling(Math.Max(one, other) - 0.5));
                double depth = anchor.Z + slopeX * (first + 0.5 - anchor.X) + slopeY * (y - anchor.Y);
                for (int k = row * pixels + first; k < row * pixels + end; k++)
                {
                    if (_crossings != null)
                    {
                        _crossings.Add((k, depth, sign > 0.0));
                    }
                    else
                    {
                        _sum[k] += sign * depth;
                    }
                    depth += slopeX;
                }
            }
        }

        private static double Crossing(in Vector3d upper, in Vector3d lower, double y) =>
            upper.X + (y - upper.Y) / (lower.Y - upper.Y) * (lower.X - upper.X);

        private static void Order(ref Vector3d a, ref Vector3d b)
        {
            if (b.Y < a.Y || (b.Y == a.Y && b.X < a.X))
            {
                (a, b) = (b, a);
            }
        }

        private static void CloseRims(List<Vector3d> vertices, List<int> triangles)
        {
            var sides = new HashSet<(int, int)>();
            for (int t = 0; t < triangles.Count; t += 3)
            {
                for (int k = 0; k < 3; k++)
                {
                    sides.Add((triangles[t + k], triangles[t + (k + 1) % 3]));
                }
            }
            var rim = new List<(int, int)>();
            var root = new Dictionary<int, int>();
            for (int t = 0; t < triangles.Count; t += 3)
            {
                for (int k = 0; k < 3; k++)
                {
                    (int, int) side = (triangles[t + k], triangles[t + (k + 1) % 3]);
                    if (!sides.Contains((side.Item2, side.Item1)))
                    {
                        rim.Add(side);
                        root[Root(root, side.Item1)] = Root(root, side.Item2);
                    }
                }
            }
            var middles = new Dictionary<int, (Vector3d Sum, int Count, int Vertex)>();
            foreach ((int from, int _) in rim)
            {
                middles.TryGetValue(Root(root, from), out (Vector3d Sum, int Count, int Vertex) sum);
                middles[Root(root, from)] = (sum.Sum + vertices[from], sum.Count + 1, 0);
            }
            foreach (int key in new List<int>(middles.Keys))
            {
                middles[key] = (middles[key].Sum, middles[key].Count, vertices.Count);
                vertices.Add(middles[key].Sum / middles[key].Count);
            }
            foreach ((int from, int to) in rim)
            {
                triangles.AddRange(new[] { to, from, middles[Root(root, from)].Vertex });
            }
        }

        private static int Root(Dictionary<int, int> root, int vertex)
        {
            while (root.TryGetValue(vertex, out int above) && above != vertex)
            {
                vertex = above;
            }
            return vertex;
        }
    }
}

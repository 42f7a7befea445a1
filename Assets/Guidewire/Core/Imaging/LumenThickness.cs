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

    /// <summary>How far the ray through each pixel goes in each cell of a vessel's tree. A place in the lumen belongs
    /// to the
    /// cell whose sphere has the least power at the middle of its voxel, one of 128 along the largest side.</summary>
    internal sealed class LumenCells
    {
        private const int Voxels = 128;

        private readonly Vector3d[] _middles;
        private readonly double[] _radii;
        private readonly Vector3d _low;
        private readonly double _side;
        private readonly double _spacing;
        private readonly int[] _counts = new int[3];
        private readonly short[] _cells;    // of voxels, from 1 on; 0: not asked for yet
        private readonly List<(int Pixel, double Depth, bool IsIn)> _crossings =
            new List<(int Pixel, double Depth, bool IsIn)>();
        private readonly List<(int Pixel, int Cell, double Length)> _parts =
            new List<(int Pixel, int Cell, double Length)>();

        /// <param name="middles">Of the cells, units.</param>
        /// <param name="radii">Units.</param>
        /// <param name="low">Lowest corner of the vessels, units.</param>
        /// <param name="high">Their highest.</param>
        public LumenCells(Vector3d[] middles, double[] radii, in Vector3d low, in Vector3d high)
        {
            (_middles, _radii, _low) = (middles, radii, low);
            Vector3d box = high - low;
            _side = Math.Max(Math.Max(box.X, box.Y), Math.Max(box.Z, 1e-9)) / Voxels;
            _counts[0] = (int)(box.X / _side) + 1;
            _counts[1] = (int)(box.Y / _side) + 1;
            _counts[2] = (int)(box.Z / _side) + 1;
            _cells = new short[_counts[0] * _counts[1] * _counts[2]];
            double sum = 0.0;
            foreach (double radius in radii)
            {
                sum += radius;
            }
            _spacing = sum / radii.Length;
        }

        /// <summary>Looks at the vessels anew.</summary>
        public void Look(CArm arm, IReadOnlyList<LumenThickness> lumens)
        {
            _crossings.Clear();
            _parts.Clear();
            foreach (LumenThickness lumen in lumens)
            {
                lumen.Cross(arm, _crossings);
            }
            _crossings.Sort((one, other) => one.Pixel != other.Pixel ? one.Pixel.CompareTo(other.Pixel)
                : other.Depth.CompareTo(one.Depth));
            int inside = 0;
            for (int k = 0; k + 1 < _crossings.Count; k++)
            {
                (int pixel, double depth, bool isIn) = _crossings[k];
                if (k == 0 || _crossings[k - 1].Pixel != pixel)
                {
                    inside = 0;
                }
                inside += isIn ? 1 : -1;
                if (inside > 0 && _crossings[k + 1].Pixel == pixel)
                {
                    Divide(arm, pixel, depth, _crossings[k + 1].Depth);
                }
            }
        }

        /// <summary>Adds up the agent along each ray, part times units.</summary>
        /// <param name="parts">Of the blood in each cell that is agent.</param>
        /// <param name="sum">Row by row; begins anew.</param>
        public void Sum(ReadOnlySpan<double> parts, double[] sum)
        {
            Array.Clear(sum, 0, sum.Length);
            foreach ((int pixel, int cell, double length) in _parts)
            {
                sum[pixel] += parts[cell] * length;
            }
        }

        private void Divide(CArm arm, int pixel, double from, double to)
        {
            double x = pixel % arm.Pixels + 0.5;
            double y = pixel / arm.Pixels + 0.5;
            double length = (from - to) / arm.Scale;
            int count = Math.Max(1, (int)Math.Ceiling(length / _spacing));
            for (int k = 0; k < count; k++)
            {
                int cell = CellAt(arm.FromDetector(x, y, from + (k + 0.5) / count * (to - from)));
                _parts.Add((pixel, cell, length / count));
            }
        }

        private int CellAt(in Vector3d point)
        {
            int i = Index((point.X - _low.X) / _side, 0);
            int j = Index((point.Y - _low.Y) / _side, 1);
            int k = Index((point.Z - _low.Z) / _side, 2);
            ref short cell = ref _cells[(i * _counts[1] + j) * _counts[2] + k];
            if (cell == 0)
            {
                cell = (short)(1 + VesselCells.Nearest(
                    _low + _side * new Vector3d(i + 0.5, j + 0.5, k + 0.5), _middles, _radii));
            }
            return cell - 1;
        }

        private int Index(double at, int axis) => (int)Math.Max(0.0, Math.Min(_counts[axis] - 1.0, Math.Floor(at)));
    }
}

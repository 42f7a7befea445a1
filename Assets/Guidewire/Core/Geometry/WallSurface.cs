using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>A wall as triangles, for pictures: the triangles of a mesh, or flat patches, rings and spheres for
    /// analytic shapes. Nothing here takes part in a step.</summary>
    public sealed class WallSurface
    {
        private const int Sides = 32;
        private const double Fine = 0.5;      // of its radius: between rings of a tube that gives way
        private const int MostRings = 500;    // between knots
        private readonly List<Vector3d> _vertices = new List<Vector3d>();
        private readonly List<int> _triangles = new List<int>();

        private WallSurface()
        {
        }

        /// <summary>The corners in units.</summary>
        public IReadOnlyList<Vector3d> Vertices => _vertices;

        /// <summary>Three indices a triangle; seen from the lumen they run counter-clockwise in a right-handed frame.
        /// </summary>
        public IReadOnlyList<int> Triangles => _triangles;

        /// <summary>The triangles of a wall.</summary>
        /// <param name="shape">The wall.</param>
        /// <param name="middle">Where the picture's middle is, units.</param>
        /// <param name="extent">How far from there an unbounded wall is drawn, units.</param>
        public static WallSurface Create(ContactShape shape, in Vector3d middle, double extent)
        {
            var surface = new WallSurface();
            switch (shape)
            {
                case MeshShape mesh:
                    surface.AddMesh(mesh.Wall);
                    break;
                case PlaneShape plane:
                    surface.AddPlane(plane, middle, extent);
                    break;
                case TubeShape tube:
                    surface.AddTube(tube, extent);
                    break;
                case ConvexObstacle obstacle:
                    surface.AddObstacle(obstacle);
                    break;
                case ConeShape cone:
                    surface.AddCone(cone, middle, extent);
                    break;
                default:
                    throw new ArgumentException("no picture of a " + shape.GetType().Name);
            }
            return surface;
        }

        private void AddMesh(MeshGeometry mesh)
        {
            var indices = new Dictionary<Vector3d, int>();
            for (int t = 0; t < mesh.FaceNormals.Length; t++)
            {
                Vector3d a = mesh.Corners[3 * t];
                Vector3d b = mesh.Corners[3 * t + 1];
                Vector3d c = mesh.Corners[3 * t + 2];
                bool isTurned = Vector3d.Dot(Vector3d.Cross(b - a, c - a), mesh.FaceNormals[t]) < 0.0;
                _triangles.Add(IndexOf(indices, a));
                _triangles.Add(IndexOf(indices, isTurned ? c : b));
                _triangles.Add(IndexOf(indices, isTurned ? b : c));
            }
        }

        private int IndexOf(Dictionary<Vector3d, int> known, in Vector3d corner)
        {
            if (!known.TryGetValue(corner, out int index))
            {
                index = _vertices.Count;
                known.Add(corner, index);
                _vertices.Add(corner);
            }
            return index;
        }

        private void AddPlane(PlaneShape plane, in Vector3d middle, double extent)
        {
            Vector3d n = plane.Normal;
            Vector3d u = extent * Vector3d.Perpendicular(n);
            Vector3d v = Vector3d.Cross(n, u);
            Vector3d foot = middle - Vector3d.Dot(middle - plane.Point, n) * n;
            _vertices.AddRange(new[] { foot - u - v, foot + u - v, foot + u + v, foot - u + v });
            _triangles.AddRange(new[] { 0, 1, 2, 0, 2, 3 });
        }

        private void AddTube(TubeShape tube, double extent)
        {
            var knots = (Vector3d[])tube.Knots.Clone();
            int last = knots.Length - 1;
            knots[0] = Nearer(knots[0], knots[1], extent);
            knots[last] = Nearer(knots[last], knots[last - 1], extent);
            Vector3d side = Vector3d.Perpendicular(knots[1] - knots[0]);
            int rings = 0;
            for (int i = 0; i <= last; i++)
            {
                Vector3d before = Vector3d.Normalize(knots[Math.Max(i, 1)] - knots[Math.Max(i, 1) - 1]);
                Vector3d after = Vector3d.Normalize(knots[Math.Min(i + 1, last)] - knots[Math.Min(i + 1, last) - 1]);
                Vector3d tangent = Vector3d.Normalize(before + after);
                side = Vector3d.Normalize(side - Vector3d.Dot(side, tangent) * tangent);
                AddRing(knots[i], tube.Radii[i] * side, tube.Radii[i] * Vector3d.Cross(tangent, side));
                rings += i == 0 || tube.Softness == null ? 1 : DivideLastStrip((int)Math.Min(MostRings,
                    Math.Ceiling(Vector3d.Distance(knots[i - 1], knots[i]) / (Fine * tube.Radii[i]))));
            }
            AddStrips(rings);
        }

        // Into so many between its two rings, so that a part of it can be drawn elsewhere.
        private int DivideLastStrip(int pieces)
        {
            List<Vector3d> ends = _vertices.GetRange(_vertices.Count - 2 * Sides, 2 * Sides);
            _vertices.RemoveRange(_vertices.Count - Sides, Sides);
            for (int piece = 1; piece <= pieces; piece++)
            {
                double part = (double)piece / pieces;
                for (int k = 0; k < Sides; k++)
                {
                    _vertices.Add((1.0 - part) * ends[k] + part * ends[k + Sides]);
                }
            }
            return pieces;
        }

        // A wall's outside is drawn as seen from the wire, which is outside an obstacle. Every vertex is the body's
        // farthest point in its direction, so a box has its own corners and only the order of its faces is lost.
        private void AddObstacle(ConvexObstacle obstacle)
        {
            int rows = Sides / 2;
            for (int row = 0; row <= rows; row++)
            {
                double latitude = Math.PI * row / rows;
                for (int k = 0; k < Sides; k++)
                {
                    double longitude = 2.0 * Math.PI * k / Sides;
                    var direction = new Vector3d(Math.Sin(latitude) * Math.Cos(longitude),
                        Math.Sin(latitude) * Math.Sin(longitude), Math.Cos(latitude));
                    Vector3d farthest = obstacle.Points[0];
                    foreach (Vector3d point in obstacle.Points)
                    {
                        farthest = Vector3d.Dot(point - farthest, direction) > 0.0 ? point : farthest;
                    }
                    _vertices.Add(farthest + obstacle.Radius * direction);
                }
            }
            AddStrips(rows + 1);
        }

        private void AddCone(ConeShape cone, in Vector3d middle, double extent)
        {
            Vector3d side = Vector3d.Perpendicular(cone.Axis);
            foreach ((Vector3d centre, double radius) in cone.Circles(middle, extent, Sides / 2 + 1))
            {
                // Clockwise about the axis, so that the outside is seen.
                AddRing(centre, radius * side, radius * Vector3d.Cross(side, cone.Axis));
            }
            AddStrips(Sides / 2 + 1);
        }

        private static Vector3d Nearer(in Vector3d far, in Vector3d from, double extent)
        {
            Vector3d direction = far - from;
            return direction.Length > extent ? from + extent * Vector3d.Normalize(direction) : far;
        }

        private void AddRing(in Vector3d centre, in Vector3d u, in Vector3d v)
        {
            for (int k = 0; k < Sides; k++)
            {
                double angle = 2.0 * Math.PI * k / Sides;
                _vertices.Add(centre + Math.Cos(angle) * u + Math.Sin(angle) * v);
            }
        }

        // Rings that run counter-clockwise about their direction (right-hand rule), seen from within; or circles of
        // latitude from pole to pole, seen from without.
        private void AddStrips(int rings)
        {
            for (int a = 0; a < (rings - 1) * Sides; a++)
            {
                int b = a % Sides == Sides - 1 ? a + 1 - Sides : a + 1;
                _triangles.AddRange(new[] { a, a + Sides, b, b, a + Sides, b + Sides });
            }
        }
    }
}

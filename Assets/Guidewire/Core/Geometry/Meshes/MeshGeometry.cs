using System;
using System.Collections.Generic;
using System.Runtime.CompilerServices;
#if NET8_0_OR_GREATER
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
#endif

namespace Guidewire.Core
{
    /// <summary>A placed mesh: the hierarchy over its triangles and the normals of its faces, edges and
    /// corners.</summary>
    internal sealed class MeshGeometry
    {
        private readonly Vector3d[] _rest;
        private readonly int[] _triangles;
        private readonly int[] _twin;             // half-edge in the opposite direction, -1 at a rim
        private readonly int[] _halfEdgeOfVertex;
        private readonly bool[] _isRimVertex;
        private readonly int[] _firstAround;      // of a vertex's half-edges in the next array
        private readonly int[] _around;           // half-edges by the vertex at which they start, in their order
        private readonly Vector3d[] _corners;
        private readonly Vector3d[] _faceNormals;
        private readonly Vector3d[] _vertexNormals;    // 0 where it was not asked for yet
        private readonly MeshGeometry? _other;    // the same mesh before its placement
        private Bvh? _tree;
        private bool _mirrored;

        /// <summary>Makes the mesh, with a fan over each open rim or without.</summary>
        public MeshGeometry(TriangleMesh mesh, bool closeRims, in Placement placement)
        {
            var vertices = new List<Vector3d>(mesh.Vertices);
            var triangles = new List<int>(mesh.Triangles);
            if (closeRims)
            {
                foreach (int[] rim in mesh.Rims)
                {
                    AddFan(vertices, triangles, rim);
                }
            }
            _rest = vertices.ToArray();
            _triangles = triangles.ToArray();
            _twin = HalfEdges.Pair(_triangles, _rest.Length, out _);
            _isRimVertex = new bool[_rest.Length];
            _halfEdgeOfVertex = new int[_rest.Length];
            for (int halfEdge = _triangles.Length - 1; halfEdge >= 0; halfEdge--)
            {
                _halfEdgeOfVertex[_triangles[halfEdge]] = halfEdge;
                if (_twin[halfEdge] < 0)
                {
                    _isRimVertex[_triangles[halfEdge]] = true;
                    _isRimVertex[_triangles[HalfEdges.Next(halfEdge)]] = true;
                }
            }
            SortByVertex(out _firstAround, out _around);
            _corners = new Vector3d[_triangles.Length];
            _faceNormals = new Vector3d[_triangles.Length / 3];
            _vertexNormals = new Vector3d[_rest.Length];
            Update(placement);
        }

        private MeshGeometry(MeshGeometry other, in Placement placement, SmoothWarp? warp)
        {
            _rest = warp?.Apply(other._rest) ?? other._rest;
            (_triangles, _twin) = (other._triangles, other._twin);
            (_halfEdgeOfVertex, _isRimVertex) = (other._halfEdgeOfVertex, other._isRimVertex);
            (_firstAround, _around, _other) = (other._firstAround, other._around, other);
            _corners = new Vector3d[_triangles.Length];
            _faceNormals = new Vector3d[_triangles.Length / 3];
            _vertexNormals = new Vector3d[_rest.Length];
            Update(placement);
        }

        /// <summary>Gives this mesh at another placement, for another run: what does not depend on the placement is
        /// shared, and both
        /// may be queried at once.</summary>
        /// <param name="placement">Where.</param>
        /// <param name="warp">What moves its vertices before that; null: nothing.</param>
        public MeshGeometry At(in Placement placement, SmoothWarp? warp = null) =>
            new MeshGeometry(this, placement, warp);

        /// <summary>The hierarchy over the placed triangles.</summary>
        public Bvh Tree => _tree ??= _other?.Tree.Over(_corners) ?? new Bvh(_corners);

        /// <summary>Corners of triangle t, at 3 t to 3 t + 2, units.</summary>
        public Vector3d[] Corners => _corners;

        /// <summary>Unit normals of the triangles, into the lumen.</summary>
        public Vector3d[] FaceNormals => _faceNormals;

        /// <summary>The number of vertices.</summary>
        public int VertexCount => _rest.Length;

        /// <summary>The vertex at which a half-edge starts: half-edge 3 t + k starts at corner k of triangle
        /// t.</summary>
        public int VertexAt(int halfEdge) => _triangles[halfEdge];

        /// <summary>The first half-edge that starts at a vertex.</summary>
        public int HalfEdgeOfVertex(int vertex) => _halfEdgeOfVertex[vertex];

        /// <summary>Is true for a vertex of an open rim.</summary>
        public bool IsRimVertex(int vertex) => _isRimVertex[vertex];

        /// <summary>The edge of a half-edge, by the lower of the two half-edges at which its two triangles have
        /// it.</summary>
        public int EdgeOf(int halfEdge) => _twin[halfEdge] < 0 ? halfEdge : Math.Min(halfEdge, _twin[halfEdge]);

        /// <summary>Is true for an edge of an open rim.</summary>
        public bool IsRimEdge(int edge) => _twin[edge] < 0;

        /// <summary>Gives the unit normal of an edge: the sum of its faces' normals, of a rim's edge that of its one
        /// face.</summary>
        public Vector3d NormalOfEdge(int edge) => FeatureNormal(edge / 3, ClosestPoints.Edge + edge % 3, out _);

        /// <summary>Corners of an edge's two ends, that of the lower vertex first, so that the edge has one direction
        /// whatever its triangles do.</summary>
        public void EndsOf(int edge, out int from, out int to)
        {
            from = edge;
            to = HalfEdges.Next(edge);
            if (_triangles[from] > _triangles[to])
            {
                (from, to) = (to, from);
            }
        }

        /// <summary>Moves everything by a new placement.</summary>
        public void Place(in Placement placement)
        {
            Update(placement);
            _tree?.Refit(_corners);
        }

        /// <summary>The contact of point x with the feature on which its nearest point c lies.</summary>
        public SurfaceContact ContactAt(
            in Vector3d x, double position, in Vector3d c, double distance, int triangle, int feature)
        {
            Vector3d inward = FeatureNormal(triangle, feature, out bool isRim);
            if (!(distance > 0.0))
            {
                return new SurfaceContact(position, c, inward, 0.0);
            }
            Vector3d away = (x - c) / distance;
            return isRim || Vector3d.Dot(away, inward) >= 0.0
                ? new SurfaceContact(position, c, away, distance)
                : new SurfaceContact(position, c, -away, -distance);
        }

        private Vector3d FeatureNormal(int triangle, int feature, out bool isRim)
        {
            isRim = false;
            if (feature == ClosestPoints.Face)
            {
                return _faceNormals[triangle];
            }
            if (feature >= ClosestPoints.Corner)
            {
                int vertex = _triangles[3 * triangle + feature - ClosestPoints.Corner];
                isRim = _isRimVertex[vertex];
                return NormalOfVertex(vertex);
            }
            int twin = _twin[3 * triangle + feature - ClosestPoints.Edge];
            isRim = twin < 0;
            return isRim
                ? _faceNormals[triangle] : Vector3d.Normalize(_faceNormals[triangle] + _faceNormals[twin / 3]);
        }

        private void Update(in Placement placement)
        {
            _mirrored = placement.Mirrors;
            var vertices = new Vector3d[_rest.Length];
            for (int i = 0; i < vertices.Length; i++)
            {
                vertices[i] = placement.Apply(_rest[i]);
            }
            Array.Clear(_vertexNormals, 0, _vertexNormals.Length);
            for (int t = 0; t < _faceNormals.Length; t++)
            {
                for (int k = 3 * t; k < 3 * t + 3; k++)
                {
                    _corners[k] = vertices[_triangles[k]];
                }
                Vector3d normal = Vector3d.Normalize(Vector3d.Cross(
                    _corners[3 * t + 1] - _corners[3 * t], _corners[3 * t + 2] - _corners[3 * t]));
                _faceNormals[t] = _mirrored ? -normal : normal;
            }
        }

        // The sum of the faces' normals around it, each weighted by its angle there. A run asks for a few of them.
        private Vector3d NormalOfVertex(int vertex)
        {
            if (_vertexNormals[vertex].LengthSquared > 0.0)
            {
                return _vertexNormals[vertex];
            }
            Vector3d sum = Vector3d.Zero;
            for (int at = _firstAround[vertex]; at < _firstAround[vertex + 1]; at++)
            {
                int t = _around[at] / 3;
                int k = _around[at] % 3;
                double angle = Angle(_corners[3 * t + (k + 1) % 3] - _corners[3 * t + k],
                    _corners[3 * t + (k + 2) % 3] - _corners[3 * t + k]);
                sum += angle * _faceNormals[t];
            }
            return _vertexNormals[vertex] = Vector3d.Normalize(sum);
        }

        private void SortByVertex(out int[] first, out int[] around)
        {
            first = new int[_rest.Length + 1];
            foreach (int vertex in _triangles)
            {
                first[vertex + 1]++;
            }
            for (int vertex = 0; vertex < _rest.Length; vertex++)
            {
                first[vertex + 1] += first[vertex];
            }
            around = new int[_triangles.Length];
            int[] next = (int[])first.Clone();
            for (int halfEdge = 0; halfEdge < _triangles.Length; halfEdge++)
            {
                around[next[_triangles[halfEdge]]++] = halfEdge;
            }
        }

        private static double Angle(in Vector3d u, in Vector3d v) =>
            Math.Atan2(Vector3d.Cross(u, v).Length, Vector3d.Dot(u, v));

        private static void AddFan(List<Vector3d> vertices, List<int> triangles, int[] rim)
        {
            int centre = vertices.Count;
            vertices.Add(TriangleMesh.RimCentre(vertices.ToArray(), rim));
            for (int i = 0; i < rim.Length; i++)
            {
                triangles.Add(rim[(i + 1) % rim.Length]);
                triangles.Add(rim[i]);
                triangles.Add(centre);
            }
        }
    }

    /// <summary>Four planes of each triangle of a mesh, tested at once: its own, and those through its edges across it.
    /// Triangles that are surely farther from a point than a distance, or from all of its straight path, are left out
    /// by them before closest points are searched for.</summary>
    /// <remarks>A point with height h over the triangle and e over one of its edges, in its plane and negative outside,
    /// is no nearer to it than sqrt(h^2 + min(0, e)^2). Needles, whose normals have few digits, are never left
    /// out.</remarks>
    internal sealed class TrianglePlanes
    {
        private const int Lanes = 4;
        private const int Stride = 4 * Lanes;        // normals by component, offsets
        private const double RoundedUp = 1.0 + 1e-9;
        private const double OfCoordinates = 1e-14;
        private const double OfEdges = 1e-11;        // that of a normal next to a needle's
        private readonly double[] _planes;           // by triangle
        private readonly double _rounding;           // of a height at most, units

        /// <summary>Makes the planes of triangles with three corners each, units.</summary>
        public TrianglePlanes(Vector3d[] corners)
        {
            _planes = new double[Stride * (corners.Length / 3)];
            double largest = 0.0;
            double longest = 0.0;
            for (int t = 0; t < corners.Length / 3; t++)
            {
                Vector3d n = Vector3d.Cross(corners[3 * t + 1] - corners[3 * t], corners[3 * t + 2] - corners[3 * t]);
                bool isNeedle = ClosestPoints.IsNeedle(
                    n.LengthSquared, corners[3 * t + 1] - corners[3 * t], corners[3 * t + 2] - corners[3 * t]);
                n = isNeedle ? Vector3d.Zero : Vector3d.Normalize(n);
                Put(t, 0, n, corners[3 * t]);
                for (int k = 0; k < 3; k++)
                {
                    Vector3d from = corners[3 * t + k];
                    Vector3d along = corners[3 * t + (k + 1) % 3] - from;
                    Put(t, k + 1, isNeedle ? Vector3d.Zero : Vector3d.Normalize(Vector3d.Cross(n, along)), from);
                    largest = Math.Max(largest, from.LengthSquared);
                    longest = Math.Max(longest, along.LengthSquared);
                }
            }
            _rounding = OfCoordinates * Math.Sqrt(largest) + OfEdges * Math.Sqrt(longest);
        }

        /// <summary>False where a triangle is surely farther from a point than a distance, units.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public bool MayBeWithin(in Vector3d x, double distance, int triangle)
        {
            double limit = RoundedUp * distance + _rounding;
            return SquaredBound(x, triangle) <= limit * limit;
        }

        /// <summary>Lower bound of a triangle's distance from a point, units; negative where none is known.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public double MinDistance(in Vector3d x, int triangle) =>
            (Math.Sqrt(SquaredBound(x, triangle)) - _rounding) / RoundedUp;

        /// <summary>False where a point that moves in a straight line stays beyond one of a triangle's planes by more
        /// than a distance, units.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public bool MayMeet(in Vector3d from, in Vector3d to, double distance, int triangle)
        {
            double limit = RoundedUp * distance + _rounding;
#if NET8_0_OR_GREATER
            Vector256<double> start = Heights(from, triangle);
            Vector256<double> end = Heights(to, triangle);
            return !Vector256.LessThanAny(Vector256.Max(start, end), Vector256.Create(-limit))
                && !(Math.Min(start[0], end[0]) > limit);
#else
            for (int k = 0; k < Lanes; k++)
            {
                double start = Height(from, triangle, k);
                double end = Height(to, triangle, k);
                if (Math.Max(start, end) < -limit || (k == 0 && Math.Min(start, end) > limit))
                {
                    return false;
                }
            }
            return true;
#endif
        }

        // Square of a lower bound of the distance, but for rounding.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private double SquaredBound(in Vector3d x, int triangle)
        {
#if NET8_0_OR_GREATER
            Vector256<double> heights = Heights(x, triangle);
            double height = heights[0];
            double outside = Math.Min(Math.Min(0.0, heights[1]), Math.Min(heights[2], heights[3]));
#else
            double height = Height(x, triangle, 0);
            double outside = Math.Min(Math.Min(0.0, Height(x, triangle, 1)),
                Math.Min(Height(x, triangle, 2), Height(x, triangle, 3)));
#endif
            return height * height + outside * outside;
        }

#if NET8_0_OR_GREATER
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private Vector256<double> Heights(in Vector3d x, int triangle)
        {
            ref double first = ref Unsafe.Add(ref MemoryMarshal.GetArrayDataReference(_planes), Stride * triangle);
            return Vector256.LoadUnsafe(ref first) * x.X + Vector256.LoadUnsafe(ref Unsafe.Add(ref first, Lanes)) * x.Y
                + Vector256.LoadUnsafe(ref Unsafe.Add(ref first, 2 * Lanes)) * x.Z
                - Vector256.LoadUnsafe(ref Unsafe.Add(ref first, 3 * Lanes));
        }
#else
        private double Height(in Vector3d x, int triangle, int plane)
        {
            int at = Stride * triangle + plane;
            return _planes[at] * x.X + _planes[at + Lanes] * x.Y + _planes[at + 2 * Lanes] * x.Z
                - _planes[at + 3 * Lanes];
        }
#endif

        private void Put(int triangle, int plane, in Vector3d normal, in Vector3d point)
        {
            int at = Stride * triangle + plane;
            _planes[at] = normal.X;
            _planes[at + Lanes] = normal.Y;
            _planes[at + 2 * Lanes] = normal.Z;
            _planes[at + 3 * Lanes] = Vector3d.Dot(normal, point);
        }
    }
}

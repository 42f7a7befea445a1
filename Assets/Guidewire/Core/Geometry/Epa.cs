using System;

namespace Guidewire.Core
{
    /// <summary>Depth by which a segment overlaps a convex hull (van den Bergen 2001, expanding polytope): the face of
    /// their Minkowski difference nearest to the origin, found by growing a polytope inside the difference.</summary>
    /// <remarks>The difference of a segment and a flat hull has no volume; touching such a hull has depth 0 and a
    /// normal of the flat figure. Scratch memory is made once, for <see cref="MaxVertices"/> vertices; where a hull
    /// needs more, the depth found so far is returned, a lower bound.</remarks>
    internal sealed class Epa
    {
        private const int MaxVertices = 256;
        private const double Resolution = 1e-13;
        private readonly MinkowskiVertex[] _vertices = new MinkowskiVertex[MaxVertices];
        private readonly int[] _face = new int[6 * MaxVertices];
        private readonly Vector3d[] _normal = new Vector3d[2 * MaxVertices];
        private readonly double[] _height = new double[2 * MaxVertices];
        private readonly int[] _edge = new int[6 * MaxVertices];
        private int _vertexCount;
        private int _faceCount;
        private Vector3d _inside;

        /// <summary>Depth (0 or more), with the outward normal of the hull at its <paramref name="point"/> and the
        /// position <paramref name="s"/> on the segment, from a simplex of vertices that holds the origin.</summary>
        public double Depth(
            in Vector3d a, in Vector3d b, Vector3d[] hull, MinkowskiVertex[] simplex, int count,
            out double s, out Vector3d point, out Vector3d normal)
        {
            Array.Copy(simplex, _vertices, count);
            _vertexCount = count;
            if (!Complete(a, b, hull, out normal))
            {
                Gjk.Witness(simplex, count, out s, out point);
                return 0.0;
            }
            Start();
            while (true)
            {
                int nearest = NearestFace();
                normal = -_normal[nearest];
                MinkowskiVertex next = MinkowskiVertex.Support(a, b, hull, _normal[nearest]);
                double size = Math.Max(1e-300, next.Offset.Length);
                double gain = Vector3d.Dot(next.Offset, _normal[nearest]) - _height[nearest];
                if (gain <= Resolution * size || _vertexCount == MaxVertices || !Grow(next))
                {
                    Vector3d foot = _height[nearest] * _normal[nearest];
                    Gjk.Blend(
                        _vertices[_face[3 * nearest]], _vertices[_face[3 * nearest + 1]],
                        _vertices[_face[3 * nearest + 2]], foot, out s, out point);
                    return Math.Max(0.0, _height[nearest]);
                }
            }
        }

        // Adds vertices until four of them span a volume; false, with a normal of the figure, when none do.
        private bool Complete(in Vector3d a, in Vector3d b, Vector3d[] hull, out Vector3d normal)
        {
            normal = Vector3d.UnitX;
            if (_vertexCount == 4 && Volume() > 0.0)
            {
                return true;
            }
            _vertexCount = Math.Min(_vertexCount, 3);
            while (_vertexCount < 4)
            {
                if (!AddOutside(a, b, hull, out normal))
                {
                    return false;
                }
            }
            return true;
        }

        private bool AddOutside(in Vector3d a, in Vector3d b, Vector3d[] hull, out Vector3d normal)
        {
            normal = Vector3d.UnitX;
            for (int k = 0; k < 6; k++)
            {
                Vector3d axis = k < 2 ? Vector3d.UnitX : k < 4 ? Vector3d.UnitY : Vector3d.UnitZ;
                Vector3d direction = (k & 1) == 0 ? axis : -axis;
                if (_vertexCount == 2)
                {
                    direction = Vector3d.Cross(_vertices[1].Offset - _vertices[0].Offset, direction);
                }
                else if (_vertexCount == 3)
                {
                    direction = Vector3d.Cross(
                        _vertices[1].Offset - _vertices[0].Offset, _vertices[2].Offset - _vertices[0].Offset);
                    direction = (k & 1) == 0 ? direction : -direction;
                }
                if (!(direction.Length > 0.0))
                {
                    continue;
                }
                normal = Vector3d.Normalize(direction);
                MinkowskiVertex next = MinkowskiVertex.Support(a, b, hull, normal);
                double height = Vector3d.Dot(next.Offset - _vertices[0].Offset, normal);
                if (height > Resolution * (next.Offset.Length + _vertices[0].Offset.Length))
                {
                    _vertices[_vertexCount++] = next;
                    return true;
                }
            }
            return false;
        }

        private double Volume()
        {
            Vector3d p = _vertices[0].Offset;
            double volume = Math.Abs(Vector3d.Dot(
                Vector3d.Cross(_vertices[1].Offset - p, _vertices[2].Offset - p), _vertices[3].Offset - p));
            double size = Math.Max(p.Length, _vertices[3].Offset.Length);
            return volume > Resolution * size * size * size ? volume : 0.0;
        }

        private void Start()
        {
            _faceCount = 0;
            _inside = 0.25 * (_vertices[0].Offset + _vertices[1].Offset + _vertices[2].Offset + _vertices[3].Offset);
            AddFace(0, 1, 2);
            AddFace(0, 1, 3);
            AddFace(0, 2, 3);
            AddFace(1, 2, 3);
        }

        private void AddFace(int i, int j, int k)
        {
            Vector3d p = _vertices[i].Offset;
            Vector3d n = Vector3d.Normalize(Vector3d.Cross(_vertices[j].Offset - p, _vertices[k].Offset - p));
            bool outward = Vector3d.Dot(n, p - _inside) >= 0.0;
            _face[3 * _faceCount] = i;
            _face[3 * _faceCount + 1] = outward ? j : k;
            _face[3 * _faceCount + 2] = outward ? k : j;
            _normal[_faceCount] = outward ? n : -n;
            _height[_faceCount] = Vector3d.Dot(_normal[_faceCount], p);
            _faceCount++;
        }

        private int NearestFace()
        {
            int nearest = 0;
            for (int f = 1; f < _faceCount; f++)
            {
                if (_height[f] < _height[nearest] && _normal[f] != Vector3d.Zero)
                {
                    nearest = f;
                }
            }
            return nearest;
        }

        // Replaces all faces that the new vertex lies above by a cone from it to their rim.
        private bool Grow(in MinkowskiVertex next)
        {
            int edges = 0;
            int kept = 0;
            for (int f = 0; f < _faceCount; f++)
            {
                if (Vector3d.Dot(_normal[f], next.Offset) > _height[f])
                {
                    edges = AddEdge(_face[3 * f], _face[3 * f + 1], edges);
                    edges = AddEdge(_face[3 * f + 1], _face[3 * f + 2], edges);
                    edges = AddEdge(_face[3 * f + 2], _face[3 * f], edges);
                    continue;
                }
                Array.Copy(_face, 3 * f, _face, 3 * kept, 3);
                _normal[kept] = _normal[f];
                _height[kept] = _height[f];
                kept++;
            }
            if (edges == 0)
            {
                return false;
            }
            _faceCount = kept;
            _vertices[_vertexCount] = next;
            for (int e = 0; e < edges && _faceCount < _normal.Length; e++)
            {
                AddFace(_edge[2 * e], _edge[2 * e + 1], _vertexCount);
            }
            _vertexCount++;
            return true;
        }

        // An edge between two removed faces comes twice, in both directions, and is no rim.
        private int AddEdge(int from, int to, int edges)
        {
            for (int e = 0; e < edges; e++)
            {
                if (_edge[2 * e] == to && _edge[2 * e + 1] == from)
                {
                    _edge[2 * e] = _edge[2 * edges - 2];
                    _edge[2 * e + 1] = _edge[2 * edges - 1];
                    return edges - 1;
                }
            }
            _edge[2 * edges] = from;
            _edge[2 * edges + 1] = to;
            return edges + 1;
        }
    }
}

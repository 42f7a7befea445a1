using System;

namespace Guidewire.Core
{
    /// <summary>Distance of a segment from the convex hull of some points (Gilbert, Johnson and Keerthi 1988): the
    /// point of their Minkowski difference nearest to the origin, found on a simplex that moves towards it.</summary>
    /// <remarks>Holds scratch memory: one object serves one thread. Sizes: the answer is within 1e-12 of the largest
    /// offset between the two.</remarks>
    internal sealed class Gjk
    {
        private const int MaxIterations = 100;
        private const double Resolution = 1e-13;
        private readonly MinkowskiVertex[] _simplex = new MinkowskiVertex[4];
        private readonly MinkowskiVertex[] _reduced = new MinkowskiVertex[4];
        private readonly Epa _epa = new Epa();
        private int _count;

        /// <summary>Signed distance of segment a b from the hull: positive apart, minus the depth where they overlap.
        /// <paramref name="normal"/> points from the hull's <paramref name="point"/> to the segment's at <paramref
        /// name="s"/>, or where they overlap in the direction of the shortest displacement that separates
        /// them.</summary>
        public double Distance(
            in Vector3d a, in Vector3d b, Vector3d[] hull, out double s, out Vector3d point, out Vector3d normal)
        {
            Vector3d nearest = a - hull[0];
            _simplex[0] = MinkowskiVertex.Support(a, b, hull, -nearest);
            _count = 1;
            nearest = _simplex[0].Offset;
            double size = nearest.Length;
            bool overlap = false;
            for (int k = 0; k < MaxIterations; k++)
            {
                double distance = nearest.Length;
                if (distance <= Resolution * size)
                {
                    overlap = true;
                    break;
                }
                MinkowskiVertex next = MinkowskiVertex.Support(a, b, hull, -nearest);
                size = Math.Max(size, next.Offset.Length);

                // The difference lies beyond the plane through the next vertex: no point of it is nearer than that.
                double gap = distance - Vector3d.Dot(nearest, next.Offset) / distance;
                if (gap <= Resolution * size || IsKnown(next))
                {
                    break;
                }
                _simplex[_count++] = next;
                Vector3d closer = Reduce(out bool inside);
                if (inside)
                {
                    overlap = true;
                    break;
                }
                if (!(closer.LengthSquared < nearest.LengthSquared))
                {
                    nearest = closer;
                    break;
                }
                nearest = closer;
            }
            if (overlap)
            {
                return -_epa.Depth(a, b, hull, _simplex, _count, out s, out point, out normal);
            }
            Witness(_simplex, _count, out s, out point);
            double apart = nearest.Length;
            normal = nearest / apart;
            return apart;
        }

        private bool IsKnown(in MinkowskiVertex vertex)
        {
            for (int i = 0; i < _count; i++)
            {
                if (_simplex[i].End == vertex.End && _simplex[i].HullVertex == vertex.HullVertex)
                {
                    return true;
                }
            }
            return false;
        }

        // Leaves in the simplex only the corners that hold its point nearest to the origin, and returns that point.
        private Vector3d Reduce(out bool inside)
        {
            inside = false;
            if (_count == 2)
            {
                double t = ClosestPoints.PointSegment(Vector3d.Zero, _simplex[0].Offset, _simplex[1].Offset);
                return KeepEdge(t);
            }
            if (_count == 3)
            {
                ClosestPoints.PointTriangle(
                    Vector3d.Zero, _simplex[0].Offset, _simplex[1].Offset, _simplex[2].Offset,
                    out Vector3d point, out int feature);
                KeepFeature(0, 1, 2, feature);
                return point;
            }
            return ReduceTetrahedron(out inside);
        }

        private Vector3d ReduceTetrahedron(out bool inside)
        {
            double best = double.PositiveInfinity;
            Vector3d nearest = Vector3d.Zero;
            int bestOpposite = -1;
            int bestFeature = 0;
            for (int opposite = 0; opposite < 4; opposite++)
            {
                Vector3d p = _simplex[(opposite + 1) & 3].Offset;
                Vector3d q = _simplex[(opposite + 2) & 3].Offset;
                Vector3d r = _simplex[(opposite + 3) & 3].Offset;
                Vector3d n = Vector3d.Cross(q - p, r - p);
                double corner = Vector3d.Dot(n, _simplex[opposite].Offset - p);
                double origin = -Vector3d.Dot(n, p);
                if (corner * origin > 0.0)
                {
                    continue;
                }
                double squared = ClosestPoints.PointTriangle(
                    Vector3d.Zero, p, q, r, out Vector3d point, out int feature);
                if (squared < best)
                {
                    best = squared;
                    nearest = point;
                    bestOpposite = opposite;
                    bestFeature = feature;
                }
            }
            inside = bestOpposite < 0;
            if (!inside)
            {
                KeepFeature((bestOpposite + 1) & 3, (bestOpposite + 2) & 3, (bestOpposite + 3) & 3, bestFeature);
            }
            return nearest;
        }

        private void KeepFeature(int i, int j, int k, int feature)
        {
            _reduced[0] = _simplex[i];
            _reduced[1] = _simplex[j];
            _reduced[2] = _simplex[k];
            int first = feature >= ClosestPoints.Corner ? feature - ClosestPoints.Corner
                : feature >= ClosestPoints.Edge ? feature - ClosestPoints.Edge : 0;
            _count = feature >= ClosestPoints.Corner ? 1 : feature >= ClosestPoints.Edge ? 2 : 3;
            for (int n = 0; n < _count; n++)
            {
                _simplex[n] = _reduced[(first + n) % 3];
            }
        }

        private Vector3d KeepEdge(double t)
        {
            Vector3d nearest = Vector3d.Lerp(_simplex[0].Offset, _simplex[1].Offset, t);
            _count = t > 0.0 && t < 1.0 ? 2 : 1;
            if (!(t < 1.0))
            {
                _simplex[0] = _simplex[1];
            }
            return nearest;
        }

        /// <summary>What lies on segment and hull at the point of a simplex of one to three vertices that is nearest to
        /// the origin.</summary>
        public static void Witness(MinkowskiVertex[] simplex, int count, out double s, out Vector3d point)
        {
            if (count == 1)
            {
                s = simplex[0].End;
                point = simplex[0].HullVertex;
            }
            else if (count == 2)
            {
                double t = ClosestPoints.PointSegment(Vector3d.Zero, simplex[0].Offset, simplex[1].Offset);
                s = (1.0 - t) * simplex[0].End + t * simplex[1].End;
                point = Vector3d.Lerp(simplex[0].HullVertex, simplex[1].HullVertex, t);
            }
            else
            {
                Blend(simplex[0], simplex[1], simplex[2], Vector3d.Zero, out s, out point);
            }
        }

        /// <summary>What lies on segment and hull at the point of face p q r nearest to x.</summary>
        public static void Blend(
            in MinkowskiVertex p, in MinkowskiVertex q, in MinkowskiVertex r, in Vector3d x,
            out double s, out Vector3d point)
        {
            Vector3d n = Vector3d.Cross(q.Offset - p.Offset, r.Offset - p.Offset);
            double nn = n.LengthSquared;
            double weightQ = Vector3d.Dot(Vector3d.Cross(x - p.Offset, r.Offset - p.Offset), n) / nn;
            double weightR = Vector3d.Dot(Vector3d.Cross(q.Offset - p.Offset, x - p.Offset), n) / nn;
            double weightP = 1.0 - weightQ - weightR;
            s = weightP * p.End + weightQ * q.End + weightR * r.End;
            point = weightP * p.HullVertex + weightQ * q.HullVertex + weightR * r.HullVertex;
        }
    }

    /// <summary>A vertex of the difference of a segment and a hull: one end of the segment less one vertex of the hull.
    /// The two meet where the difference holds the origin.</summary>
    internal readonly struct MinkowskiVertex
    {
        /// <summary>End less hull vertex.</summary>
        public readonly Vector3d Offset;

        /// <summary>The hull's vertex.</summary>
        public readonly Vector3d HullVertex;

        /// <summary>0 for the segment's first end, 1 for its second.</summary>
        public readonly double End;

        private MinkowskiVertex(in Vector3d offset, in Vector3d hullVertex, double end)
        {
            Offset = offset;
            HullVertex = hullVertex;
            End = end;
        }

        /// <summary>Gives the vertex farthest along <paramref name="direction"/>.</summary>
        public static MinkowskiVertex Support(in Vector3d a, in Vector3d b, Vector3d[] hull, in Vector3d direction)
        {
            int lowest = 0;
            double least = double.PositiveInfinity;
            for (int i = 0; i < hull.Length; i++)
            {
                double value = Vector3d.Dot(hull[i], direction);
                if (value < least)
                {
                    least = value;
                    lowest = i;
                }
            }
            bool second = Vector3d.Dot(b - a, direction) > 0.0;
            Vector3d end = second ? b : a;
            return new MinkowskiVertex(end - hull[lowest], hull[lowest], second ? 1.0 : 0.0);
        }
    }

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

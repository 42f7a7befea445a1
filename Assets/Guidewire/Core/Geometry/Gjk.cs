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
}

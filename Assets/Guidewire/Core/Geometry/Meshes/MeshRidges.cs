using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>The ridges of a mesh: edges at which its two faces turn towards the free side, and edges of open
    /// rims.</summary>
    /// <remarks>The weight of an edge is the angle between its faces, 1 at a rim. Where segment and edge are parallel
    /// their closest points jump; so the weight fades as c = sin^2 of the angle between them goes to 0: t (2 - t) with
    /// t = c/0.01. A segment along an edge is seen at its ends.</remarks>
    internal sealed class MeshRidges
    {
        private const double Fade = 0.01;         // of sin^2
        private const double LeastAngle = 1e-6;   // radians
        private const double RimWeight = 1.0;
        private readonly MeshGeometry _mesh;
        private readonly double[] _weight;        // of the edge that starts at a place, 0 for all but its own
        private readonly StructList<int> _edges = new StructList<int>(64);

        /// <summary>For this mesh where it stands.</summary>
        public MeshRidges(MeshGeometry mesh)
        {
            _mesh = mesh;
            _weight = new double[mesh.Corners.Length];
            for (int place = 0; place < _weight.Length; place++)
            {
                int edge = mesh.EdgeOf(place);
                if (mesh.IsRimEdge(edge))
                {
                    _weight[edge] = RimWeight;
                }
                else if (place != edge)
                {
                    _weight[edge] = Angle(edge, place);
                }
            }
        }

        /// <summary>Places of the edges that are ridges.</summary>
        public int[] Edges()
        {
            var edges = new List<int>();
            for (int place = 0; place < _weight.Length; place++)
            {
                if (_weight[place] > 0.0)
                {
                    edges.Add(place);
                }
            }
            return edges.ToArray();
        }

        /// <summary>Adds the ridges within <paramref name="range"/> of segment a b, in the order of their
        /// places.</summary>
        public void Find(in Vector3d a, in Vector3d b, double range, MeshNearby nearby, FeatureRange among,
            StructList<WallRidge> ridges)
        {
            _edges.Clear();
            if (!among.IsKnown)
            {
                nearby.ChooseRidges(a, b, range, _edges);
            }
            for (int k = among.From; k < among.To && among.LeastDistance(k) <= range; k++)
            {
                _edges.Add(among[k]);
            }
            _edges.Sort(0);
            for (int k = 0; k < _edges.Count; k++)
            {
                Add(a, b, range, _edges[k], ridges);
            }
        }

        private void Add(in Vector3d a, in Vector3d b, double range, int edge, StructList<WallRidge> ridges)
        {
            _mesh.EndsOf(edge, out int from, out int to);
            Vector3d start = _mesh.Corners[from];
            Vector3d end = _mesh.Corners[to];
            double squared = ClosestPoints.SegmentSegment(a, b, start, end, out double s, out double t);
            if (squared > range * range || squared == 0.0)
            {
                return;
            }
            double distance = Math.Sqrt(squared);
            Vector3d normal = (Vector3d.Lerp(a, b, s) - Vector3d.Lerp(start, end, t)) / distance;
            double weight = _weight[edge];
            Vector3d slope = Vector3d.Zero;
            Vector3d u = b - a;
            Vector3d along = Vector3d.Normalize(end - start);
            double size = u.Length;
            Vector3d direction = u / size;
            double cosine = Vector3d.Dot(direction, along);
            double share = Math.Max(0.0, 1.0 - cosine * cosine) / Fade;
            if (share < 1.0)
            {
                double rate = 2.0 * (1.0 - share) / Fade;
                slope = (weight * rate * -2.0 * cosine / size) * (along - cosine * direction);
                weight *= share * (2.0 - share);
            }
            var ridge = new WallRidge(s, distance, normal, weight, -slope, slope);
            ridges.Add(s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0 ? Sliding(ridge, u, along) : ridge);
        }

        // Between the ends of both the crossing slides to where the distance along the segment stays least.
        private static WallRidge Sliding(in WallRidge ridge, in Vector3d u, in Vector3d along)
        {
            double s = ridge.Position;
            Vector3d n = ridge.Normal;
            Vector3d across = Vector3d.Cross(n, along);
            double rate = Vector3d.Dot(across, u) / ridge.Distance;
            double perSecond = -ridge.Distance / (Vector3d.Dot(across, u) * Vector3d.Dot(across, u));
            return ridge.Sliding(perSecond * ((1.0 - s) * rate * across - n), perSecond * (s * rate * across + n),
                Symmetric3.Outer(1.0 / ridge.Distance, across));
        }

        // By which the faces on both sides of an edge turn towards the free side; 0 in a valley.
        private double Angle(int edge, int twin)
        {
            Vector3d first = _mesh.FaceNormals[edge / 3];
            Vector3d second = _mesh.FaceNormals[twin / 3];
            int opposite = 3 * (twin / 3) + (twin % 3 + 2) % 3;
            bool bulges = Vector3d.Dot(_mesh.Corners[opposite] - _mesh.Corners[edge], first) < 0.0;
            double angle = Math.Atan2(Vector3d.Cross(first, second).Length, Vector3d.Dot(first, second));
            return bulges && angle > LeastAngle ? angle : 0.0;
        }
    }
}

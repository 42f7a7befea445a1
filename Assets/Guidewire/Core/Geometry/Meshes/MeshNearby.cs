using System;

namespace Guidewire.Core
{
    /// <summary>The features of a mesh near a wire, found once in the hierarchies and then queried as the wire moves:
    /// triangles near nodes, convex edges near elements.</summary>
    /// <remarks>The interior of an element can only be nearer to the wall than its ends where the wall bulges: at the
    /// nearest point of a valley, a flat wall or a concave corner the distance is a concave function along the element.
    /// So points need the triangles, and elements only the convex edges; corners are ends of those.</remarks>
    internal sealed class MeshNearby
    {
        private const double RoundedUp = 1.0 + 1e-9;
        private readonly MeshGeometry _mesh;
        private readonly Vector3d[] _centre;     // of the triangles
        private readonly double[] _radius;       // of the balls around them
        private readonly TrianglePlanes _planes;
        private readonly int[] _convexEdge;           // half-edges of the convex edges
        private readonly Vector3d[] _edgeNormal; // between those of an edge's faces, unit vectors
        private readonly Bvh? _edgeTree;
        private readonly StructList<int> _found = new StructList<int>(256);

        /// <summary>Searches this mesh at its placement.</summary>
        /// <param name="mesh">Its triangles.</param>
        /// <param name="edgeContacts">Its convex edges.</param>
        /// <param name="other">The search before the placement, whose hierarchy does where the same edges are convex.
        /// </param>
        public MeshNearby(MeshGeometry mesh, MeshEdges edgeContacts, MeshNearby? other = null)
        {
            _mesh = mesh;
            _centre = new Vector3d[mesh.Corners.Length / 3];
            _radius = new double[_centre.Length];
            for (int i = 0; i < _centre.Length; i++)
            {
                Vector3d centre = (1.0 / 3.0) * (mesh.Corners[3 * i] + mesh.Corners[3 * i + 1]
                    + mesh.Corners[3 * i + 2]);
                _centre[i] = centre;
                for (int k = 3 * i; k < 3 * i + 3; k++)
                {
                    _radius[i] = Math.Max(_radius[i], Vector3d.Distance(centre, mesh.Corners[k]));
                }
            }
            _planes = new TrianglePlanes(mesh.Corners);
            _convexEdge = edgeContacts.Edges();
            _edgeNormal = Array.ConvertAll(_convexEdge, mesh.NormalOfEdge);
            if (_convexEdge.Length > 0)
            {
                var corners = new Vector3d[3 * _convexEdge.Length];
                for (int k = 0; k < _convexEdge.Length; k++)
                {
                    mesh.EndsOf(_convexEdge[k], out int from, out int to);
                    corners[3 * k] = mesh.Corners[from];
                    corners[3 * k + 1] = mesh.Corners[to];
                    corners[3 * k + 2] = mesh.Corners[to];
                }
                _edgeTree = other != null && other._convexEdge.AsSpan().SequenceEqual(_convexEdge)
                    ? other._edgeTree!.Over(corners, _edgeNormal) : new Bvh(corners, _edgeNormal);
            }
        }

        /// <summary>Adds the triangles that may be within a range of a point, nearest first.</summary>
        /// <returns>The distance of the nearest; infinite where there is none.</returns>
        public double FindTriangles(in Vector3d x, double range, StructList<WallFeature> triangles)
        {
            int from = triangles.Count;
            _found.Clear();
            _mesh.Tree.Within(x, x, range, _found);
            for (int k = 0; k < _found.Count; k++)
            {
                double least = MinDistance(x, _found[k]);
                if (least <= range)
                {
                    triangles.Add(new WallFeature(_found[k], least));
                }
            }
            triangles.Sort(from);
            double nearest = double.PositiveInfinity;
            for (int k = from; k < triangles.Count && triangles[k].Distance < nearest; k++)
            {
                int i = 3 * triangles[k].Index;
                double squared = ClosestPoints.PointTriangle(
                    x, _mesh.Corners[i], _mesh.Corners[i + 1], _mesh.Corners[i + 2], out _, out _);
                nearest = Math.Min(nearest, Math.Sqrt(squared));
            }
            return nearest;
        }

        /// <summary>Adds the edge contacts within a range of segment a b, nearest first.</summary>
        /// <returns>The distance of the nearest; infinite where there is none.</returns>
        public double FindEdgeContacts(in Vector3d a, in Vector3d b, double range, StructList<WallFeature> edgeContacts)
        {
            int from = edgeContacts.Count;
            _found.Clear();
            _edgeTree?.Within(a, b, range, _found);
            for (int k = 0; k < _found.Count; k++)
            {
                int edge = _convexEdge[_found[k]];
                double distance = Distance(a, b, edge);
                if (distance <= range)
                {
                    edgeContacts.Add(new WallFeature(edge, distance));
                }
            }
            edgeContacts.Sort(from);
            return edgeContacts.Count > from ? edgeContacts[from].Distance : double.PositiveInfinity;
        }

        /// <summary>Adds those triangles that may be within a distance of a point.</summary>
        public void Choose(in Vector3d x, double distance, FeatureRange among, StructList<int> triangles)
        {
            for (int k = among.From; k < among.To && among.MinDistance(k) <= distance; k++)
            {
                if (_planes.MayBeWithin(x, distance, among[k]))
                {
                    triangles.Add(among[k]);
                }
            }
        }

        /// <summary>Adds the convex edges that may be within a distance of segment a b.</summary>
        public void ChooseEdges(in Vector3d a, in Vector3d b, double distance, StructList<int> edgeContacts)
        {
            int from = edgeContacts.Count;
            _edgeTree?.Within(a, b, distance, edgeContacts);
            for (int k = from; k < edgeContacts.Count; k++)
            {
                edgeContacts[k] = _convexEdge[edgeContacts[k]];
            }
        }

        /// <summary>Lowers the fraction, at most 1, of a point's motion during which it stays at least <paramref
        /// name="clearance"/> from every triangle, as <see cref="Bvh.TimeOfImpact"/> does, but without convex
        /// edges.</summary>
        public void ImpactOfPoint(in Vector3d from, in Vector3d to, double clearance, double resolution,
            FeatureRange among, ref double impact)
        {
            if (!among.IsKnown)
            {
                ImpactOfPoint(from, to, clearance, resolution, ref impact);
                return;
            }
            double motion = Vector3d.Distance(from, to);
            Vector3d end = Vector3d.Lerp(from, to, impact);
            if (impact * motion <= clearance && KeepsClearance(end, clearance, impact * motion, among))
            {
                return;
            }
            for (int k = among.From;
                k < among.To && among.MinDistance(k) <= (clearance + impact * motion) * RoundedUp; k++)
            {
                int i = among[k];
                if (_planes.MayMeet(from, end, clearance, i))
                {
                    SegmentImpact.WithTriangle(_mesh.Corners[3 * i], _mesh.Corners[3 * i + 1], _mesh.Corners[3 * i + 2],
                        from, from, to, to, clearance, resolution, motion, ref impact);
                }
            }
        }

        /// <summary>Does the same for a segment and the convex edges.</summary>
        public void ImpactOfSegment(in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double clearance,
            double resolution, FeatureRange among, ref double impact)
        {
            Vector3d stepA = a1 - a0;
            Vector3d stepB = b1 - b0;
            double motion = Math.Sqrt(Math.Max(stepA.LengthSquared, stepB.LengthSquared));
            if (among.IsKnown)
            {
                for (int k = among.From;
                    k < among.To && among.MinDistance(k) <= (clearance + impact * motion) * RoundedUp; k++)
                {
                    ImpactWithEdge(among[k], a0, b0, a1, b1, clearance, resolution, motion, ref impact);
                }
                return;
            }
            _found.Clear();
            var swept = new SweptSegment(a0, b0, a0 + impact * stepA, b0 + impact * stepB, clearance);
            _edgeTree?.Within(swept, _found);
            for (int k = 0; k < _found.Count; k++)
            {
                if (!IsInRange(_found[k], swept))
                {
                    ImpactWithEdge(_convexEdge[_found[k]], a0, b0, a1, b1, clearance, resolution, motion, ref impact);
                }
            }
        }

        // All that the point may meet is near its path.
        private void ImpactOfPoint(in Vector3d from, in Vector3d to, double clearance, double resolution,
            ref double impact)
        {
            double motion = Vector3d.Distance(from, to);
            Vector3d end = Vector3d.Lerp(from, to, impact);
            _found.Clear();
            _mesh.Tree.Within(from, end, clearance * RoundedUp, _found);
            for (int k = 0; k < _found.Count; k++)
            {
                if (!_planes.MayMeet(from, end, clearance, _found[k]))
                {
                    continue;
                }
                int i = 3 * _found[k];
                SegmentImpact.WithTriangle(_mesh.Corners[i], _mesh.Corners[i + 1], _mesh.Corners[i + 2],
                    from, from, to, to, clearance, resolution, motion, ref impact);
            }
        }

        // Whether a point at its end position, after a displacement too short to have crossed a wall and be as far
        // behind it, has the clearance. Where no convex edge is near, the distance along a straight path is a concave
        // function, so the values at its ends suffice; convex edges are met by the segments on both sides of the point.
        private bool KeepsClearance(in Vector3d x, double clearance, double motion, FeatureRange among)
        {
            double limit = clearance * clearance;
            for (int k = among.From; k < among.To && among.MinDistance(k) <= clearance + motion; k++)
            {
                int i = 3 * among[k];
                if (_planes.MayBeWithin(x, clearance, among[k]) && ClosestPoints.PointTriangle(
                    x, _mesh.Corners[i], _mesh.Corners[i + 1], _mesh.Corners[i + 2], out _, out _) < limit)
                {
                    return false;
                }
            }
            return true;
        }

        // Whether the motion stays on one side of a plane, or a thin slab, that a convex edge lies in.
        private bool IsInRange(int edgeContact, in SweptSegment swept)
        {
            _mesh.EndsOf(_convexEdge[edgeContact], out int from, out int to);
            double start = Vector3d.Dot(_edgeNormal[edgeContact], _mesh.Corners[from]);
            double end = Vector3d.Dot(_edgeNormal[edgeContact], _mesh.Corners[to]);
            return swept.IsInRange(_edgeNormal[edgeContact], Math.Min(start, end), Math.Max(start, end));
        }

        private void ImpactWithEdge(int edge, in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1,
            double clearance, double resolution, double motion, ref double impact)
        {
            _mesh.EndsOf(edge, out int from, out int to);
            ref readonly Vector3d start = ref _mesh.Corners[from];
            ref readonly Vector3d end = ref _mesh.Corners[to];
            SegmentImpact.WithBody(new EdgeBody(start, end), 0.5 * (start + end), 0.5 * Vector3d.Distance(start, end),
                a0, b0, a1, b1, clearance, resolution, motion, ref impact);
        }

        private double Distance(in Vector3d a, in Vector3d b, int edge)
        {
            _mesh.EndsOf(edge, out int from, out int to);
            return Math.Sqrt(ClosestPoints.SegmentSegment(
                a, b, _mesh.Corners[from], _mesh.Corners[to], out _, out _));
        }

        private double MinDistance(in Vector3d x, int triangle)
        {
            double fromSphere = Vector3d.Distance(x, _centre[triangle]) - _radius[triangle];
            return Math.Max(fromSphere, _planes.MinDistance(x, triangle));
        }
    }

    /// <summary>All contact points of a mesh within a range of a point.</summary>
    /// <remarks>By inclusion and exclusion: the surface is the union of its closed triangles, two neighbours share an
    /// edge, all around an inner corner share that corner. So triangles count 1, inner edges -1, inner corners 1, each
    /// at its point nearest to the query point; an edge or corner of an open rim is shared by no two triangles and
    /// counts 0. That nearest point lies inside a face, inside an edge or at a corner, and a feature's weight is the
    /// sum of the counts of all triangles, edges and corners whose nearest point lies on it. Where the wall is flat all
    /// but the foot cancel, however finely it is cut; an edge that bulges into the free side is left with 1, the edge
    /// of a valley between two feet with -1. Each triangle's distance changes continuously with the point, and so does
    /// the sum of any function of the distances over all of them.</remarks>
    internal sealed class MeshContactPoints
    {
        private const int Touched = 1 << 20;    // added to the weight of what has one, so that 0 means untouched
        private readonly MeshGeometry _mesh;
        private readonly StructList<int> _triangles = new StructList<int>(64);
        private readonly StructList<int> _features = new StructList<int>(64);
        private readonly int[] _weight;         // of edges, by half-edge, then of vertices
        private double _nearest;
        private bool _isBehind;

        /// <summary>Makes what queries of one thread need.</summary>
        public MeshContactPoints(MeshGeometry mesh)
        {
            _mesh = mesh;
            _weight = new int[mesh.Corners.Length + mesh.VertexCount];
        }

        /// <summary>Adds the contact points within <paramref name="range"/> of a point: first faces in the order of the
        /// triangles, then edges and corners in the order in which those faces and their neighbours lead to
        /// them.</summary>
        /// <param name="x">The point, units.</param>
        /// <param name="range">Units.</param>
        /// <param name="nearby">Chooses from the features.</param>
        /// <param name="among">The triangles near the point; all are searched where they are not known.</param>
        /// <param name="contactPoints">Receives the contact points.</param>
        public void Find(in Vector3d x, double range, MeshNearby nearby, FeatureRange among,
            StructList<ContactPoint> contactPoints)
        {
            _triangles.Clear();
            if (among.IsKnown)
            {
                nearby.Choose(x, range, among, _triangles);
            }
            else
            {
                _mesh.Tree.Within(x, x, range, _triangles);
            }
            int first = contactPoints.Count;
            _triangles.Sort(0);
            _nearest = double.PositiveInfinity;
            _isBehind = false;
            _features.Clear();
            double limit = range * range;
            for (int i = 0; i < _triangles.Count; i++)
            {
                CountTriangle(x, limit, _triangles[i], contactPoints);
            }
            for (int i = 0; i < _features.Count; i++)
            {
                int feature = _features[i];
                int weight = _weight[feature] - Touched;
                _weight[feature] = 0;
                if (weight != 0)
                {
                    AddFeature(x, feature, weight, contactPoints);
                }
            }
            for (int i = first; i < contactPoints.Count && _isBehind; i++)
            {
                contactPoints[i] = contactPoints[i].FromBehind();
            }
        }

        // The triangle, and those of its edges and corners that are counted with it.
        private void CountTriangle(in Vector3d x, double limit, int triangle, StructList<ContactPoint> contactPoints)
        {
            ref readonly Vector3d v0 = ref _mesh.Corners[3 * triangle];
            ref readonly Vector3d v1 = ref _mesh.Corners[3 * triangle + 1];
            ref readonly Vector3d v2 = ref _mesh.Corners[3 * triangle + 2];
            double squared = ClosestPoints.PointTriangle(x, v0, v1, v2, out Vector3d point, out int feature);
            if (squared > limit)
            {
                return;
            }
            if (feature == ClosestPoints.Face)
            {
                SurfaceContact contact = Unsigned(x, point, triangle, feature);
                contactPoints.Add(ContactPoint.Flat(contact, 1));
            }
            else if (feature >= ClosestPoints.Corner)
            {
                Count(VertexOf(3 * triangle + feature - ClosestPoints.Corner), 1);
            }
            else
            {
                Count(_mesh.EdgeOf(3 * triangle + feature - ClosestPoints.Edge), 1);
            }
            for (int halfEdge = 3 * triangle; halfEdge < 3 * triangle + 3; halfEdge++)
            {
                if (_mesh.EdgeOf(halfEdge) == halfEdge && !_mesh.IsRimEdge(halfEdge))
                {
                    CountEdge(x, limit, halfEdge);
                }
                if (_mesh.HalfEdgeOfVertex(_mesh.VertexAt(halfEdge)) == halfEdge
                    && !_mesh.IsRimVertex(_mesh.VertexAt(halfEdge))
                    && (x - _mesh.Corners[halfEdge]).LengthSquared <= limit)
                {
                    Count(VertexOf(halfEdge), 1);
                }
            }
        }

        private void CountEdge(in Vector3d x, double limit, int edge)
        {
            _mesh.EndsOf(edge, out int from, out int to);
            double t = ClosestPoints.PointSegment(x, _mesh.Corners[from], _mesh.Corners[to]);
            if ((x - Vector3d.Lerp(_mesh.Corners[from], _mesh.Corners[to], t)).LengthSquared <= limit)
            {
                Count(t <= 0.0 ? VertexOf(from) : t >= 1.0 ? VertexOf(to) : edge, -1);
            }
        }

        private int VertexOf(int halfEdge) => _mesh.Corners.Length + _mesh.VertexAt(halfEdge);

        private void Count(int feature, int weight)
        {
            if (_weight[feature] == 0)
            {
                _weight[feature] = Touched;
                _features.Add(feature);
            }
            _weight[feature] += weight;
        }

        private void AddFeature(in Vector3d x, int feature, int weight, StructList<ContactPoint> contactPoints)
        {
            if (feature >= _mesh.Corners.Length)
            {
                int halfEdge = _mesh.HalfEdgeOfVertex(feature - _mesh.Corners.Length);
                Vector3d corner = _mesh.Corners[halfEdge];
                SurfaceContact contact = Unsigned(x, corner, halfEdge / 3, ClosestPoints.Corner + halfEdge % 3);
                contactPoints.Add(ContactPoint.Corner(contact, weight, contact.Distance));
            }
            else
            {
                _mesh.EndsOf(feature, out int from, out int to);
                Vector3d start = _mesh.Corners[from];
                Vector3d end = _mesh.Corners[to];
                double t = ClosestPoints.PointSegment(x, start, end);
                SurfaceContact contact = Unsigned(
                    x, Vector3d.Lerp(start, end, t), feature / 3, ClosestPoints.Edge + feature % 3);
                contactPoints.Add(ContactPoint.Edge(contact, weight, Vector3d.Normalize(end - start),
                    contact.Distance));
            }
        }

        // The contact as the free side sees it. Only of the nearest feature of all does the side say on which side of
        // the wall the point lies.
        private SurfaceContact Unsigned(in Vector3d x, in Vector3d point, int triangle, int feature)
        {
            double distance = Vector3d.Distance(x, point);
            SurfaceContact contact = _mesh.ContactAt(x, 0.0, point, distance, triangle, feature);
            if (distance < _nearest)
            {
                _nearest = distance;
                _isBehind = contact.Distance < 0.0;
            }
            return contact.Distance < 0.0 ? new SurfaceContact(0.0, point, -contact.Normal, distance) : contact;
        }
    }
}

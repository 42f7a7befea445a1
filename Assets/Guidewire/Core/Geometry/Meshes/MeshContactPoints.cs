namespace Guidewire.Core
{
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

using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>A vessel given by triangles. Distance and normal are those of the surface itself, also at its edges and
    /// corners.</summary>
    /// <remarks>On which side of the wall a point lies follows from the nearest feature: the sign of (x - c).n, with n
    /// the triangle's normal, the sum of both at an edge, the sum weighted by angle at a corner (Baerentzen and Aanaes
    /// 2005). The normal is then (x - c)/|x - c|, turned into the lumen. A rim's edge has no second side: there the
    /// wall is only repelling, and on which side a point lies is asked of the surface closed by a fan over each
    /// rim.</remarks>
    public sealed class MeshShape : ContactShape
    {
        private readonly TriangleMesh _mesh;
        private readonly MeshGeometry _wall;
        private readonly MeshGeometry _closed;     // with a fan over each rim behind the wall's triangles; no hierarchy
        private readonly Bvh? _fans;               // over those
        private readonly Derived _derived;
        private readonly MeshShape? _unplaced;     // the same wall before its placement
        private Placement _placement;

        /// <summary>The wall where its file has it.</summary>
        public MeshShape(TriangleMesh mesh)
            : this(mesh, Placement.Identity)
        {
        }

        /// <summary>Makes the wall of a mesh that is placed.</summary>
        public MeshShape(TriangleMesh mesh, in Placement placement)
        {
            _mesh = mesh;
            _wall = new MeshGeometry(mesh, closeRims: false, placement);
            _closed = mesh.Rims.Count > 0 ? new MeshGeometry(mesh, closeRims: true, placement) : _wall;
            _fans = _closed == _wall ? null : new Bvh(CornersOfFans());
            _derived = new Derived();
        }

        private MeshShape(MeshShape other, in Placement placement, SmoothWarp? warp)
        {
            _mesh = other._mesh;
            _wall = other._wall.At(placement, warp);
            _closed = other._closed == other._wall ? _wall : other._closed.At(placement, warp);
            _fans = other._fans?.Over(CornersOfFans());
            _derived = new Derived();
            (_unplaced, _placement) = (other, placement);
        }

        private MeshShape(MeshShape other)
        {
            _mesh = other._mesh;
            _wall = other._wall;
            _closed = other._closed;
            _fans = other._fans;
            _derived = other._derived;
            (_unplaced, _placement) = (other._unplaced, other._placement);
        }

        /// <inheritdoc/>
        public override IEnumerable<Vector3d> SurfacePoints()
        {
            const int Most = 2000;
            int corners = _wall.Corners.Length;
            for (int k = 0; k < corners; k += 1 + corners / Most)
            {
                yield return _wall.Corners[k];
            }
        }

        /// <summary>What was found in the mesh and repaired.</summary>
        public MeshReport Report => _mesh.Report;

        /// <summary>The wall's triangles where they are.</summary>
        internal MeshGeometry Wall => _wall;

        /// <inheritdoc/>
        internal override bool IsSurface => true;

        /// <summary>How many times an edge of the wall pierces one of its triangles, and where it does first, units.
        /// </summary>
        public int CountSelfIntersections(out Vector3d position)
        {
            if (_derived.SelfIntersections == null && _unplaced != null)
            {
                lock (_unplaced._derived) // runs at once may ask for it
                {
                    // No placement makes one or takes one away, nor does a map that is one to one.
                    int count = _unplaced.CountSelfIntersections(out Vector3d before);
                    _derived.SelfIntersections = (count, count == 0 ? before : _placement.Apply(before));
                }
            }
            if (_derived.SelfIntersections == null)
            {
                int count = SelfIntersection.Count(_wall, out Vector3d first);
                _derived.SelfIntersections = (count, first);
            }
            position = _derived.SelfIntersections.Value.Position;
            return _derived.SelfIntersections.Value.Count;
        }

        /// <summary>The same wall for the next run, with a friction coefficient of its own. Both share what is computed
        /// from the triangles, so placing one places the other, and only one may be queried at a time.</summary>
        public MeshShape ForNextRun() => new MeshShape(this);

        /// <summary>Gives this wall at another placement, for a run beside others. No hierarchy is built again, and
        /// both walls may be queried at once.</summary>
        /// <param name="placement">Of the wall as it was made, which no placement may have moved.</param>
        /// <param name="warp">What moves its vertices before that; null: nothing.</param>
        public MeshShape At(in Placement placement, SmoothWarp? warp = null) => new MeshShape(this, placement, warp);

        /// <summary>Moves, turns and scales the wall; its hierarchy is refitted, not built again.</summary>
        public void Place(in Placement placement)
        {
            _placement = placement;
            _wall.Place(placement);
            _derived.Nearby = null;
            _derived.SelfIntersections = null;
            _derived.Narrowest.Clear();
            ClearCache();
            if (_closed != _wall)
            {
                _closed.Place(placement);
                _fans!.Refit(CornersOfFans());
            }
        }

        private Vector3d[] CornersOfFans() => _closed.Corners.AsSpan(_wall.Corners.Length).ToArray();

        /// <inheritdoc/>
        public override bool Nearest(
            in Vector3d a, in Vector3d b, double range, ref int hint, out SurfaceContact contact)
        {
            int triangle = _wall.Tree.Nearest(
                a, b, range, hint, out double squared, out double s, out Vector3d point, out int feature);
            if (triangle < 0)
            {
                // Beyond the wall by more than the range is seen only by the sign, which a wire that the swept test
                // inside never needs.
                contact = default;
                return false;
            }
            hint = triangle;
            contact = _wall.ContactAt(Vector3d.Lerp(a, b, s), s, point, Math.Sqrt(squared), triangle, feature);
            return true;
        }

        /// <summary>The nearest points of all triangles, edges and corners, less those that cancel each other: feet
        /// inside faces, and what of edges and corners is left; see <see cref="MeshContactPoints"/>. All have the
        /// sign of the nearest. On an edge or corner itself, at distance 0, no curvature is stated.</summary>
        internal override double FindContactPoints(in Vector3d x, double range, FeatureRange features,
            StructList<ContactPoint> contactPoints)
        {
            _derived.ContactPoints ??= new MeshContactPoints(_wall);
            _derived.ContactPoints.Find(x, range, Nearby, features, contactPoints);
            return range;
        }

        /// <summary>The triangles within the range of a point, the convex edges within that of a segment.</summary>
        internal override double FindFeatures(in Vector3d a, in Vector3d b, double range, double skin, ref int hint,
            StructList<WallFeature> features)
        {
            return a == b ? Nearby.FindTriangles(a, range, features)
                : Nearby.FindEdgeContacts(a, b, range, features);
        }

        /// <summary>Finds edges that bulge into the lumen, and those of open rims; see <see
        /// cref="MeshEdges"/>.</summary>
        internal override void FindEdgeContacts(in Vector3d a, in Vector3d b, double range, FeatureRange features,
            StructList<EdgeContact> edgeContacts) => EdgeContacts.Find(a, b, range, Nearby, features, edgeContacts);

        /// <summary>A point against the triangles, a segment against the convex edges.</summary>
        internal override double ConservativeTimeOfImpact(in Vector3d a0, in Vector3d b0, in Vector3d a1,
            in Vector3d b1, double clearance, double resolution, int hint, FeatureRange features, double limit)
        {
            double impact = limit;
            if (a0 == b0 && a1 == b1)
            {
                Nearby.ImpactOfPoint(a0, a1, clearance, resolution, features, ref impact);
            }
            else
            {
                Nearby.ImpactOfSegment(a0, b0, a1, b1, clearance, resolution, features, ref impact);
            }
            return impact;
        }

        /// <inheritdoc/>
        internal override bool MayMeet(in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double distance,
            ref int hint) => _wall.Tree.MayMeet(new SweptSegment(a0, b0, a1, b1, distance));

        private MeshEdges EdgeContacts => _derived.EdgeContacts ??= new MeshEdges(_wall);

        private MeshNearby Nearby => _derived.Nearby ??= new MeshNearby(_wall, EdgeContacts, NearbyBefore());

        private MeshNearby? NearbyBefore()
        {
            if (_unplaced == null)
            {
                return null;
            }
            lock (_unplaced._derived) // runs at once may ask for it
            {
                return _unplaced.Nearby;
            }
        }

        /// <summary>Finds the narrowest place as <see cref="MeshWidth"/> says.</summary>
        internal override double NarrowestRadius(double above, double below)
        {
            if (!_derived.Narrowest.TryGetValue((above, below), out double radius))
            {
                radius = MeshWidth.Narrowest(this, _wall, above, below);
                _derived.Narrowest.Add((above, below), radius);
            }
            return radius;
        }

        /// <inheritdoc/>
        public override bool Contains(in Vector3d point)
        {
            if (!_wall.Tree.Encloses(point)) // a fan lies between its rim's vertices
            {
                return false;
            }
            int triangle = _wall.Tree.Nearest(
                point, point, double.PositiveInfinity, -1, out double squared, out _, out Vector3d c, out int feature);
            if (_fans != null)
            {
                int fan = _fans.Nearest(point, point, double.PositiveInfinity, -1, out double ofFan, out _,
                    out Vector3d onFan, out int featureOfFan);
                if (ofFan < squared)
                {
                    (triangle, squared) = (_wall.Corners.Length / 3 + fan, ofFan);
                    (c, feature) = (onFan, featureOfFan);
                }
            }
            return _closed.ContactAt(point, 0.0, c, Math.Sqrt(squared), triangle, feature).Distance > 0.0;
        }

        private protected override double TimeOfImpact(in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1,
            double clearance, double resolution, int hint) =>
            _wall.Tree.TimeOfImpact(a0, b0, a1, b1, clearance, resolution, hint);

        // What follows from the triangles where they are, each computed when it is first asked for.
        private sealed class Derived
        {
            public MeshContactPoints? ContactPoints;
            public MeshEdges? EdgeContacts;
            public MeshNearby? Nearby;
            public (int Count, Vector3d Position)? SelfIntersections;
            public readonly Dictionary<(double, double), double> Narrowest =
                new Dictionary<(double, double), double>();
        }
    }
}

using System;

namespace Guidewire.Core
{
    /// <summary>Moves nodes of a shape along the walls' normals, until those that touched a wall in the shape before
    /// have the gap that they had, and no other gap is less than half of the barrier's distance, up to the effect of
    /// one projection on the next.</summary>
    /// <remarks>A node that touched is pulled back too: where it would leave the wall in the first iteration of a step,
    /// nothing would hold it there, and it would hit the wall again in the next.</remarks>
    internal sealed class WallProjection
    {
        private const double ProjectedTo = 0.5;      // of the barrier's distance
        private const double MinLever = 0.1;
        private const double Pulled = 5.0;        // barrier's distances, from where a node is still pulled back
        private readonly BarrierEnergy _barrier;
        private readonly double _units;           // per metre
        private readonly StructList<ContactPoint> _contactPoints = new StructList<ContactPoint>(16);
        private readonly StructList<EdgeContact> _edgeContacts = new StructList<EdgeContact>(16);

        /// <summary>Off the walls of a barrier.</summary>
        public WallProjection(BarrierEnergy barrier)
        {
            _barrier = barrier;
            _units = barrier.UnitsPerMetre;
        }

        /// <summary>Moves nodes of a shape.</summary>
        /// <param name="before">The other shape.</param>
        /// <param name="shape">Its nodes 1 to <paramref name="last"/> are moved.</param>
        /// <param name="last">Up to n.</param>
        public void Apply(RodShape before, RodShape shape, int last)
        {
            NeighbourList near = _barrier.Near(shape, before);
            int n = shape.ElementCount;
            int first = _barrier.Nodes.Inside(shape);
            for (int w = 0; w < _barrier.Walls.Length; w++)
            {
                for (int i = Math.Max(first, 1); i <= last; i++)
                {
                    if (near.IsNodeNear(w, i))
                    {
                        ProjectNode(w, i, near, ref shape.X[i]);
                    }
                }
                for (int j = first; j < n; j++)
                {
                    if (near.IsNear(w, j))
                    {
                        ProjectElement(w, j, near, shape, last);
                    }
                }
            }
        }

        private void ProjectNode(int w, int i, NeighbourList near, ref Vector3d x)
        {
            double radius = _barrier.LawOf(w).RadiusOfNode(i);
            double distance = _barrier.LawOf(w).OfNode(i).Distance;
            double before = _barrier.NodeGap(w, i);
            bool touched = before < distance;
            double asked = touched ? before : ProjectedTo * distance;
            double nearest = !touched ? asked
                : Math.Min(Pulled * distance, distance + Pulled * _barrier.Barrier.Distance);
            _contactPoints.Clear();
            Vector3d point = _barrier.OnWall(w, _units * x);
            double range = _units * (radius + nearest);
            if (near.NodeMayBeInRange(w, i, point, range))
            {
                double found = _barrier.Walls[w].FindContactPoints(
                    point, range, near.FeaturesOfNode(w, i, point), _contactPoints);
                if (_contactPoints.Count == 0)
                {
                    near.SetDistanceOfNode(w, i, point, found);
                }
            }
            Vector3d normal = Vector3d.Zero;
            for (int k = 0; k < _contactPoints.Count; k++)
            {
                double gap = _contactPoints[k].Contact.Distance / _units - radius;
                if (gap < nearest && _contactPoints[k].Weight > 0)
                {
                    nearest = gap;
                    normal = _contactPoints[k].Contact.Normal;
                }
            }
            x += (asked - nearest) * _barrier.Away(w, _units * x, normal);
        }

        private void ProjectElement(int w, int j, NeighbourList near, RodShape shape, int last)
        {
            double radius = _barrier.LawOf(w).RadiusOf(j);
            double asked = Math.Min(_barrier.EdgeGap(w, j), ProjectedTo * _barrier.LawOf(w).DistanceOf(j));
            _edgeContacts.Clear();
            Vector3d start = _barrier.OnWall(w, _units * shape.X[j]);
            Vector3d end = _barrier.OnWall(w, _units * shape.X[j + 1]);
            _barrier.Walls[w].FindEdgeContacts(
                start, end, _units * (radius + asked), near.FeaturesOf(w, j, start, end), _edgeContacts);
            for (int k = 0; k < _edgeContacts.Count; k++)
            {
                ref EdgeContact edgeContact = ref _edgeContacts[k];
                double gap = edgeContact.Distance / _units - radius;
                if (gap < asked)
                {
                    double a = j > 0 ? 1.0 - edgeContact.Position : 0.0;
                    double b = j < last ? edgeContact.Position : 0.0;
                    double fraction = (asked - gap) / Math.Max(a * a + b * b, MinLever);
                    Vector3d normal = _barrier.Away(w, _units * shape.X[j], edgeContact.Normal);
                    shape.X[j] += fraction * a * normal;
                    shape.X[j + 1] += fraction * b * normal;
                    return;
                }
            }
        }
    }
}

using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>A wall that the wire can touch: a vessel, whose inside is the lumen, or an obstacle in it. Distances
    /// are positive on the free side; normals point from the wall into it. Lengths in units.</summary>
    /// <remarks>One virtual call per element and step: some 2 ns beside the 100 to 1000 ns of a distance.</remarks>
    public abstract class ContactShape
    {
        /// <summary>Value of a time of impact for a motion that meets no wall.</summary>
        public const double NoImpact = 2.0;

        private const double SlidingLoss = 1e-7;
        private const double Resolved = 1e-3;
        private FeatureCache? _cache;         // of a surface, with the skin of the last request
        private ContactShape? _outward;       // the last one asked for
        private double _outwardBy;            // units

        /// <summary>mu, Coulomb's coefficient of friction between the wire and this wall, 0 or more,
        /// dimensionless.</summary>
        public double FrictionCoefficient { get; set; }

        /// <summary>How the wall gives way; null where it is rigid.</summary>
        public WallSoftness? Softness { get; set; }

        /// <summary>How the wall moves; null where it stands still. The shape is that at rest.</summary>
        public WallMotion? Motion { get; set; }

        /// <summary>Points of the wall all over it, at most some thousand, units; none of a shape without
        /// bounds.</summary>
        public virtual IEnumerable<Vector3d> SurfacePoints() => Array.Empty<Vector3d>();

        /// <summary>The point where segment a b comes nearest to the wall, if that is no farther than <paramref
        /// name="range"/>; a = b for a sphere's centre.</summary>
        /// <param name="a">First end of the segment.</param>
        /// <param name="b">Second end of the segment.</param>
        /// <param name="range">Largest distance of interest; negative distances always count.</param>
        /// <param name="hint">Kept by the caller from one query of an element to its next, -1 at first: where the
        /// nearest point was. It affects the cost of a query, never its result.</param>
        /// <param name="contact">The nearest point.</param>
        public abstract bool Nearest(
            in Vector3d a, in Vector3d b, double range, ref int hint, out SurfaceContact contact);

        /// <summary>Adds to <paramref name="contactPoints"/> the contact points of the wall within <paramref
        /// name="range"/> of a point, each once. Beyond a plane, tube or obstacle negative distances always count; of a
        /// mesh, points whose distance is no larger than the range by its size.</summary>
        /// <param name="x">The point, units.</param>
        /// <param name="range">Units.</param>
        /// <param name="features">The wall's features near the point, where known: they speed up the query.</param>
        /// <param name="contactPoints">Receives the contact points.</param>
        /// <returns>A distance, units, than which the wall is not nearer, where there are no contact points.</returns>
        /// <remarks>Each shape defines its contact points; the nearest one, as found by <see cref="Nearest"/>, is among
        /// them. Their weights make sums over them continuous: for any function f that is 0 from the range on, the sum
        /// of Weight f(Distance) has no jump when the point moves, although points appear and vanish. A point of weight
        /// -1 subtracts what the two points on either side of it have in common. The order depends on wall and point
        /// alone. Nothing is allocated once the list and the shape's scratch memory have reached their size; one object
        /// serves one thread.</remarks>
        internal abstract double FindContactPoints(in Vector3d x, double range, FeatureRange features,
            StructList<ContactPoint> contactPoints);

        /// <summary>True where the wire may be: in a vessel's lumen, outside an obstacle.</summary>
        public abstract bool Contains(in Vector3d point);

        /// <summary>The same without what an open end of a vessel leads to.</summary>
        public virtual bool IsWithin(in Vector3d point) => Contains(point);

        /// <summary>Fraction of the linear motion of segment a b from (a0, b0) to (a1, b1) after which it stops clear
        /// of the wall, or <see cref="NoImpact"/>. At that moment its distance is at least <see
        /// cref="FinalClearance"/>, and until then nowhere less than that or half the clearance, whichever is
        /// less.</summary>
        /// <remarks>During the motion a segment may come nearer than at its end. Otherwise it could not turn about an
        /// edge that it touches, because every bound on the distance between two moments needs some
        /// clearance.</remarks>
        /// <param name="a0">First end before the motion; the segment starts on the free side.</param>
        /// <param name="b0">Second end before the motion.</param>
        /// <param name="a1">First end after the motion.</param>
        /// <param name="b1">Second end after the motion.</param>
        /// <param name="clearance">Clearance, units.</param>
        /// <param name="contact">The nearest point at that moment, when there is an impact.</param>
        public double TimeOfImpact(
            in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double clearance,
            out SurfaceContact contact)
        {
            contact = default;
            int hint = -1;
            double start = Nearest(a0, b0, 2.0 * clearance, ref hint, out SurfaceContact before)
                ? Math.Abs(before.Distance) : 2.0 * clearance;
            double final = FinalClearance(start, clearance);
            double impact = TimeOfImpact(a0, b0, a1, b1, final, Resolved * final, hint);
            if (impact == NoImpact)
            {
                return NoImpact;
            }
            int near = hint;
            double floor = Math.Min(final, 0.5 * clearance);
            if (floor < final && !Nearest(a1, b1, final, ref hint, out _))
            {
                // It ends clear of the wall.
                double free = TimeOfImpact(a0, b0, a1, b1, floor, Resolved * floor, near);
                impact = Math.Max(impact, TimeIfClear(a0, b0, a1, b1, free, final, ref hint));
                if (impact == NoImpact)
                {
                    return NoImpact;
                }
            }
            Nearest(
                Vector3d.Lerp(a0, a1, impact), Vector3d.Lerp(b0, b1, impact), double.PositiveInfinity, ref hint,
                out contact);
            return impact;
        }

        /// <summary>The clearance of a segment at the end of a motion that starts at distance <paramref name="start"/>
        /// (0 or more, units): the one asked for, or the smaller distance at the start less a small fraction, so that
        /// the segment can slide in spite of rounding.</summary>
        /// <remarks>Pressed against the wall in every part of every step, a wire would lose half the clearance in 7
        /// million parts; a clearance of a thousandth of the radius is some 10 digits above rounding.</remarks>
        internal static double FinalClearance(double start, double clearance) =>
            (1.0 - SlidingLoss) * Math.Min(start, clearance);

        /// <summary>Whether the wall is a surface of faces, which may end in open rims, and not the boundary of a body
        /// or a lumen: the sign of a distance is then known only near it, and points of the wire have features of their
        /// own.</summary>
        internal virtual bool IsSurface => false;

        /// <summary>The same wall moved away from its free side by a distance, units: it is farther by as much from
        /// every point. Null where only a shape of another kind would be.</summary>
        internal ContactShape? MovedOut(double distance)
        {
            if (_outward == null || _outwardBy != distance)
            {
                _outward = Outward(distance);
                _outwardBy = distance;
            }
            if (_outward != null)
            {
                _outward.FrictionCoefficient = FrictionCoefficient;
                _outward.Softness = Softness;
                _outward.Motion = Motion;
            }
            return _outward;
        }

        /// <summary>The wall where it has given way as far as it may, if a core line may go beyond the wall itself.
        /// </summary>
        /// <param name="units">Per metre.</param>
        internal ContactShape AtLimit(double units) =>
            (Softness == null || Softness.Limit == 0.0 ? null : MovedOut(units * Softness.Limit)) ?? this;

        /// <summary>Makes the wall of <see cref="MovedOut"/>.</summary>
        private protected virtual ContactShape? Outward(double distance) => null;

        /// <summary>Distance of a guarded wire's element from the wall, 0 where it lies across it, by its signed
        /// distance, units. Spheres never get behind a wall that has no exit: an element of negative distance lies
        /// across it. A wire that left a surface by an open rim may lie beside it.</summary>
        internal double UnsignedDistance(double distance) => IsSurface ? Math.Abs(distance) : Math.Max(0.0, distance);

        /// <summary>Turns the contact points of one point of a guarded wire to the side of the wall on which it is. One
        /// that a surface sees from behind lies beside the vessel, which it left by an open rim.</summary>
        /// <returns>Whether the surface sees the wire from behind.</returns>
        internal bool TurnToWire(StructList<ContactPoint> contactPoints)
        {
            bool isBehind = IsSurface && contactPoints.Count > 0 && contactPoints[0].Contact.Distance < 0.0;
            for (int k = 0; k < contactPoints.Count && isBehind; k++)
            {
                contactPoints[k] = contactPoints[k].FromBehind();
            }
            return isBehind;
        }

        /// <summary>Least signed distance of a point of segment a b, units, where <see cref="Nearest"/> found the
        /// segment at a negative distance. The two differ where a segment's distance is the displacement that takes all
        /// of it out of the wall.</summary>
        internal virtual double MinAlong(in Vector3d a, in Vector3d b, double distance) => distance;

        /// <summary>Largest fraction of the motion for which every point of the segment is proven to stay at least
        /// <paramref name="clearance"/> from the wall, <see cref="NoImpact"/> for all of it. Approaches below the
        /// resolution, units, are ignored. The hint, where the nearest point was at the start or -1, affects the cost
        /// alone.</summary>
        private protected abstract double TimeOfImpact(in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1,
            double clearance, double resolution, int hint);

        // The time itself if the segment has the clearance then, else 0.
        private double TimeIfClear(
            in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double time, double final, ref int hint)
        {
            bool isClear = time == NoImpact || !Nearest(
                Vector3d.Lerp(a0, a1, time), Vector3d.Lerp(b0, b1, time), final, ref hint, out _);
            return isClear ? time : 0.0;
        }

        /// <summary>False where no part of the wall can come within a distance, units, of a segment that moves from
        /// (a0, b0) to (a1, b1). The hint is that of <see cref="Nearest"/>.</summary>
        internal virtual bool MayMeet(in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double distance,
            ref int hint)
        {
            double motion = Math.Max(Vector3d.Distance(a0, a1), Vector3d.Distance(b0, b1));
            return Nearest(a0, b0, motion + distance, ref hint, out _);
        }

        /// <summary>True if the whole segment certainly lies on the free side; also false where a shape cannot tell
        /// quickly.</summary>
        internal virtual bool Holds(in Vector3d a, in Vector3d b, ref int hint) => false;

        /// <summary>Adds to a list the features of the wall (as the shape defines them) that queries of points and
        /// parts of segment a b may meet while nothing of it moves farther than <paramref name="skin"/>, units; such
        /// queries are then faster. Some shapes have none. A surface has features of points (a = b) and others of the
        /// interiors of segments.</summary>
        /// <returns>Distance in units, infinite beyond <paramref name="range"/>. It may be too small, and up to a tenth
        /// too large where the wall's edges are uneven; of a surface and a segment it is that of the segment's interior
        /// and counts only where it is less than those of its ends.</returns>
        internal virtual double FindFeatures(in Vector3d a, in Vector3d b, double range, double skin, ref int hint,
            StructList<WallFeature> features)
        {
            return Nearest(a, b, range, ref hint, out SurfaceContact contact) ? contact.Distance
                : double.PositiveInfinity;
        }

        /// <summary>The cache of a surface's features of points, shared by all queries with this skin, units; null
        /// where there are none.</summary>
        internal FeatureCache? FeatureCacheFor(double skin)
        {
            if (IsSurface && (_cache == null || _cache.Skin != skin))
            {
                _cache = new FeatureCache(this, skin);
            }
            return _cache;
        }

        /// <summary>Drops the cache, where the wall was moved.</summary>
        private protected void ClearCache() => _cache = null;

        /// <summary>A lower bound of the time of impact of segment a b in linear motion from (a0, b0) to (a1, b1), as a
        /// fraction during which it has at least a clearance, in units: <paramref name="limit"/> where that is less or
        /// there is no impact, 0 where it starts nearer. Of a surface it is that of the segment's interior, not of its
        /// ends, or that of a point (a = b). Approaches below <paramref name="resolution"/>, units, are ignored. The
        /// hint is that of a query of the start, or -1; the features, where they are known, those of the start, for a
        /// skin that the motion up to the limit does not leave.</summary>
        internal virtual double ConservativeTimeOfImpact(in Vector3d a0, in Vector3d b0, in Vector3d a1,
            in Vector3d b1, double clearance, double resolution, int hint, FeatureRange features, double limit) =>
            Math.Min(limit, TimeOfImpact(a0, b0, a1, b1, clearance, resolution, hint));

        /// <summary>Adds the edge contacts within <paramref name="range"/> of segment a b: where the wall is convex
        /// towards the free side, so that the interior of a segment can meet it before its ends do. None where the wall
        /// has no convex edge. The features near the segment, where they are known, speed it up.</summary>
        internal virtual void FindEdgeContacts(in Vector3d a, in Vector3d b, double range, FeatureRange features,
            StructList<EdgeContact> edgeContacts)
        {
        }

        /// <summary>Radius in units of the largest ball that fits where the free side is narrowest, of all positions
        /// where that is between two radii; infinite where there is none.</summary>
        internal virtual double NarrowestRadius(double above, double below) => double.PositiveInfinity;
    }

    /// <summary>The closest points of a rod element (or a sphere, an element of zero length) and a wall.</summary>
    public readonly struct SurfaceContact
    {
        /// <summary>Position along the element, 0 at its first sphere, 1 at its second; 0 for a sphere.</summary>
        public readonly double Position;

        /// <summary>Nearest point c of the wall, units.</summary>
        public readonly Vector3d Point;

        /// <summary>Unit vector from the wall into the lumen: the gradient of the distance.</summary>
        public readonly Vector3d Normal;

        /// <summary>Distance of the element's core line from the wall in units, negative beyond the wall.</summary>
        public readonly double Distance;

        /// <summary>Makes a contact with these values.</summary>
        public SurfaceContact(double position, in Vector3d point, in Vector3d normal, double distance)
        {
            Position = position;
            Point = point;
            Normal = normal;
            Distance = distance;
        }
    }

    /// <summary>A contact point of a wall near a segment: its position, the wall's normal there, and its
    /// curvature.</summary>
    /// <remarks>The curvatures are those of the surface of equal distance through the segment's point x: the second
    /// derivative of the distance d of a point at x is H = k1 t1 t1^T + k2 t2 t2^T with t1 = <see cref="Direction"/>,
    /// t2 = n x t1, k1 = <see cref="Curvature"/>, k2 = <see cref="CrossCurvature"/>; its first is the normal n. They
    /// are negative where the wall is hollow (a tube), positive where it bulges into the free side. An energy f(d) has
    /// the second derivative f'' n n^T + f' H, whose eigenvectors are n, t1 and t2. Of a segment whose ends z = (a, b)
    /// move, u = b - a, d has the first derivative ((1 - s) n, s n) and, at 0 &lt; s &lt; 1, where s moves with them,
    /// the second [(1 - s)^2 H, s (1 - s) H; s (1 - s) H, s^2 H] - g g^T/(u.H u), g = ((1 - s) H u - n, s H u + n).
    /// </remarks>
    internal readonly struct ContactPoint
    {
        /// <summary>Position s along the segment, point of the wall, normal n into the free side, and distance, signed
        /// as <see cref="ContactShape.Nearest"/> has it.</summary>
        public readonly SurfaceContact Contact;

        /// <summary>How often the point counts in a sum over all contact points, not 0; see <see
        /// cref="ContactShape.FindContactPoints"/>.</summary>
        public readonly int Weight;

        /// <summary>First principal direction t1, a unit vector along the wall.</summary>
        public readonly Vector3d Direction;

        /// <summary>Principal curvature along <see cref="Direction"/>, 1/units.</summary>
        public readonly double Curvature;

        /// <summary>Principal curvature along n x <see cref="Direction"/>, 1/units.</summary>
        public readonly double CrossCurvature;

        /// <summary>Makes a contact point with these values.</summary>
        public ContactPoint(in SurfaceContact contact, int weight, in Vector3d direction, double curvature,
            double crossCurvature)
        {
            Contact = contact;
            Weight = weight;
            Direction = direction;
            Curvature = curvature;
            CrossCurvature = crossCurvature;
        }

        /// <summary>Gives a contact point of a flat wall.</summary>
        public static ContactPoint Flat(in SurfaceContact contact, int weight) =>
            new ContactPoint(contact, weight, Vector3d.Perpendicular(contact.Normal), 0.0, 0.0);

        /// <summary>Gives a contact point at a straight edge, or on a cylinder.</summary>
        /// <param name="contact">Where.</param>
        /// <param name="weight">How often it counts.</param>
        /// <param name="along">Unit vector along the edge.</param>
        /// <param name="radius">Distance of the segment's point from the edge, negative where the centre of curvature
        /// lies on the free side; at 0 there is no curvature to state, and none is.</param>
        public static ContactPoint Edge(in SurfaceContact contact, int weight, in Vector3d along, double radius) =>
            new ContactPoint(contact, weight, along, 0.0, radius == 0.0 ? 0.0 : 1.0 / radius);

        /// <summary>Gives a contact point at a corner, or on a ball.</summary>
        /// <param name="contact">Where.</param>
        /// <param name="weight">How often it counts.</param>
        /// <param name="radius">Distance of the segment's point from the corner, signed as an edge's.</param>
        public static ContactPoint Corner(in SurfaceContact contact, int weight, double radius)
        {
            double curvature = radius == 0.0 ? 0.0 : 1.0 / radius;
            return new ContactPoint(contact, weight, Vector3d.Perpendicular(contact.Normal), curvature, curvature);
        }

        /// <summary>Gives f'' n n^T + f' H.</summary>
        /// <param name="slope">f'.</param>
        /// <param name="curvature">f''.</param>
        public Symmetric3 SecondDerivative(double slope, double curvature)
        {
            Vector3d n = Contact.Normal;
            Symmetric3 own = Symmetric3.Outer(curvature, n);
            return Curvature == 0.0 && CrossCurvature == 0.0 ? own : own
                + Symmetric3.Outer(slope * Curvature, Direction)
                + Symmetric3.Outer(slope * CrossCurvature, Vector3d.Cross(n, Direction));
        }

        /// <summary>Gives the same point seen from behind the wall.</summary>
        public ContactPoint FromBehind()
        {
            return new ContactPoint(
                new SurfaceContact(Contact.Position, Contact.Point, -Contact.Normal, -Contact.Distance), Weight,
                Direction, -Curvature, -CrossCurvature);
        }
    }
}

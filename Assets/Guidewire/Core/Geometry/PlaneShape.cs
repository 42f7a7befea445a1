using System;

namespace Guidewire.Core
{
    /// <summary>A half-space: free is where (x - point).normal is positive.</summary>
    public sealed class PlaneShape : ContactShape
    {
        private readonly Vector3d _point;
        private readonly Vector3d _normal;

        /// <summary>The plane through <paramref name="point"/> whose <paramref name="normal"/>, of any length but 0,
        /// points to the free side.</summary>
        /// <exception cref="ArgumentException">The normal has no direction or a value is not finite.</exception>
        public PlaneShape(in Vector3d point, in Vector3d normal)
        {
            if (!point.IsFinite || !normal.IsFinite || !(normal.Length > 0.0))
            {
                throw new ArgumentException("a plane needs a finite point and a normal of finite, non-zero length");
            }
            _point = point;
            _normal = Vector3d.Normalize(normal);
        }

        /// <summary>A point of the plane, units.</summary>
        internal Vector3d Point => _point;

        /// <summary>Unit vector to the free side.</summary>
        internal Vector3d Normal => _normal;

        /// <inheritdoc/>
        public override bool Nearest(
            in Vector3d a, in Vector3d b, double range, ref int hint, out SurfaceContact contact)
        {
            double da = Vector3d.Dot(a - _point, _normal);
            double db = Vector3d.Dot(b - _point, _normal);
            contact = At(a, b, da, db);
            return contact.Distance <= range;
        }

        /// <summary>Gives the foot of the perpendicular.</summary>
        internal override double FindContactPoints(in Vector3d x, double range, FeatureRange features,
            StructList<ContactPoint> contactPoints)
        {
            int hint = -1;
            if (Nearest(x, x, range, ref hint, out SurfaceContact contact))
            {
                contactPoints.Add(ContactPoint.Flat(contact, 1));
            }
            return contact.Distance;
        }

        private protected override ContactShape? Outward(double distance) =>
            new PlaneShape(_point - distance * _normal, _normal);

        /// <inheritdoc/>
        public override bool Contains(in Vector3d point) => Vector3d.Dot(point - _point, _normal) > 0.0;

        private protected override double TimeOfImpact(in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1,
            double clearance, double resolution, int hint)
        {
            double da0 = Vector3d.Dot(a0 - _point, _normal);
            double db0 = Vector3d.Dot(b0 - _point, _normal);
            double da1 = Vector3d.Dot(a1 - _point, _normal);
            double db1 = Vector3d.Dot(b1 - _point, _normal);
            return Math.Min(Crossing(da0, da1, clearance), Crossing(db0, db1, clearance));
        }

        private static double Crossing(double before, double after, double clearance) =>
            after < clearance ? Math.Max(0.0, (before - clearance) / (before - after)) : NoImpact;

        // An element parallel to the plane touches it everywhere: its middle represents it, so that a symmetric problem
        // symmetric.
        private SurfaceContact At(in Vector3d a, in Vector3d b, double da, double db)
        {
            double s = da < db ? 0.0 : da > db ? 1.0 : 0.5;
            double distance = Math.Min(da, db);
            return new SurfaceContact(s, Vector3d.Lerp(a, b, s) - distance * _normal, _normal, distance);
        }
    }
}

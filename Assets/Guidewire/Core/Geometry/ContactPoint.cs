namespace Guidewire.Core
{
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

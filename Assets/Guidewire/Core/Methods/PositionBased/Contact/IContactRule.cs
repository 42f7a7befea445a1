namespace Guidewire.Core
{
    /// <summary>How a wire that touches a wall is treated: which contacts it has, and what they do in a sweep. One
    /// implementation a rule, chosen once.</summary>
    internal interface IContactRule
    {
        /// <summary>Whether the swept test keeps spheres from passing the wall under this rule.</summary>
        bool GuardsSpheres { get; }

        /// <summary>Whether it keeps rod elements from passing, too.</summary>
        bool GuardsElements { get; }

        /// <summary>Finds the contacts of a motion of the wire.</summary>
        /// <param name="from">Where the n + 1 spheres are, units; under a rule that guards, clear of the wall.</param>
        /// <param name="to">Where the prediction takes them.</param>
        void Detect(Vector3d[] from, Vector3d[] to);

        /// <summary>Holds sphere or element (its first sphere) j off the place where the swept test met the
        /// wall.</summary>
        void AddImpact(int j, bool isElement, in SurfaceContact contact);

        /// <summary>Lower bound of the distance of element j from the wall at <c>from</c>, as the last detection saw
        /// it.</summary>
        double ClearanceOf(int j);

        /// <summary>Projects all contacts once.</summary>
        void Sweep(Vector3d[] x);

        /// <summary>Contacts at present, in the order of a sweep.</summary>
        int ContactCount { get; }

        /// <summary>Which spheres contact k moves: one, or the two of an element.</summary>
        void SpheresOf(int k, out int first, out int last);

        /// <summary>Projects contact k once, by its spheres alone; false where it moved nothing.</summary>
        bool Project(int k, Vector3d[] x);

        /// <summary>Adds the momentum over dt, in mass unit * unit, that contacts gave each sphere.</summary>
        void AddImpulses(Vector3d[] impulses);

        /// <summary>How far the wire's surface reaches into the wall, units; 0 or less where it does not.</summary>
        double Penetration(Vector3d[] x);
    }
}

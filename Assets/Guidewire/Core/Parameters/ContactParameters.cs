namespace Guidewire.Core
{
    /// <summary>Contact with walls, for methods that support them.</summary>
    public sealed class ContactParameters
    {
        /// <summary>The radius r of a sphere, units.</summary>
        public double SphereRadius { get; set; } = 5.0;

        /// <summary>Distance kept beyond the radius, in units.</summary>
        public double CollisionMargin { get; set; }

        /// <summary>k_C, gain of a contact, dimensionless.</summary>
        public double CollisionStiffness { get; set; } = 1e-4;

        /// <summary>What touches a wall besides the spheres.</summary>
        public ElementContact ElementContact { get; set; } = ElementContact.Barycentric;

        /// <summary>g0, the gap below which barriers act on a wire with a material, m; 0: by rule (<see
        /// cref="BarrierDefaults"/>).</summary>
        public double ContactDistance { get; set; }

        /// <summary>Stiffness of the barrier, N/m; 0: by rule.</summary>
        public double ContactStiffness { get; set; }

        /// <summary>Elastic displacement along a wall from which a contact of a wire with a material slips, m; 0: by
        /// rule (<see cref="FrictionEnergy"/>).</summary>
        public double ElasticSlip { get; set; }

        /// <summary>Whether a wire with a material touches itself; null: where it has walls.</summary>
        public bool? SelfContact { get; set; }

        /// <summary>Friction coefficient of the wire on itself, dimensionless.</summary>
        public double SelfFriction { get; set; }

        /// <summary>Whether a wire between so many walls touches itself, with a method that has barriers.</summary>
        internal bool TouchesItself(int wallCount) => SelfContact ?? wallCount > 0;

        /// <summary>The same values; lists and walls are shared.</summary>
        internal ContactParameters Copy() => (ContactParameters)MemberwiseClone();
    }

    /// <summary>Contact of rod elements with walls, in addition to that of spheres.</summary>
    public enum ElementContact
    {
        /// <summary>Rod elements; the correction is split between their two spheres by the lever rule.</summary>
        Barycentric,

        /// <summary>Elements have no contact of their own.</summary>
        None,

        /// <summary>Rod elements, by the rule as published (thesis 3.1.2).</summary>
        Thesis,
    }
}

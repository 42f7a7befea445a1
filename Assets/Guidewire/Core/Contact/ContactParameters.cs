namespace Guidewire.Core
{
    /// <summary>How the wire touches walls, for methods that meet them.</summary>
    public sealed class ContactParameters
    {
        /// <summary>r in units.</summary>
        public double SphereRadius { get; set; } = 5.0;

        /// <summary>Distance kept beyond the radius, in units.</summary>
        public double CollisionMargin { get; set; }

        /// <summary>k_C, gain of a contact, dimensionless.</summary>
        public double CollisionStiffness { get; set; } = 1e-4;

        /// <summary>What touches a wall besides the spheres.</summary>
        public ElementContact ElementContact { get; set; } = ElementContact.Barycentric;

        /// <summary>The same values; lists and walls are shared.</summary>
        internal ContactParameters Copy()
        {
            return (ContactParameters)MemberwiseClone();
        }
    }
}

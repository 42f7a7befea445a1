namespace Guidewire.Core
{
    /// <summary>How a material rod is held and discretised: its two ends, and the rules for clamps, mass and
    /// bending.</summary>
    internal sealed class RodSupports
    {
        /// <summary>The proximal end; default clamped.</summary>
        public ProximalEnd Proximal { get; set; } = ProximalEnd.Clamped;

        /// <summary>Whether node 0 follows its support on a stiff spring (<see cref="SupportSpring"/>) instead of being
        /// there exactly.</summary>
        public bool HasSpring { get; set; }

        /// <summary>Where the sheath ends in which the rod's first nodes may be; null without one.</summary>
        public SheathEnd? SheathEnd => Coaxial?.Sheath;

        /// <summary>The instruments of a rod that is several coaxial ones, or one in a sheath; null for a wire
        /// alone.</summary>
        public CoaxialRod? Coaxial { get; set; }

        /// <summary>How many instruments are inside it.</summary>
        public int InnerCount => Coaxial == null ? 0 : Coaxial.Joints.InnerCount;

        /// <summary>The fraction of joint k that is outside a sheath: 0 where none of it is, above 0 to 1
        /// elsewhere.</summary>
        public double FractionOutside(int k) => Coaxial?.Joints.FractionOutside(k) ?? 1.0;

        /// <summary>Whether the joint at the proximal clamp stands for all of a wire in its sheath, and turns about it
        /// without limit.</summary>
        public bool Winds => Coaxial != null && InnerCount == 0;

        /// <summary>The distal end; default free.</summary>
        public DistalEnd Distal { get; set; } = DistalEnd.Free;

        /// <summary>The unit vector along which a sliding distal end may move.</summary>
        public Vector3d SlidingAxis { get; set; } = Vector3d.UnitZ;

        /// <summary>Weights at the clamps; default fourth order.</summary>
        public ClampRule Clamp { get; set; } = ClampRule.FourthOrder;

        /// <summary>The mass matrix; default consistent.</summary>
        public MassRule Mass { get; set; } = MassRule.Consistent;

        /// <summary>The law of a joint; default rotation vector.</summary>
        public BendLaw Bend { get; set; } = BendLaw.RotationVector;

        /// <summary>True where a frame holds the first element by a spring.</summary>
        public bool HasProximalJoint => Proximal == ProximalEnd.Clamped;

        /// <summary>True where a frame holds the last element by a spring.</summary>
        public bool HasDistalJoint => Distal == DistalEnd.Clamped || Distal == DistalEnd.Sliding;

        /// <summary>True where the last node is where its support is; not so where it slides.</summary>
        public bool HoldsLastNode => Distal == DistalEnd.Clamped || Distal == DistalEnd.Held;
    }
}

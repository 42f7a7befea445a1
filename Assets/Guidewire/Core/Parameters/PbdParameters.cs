namespace Guidewire.Core
{
    /// <summary>Properties of a pbd wire, which has no material and whose mass is given as a whole.</summary>
    public sealed class PbdParameters
    {
        /// <summary>k_A, pbd stiffness of the stretch constraint, dimensionless: at 2 the iteration diverges.</summary>
        public double StretchStiffness { get; set; } = 0.1;

        /// <summary>k_B, pbd stiffness of the bend-twist constraint in units of length: at l the iteration
        /// diverges.</summary>
        public double BendStiffness { get; set; } = 0.1;

        /// <summary>M in mass units, distributed evenly over the spheres (thesis eq. 3.2).</summary>
        public double TotalMass { get; set; } = 0.01;

        /// <summary>The same values; lists and walls are shared.</summary>
        internal PbdParameters Copy() => (PbdParameters)MemberwiseClone();
    }
}

namespace Guidewire.Core
{
    /// <summary>What makes a wire of gains (solver pbd): it has no material, and its mass is given as a
    /// whole.</summary>
    public sealed class PbdParameters
    {
        /// <summary>k_A, gain of the stretch constraint, dimensionless: at 2 the sweep breaks down.</summary>
        public double StretchStiffness { get; set; } = 0.1;

        /// <summary>k_B, gain of the bend-twist constraint in units of length: at l the sweep breaks down.</summary>
        public double BendStiffness { get; set; } = 0.1;

        /// <summary>M in mass units, shared evenly by the spheres (thesis eq. 3.2).</summary>
        public double TotalMass { get; set; } = 0.01;

        /// <summary>The same values; lists and walls are shared.</summary>
        internal PbdParameters Copy()
        {
            return (PbdParameters)MemberwiseClone();
        }
    }
}

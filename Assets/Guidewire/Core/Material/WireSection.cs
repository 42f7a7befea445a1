namespace Guidewire.Core
{
    /// <summary>A piece of the wire whose material or rest shape differs: a soft, pre-bent tip. What is null is as in
    /// the rest of the wire.</summary>
    public sealed class WireSection
    {
        /// <summary>Where it begins, units from the proximal end.</summary>
        public double From { get; set; }

        /// <summary>Where it ends, units from the proximal end.</summary>
        public double To { get; set; }

        /// <summary>Equal elements that it is cut into, at least 1; null where its borders do not matter to the
        /// elements (see <see cref="ElementLayout"/>).</summary>
        public int? NumberRodElements { get; set; }

        /// <summary>E, Pa.</summary>
        public double? YoungsModulus { get; set; }

        /// <summary>G, Pa.</summary>
        public double? ShearModulus { get; set; }

        /// <summary>rho, kg/m^3.</summary>
        public double? Density { get; set; }

        /// <summary>Radius, m.</summary>
        public double? WireRadius { get; set; }

        /// <summary>Curvature and twist at rest, rad/m.</summary>
        public Vector3d? RestCurvature { get; set; }
    }
}

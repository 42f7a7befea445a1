using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Material of the wire (solvers xpbd, direct, explicit), in SI units except for positions
    /// along the wire, which are in units of length.</summary>
    public sealed class MaterialParameters
    {
        /// <summary>Young's modulus E, Pa.</summary>
        public double YoungsModulus { get; set; } = 60e9;

        /// <summary>The shear modulus G, Pa.</summary>
        public double ShearModulus { get; set; } = 23e9;

        /// <summary>EA, N, instead of E times the area; null: none.</summary>
        public double? AxialStiffness { get; set; }

        /// <summary>The density rho, kg/m^3.</summary>
        public double Density { get; set; } = 6450.0;

        /// <summary>Radius of the wire, m.</summary>
        public double WireRadius { get; set; } = 0.5e-3;

        /// <summary>Radius of the hollow of a tube, m, less than that of the wire; 0: none.</summary>
        public double InnerRadius { get; set; }

        /// <summary>Diameter of the thickest solid part, m: of the core, or of a coil's wire; null: the wire's own.
        /// </summary>
        public double? CoreDiameter { get; set; }

        /// <summary>What the core is made of.</summary>
        public CoreMaterial Material { get; set; }

        /// <summary>Plateau of a superelastic core; null: none.</summary>
        public Plateau? Plateau { get; set; }

        /// <summary>Stress at which the core yields, Pa; null: none.</summary>
        public double? YieldStress { get; set; }

        /// <summary>Slope of its stress over its own strain beyond that, Pa; null: E/1000.</summary>
        public double? Hardening { get; set; }

        /// <summary>Rings of fibres in a section that is not linear; 0: as the material needs.</summary>
        public int Fibres { get; set; }

        /// <summary>A bend put into the wire before the run; null: none.</summary>
        public Shaping? Shaped { get; set; }

        /// <summary>A = pi (r^2 - a^2), m^2.</summary>
        public double Area => Math.PI * (WireRadius * WireRadius - InnerRadius * InnerRadius);

        /// <summary>I = A (r^2 + a^2)/4, m^4.</summary>
        public double SecondMomentOfArea => 0.25 * Area * (WireRadius * WireRadius + InnerRadius * InnerRadius);

        /// <summary>What of GA resists shear, because the shear is not even over the cross-section: 0.9 for a round
        /// one, between Cowper's 6 (1 + nu)/(7 + 6 nu), 0.886 at nu = 0.3 (1966), and Hutchinson's 0.925
        /// (2001).</summary>
        public double ShearFactor { get; set; } = 0.9;

        /// <summary>Curvature about d1 and d2 and twist about d3 at rest, rad/m.</summary>
        public Vector3d RestCurvature { get; set; }

        /// <summary>Pieces of the wire that differ from the rest; later ones count where they overlap.</summary>
        public IReadOnlyList<WireSection> Sections { get; set; } = Array.Empty<WireSection>();

        /// <summary>a of the force -a M v, 1/s.</summary>
        public double MassDamping { get; set; }

        /// <summary>b of the stress b K times the rate of strain (Kelvin-Voigt), s.</summary>
        public double MaterialDamping { get; set; }

        /// <summary>Weights of the joints at a clamp.</summary>
        public ClampRule ClampRule { get; set; } = ClampRule.FourthOrder;

        /// <summary>The mass matrix.</summary>
        public MassRule MassRule { get; set; } = MassRule.Consistent;

        /// <summary>The law of a joint.</summary>
        public BendLaw BendLaw { get; set; } = BendLaw.RotationVector;

        /// <summary>The same values; lists and walls are shared.</summary>
        internal MaterialParameters Copy() => (MaterialParameters)MemberwiseClone();
    }

    /// <summary>A bend that is put into a wire before the run, over a mandrel: what remains of it is what the core's
    /// law leaves after spring-back.</summary>
    public sealed class Shaping
    {
        /// <summary>Where it begins, units from the hub.</summary>
        public double From { get; set; }

        /// <summary>Where it ends, units from the hub.</summary>
        public double To { get; set; }

        /// <summary>Radius of the mandrel, units; null: as the angle needs.</summary>
        public double? Radius { get; set; }

        /// <summary>Angle that remains, rad; null: as the radius leaves.</summary>
        public double? Angle { get; set; }
    }
}

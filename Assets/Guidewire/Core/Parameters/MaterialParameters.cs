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

        /// <summary>Gives a copy of the values; lists and walls are shared.</summary>
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

    /// <summary>How a joint's couple depends on its angle.</summary>
    public enum BendLaw
    {
        /// <summary>Proportional to the rotation vector, up to half a turn.</summary>
        RotationVector,

        /// <summary>Proportional to the Darboux vector: K sin(angle) (Kugelstadt and Schoemer 2016).</summary>
        Darboux,
    }

    /// <summary>How an element's mass acts on its two nodes.</summary>
    public enum MassRule
    {
        /// <summary>Velocity linear along the element: rho A l times 1/3 on each node, 1/6 between them.</summary>
        Consistent,

        /// <summary>Half of each element's mass on either node.</summary>
        Lumped,

        /// <summary>The whole mass spread evenly over the n+1 nodes (thesis, eq. 3.2).</summary>
        Uniform,
    }

    /// <summary>Length of rod that the spring between a clamp's frame and the first element represents.</summary>
    public enum ClampRule
    {
        /// <summary>Gregory's end weights 3/8, 7/6 and 23/24 of an element for the clamp's spring and the next two
        /// joints: static compliance of fourth order.</summary>
        /// <remarks>A thrust stays of second order, with these weights as with others: the chain itself bends in waves
        /// of k under P = EI 2 (1 - cos k l)/l^2 = EI k^2 (1 - (k l)^2/12 + ..). Clamped at both ends, k = 2 pi/L, it
        /// buckles (2 pi/n)^2/12 too early (0.82 % at n = 20, 0.21 % at n = 40), and holds as much less thrust when
        /// shortened. A correction would tie each joint's stiffness to the thrust beside it, and so positions two
        /// elements apart, which the block-tridiagonal matrix cannot hold.</remarks>
        FourthOrder,

        /// <summary>Half an element, the trapezoidal rule: second order; a circular arc comes out exact.</summary>
        HalfElement,

        /// <summary>A whole element: a hinge of the chain at the clamp, first order. To tell errors of the chain from
        /// errors of a solver: the tip's compliance is n (n + 1)(2n + 1)/(2 n^3) times that of the beam.</summary>
        WholeElement,
    }
}

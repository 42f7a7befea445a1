using System;

namespace Guidewire.Core
{
    /// <summary>Cross-section of the wire at one position: stiffness, mass per length and rest curvature.</summary>
    internal struct CrossSection
    {
        /// <summary>The axial stiffness EA, N.</summary>
        public double StretchStiffness;

        /// <summary>GA times the shear factor, N.</summary>
        public double ShearStiffness;

        /// <summary>EI about d1, N m^2.</summary>
        public double BendStiffness1;

        /// <summary>EI about d2, N m^2.</summary>
        public double BendStiffness2;

        /// <summary>GJ about d3, N m^2.</summary>
        public double TwistStiffness;

        /// <summary>The mass per length rho A, kg/m.</summary>
        public double LineDensity;

        /// <summary>rho I about d1, kg m; about d3 it is the sum of both.</summary>
        public double RotaryInertia1;

        /// <summary>rho I about d2, kg m.</summary>
        public double RotaryInertia2;

        /// <summary>Curvature and twist at rest, rad/m.</summary>
        public Vector3d RestCurvature;

        /// <summary>Radius of the surface, m.</summary>
        public double Radius;

        /// <summary>Radius of the thickest solid part, m: its surface is strained by this times the change of
        /// curvature. Of a spring coil it is that of the coil's wire, which bends and twists by less.</summary>
        public double CoreRadius;

        /// <summary>The law of its bending; null where that is linear.</summary>
        public FibreSection? Fibres;

        /// <summary>What a joint sees of it.</summary>
        public JointSide Side => new JointSide
        {
            Bend1 = BendStiffness1,
            Bend2 = BendStiffness2,
            Twist = TwistStiffness,
            RestCurvature = RestCurvature,
        };

        /// <summary>Gives a round wire: A = pi r^2, I = pi r^4/4, J = 2 I.</summary>
        /// <param name="radius">r, m.</param>
        /// <param name="youngsModulus">E, Pa.</param>
        /// <param name="shearModulus">G, Pa.</param>
        /// <param name="density">rho, kg/m^3.</param>
        public static CrossSection Round(double radius, double youngsModulus, double shearModulus, double density)
        {
            double area = Math.PI * radius * radius;
            CrossSection round = Of(area, 0.25 * area * radius * radius, youngsModulus, shearModulus, density);
            round.Radius = radius;
            round.CoreRadius = radius;
            return round;
        }

        /// <summary>Gives a round tube: A = pi (r^2 - a^2), I = pi (r^4 - a^4)/4, J = 2 I.</summary>
        /// <param name="radius">r, m.</param>
        /// <param name="innerRadius">a, m, less than r.</param>
        /// <param name="youngsModulus">E, Pa.</param>
        /// <param name="shearModulus">G, Pa.</param>
        /// <param name="density">rho, kg/m^3.</param>
        public static CrossSection Tube(double radius, double innerRadius, double youngsModulus, double shearModulus,
            double density)
        {
            double hollow = innerRadius * innerRadius;
            double square = radius * radius;
            double area = Math.PI * (square - hollow);
            return Of(area, 0.25 * area * (square + hollow), youngsModulus, shearModulus, density);
        }

        /// <summary>The wire of these parameters at a position, units from the proximal end: if sections overlap, the
        /// last one with a value applies.</summary>
        /// <param name="hasLaw">Whether to make its fibres, where its bending is not linear.</param>
        public static CrossSection At(MaterialParameters material, double position, bool hasLaw = true)
        {
            var wire = new WireSection
            {
                AxialStiffness = material.AxialStiffness,
                CoreDiameter = material.CoreDiameter,
                Material = material.Material,
                Plateau = material.Plateau,
                YieldStress = material.YieldStress,
                Hardening = material.Hardening,
            };
            foreach (WireSection section in material.Sections)
            {
                if (position >= section.From && position < section.To)
                {
                    wire.TakeOver(section);
                }
            }
            double young = wire.YoungsModulus ?? material.YoungsModulus;
            double shear = wire.ShearModulus ?? material.ShearModulus;
            double density = wire.Density ?? material.Density;
            double radius = wire.WireRadius ?? material.WireRadius;
            double inner = wire.InnerRadius ?? material.InnerRadius;
            CrossSection here = inner == 0.0 ? Round(radius, young, shear, density)
                : Tube(radius, inner, young, shear, density);
            here.ShearStiffness *= wire.ShearFactor ?? material.ShearFactor;
            here.Radius = radius;
            here.CoreRadius = 0.5 * wire.CoreDiameter ?? radius;
            here.RestCurvature = wire.RestCurvature ?? material.RestCurvature;
            here.TakeDirect(wire);
            MaterialLaw? law = hasLaw ? MaterialLaw.Of(wire, material.Fibres) : null;
            here.Fibres = law == null ? null : FibresOf(law, wire, here.BendStiffness1, young, radius, inner);
            return here;
        }

        // Of a core whose diameter nobody said, that which has EI: a solid one, or a tube of these two radii. What EI
        // is less than the core's makes E less; what it is more is linear.
        private static FibreSection FibresOf(MaterialLaw law, WireSection wire, double stiffness, double young,
            double radius, double inner)
        {
            double modulus = law.YoungsModulus > 0.0 ? law.YoungsModulus : young;
            double core = 0.5 * wire.CoreDiameter ?? (inner > 0.0 ? radius
                : Math.Min(radius, Math.Pow(4.0 * stiffness / (Math.PI * modulus), 0.25)));
            double hollow = wire.CoreDiameter == null ? inner : 0.0;
            double second = 0.25 * Math.PI * (Math.Pow(core, 4.0) - Math.Pow(hollow, 4.0));
            bool isAll = law.YoungsModulus == 0.0 && wire.CoreDiameter != null;
            return new FibreSection(law, isAll ? stiffness / second : Math.Min(modulus, stiffness / second), core,
                hollow);
        }

        /// <summary>Radius of the lumen of these parameters at a position, m: 0 where there is none.</summary>
        public static double LumenAt(MaterialParameters material, double position)
        {
            double inner = material.InnerRadius;
            foreach (WireSection section in material.Sections)
            {
                inner = position >= section.From && position < section.To ? section.InnerRadius ?? inner : inner;
            }
            return inner;
        }

        private static CrossSection Of(double area, double second, double youngsModulus, double shearModulus,
            double density)
        {
            return new CrossSection
            {
                StretchStiffness = youngsModulus * area,
                ShearStiffness = shearModulus * area,
                BendStiffness1 = youngsModulus * second,
                BendStiffness2 = youngsModulus * second,
                TwistStiffness = 2.0 * shearModulus * second,
                LineDensity = density * area,
                RotaryInertia1 = density * second,
                RotaryInertia2 = density * second,
            };
        }

        /// <summary>Takes over what is given as stiffness and mass. Rotary inertia follows from them, rho A EI/EA about
        /// each axis, where it is not given.</summary>
        private void TakeDirect(WireSection given)
        {
            StretchStiffness = given.AxialStiffness ?? StretchStiffness;
            ShearStiffness = given.ShearStiffness ?? ShearStiffness;
            BendStiffness1 = given.BendingStiffness1 ?? BendStiffness1;
            BendStiffness2 = given.BendingStiffness2 ?? BendStiffness2;
            TwistStiffness = given.TorsionalStiffness ?? TwistStiffness;
            LineDensity = given.MassPerLength ?? LineDensity;
            if (given.RotaryInertia.HasValue)
            {
                RotaryInertia1 = given.RotaryInertia.Value;
                RotaryInertia2 = given.RotaryInertia.Value;
            }
            else if (given.AxialStiffness.HasValue || given.BendingStiffness1.HasValue
                || given.BendingStiffness2.HasValue || given.MassPerLength.HasValue)
            {
                RotaryInertia1 = LineDensity * BendStiffness1 / StretchStiffness;
                RotaryInertia2 = LineDensity * BendStiffness2 / StretchStiffness;
            }
        }

        /// <summary>Makes element j of a rod of it.</summary>
        public void CopyTo(MaterialRod rod, int j)
        {
            rod.StretchStiffness[j] = StretchStiffness;
            rod.ShearStiffness[j] = ShearStiffness;
            rod.BendStiffness1[j] = BendStiffness1;
            rod.BendStiffness2[j] = BendStiffness2;
            rod.TwistStiffness[j] = TwistStiffness;
            rod.LineDensity[j] = LineDensity;
            rod.RotaryInertia1[j] = RotaryInertia1;
            rod.RotaryInertia2[j] = RotaryInertia2;
            rod.RestCurvature[j] = RestCurvature;
            rod.Radius[j] = Radius;
            rod.CoreRadius[j] = CoreRadius;
        }
    }

    /// <summary>The element on one side of a joint: the uniform element that would bend and twist as much
    /// there.</summary>
    internal struct JointSide
    {
        /// <summary>EI about d1, N m^2.</summary>
        public double Bend1;

        /// <summary>EI about d2, N m^2.</summary>
        public double Bend2;

        /// <summary>GJ about d3, N m^2.</summary>
        public double Twist;

        /// <summary>Curvature and twist at rest, rad/m.</summary>
        public Vector3d RestCurvature;

        /// <summary>Whether another is the same.</summary>
        public bool IsLike(in JointSide other)
        {
            return Bend1 == other.Bend1 && Bend2 == other.Bend2 && Twist == other.Twist
                && RestCurvature == other.RestCurvature;
        }
    }
}

using System;

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

        /// <summary>Young's modulus E, Pa.</summary>
        public double? YoungsModulus { get; set; }

        /// <summary>The shear modulus G, Pa.</summary>
        public double? ShearModulus { get; set; }

        /// <summary>The density rho, kg/m^3.</summary>
        public double? Density { get; set; }

        /// <summary>The outer radius, m.</summary>
        public double? WireRadius { get; set; }

        /// <summary>Radius of a tube's hollow, m.</summary>
        public double? InnerRadius { get; set; }

        /// <summary>Diameter of the thickest solid part, m: the core, or the wire of a coil.</summary>
        public double? CoreDiameter { get; set; }

        /// <summary>What the core is made of: all of a material's numbers that the section does not state.</summary>
        public CoreMaterial? Material { get; set; }

        /// <summary>Plateau of a superelastic core.</summary>
        public Plateau? Plateau { get; set; }

        /// <summary>Stress at which the core yields, Pa.</summary>
        public double? YieldStress { get; set; }

        /// <summary>Slope of its stress over its own strain beyond that, Pa.</summary>
        public double? Hardening { get; set; }

        /// <summary>What of GA resists shear.</summary>
        public double? ShearFactor { get; set; }

        /// <summary>Curvature and twist at rest, rad/m.</summary>
        public Vector3d? RestCurvature { get; set; }

        /// <summary>EA, N, as all that follow instead of what material and radius give: of coiled or flat
        /// wires.</summary>
        public double? AxialStiffness { get; set; }

        /// <summary>GA with its shear factor, N.</summary>
        public double? ShearStiffness { get; set; }

        /// <summary>EI about d1, N m^2.</summary>
        public double? BendingStiffness1 { get; set; }

        /// <summary>EI about d2, N m^2.</summary>
        public double? BendingStiffness2 { get; set; }

        /// <summary>The torsional stiffness GJ, N m^2.</summary>
        public double? TorsionalStiffness { get; set; }

        /// <summary>The mass per length rho A, kg/m.</summary>
        public double? MassPerLength { get; set; }

        /// <summary>rho I about d1 and d2, the mean of both, kg m.</summary>
        public double? RotaryInertia { get; set; }

        /// <summary>Attenuation of X-rays beyond that of its density, 1/mm, as of a marker of platinum in its wall;
        /// only pictures depend on it.</summary>
        public double? Attenuation { get; set; }

        /// <summary>Whether it is a marker alone: nothing else of the wire is another here.</summary>
        public bool IsMarker => Attenuation.HasValue && !NumberRodElements.HasValue && !RestCurvature.HasValue
            && !(YoungsModulus ?? ShearModulus ?? Density ?? WireRadius ?? InnerRadius ?? ShearFactor ?? AxialStiffness
                ?? ShearStiffness ?? BendingStiffness1 ?? BendingStiffness2 ?? TorsionalStiffness ?? MassPerLength
                ?? RotaryInertia ?? CoreDiameter ?? YieldStress ?? Hardening).HasValue && Plateau == null
            && !Material.HasValue;

        /// <summary>The first key of which another section has another value than this one; null where there is
        /// none.</summary>
        public string? FirstOther(WireSection over)
        {
            (string Key, double? Own, double? Over)[] values =
            {
                ("youngsModulus", YoungsModulus, over.YoungsModulus), ("shearModulus", ShearModulus, over.ShearModulus),
                ("density", Density, over.Density), ("wireRadius", WireRadius, over.WireRadius),
                ("innerRadius", InnerRadius, over.InnerRadius), ("shearFactor", ShearFactor, over.ShearFactor),
                ("axialStiffness", AxialStiffness, over.AxialStiffness),
                ("shearStiffness", ShearStiffness, over.ShearStiffness),
                ("bendingStiffness1", BendingStiffness1, over.BendingStiffness1),
                ("bendingStiffness2", BendingStiffness2, over.BendingStiffness2),
                ("torsionalStiffness", TorsionalStiffness, over.TorsionalStiffness),
                ("massPerLength", MassPerLength, over.MassPerLength),
                ("rotaryInertia", RotaryInertia, over.RotaryInertia), ("attenuation", Attenuation, over.Attenuation),
                ("restCurvature", RestCurvature?.X, over.RestCurvature?.X),
                ("restCurvature", RestCurvature?.Y, over.RestCurvature?.Y),
                ("restCurvature", RestCurvature?.Z, over.RestCurvature?.Z),
            };
            return Array.Find(values, one => one.Own.HasValue && one.Over.HasValue && one.Own != one.Over).Key;
        }

        /// <summary>Adds what another section that lies over this one says. A new material or radius puts stiffness and
        /// mass that were given directly out of force.</summary>
        internal void TakeOver(WireSection over)
        {
            bool isNew = over.YoungsModulus.HasValue || over.ShearModulus.HasValue || over.Density.HasValue
                || over.WireRadius.HasValue || over.InnerRadius.HasValue || over.ShearFactor.HasValue
                || over.Material > CoreMaterial.Linear;
            MaterialLaw? law = MaterialLaw.Find(over.Material);
            YoungsModulus = over.YoungsModulus ?? law?.YoungsModulus ?? YoungsModulus;
            ShearModulus = over.ShearModulus ?? law?.ShearModulus ?? ShearModulus;
            Density = over.Density ?? law?.Density ?? Density;
            if (over.Material.HasValue || over.Plateau != null || over.YieldStress.HasValue)
            {
                (Material, Plateau, YieldStress) = (over.Material, over.Plateau, over.YieldStress);
                Hardening = null;
            }
            Hardening = over.Hardening ?? Hardening;
            CoreDiameter = over.CoreDiameter ?? (over.WireRadius.HasValue ? 2.0 * over.WireRadius : CoreDiameter);
            WireRadius = over.WireRadius ?? WireRadius;
            InnerRadius = over.InnerRadius ?? InnerRadius;
            ShearFactor = over.ShearFactor ?? ShearFactor;
            RestCurvature = over.RestCurvature ?? RestCurvature;
            AxialStiffness = over.AxialStiffness ?? (isNew ? null : AxialStiffness);
            ShearStiffness = over.ShearStiffness ?? (isNew ? null : ShearStiffness);
            BendingStiffness1 = over.BendingStiffness1 ?? (isNew ? null : BendingStiffness1);
            BendingStiffness2 = over.BendingStiffness2 ?? (isNew ? null : BendingStiffness2);
            TorsionalStiffness = over.TorsionalStiffness ?? (isNew ? null : TorsionalStiffness);
            MassPerLength = over.MassPerLength ?? (isNew ? null : MassPerLength);
            RotaryInertia = over.RotaryInertia ?? (isNew ? null : RotaryInertia);
        }
    }
}

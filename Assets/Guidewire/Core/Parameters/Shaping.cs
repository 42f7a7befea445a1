using System;

namespace Guidewire.Core
{
    /// <summary>A bend that is put into a wire before the run, over a mandrel: what remains of it is what the core's law
    /// leaves after spring-back.</summary>
    public sealed class Shaping
    {
        private const int Bisections = 100;

        /// <summary>Where it begins, units from the hub.</summary>
        public double From { get; set; }

        /// <summary>Where it ends, units from the hub.</summary>
        public double To { get; set; }

        /// <summary>Radius of the mandrel, units; null: as the angle needs.</summary>
        public double? Radius { get; set; }

        /// <summary>Angle that remains, rad; null: as the radius leaves.</summary>
        public double? Angle { get; set; }

        /// <summary>Curvature on the mandrel, rad/m, and what of it remains; null where no core yields there, or where
        /// none remains so much.</summary>
        public (double Bent, double Kept)? Find(MaterialParameters material, double metres)
        {
            CrossSection here = CrossSection.At(material, 0.5 * (From + To));
            if (!(here.Fibres is FibreSection section) || section.Law.IsSuperelastic)
            {
                return null;
            }
            double Kept(double curvature) =>
                section.Shape(curvature, here.BendStiffness1, new double[section.StateCount]);
            if (Radius is double radius)
            {
                double on = 1.0 / (metres * radius + here.Radius);
                return (on, Kept(on));
            }
            double asked = Math.Abs(Angle!.Value) / (metres * (To - From));
            double low = 0.0;
            double high = 1.0 / here.Radius;
            if (Kept(high) < asked)
            {
                return null;
            }
            for (int k = 0; k < Bisections; k++)
            {
                double middle = 0.5 * (low + high);
                (low, high) = Kept(middle) < asked ? (middle, high) : (low, middle);
            }
            return (high, asked);
        }

        /// <summary>Radius of the mandrel, units.</summary>
        public double RadiusOf(double bent, MaterialParameters material, double metres) =>
            (1.0 / bent - CrossSection.At(material, 0.5 * (From + To)).Radius) / metres;

        /// <summary>Strain of the core's outermost fibre on the mandrel.</summary>
        public double StrainOf(double bent, MaterialParameters material) =>
            bent * CrossSection.At(material, 0.5 * (From + To)).Fibres!.Radius;
    }
}

using System;

namespace Guidewire.Core
{
    /// <summary>The mandrel over which a wire is bent, and what of the bend its core keeps.</summary>
    public static class Mandrel
    {
        private const int Bisections = 100;

        /// <summary>Gives the curvature on the mandrel and what of it remains, rad/m; null where no core yields in the
        /// middle of the bend, or where none keeps so much.</summary>
        /// <param name="metres">Of a unit.</param>
        public static (double Bent, double Kept)? Find(Shaping shaped, MaterialParameters material, double metres)
        {
            CrossSection here = CrossSection.At(material, 0.5 * (shaped.From + shaped.To));
            if (!(here.Fibres is FibreSection section) || section.Law.IsSuperelastic)
            {
                return null;
            }
            double Kept(double curvature) =>
                section.Shape(curvature, here.BendStiffness1, new double[section.StateCount]);
            if (shaped.Radius is double radius)
            {
                double on = 1.0 / (metres * radius + here.Radius);
                return (on, Kept(on));
            }
            double asked = Math.Abs(shaped.Angle!.Value) / (metres * (shaped.To - shaped.From));
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

        /// <summary>Gives the radius of the mandrel, units.</summary>
        /// <param name="bent">Curvature on it, rad/m.</param>
        public static double RadiusOf(Shaping shaped, double bent, MaterialParameters material, double metres) =>
            (1.0 / bent - CrossSection.At(material, 0.5 * (shaped.From + shaped.To)).Radius) / metres;

        /// <summary>Gives the strain of the core's outermost fibre on the mandrel.</summary>
        /// <param name="bent">Curvature on it, rad/m.</param>
        public static double StrainOf(Shaping shaped, double bent, MaterialParameters material) =>
            bent * CrossSection.At(material, 0.5 * (shaped.From + shaped.To)).Fibres!.Radius;
    }
}

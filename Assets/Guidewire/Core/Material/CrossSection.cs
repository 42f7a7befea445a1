using System;

namespace Guidewire.Core
{
    /// <summary>The wire at one place: how stiff and heavy its cross-section is, and how it is bent at rest.</summary>
    internal struct CrossSection
    {
        /// <summary>EA, N.</summary>
        public double StretchStiffness;

        /// <summary>GA, N.</summary>
        public double ShearStiffness;

        /// <summary>EI about d1 and d2, N m^2.</summary>
        public double BendStiffness;

        /// <summary>GJ about d3, N m^2.</summary>
        public double TwistStiffness;

        /// <summary>rho A, kg/m.</summary>
        public double LineDensity;

        /// <summary>rho I about d1 and d2, kg m; about d3 it is twice that.</summary>
        public double RotaryInertia;

        /// <summary>Curvature and twist at rest, rad/m.</summary>
        public Vector3d RestCurvature;

        /// <summary>What a joint sees of it.</summary>
        public JointSide Side => new JointSide
        {
            Bend = BendStiffness,
            Twist = TwistStiffness,
            RestCurvature = RestCurvature,
        };

        /// <summary>A round wire: A = pi r^2, I = pi r^4/4, J = 2 I.</summary>
        /// <param name="radius">r, m.</param>
        /// <param name="youngsModulus">E, Pa.</param>
        /// <param name="shearModulus">G, Pa.</param>
        /// <param name="density">rho, kg/m^3.</param>
        public static CrossSection Round(double radius, double youngsModulus, double shearModulus, double density)
        {
            double area = Math.PI * radius * radius;
            double second = 0.25 * area * radius * radius;
            return new CrossSection
            {
                StretchStiffness = youngsModulus * area,
                ShearStiffness = shearModulus * area,
                BendStiffness = youngsModulus * second,
                TwistStiffness = 2.0 * shearModulus * second,
                LineDensity = density * area,
                RotaryInertia = density * second,
            };
        }

        /// <summary>The wire of these parameters at a place, units from the proximal end: of the sections there the
        /// last one that says something counts.</summary>
        public static CrossSection At(MaterialParameters material, double place)
        {
            double radius = material.WireRadius;
            double young = material.YoungsModulus;
            double shear = material.ShearModulus;
            double density = material.Density;
            Vector3d curvature = material.RestCurvature;
            foreach (WireSection section in material.Sections)
            {
                if (place >= section.From && place < section.To)
                {
                    radius = section.WireRadius ?? radius;
                    young = section.YoungsModulus ?? young;
                    shear = section.ShearModulus ?? shear;
                    density = section.Density ?? density;
                    curvature = section.RestCurvature ?? curvature;
                }
            }
            CrossSection round = Round(radius, young, shear, density);
            round.RestCurvature = curvature;
            return round;
        }

        /// <summary>Makes element j of a rod of it.</summary>
        public void CopyTo(MaterialRod rod, int j)
        {
            rod.StretchStiffness[j] = StretchStiffness;
            rod.ShearStiffness[j] = ShearStiffness;
            rod.BendStiffness[j] = BendStiffness;
            rod.TwistStiffness[j] = TwistStiffness;
            rod.LineDensity[j] = LineDensity;
            rod.RotaryInertia[j] = RotaryInertia;
            rod.RestCurvature[j] = RestCurvature;
        }
    }
}

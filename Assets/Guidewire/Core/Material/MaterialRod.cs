using System;

namespace Guidewire.Core
{
    /// <summary>A rod as a material: stiffness, density and rest shape of each of its n elements, in SI
    /// units.</summary>
    internal sealed class MaterialRod
    {
        // Gregory's end weights for the trapezoidal rule, fourth order.
        private static readonly double[] GregoryWeights = { 3.0 / 8.0, 7.0 / 6.0, 23.0 / 24.0 };

        /// <summary>A rod of n elements, all of whose numbers are still 0.</summary>
        public MaterialRod(int elementCount)
        {
            Length = new double[elementCount];
            StretchStiffness = new double[elementCount];
            ShearStiffness = new double[elementCount];
            BendStiffness = new double[elementCount];
            TwistStiffness = new double[elementCount];
            LineDensity = new double[elementCount];
            RotaryInertia = new double[elementCount];
            RestCurvature = new Vector3d[elementCount];
        }

        /// <summary>n.</summary>
        public int ElementCount => Length.Length;

        /// <summary>Rest length l of each element, m.</summary>
        public double[] Length { get; }

        /// <summary>EA, N.</summary>
        public double[] StretchStiffness { get; }

        /// <summary>GA, N.</summary>
        public double[] ShearStiffness { get; }

        /// <summary>EI about d1 and d2, N m^2.</summary>
        public double[] BendStiffness { get; }

        /// <summary>GJ about d3, N m^2.</summary>
        public double[] TwistStiffness { get; }

        /// <summary>rho A, kg/m.</summary>
        public double[] LineDensity { get; }

        /// <summary>rho I about d1 and d2, kg m; about d3 it is twice that.</summary>
        public double[] RotaryInertia { get; }

        /// <summary>Curvature and twist at rest along the element's axes, rad/m.</summary>
        public Vector3d[] RestCurvature { get; }

        /// <summary>L, m.</summary>
        public double TotalLength
        {
            get
            {
                double sum = 0.0;
                foreach (double l in Length)
                {
                    sum += l;
                }
                return sum;
            }
        }

        /// <summary>EI/L^2 of the stiffest element, N: the scale of the forces that bend the rod.</summary>
        public double BendForce
        {
            get
            {
                double largest = 0.0;
                foreach (double stiffness in BendStiffness)
                {
                    largest = Math.Max(largest, stiffness);
                }
                double length = TotalLength;
                return largest / (length * length);
            }
        }

        /// <summary>A straight round wire of n equal elements: A = pi r^2, I = pi r^4/4, J = 2 I.</summary>
        /// <param name="elementCount">n, at least 1.</param>
        /// <param name="length">L, m.</param>
        /// <param name="radius">r, m.</param>
        /// <param name="youngsModulus">E, Pa.</param>
        /// <param name="shearModulus">G, Pa.</param>
        /// <param name="density">rho, kg/m^3.</param>
        public static MaterialRod Round(int elementCount, double length, double radius, double youngsModulus,
            double shearModulus, double density)
        {
            MaterialRod rod = new MaterialRod(elementCount);
            for (int j = 0; j < elementCount; j++)
            {
                rod.Length[j] = length / elementCount;
                rod.SetRound(j, radius, youngsModulus, shearModulus, density);
            }
            return rod;
        }

        /// <summary>Makes element j a round wire of this radius and material; its length and rest curvature
        /// stay.</summary>
        public void SetRound(int j, double radius, double youngsModulus, double shearModulus, double density)
        {
            double area = Math.PI * radius * radius;
            double second = 0.25 * area * radius * radius;
            StretchStiffness[j] = youngsModulus * area;
            ShearStiffness[j] = shearModulus * area;
            BendStiffness[j] = youngsModulus * second;
            TwistStiffness[j] = 2.0 * shearModulus * second;
            LineDensity[j] = density * area;
            RotaryInertia[j] = density * second;
        }

        /// <summary>The n+1 joints: 0 and n at the ends, k between elements k-1 and k. A joint stands for half of the
        /// element on either side, times its weight; its compliance is the sum of theirs.</summary>
        /// <remarks>Gregory's weights need three joints from each clamp of their own; a shorter rod takes the half
        /// element. </remarks>
        public Joint[] Joints(RodSupports supports)
        {
            int n = ElementCount;
            int needed = supports.HasProximalJoint && supports.HasDistalJoint ? 6 : 3;
            ClampRule rule = supports.Clamp == ClampRule.FourthOrder && n < needed
                ? ClampRule.HalfElement : supports.Clamp;
            Joint[] joints = new Joint[n + 1];
            for (int k = 0; k <= n; k++)
            {
                int before = Math.Max(k - 1, 0);
                int after = Math.Min(k, n - 1);
                double weight = 1.0;
                if (supports.HasProximalJoint)
                {
                    weight *= Weight(rule, k);
                }
                if (supports.HasDistalJoint)
                {
                    weight *= Weight(rule, n - k);
                }
                double half = 0.5 * weight;
                joints[k].Bend = 1.0 / (half * (Length[before] / BendStiffness[before]
                    + Length[after] / BendStiffness[after]));
                joints[k].Twist = 1.0 / (half * (Length[before] / TwistStiffness[before]
                    + Length[after] / TwistStiffness[after]));
                joints[k].Rest = half * (Length[before] * RestCurvature[before] + Length[after] * RestCurvature[after]);
            }
            return joints;
        }

        /// <summary>Weight of the joint that stands <paramref name="place"/> places from a clamp (0: the clamp's
        /// own).</summary>
        private static double Weight(ClampRule rule, int place)
        {
            switch (rule)
            {
                case ClampRule.FourthOrder:
                    return place < GregoryWeights.Length ? GregoryWeights[place] : 1.0;
                case ClampRule.HalfElement:
                    return place == 0 ? 0.5 : 1.0;
                default:
                    return 1.0;
            }
        }
    }
}

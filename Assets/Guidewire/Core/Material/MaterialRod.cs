using System;

namespace Guidewire.Core
{
    /// <summary>A rod as a material: stiffness, density and rest shape of each of its n elements, in SI
    /// units.</summary>
    internal sealed class MaterialRod
    {
        private const double LeastWeight = 0.1;    // of a joint by the rule of fourth order

        private readonly JointSide[]?[] _sides;  // of an element that is not the same all along: start and end

        /// <summary>A rod of n elements, all of whose numbers are still 0.</summary>
        /// <param name="capacity">The most elements that it will have.</param>
        public MaterialRod(int elementCount, int capacity = 0)
        {
            ElementCount = elementCount;
            Capacity = Math.Max(elementCount, capacity);
            Length = new double[Capacity];
            StretchStiffness = new double[Capacity];
            ShearStiffness = new double[Capacity];
            BendStiffness1 = new double[Capacity];
            BendStiffness2 = new double[Capacity];
            TwistStiffness = new double[Capacity];
            LineDensity = new double[Capacity];
            RotaryInertia1 = new double[Capacity];
            RotaryInertia2 = new double[Capacity];
            RestCurvature = new Vector3d[Capacity];
            Radius = new double[Capacity];
            CoreRadius = new double[Capacity];
            _sides = new JointSide[]?[Capacity];
        }

        /// <summary>The number of elements n; what is made for a rod has its <see cref="Capacity"/>.</summary>
        public int ElementCount { get; set; }

        /// <summary>The most elements that the rod will have.</summary>
        public int Capacity { get; }

        /// <summary>Rest length l of each element, m.</summary>
        public double[] Length { get; }

        /// <summary>EA, N.</summary>
        public double[] StretchStiffness { get; }

        /// <summary>GA, N.</summary>
        public double[] ShearStiffness { get; }

        /// <summary>EI about d1, N m^2.</summary>
        public double[] BendStiffness1 { get; }

        /// <summary>EI about d2, N m^2; the same for a round wire.</summary>
        public double[] BendStiffness2 { get; }

        /// <summary>GJ about d3, N m^2.</summary>
        public double[] TwistStiffness { get; }

        /// <summary>rho A, kg/m.</summary>
        public double[] LineDensity { get; }

        /// <summary>rho I about d1, kg m; about d3 a flat piece of wire has the sum of both.</summary>
        public double[] RotaryInertia1 { get; }

        /// <summary>rho I about d2, kg m.</summary>
        public double[] RotaryInertia2 { get; }

        /// <summary>Curvature and twist at rest along the element's axes, rad/m.</summary>
        public Vector3d[] RestCurvature { get; }

        /// <summary>Damping in proportion to mass, 1/s.</summary>
        public double MassDamping { get; set; }

        /// <summary>Damping in proportion to stiffness (Kelvin-Voigt), s.</summary>
        public double MaterialDamping { get; set; }

        /// <summary>What its fibres remember; null of a linear wire.</summary>
        public FibreMemory? Fibres { get; set; }

        /// <summary>Radius of the surface that touches walls, m; the largest along an element.</summary>
        public double[] Radius { get; }

        /// <summary>Radius of the thickest solid part, m: that of the surface unless <see
        /// cref="MaterialParameters.CoreDiameter"/> says otherwise; the largest along an element.</summary>
        public double[] CoreRadius { get; }

        /// <summary>The length L of all elements at rest, m.</summary>
        public double TotalLength
        {
            get
            {
                double sum = 0.0;
                for (int j = 0; j < ElementCount; j++)
                {
                    sum += Length[j];
                }
                return sum;
            }
        }

        /// <summary>Smallest EI of all elements and axes, N m^2, or 3/2 GJ where that is less: of a homogeneous round
        /// section it is not.</summary>
        public double SoftestStiffness
        {
            get
            {
                double smallest = double.PositiveInfinity;
                for (int j = 0; j < ElementCount; j++)
                {
                    smallest = Math.Min(smallest, Math.Min(BendStiffness1[j], BendStiffness2[j]));
                    smallest = Math.Min(smallest, 1.5 * TwistStiffness[j]);
                }
                return smallest;
            }
        }

        /// <summary>EI/L^2 of the stiffest element, N: the scale of the forces that bend the rod.</summary>
        public double BendForce
        {
            get
            {
                double largest = 0.0;
                for (int j = 0; j < ElementCount; j++)
                {
                    largest = Math.Max(largest, Math.Max(BendStiffness1[j], BendStiffness2[j]));
                }
                double length = TotalLength;
                return largest / (length * length);
            }
        }

        /// <summary>Gives a straight round wire of n equal elements: A = pi r^2, I = pi r^4/4, J = 2 I.</summary>
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

        /// <summary>Makes element j that of another rod.</summary>
        public void CopyElement(int j, MaterialRod other, int element)
        {
            Length[j] = other.Length[element];
            StretchStiffness[j] = other.StretchStiffness[element];
            ShearStiffness[j] = other.ShearStiffness[element];
            BendStiffness1[j] = other.BendStiffness1[element];
            BendStiffness2[j] = other.BendStiffness2[element];
            TwistStiffness[j] = other.TwistStiffness[element];
            LineDensity[j] = other.LineDensity[element];
            RotaryInertia1[j] = other.RotaryInertia1[element];
            RotaryInertia2[j] = other.RotaryInertia2[element];
            RestCurvature[j] = other.RestCurvature[element];
            Radius[j] = other.Radius[element];
            CoreRadius[j] = other.CoreRadius[element];
            _sides[j] = other._sides[element];
        }

        /// <summary>Makes element j a round wire of this radius and material; its length and rest curvature
        /// stay.</summary>
        public void SetRound(int j, double radius, double youngsModulus, double shearModulus, double density)
        {
            CrossSection round = CrossSection.Round(radius, youngsModulus, shearModulus, density);
            round.RestCurvature = RestCurvature[j];
            round.CopyTo(this, j);
        }

        /// <summary>Says what the joints at the two ends of element j see of it, where it is not the same all
        /// along.</summary>
        public void SetSides(int j, in JointSide start, in JointSide end) => _sides[j] = new[] { start, end };

        /// <summary>Gives what the joint before element j sees of it.</summary>
        public JointSide StartOf(int j) => _sides[j] == null ? Even(j) : _sides[j]![0];

        /// <summary>Gives what the joint after element j sees of it.</summary>
        public JointSide EndOf(int j) => _sides[j] == null ? Even(j) : _sides[j]![1];

        /// <summary>The n+1 joints: 0 and n at the ends, k between elements k-1 and k. A joint stands for half of the
        /// element on either side, times its weight; its compliance is the sum of theirs.</summary>
        /// <remarks>Gregory's weights need three joints from each clamp of their own, on elements of one material. The
        /// trapezoidal rule has the error -l^3 f''/12 on each element; from the third joint on, on equal elements, the
        /// sum is l^2 f'/12 there. The three weights take it off a parabola: with the positions 0, a, b of the joints
        /// and l the third element, corrections c to the lengths that the joints stand for have the sum 0, and
        /// c1 a + c2 b = l^2/12, c1 a^2 + c2 b^2 = l^2 b/6 - (a^3 + (b - a)^3)/6. For equal elements that is Gregory's
        /// 3/8, 7/6, 23/24. Where a joint would have less than a tenth of its length, and on other materials, the
        /// half element replaces them.</remarks>
        public Joint[] Joints(RodSupports supports)
        {
            var joints = new Joint[Capacity + 1];
            SetJoints(supports, joints);
            return joints;
        }

        /// <summary>Sets the same.</summary>
        public void SetJoints(RodSupports supports, Joint[] joints)
        {
            int n = ElementCount;
            (EndWeights Proximal, EndWeights Distal) rules = JointRules(supports);
            for (int k = 0; k <= n; k++)
            {
                int before = Math.Max(k - 1, 0);
                int after = Math.Min(k, n - 1);
                JointSide left = k == 0 ? StartOf(0) : EndOf(before);
                JointSide right = k == n ? EndOf(n - 1) : StartOf(after);
                double half = 0.5 * WeightOf(k, supports, rules);
                joints[k].Bend1 = 1.0 / (half * (Length[before] / left.Bend1 + Length[after] / right.Bend1));
                joints[k].Bend2 = 1.0 / (half * (Length[before] / left.Bend2 + Length[after] / right.Bend2));
                joints[k].Twist = 1.0 / (half * (Length[before] / left.Twist + Length[after] / right.Twist));
                joints[k].Rest = half * (Length[before] * left.RestCurvature + Length[after] * right.RestCurvature);
            }
            if (supports.Winds)
            {
                // It stands for all of the wire before it.
                Joint whole = supports.Coaxial!.Joints[0].Alone;
                joints[0].Twist = whole.Twist;
                joints[0].Rest = new Vector3d(joints[0].Rest.X, joints[0].Rest.Y, whole.Rest.Z);
            }
        }

        /// <summary>The length of wire that each of the n+1 joints stands for, m.</summary>
        public double[] JointLengths(RodSupports supports)
        {
            var lengths = new double[Capacity + 1];
            SetJointLengths(supports, lengths);
            return lengths;
        }

        /// <summary>Sets the same.</summary>
        public void SetJointLengths(RodSupports supports, double[] lengths)
        {
            (EndWeights Proximal, EndWeights Distal) rules = JointRules(supports);
            for (int k = 0; k <= ElementCount; k++)
            {
                lengths[k] = WeightOf(k, supports, rules)
                    * (0.5 * (Length[Math.Max(k - 1, 0)] + Length[Math.Min(k, ElementCount - 1)]));
            }
        }

        /// <summary>Error of the deflection of a clamped wire of one material under a load at its other end, of which
        /// the joints' lengths are a quadrature: sum w (L - s)^2 against L^3/3, the worse of both clamps.</summary>
        public double ClampError(RodSupports supports)
        {
            double[] lengths = JointLengths(supports);
            double whole = TotalLength;
            double fromProximal = 0.0;
            double fromDistal = 0.0;
            double s = 0.0;
            for (int k = 0; k <= ElementCount; k++)
            {
                fromProximal += lengths[k] * (whole - s) * (whole - s);
                fromDistal += lengths[k] * s * s;
                s += k < ElementCount ? Length[k] : 0.0;
            }
            double exact = whole * whole * whole / 3.0;
            return Math.Max(supports.HasProximalJoint ? Math.Abs(fromProximal / exact - 1.0) : 0.0,
                supports.HasDistalJoint ? Math.Abs(fromDistal / exact - 1.0) : 0.0);
        }

        private (EndWeights Proximal, EndWeights Distal) JointRules(RodSupports supports)
        {
            int n = ElementCount;
            bool isLong = n >= (supports.HasProximalJoint && supports.HasDistalJoint ? 6 : 3);
            return isLong ? (Rule(supports, 0, 1), Rule(supports, n - 1, -1))
                : (ShortRule(supports), ShortRule(supports));
        }

        private double WeightOf(int joint, RodSupports supports, (EndWeights Proximal, EndWeights Distal) rules)
        {
            return (supports.HasProximalJoint ? rules.Proximal.At(joint) : 1.0)
                * (supports.HasDistalJoint ? rules.Distal.At(ElementCount - joint) : 1.0);
        }

        private JointSide Even(int j)
        {
            return new JointSide
            {
                Bend1 = BendStiffness1[j],
                Bend2 = BendStiffness2[j],
                Twist = TwistStiffness[j],
                RestCurvature = RestCurvature[j],
            };
        }

        /// <summary>The weights at a clamp.</summary>
        /// <param name="first">The element at it.</param>
        /// <param name="step">To the next one.</param>
        private EndWeights Rule(RodSupports supports, int first, int step)
        {
            if (supports.Clamp != ClampRule.FourthOrder)
            {
                return ShortRule(supports);
            }
            bool areEqual = true;
            for (int k = 0; k < 3; k++)
            {
                int j = first + k * step;
                if (_sides[j] != null || !Even(j).IsLike(Even(first)))
                {
                    return ShortRule(supports);
                }
                areEqual &= Math.Abs(Length[j] - Length[first]) <= 1e-9 * Length[first];
            }
            if (areEqual)
            {
                return EndWeights.Gregory;
            }
            double a = Length[first];
            double next = Length[first + step];
            double l = Length[first + 2 * step];
            double b = a + next;
            double linear = l * l / 12.0;
            double square = (l * l * b - a * a * a - next * next * next) / 6.0;
            double c2 = (square - a * linear) / (b * (b - a));
            double c1 = (linear - c2 * b) / a;
            var weights = new EndWeights(0.5 - (c1 + c2) / a, 1.0 + 2.0 * c1 / b, 1.0 + 2.0 * c2 / (next + l));
            return weights.Least >= LeastWeight ? weights : ShortRule(supports);
        }

        private static EndWeights ShortRule(RodSupports supports) =>
            supports.Clamp == ClampRule.WholeElement ? new EndWeights(1.0, 1.0, 1.0) : new EndWeights(0.5, 1.0, 1.0);

        /// <summary>Weights of the joints from a clamp on, that of the clamp first; further ones have 1.</summary>
        private readonly struct EndWeights
        {
            public static readonly EndWeights Gregory = new EndWeights(3.0 / 8.0, 7.0 / 6.0, 23.0 / 24.0);

            private readonly double _first;
            private readonly double _second;
            private readonly double _third;

            public EndWeights(double first, double second, double third) =>
                (_first, _second, _third) = (first, second, third);

            /// <summary>The smallest, of the first one twice: of equal elements it is about a half.</summary>
            public double Least => Math.Min(2.0 * _first, Math.Min(_second, _third));

            public double At(int index) => index == 0 ? _first : index == 1 ? _second : index == 2 ? _third : 1.0;
        }
    }
}

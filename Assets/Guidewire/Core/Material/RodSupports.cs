namespace Guidewire.Core
{
    /// <summary>How a material rod is held and discretised: its two ends, and the rules for clamps, mass and
    /// bending.</summary>
    internal sealed class RodSupports
    {
        /// <summary>The proximal end; default clamped.</summary>
        public ProximalEnd Proximal { get; set; } = ProximalEnd.Clamped;

        /// <summary>Whether node 0 follows its support on a stiff spring (<see cref="SupportSpring"/>) instead of being
        /// there exactly.</summary>
        public bool HasSpring { get; set; }

        /// <summary>Where the sheath ends in which the rod's first nodes may be; null without one.</summary>
        public SheathEnd? SheathEnd => Coaxial?.Sheath;

        /// <summary>The instruments of a rod that is several coaxial ones, or one in a sheath; null for a wire
        /// alone.</summary>
        public CoaxialRod? Coaxial { get; set; }

        /// <summary>How many instruments are inside it.</summary>
        public int InnerCount => Coaxial == null ? 0 : Coaxial.Joints.InnerCount;

        /// <summary>The fraction of joint k that is outside a sheath: 0 where none of it is, above 0 to 1
        /// elsewhere.</summary>
        public double FractionOutside(int k) => Coaxial?.Joints.FractionOutside(k) ?? 1.0;

        /// <summary>Whether the joint at the proximal clamp stands for all of a wire in its sheath, and turns about it
        /// without limit.</summary>
        public bool Winds => Coaxial != null && InnerCount == 0;

        /// <summary>The distal end; default free.</summary>
        public DistalEnd Distal { get; set; } = DistalEnd.Free;

        /// <summary>The unit vector along which a sliding distal end may move.</summary>
        public Vector3d SlidingAxis { get; set; } = Vector3d.UnitZ;

        /// <summary>Weights at the clamps; default fourth order.</summary>
        public ClampRule Clamp { get; set; } = ClampRule.FourthOrder;

        /// <summary>The mass matrix; default consistent.</summary>
        public MassRule Mass { get; set; } = MassRule.Consistent;

        /// <summary>The law of a joint; default rotation vector.</summary>
        public BendLaw Bend { get; set; } = BendLaw.RotationVector;

        /// <summary>True where a frame holds the first element by a spring.</summary>
        public bool HasProximalJoint => Proximal == ProximalEnd.Clamped;

        /// <summary>True where a frame holds the last element by a spring.</summary>
        public bool HasDistalJoint => Distal == DistalEnd.Clamped || Distal == DistalEnd.Sliding;

        /// <summary>True where the last node is where its support is; not so where it slides.</summary>
        public bool HoldsLastNode => Distal == DistalEnd.Clamped || Distal == DistalEnd.Held;
    }

    /// <summary>The end of a sheath, and the nodes and elements in it.</summary>
    internal sealed class SheathEnd
    {
        /// <summary>Fraction of its bending compliance that a piece in a sheath retains.</summary>
        public const double RetainedBend = 1e-8;

        /// <summary>An end.</summary>
        /// <param name="exit">m.</param>
        /// <param name="axis">Where it leads, a unit vector.</param>
        public SheathEnd(in Vector3d exit, in Vector3d axis)
        {
            Exit = exit;
            Axis = axis;
        }

        /// <summary>Where the sheath ends, m.</summary>
        public Vector3d Exit { get; }

        /// <summary>The direction in which the sheath leads, a unit vector.</summary>
        public Vector3d Axis { get; }

        /// <summary>How many nodes of a shape, from the first on, are in the sheath.</summary>
        public int NodesInside(RodShape shape)
        {
            Vector3d[] x = shape.X;
            int inside = 0;
            while (inside <= shape.ElementCount && Outside(x[inside]) < 0.0)
            {
                inside++;
            }
            return inside;
        }

        /// <summary>Gives the distance of a node beyond the exit of the sheath, m; negative inside.</summary>
        public double Outside(in Vector3d node) => Vector3d.Dot(node - Exit, Axis);

        /// <summary>Gives the point of the sheath's axis beside a node, m.</summary>
        public Vector3d OnAxis(in Vector3d node) => Exit + Outside(node) * Axis;
    }

    /// <summary>Extrapolates the frame of a clamp that a start does not state from the elements next to it.</summary>
    /// <remarks>With k_i = theta_i/L_i, theta_i the rotation at joint i and L_i the length it stands for, the
    /// curvature at the clamp is 2 k_1 - k_2, and the clamp's own joint turns by L_0 times that. The L_i are those of
    /// the clamp's rule in a shape that a run found, which then is at rest; in one sampled from a smooth curve, its
    /// orientations those at the elements' middles, they are l/2, l, l. The elements beyond, whose orientations are
    /// those of the middles in both, tell which: from their curvature at 3 l and 4 l the frame at the end is known to
    /// second order. A shape of less than five elements counts as sampled. A straight end keeps its frame.</remarks>
    internal static class ClampExtrapolation
    {
        private const int Needed = 5;   // elements that tell which

        /// <summary>The frame at an end of a shape.</summary>
        /// <param name="shape">Its elements' orientations.</param>
        /// <param name="lengths">Of the elements, m.</param>
        /// <param name="jointLengths">The length that each of the n + 1 joints stands for, m.</param>
        /// <param name="isProximal">Which end.</param>
        public static Quaterniond Frame(RodShape shape, double[] lengths, double[] jointLengths, bool isProximal)
        {
            int n = shape.ElementCount;
            Quaterniond At(int j) => shape.Q[isProximal ? j : n - 1 - j];
            double Joint(int k) => jointLengths[isProximal ? k : n - k];
            double Length(int j) => lengths[isProximal ? j : n - 1 - j];
            double Between(int k) => 0.5 * (Length(k - 1) + Length(k));
            Vector3d Turn(int k) => Log(At(k - 1), At(k));
            if (n < 2 || (Turn(1) == Vector3d.Zero && (n < 3 || Turn(2) == Vector3d.Zero)))
            {
                return At(0);
            }

            Quaterniond Back(double own, double first, double second)
            {
                Vector3d atFirst = Turn(1) / first;
                Vector3d curvature = n < 3 ? atFirst : 2.0 * atFirst - Turn(2) / second;
                return At(0) * RotationVector.Exp(-own * curvature);
            }

            Quaterniond sampled = Back(0.5 * Length(0), Between(1), n < 3 ? 0.0 : Between(2));
            if (n < Needed)
            {
                return sampled;
            }
            Quaterniond found = Back(Joint(0), Joint(1), Joint(2));
            double start = Length(0) + Length(1) + 0.5 * Length(2);
            Vector3d third = Turn(3) / Between(3);
            Vector3d fourth = Turn(4) / Between(4);
            double behind = 0.5 * Length(2) + 0.5 * start;
            Quaterniond beyond = At(2) * RotationVector.Exp(
                -start * (third - behind / Length(3) * (fourth - third)));
            return Log(beyond, found).LengthSquared < Log(beyond, sampled).LengthSquared ? found : sampled;
        }

        // The rotation from one frame to another, of at most half a turn.
        private static Vector3d Log(in Quaterniond from, in Quaterniond to)
        {
            Quaterniond between = from.Conjugate * to;
            return RotationVector.Log(between.W < 0.0 ? -1.0 * between : between);
        }
    }
}

namespace Guidewire.Core
{
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

using System;

namespace Guidewire.Core
{
    /// <summary>Stretch, bending and twist of the wire at each sphere: for pictures and logs only.</summary>
    public static class RodStrain
    {
        /// <summary>Length over rest length, less 1, of the elements at sphere i; the mean of both where there are two.
        /// Dimensionless.</summary>
        public static double Stretch(RodState state, int i)
        {
            return 0.5 * (ElementStretch(state, Math.Max(i - 1, 0))
                + ElementStretch(state, Math.Min(i, state.ElementCount - 1)));
        }

        /// <summary>Curvature at sphere i in 1/unit, not negative; 0 at both ends.</summary>
        public static double Curvature(RodState state, int i)
        {
            Vector3d omega = Darboux(state, i);
            return Math.Sqrt(omega.X * omega.X + omega.Y * omega.Y);
        }

        /// <summary>Twist at sphere i in rad/unit, about the third director; 0 at both ends.</summary>
        public static double Twist(RodState state, int i) => Darboux(state, i).Z;

        private static double ElementStretch(RodState state, int j) =>
            Vector3d.Distance(state.Positions[j], state.Positions[j + 1]) / state.ElementLengths[j] - 1.0;

        private static Vector3d Darboux(RodState state, int i)
        {
            if (i == 0 || i == state.ElementCount)
            {
                return Vector3d.Zero;
            }
            // q and -q are one orientation: the turn meant is the shorter one.
            Quaterniond turn = state.Orientations[i - 1].Conjugate * state.Orientations[i];
            double between = 0.5 * (state.ElementLengths[i - 1] + state.ElementLengths[i]);
            return ((turn.W < 0.0 ? -2.0 : 2.0) / between) * turn.Imaginary;
        }
    }
}

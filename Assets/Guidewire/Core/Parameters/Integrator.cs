namespace Guidewire.Core
{
    /// <summary>How positions are predicted.</summary>
    public enum Integrator
    {
        /// <summary>Thesis eq. 2.7, first step by Euler.</summary>
        Verlet,

        /// <summary>Thesis eqs. 2.5 and 2.6 with the new velocity in the second.</summary>
        Euler,

        /// <summary>Positions and orientations by Verlet's formula.</summary>
        OrientationVerlet,

        /// <summary>Positions by Euler, orientations by Verlet's formula.</summary>
        EulerOrientationVerlet,

        /// <summary>Direct solver, order 1.</summary>
        ImplicitEuler,

        /// <summary>Direct solver, two-step, order 2.</summary>
        Bdf2,

        /// <summary>Direct solver, TR-BDF2: L-stable Runge-Kutta with an explicit first stage and 2 implicit ones,
        /// order 2.</summary>
        Trbdf2,

        /// <summary>Direct solver, ESDIRK3(2)4L[2]SA: explicit first stage and 3 implicit ones, order 3.</summary>
        Esdirk3,

        /// <summary>Direct solver, ESDIRK4(3)6L[2]SA: explicit first stage and 5 implicit ones, order 4.</summary>
        Esdirk4,
    }
}

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

        /// <summary>Direct solver, L-stable Runge-Kutta with 2 stages, order 2.</summary>
        Sdirk2,

        /// <summary>Direct solver, L-stable Runge-Kutta with 3 stages, order 3.</summary>
        Sdirk3,

        /// <summary>Direct solver, L-stable Runge-Kutta with 5 stages, order 4.</summary>
        Sdirk4,
    }
}

using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>The features and keys that each method supports.</summary>
    public static class MethodTable
    {
        // Planes of contact are used again until the wire has moved some distance, and iterations leave a residual.
        private const double CompliantDepth = 0.05;

        /// <summary>The methods in the order of <see cref="Solver"/>.</summary>
        public static IReadOnlyList<MethodTraits> All { get; } = new[]
        {
            new MethodTraits
            {
                Solver = Solver.Pbd,
                MeetsWalls = true,
                DepthInRadii = 1.0,
                TakesSteering = true,
                Integrators = new[]
                {
                    Integrator.Verlet, Integrator.Euler, Integrator.OrientationVerlet,
                    Integrator.EulerOrientationVerlet,
                },
            },
            new MethodTraits
            {
                Solver = Solver.Xpbd,
                TakesMaterial = true,
                MeetsWalls = true,
                DepthInRadii = CompliantDepth,
                SetDefaults = SetMaterialDefaults,
            },
            new MethodTraits
            {
                Solver = Solver.Direct,
                TakesMaterial = true,
                MeetsWalls = true,
                HasBarriers = true,
                TakesSteering = true,
                Slides = true,
                TakesTipMoment = true,
                TakesDarbouxLaw = true,
                TakesSuddenRotation = true,
                Integrators = new[]
                {
                    Integrator.Esdirk3, Integrator.ImplicitEuler, Integrator.Bdf2, Integrator.Trbdf2,
                    Integrator.Esdirk4,
                },
                IntegratorBetweenWalls = Integrator.ImplicitEuler,
                SetDefaults = SetDirectDefaults,
            },
            new MethodTraits
            {
                Solver = Solver.Explicit,
                TakesMaterial = true,
                TakesTipMoment = true,
                TakesDarbouxLaw = true,
                SetDefaults = SetMaterialDefaults,
            },
        };

        /// <summary>Gives a method's row.</summary>
        /// <exception cref="ArgumentException">A method that is not known.</exception>
        public static MethodTraits Of(Solver solver)
        {
            // By index: views ask in each frame, and an enumerator would be garbage.
            for (int k = 0; k < All.Count; k++)
            {
                if (All[k].Solver == solver)
                {
                    return All[k];
                }
            }
            throw new ArgumentException("unknown solver " + solver);
        }

        // A material wire starts where it is; its iterations, where it has any, are one a substep.
        private static void SetMaterialDefaults(SimulationParameters parameters)
        {
            parameters.Drive.Displacement = 0.0;
            parameters.Method.ConstraintSolverSteps = 1;
        }

        private static void SetDirectDefaults(SimulationParameters parameters)
        {
            SetMaterialDefaults(parameters);
            parameters.Method.Integrator = Integrator.Esdirk3;
        }
    }
}

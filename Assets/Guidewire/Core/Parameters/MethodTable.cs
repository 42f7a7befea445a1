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

    /// <summary>The features and keys that a method supports: one row of the <see cref="MethodTable"/>.</summary>
    public sealed class MethodTraits
    {
        /// <summary>Names the method.</summary>
        public Solver Solver { get; internal set; }

        /// <summary>Whether its wire is a material in SI units; else it has pbd stiffness, in mass units, units and
        /// seconds.</summary>
        public bool TakesMaterial { get; internal set; }

        /// <summary>Whether it meets walls.</summary>
        public bool MeetsWalls { get; internal set; }

        /// <summary>Whether walls act by barriers, part of an energy: node 0 then follows its support on a
        /// spring.</summary>
        public bool HasBarriers { get; internal set; }

        /// <summary>Largest penetration depth allowed by its contact, in radii of the wire.</summary>
        public double DepthInRadii { get; internal set; }

        /// <summary>Whether a user may steer it.</summary>
        public bool TakesSteering { get; internal set; }

        /// <summary>Whether its distal end can slide along the clamp's axis.</summary>
        public bool Slides { get; internal set; }

        /// <summary>Whether it carries a couple at the tip.</summary>
        public bool TakesTipMoment { get; internal set; }

        /// <summary>Whether it has joints whose couple is K sin(angle), beside K angle.</summary>
        public bool TakesDarbouxLaw { get; internal set; }

        /// <summary>Whether it winds a clamp up that is turned at once by more than a joint can tell from the shorter
        /// way round.</summary>
        public bool TakesSuddenRotation { get; internal set; }

        /// <summary>Its integrators, the default first; empty where it has one of its own.</summary>
        public IReadOnlyList<Integrator> Integrators { get; internal set; } = Array.Empty<Integrator>();

        /// <summary>The default between walls, where it is another.</summary>
        public Integrator? IntegratorBetweenWalls { get; internal set; }

        /// <summary>Sets the defaults that are not those of the thesis (table 4.1).</summary>
        internal Action<SimulationParameters> SetDefaults { get; set; } = _ => { };
    }
}

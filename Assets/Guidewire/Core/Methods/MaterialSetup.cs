using System;

namespace Guidewire.Core
{
    /// <summary>Builds the step of a run with a material, once, from its parameters.</summary>
    internal static class MaterialSetup
    {
        // A search for a rest shape starts far away and may take more than a stage of a motion.
        private const int EquilibriumFactor = 10;

        /// <summary>Sets the state to the start and returns the step.</summary>
        /// <param name="failure">Why there is no start, or null.</param>
        public static TimeStepper Create(SimulationParameters parameters, RodState state, out string? failure)
        {
            var scene = new MaterialScene(parameters);
            var terms = new RodTerms(scene.Rod, scene.Supports, parameters.Scene);
            var report = new SolverReport();
            failure = null;
            if (parameters.Scene.InitialState == InitialState.Equilibrium)
            {
                failure = RestShape.Find(scene, terms, scene.Shape, Math.Min(parameters.Method.SolverTolerance, 1e-9),
                    EquilibriumFactor * parameters.Method.MaxNewtonIterations, report);
            }
            else if (scene.Supports.Proximal != ProximalEnd.Free)
            {
                scene.Shape.X[0] = scene.Schedule.ProximalPosition;
            }
            if (scene.Supports.Proximal != ProximalEnd.Free)
            {
                state.InverseMasses[0] = 0.0;
            }
            // Both the current and the previous state are the start.
            scene.Write(state, scene.Shape, scene.Velocities, scene.Spins);
            scene.Write(state, scene.Shape, scene.Velocities, scene.Spins);
            return CreateStep(parameters, scene, terms, report);
        }

        private static TimeStepper CreateStep(SimulationParameters parameters, MaterialScene scene, RodTerms terms,
            SolverReport report)
        {
            var drive = new MaterialDrive(parameters, scene.Schedule);
            ContactRecord? record = parameters.Method.StatesReactions ? new ContactRecord(scene.Shape.X.Length) : null;
            switch (parameters.Method.Solver)
            {
                case Solver.Direct:
                    var dynamics = new RodDynamics(terms, scene.Schedule, scene.Shape,
                        Scheme(parameters.Method.Integrator), parameters.Method.SolverTolerance,
                        parameters.Method.MaxNewtonIterations);
                    dynamics.Begin(scene.Velocities, scene.Spins,
                        parameters.Scene.InitialState == InitialState.Equilibrium);
                    return new DirectStep(scene, dynamics, drive, parameters.Method, report, record);
                case Solver.Xpbd:
                    return new CompliantStep(scene, terms, drive, parameters.Method, report);
                case Solver.Explicit:
                    return new ExplicitStep(scene, terms, drive, parameters.Method, report, record);
                default:
                    throw new ArgumentException("unknown solver " + parameters.Method.Solver);
            }
        }

        /// <summary>The scheme of an integrator of the direct solver; null for BDF2.</summary>
        public static RungeKuttaScheme? Scheme(Integrator integrator)
        {
            switch (integrator)
            {
                case Integrator.ImplicitEuler:
                    return RungeKuttaScheme.ImplicitEuler();
                case Integrator.Bdf2:
                    return null;
                case Integrator.Sdirk2:
                    return RungeKuttaScheme.Sdirk2();
                case Integrator.Sdirk3:
                    return RungeKuttaScheme.Sdirk3();
                case Integrator.Sdirk4:
                    return RungeKuttaScheme.Sdirk4();
                default:
                    throw new ArgumentException("the direct solver has no integrator " + integrator);
            }
        }
    }
}

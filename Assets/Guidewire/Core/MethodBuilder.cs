using System;

namespace Guidewire.Core
{
    /// <summary>Builds the wire of a run and its time stepper; here alone the method is chosen.</summary>
    internal static class MethodBuilder
    {
        /// <summary>Gives the wire at its start, and its stepper.</summary>
        /// <exception cref="ArgumentException">A wire that starts outside the vessel, or a value that the method does
        /// not take.</exception>
        public static MethodStart Build(SimulationParameters parameters, Scene scene)
        {
            switch (parameters.Method.Solver)
            {
                case Solver.Pbd:
                    return PbdSetup.Build(parameters, scene);
                case Solver.Xpbd:
                    return MaterialSetup.Build(parameters, scene, MaterialSetup.Compliant);
                case Solver.Direct:
                    return MaterialSetup.Build(parameters, scene, MaterialSetup.Direct);
                case Solver.Explicit:
                    return MaterialSetup.Build(parameters, scene, MaterialSetup.Explicit);
                default:
                    throw new ArgumentException("unknown solver " + parameters.Method.Solver);
            }
        }
    }

    /// <summary>Builds the stepper of a run with a material from its parameters.</summary>
    internal static class MaterialSetup
    {
        /// <summary>What makes the stepper of a scene, its rest shape found.</summary>
        /// <param name="parameters">The run's.</param>
        /// <param name="scene">The rod at its start.</param>
        /// <param name="terms">Its energies and loads.</param>
        /// <param name="report">What the search for the rest shape came to.</param>
        internal delegate TimeStepper CreateStepper(SimulationParameters parameters, MaterialScene scene,
            RodTerms terms, SolverReport report);

        /// <summary>Builds the wire at its start, in its rest shape where that is requested, and its stepper.</summary>
        public static MethodStart Build(SimulationParameters parameters, Scene prescribed, CreateStepper create)
        {
            var state = new RodState(ElementLayout.Lengths(parameters, 1.0, out _), parameters.Pbd.TotalMass,
                parameters.Scene.GuidewireOffset);
            if (parameters.Scene.Catheters.Count > 0 || parameters.Scene.Sheath != null)
            {
                return BuildCoaxial(parameters, state);
            }
            var scene = new MaterialScene(parameters, prescribed);
            WallTerms? walls = Walls(parameters, scene);
            var terms = new RodTerms(scene.Rod, scene.Supports, parameters.Scene, walls, Array.Empty<EnergyTerm>());
            var report = new SolverReport();
            bool isAtRest = parameters.Scene.InitialState == InitialState.Equilibrium;
            string? failure = scene.Joints.FindTurnedAtRest();
            if (isAtRest && failure == null)
            {
                failure = new RestShape(scene, terms, Math.Min(parameters.Method.SolverTolerance, 1e-9),
                    RestShape.IterationFactor * parameters.Method.MaxNewtonIterations, report).Find(scene.Shape);
            }
            else if (scene.Supports.Proximal != ProximalEnd.Free && scene.Walls.Length == 0)
            {
                scene.Shape.X[0] = scene.Schedule.Hub.PositionAt(0.0);
            }
            if (scene.Supports.Proximal != ProximalEnd.Free)
            {
                state.InverseMasses[0] = 0.0;
            }
            // Both the current and the previous state are the start.
            scene.Write(state, scene.Shape, scene.Velocities, scene.Spins);
            scene.Write(state, scene.Shape, scene.Velocities, scene.Spins);
            return new MethodStart(state, create(parameters, scene, terms, report))
            {
                Failure = failure,
                IsAtRest = isAtRest && failure == null,
            };
        }

        private static MethodStart BuildCoaxial(SimulationParameters parameters, RodState state)
        {
            state.InverseMasses[0] = 0.0;
            var instruments = CoaxialInstruments.Create(parameters, new SolverReport(), out string? failure);
            instruments.Write(state);
            instruments.Write(state);
            return new MethodStart(state, instruments)
            {
                Failure = failure,
                IsAtRest = instruments.Chain.IsAtRest,
            };
        }

        private static WallTerms? Walls(SimulationParameters parameters, MaterialScene scene)
        {
            bool hasBarriers = MethodTable.Of(parameters.Method.Solver).HasBarriers;
            if (scene.Walls.Length == 0 && !(hasBarriers && parameters.Contact.TouchesItself(0)))
            {
                return null;
            }
            string? outside = MaterialStart.FindProblem(parameters, scene);
            if (outside != null)
            {
                throw new ArgumentException(outside);
            }
            if (!hasBarriers)
            {
                return null;
            }
            double move = parameters.Drive.LargestMove(parameters.Method.TimeStep, scene.Metres);
            Barrier barrier = BarrierDefaults.Of(scene.Rod, parameters.Contact, scene.Walls, scene.Metres, move);
            WallTerms walls = DirectSetup.WallTermsOf(parameters, scene, barrier,
                new SupportSpring(scene.Rod, HubLimit.Of(parameters.Drive, parameters.Material)));
            string? overlap = walls.Self?.FindOverlap(scene.Shape);
            return overlap == null ? walls : throw new ArgumentException(overlap);
        }

        /// <summary>Implicit steps by the direct solver.</summary>
        public static TimeStepper Direct(SimulationParameters parameters, MaterialScene scene, RodTerms terms,
            SolverReport report)
        {
            var rod = new MonitoredRod(scene, DirectSetup.DynamicsOf(parameters, scene, terms), parameters.Method,
                report, Reactions(parameters, scene, terms));
            return new DirectStep(rod, parameters.Method.TimeStep);
        }

        /// <summary>Gives the iterations over constraints with compliance.</summary>
        public static TimeStepper Compliant(SimulationParameters parameters, MaterialScene scene, RodTerms terms,
            SolverReport report)
        {
            return new CompliantStep(scene, terms, parameters.Method, report,
                parameters.Contact.ContactStiffness);
        }

        /// <summary>Explicit steps.</summary>
        public static TimeStepper Explicit(SimulationParameters parameters, MaterialScene scene, RodTerms terms,
            SolverReport report)
        {
            return new ExplicitStep(scene, terms, parameters.Method, report,
                Reactions(parameters, scene, terms));
        }

        private static ContactRecord? Reactions(SimulationParameters parameters, MaterialScene scene, RodTerms terms)
        {
            return parameters.Method.StatesReactions || scene.Walls.Length > 0 || terms.Contact != null
                ? new ContactRecord(scene.Shape.X.Length) : null;
        }
    }
}

using System;

namespace Guidewire.Core
{
    /// <summary>Builds a run with pbd, once, from its parameters.</summary>
    internal static class PbdSetup
    {
        /// <summary>Gives the wire at its start, sphere 0 displaced, and its stepper.</summary>
        /// <exception cref="ArgumentException">A wire that starts outside the vessel or is too thick.</exception>
        public static MethodStart Build(SimulationParameters parameters, Scene scene)
        {
            string? problem = WireStart.FindProblem(parameters, scene);
            if (problem != null)
            {
                throw new ArgumentException(problem);
            }
            var state = new RodState(parameters.Scene.NumberRodElements, parameters.Scene.GuidewireLength,
                parameters.Pbd.TotalMass, parameters.Scene.GuidewireOffset);
            state.Start(scene.Shape, scene.Velocities, scene.Spins);
            Vector3d asked = state.Positions[0] + scene.Displacement;
            SteeredDrive? hand = scene.Steering == null ? null : new SteeredDrive(scene.Steering);
            IDriveMotion? drive = CreateDrive(parameters, scene, state, hand);
            IPositionPrediction prediction = CreatePrediction(parameters);
            IOrientationPrediction orientationPrediction = CreateOrientationPrediction(parameters);
            IConstraintSolver solver = CreateSolver(parameters, scene, state, out ContactRecord? contacts);
            if (contacts != null && parameters.Drive.Kind == Drive.Hold)
            {
                contacts.AddDrive(Math.Abs(parameters.Drive.Displacement),
                    Vector3d.Distance(state.Positions[0], asked));
            }
            if (hand != null)
            {
                hand.Record = contacts;
            }
            MethodParameters method = parameters.Method;
            var step = new PositionBasedStep(method.TimeStep, prediction, orientationPrediction, drive, solver,
                contacts);
            step.EndBy(new PbdMonitor(method.DeltaThreshold, method.SteadyStateHold, state));
            return new MethodStart(state, step);
        }

        private static IConstraintSolver CreateSolver(SimulationParameters parameters, Scene scene, RodState state,
            out ContactRecord? record)
        {
            MethodParameters method = parameters.Method;
            PbdParameters pbd = parameters.Pbd;
            ContactParameters contact = parameters.Contact;
            record = null;
            int iterations = method.ConstraintSolverSteps;
            var scalar = new ScalarIterations(new StretchConstraint(state, pbd.StretchStiffness),
                new BendTwistConstraint(state, pbd.BendStiffness), method.SweepOrder);
            IIterations fastest = IterationChoice.Fastest(scalar, iterations);
            if (scene.Walls.Length == 0)
            {
                return new GaussSeidelSolver(iterations, scalar, fastest, null);
            }
            int walls = scene.Walls.Length;
            double radius = contact.SphereRadius;
            double clearance = radius + contact.CollisionMargin;
            bool asPublished = contact.ElementContact == ElementContact.Thesis;
            IContactSearch search = asPublished
                ? (IContactSearch)new ThesisContactSearch(scene.Walls, state.ElementCount, radius)
                : new ContactSearch(scene.Walls, state.ElementCount, state.ElementLength, radius, clearance,
                    contact.ElementContact == ElementContact.Barycentric);
            IContactResponse response = asPublished
                ? (IContactResponse)new ThesisContactResponse(state, walls, clearance, contact.CollisionStiffness)
                : new ContactResponse(state, scene.Walls, radius, clearance, contact.CollisionStiffness, iterations);
            var constraints = new GaussSeidelSolver(iterations, scalar, fastest, response);
            record = new ContactRecord(state.SphereCount);
            return new ContactSolver(state, method.TimeStep, constraints, search, response, record);
        }

        private static IPositionPrediction CreatePrediction(SimulationParameters parameters)
        {
            bool euler = parameters.Method.Integrator == Integrator.Euler
                || parameters.Method.Integrator == Integrator.EulerOrientationVerlet;
            return euler
                ? (IPositionPrediction)new EulerPrediction(parameters.Method.Damping, parameters.Scene.Gravity)
                : new VerletPrediction(parameters.Method.Damping, parameters.Scene.Gravity);
        }

        private static IOrientationPrediction CreateOrientationPrediction(SimulationParameters parameters)
        {
            bool verlet = parameters.Method.Integrator == Integrator.OrientationVerlet
                || parameters.Method.Integrator == Integrator.EulerOrientationVerlet;
            return verlet ? (IOrientationPrediction)new OrientationVerletPrediction(parameters.Scene.NumberRodElements)
                : new OrientationEulerPrediction();
        }

        private static IDriveMotion? CreateDrive(SimulationParameters parameters, Scene scene, RodState state,
            SteeredDrive? hand)
        {
            IDriveMotion? drive = null;
            bool isFree = parameters.Drive.Kind == Drive.Force;
            if (isFree)
            {
                state.Forces[0] = scene.Schedule.Loads.ProximalForce;
            }
            else
            {
                state.InverseMasses[0] = 0.0;
            }
            if (scene.Drive != null)
            {
                drive = new ProximalDrive(scene.Drive, parameters.Drive.DisplacementPerStep);
            }
            else if (parameters.Drive.Kind == Drive.Hold)
            {
                Vector3d asked = state.Positions[0] + scene.Displacement;
                state.Place(0, Reachable(scene.Walls, parameters.Contact.SphereRadius, state, asked));
            }
            if (parameters.Scene.ProximalEnd == ProximalEnd.Clamped && !isFree)
            {
                HoldFrame(state, 0);
            }
            if (parameters.Drive.TwistPerStep != 0.0)
            {
                state.OrientationWeights[0] = 0.0;
                drive = new TwistDrive(drive, parameters.Drive.TwistPerStep);
            }
            if (hand != null)
            {
                state.InverseMasses[0] = 0.0;
                state.OrientationWeights[0] = 0.0;
                drive = hand;
            }
            if (parameters.Scene.DistalEnd == DistalEnd.Clamped)
            {
                int last = state.ElementCount - 1;
                state.InverseMasses[last + 1] = 0.0;
                HoldFrame(state, last);
                scene.Schedule.Distal.Begin(state.Orientations[last]);
                drive = new DistalClampDrive(drive, scene.Schedule, parameters.Method.TimeStep);
            }
            return drive;
        }

        // A weight of 0 prevents the iterations from turning a frame; a spin would go on turning it.
        private static void HoldFrame(RodState state, int element)
        {
            state.OrientationWeights[element] = 0.0;
            state.AngularVelocities[element] = Vector3d.Zero;
        }

        // Sphere 0 after its first displacement: as far as the walls let it and its element go.
        private static Vector3d Reachable(ContactShape[] walls, double radius, RodState state, in Vector3d asked)
        {
            Vector3d from = state.Positions[0];
            Vector3d next = state.Positions[1];
            double clearance = SweptSearch.ClearanceFor(radius);
            double part = 1.0;
            foreach (ContactShape wall in walls)
            {
                double own = wall.TimeOfImpact(from, from, asked, asked, clearance, out _);
                double shared = wall.TimeOfImpact(from, next, asked, next, clearance, out _);
                part = Math.Min(part, Math.Min(own, shared));
            }
            return part >= 1.0 ? asked : Vector3d.Lerp(from, asked, part);
        }
    }
}

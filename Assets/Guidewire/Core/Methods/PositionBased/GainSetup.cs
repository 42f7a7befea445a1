using System;

namespace Guidewire.Core
{
    /// <summary>Builds the step of a run with gains, once, from its parameters.</summary>
    internal static class GainSetup
    {
        /// <summary>Sets the state to the start, sphere 0 displaced, and returns the step.</summary>
        /// <exception cref="ArgumentException">A drive that is not known.</exception>
        public static ITimeStep Create(SimulationParameters parameters, RodState state)
        {
            Vector3d origin = state.Positions[0];
            IDriveMotion? drive = CreateDrive(parameters, state);
            bool euler = parameters.Integrator == Integrator.Euler
                || parameters.Integrator == Integrator.EulerOrientationVerlet;
            IPositionPrediction prediction = euler
                ? (IPositionPrediction)new EulerPrediction(parameters.Damping, parameters.Gravity)
                : new VerletPrediction(parameters.Damping, parameters.Gravity);
            bool orientationVerlet = parameters.Integrator == Integrator.OrientationVerlet
                || parameters.Integrator == Integrator.EulerOrientationVerlet;
            IOrientationPrediction orientationPrediction = orientationVerlet
                ? (IOrientationPrediction)new OrientationVerletPrediction(parameters.NumberRodElements)
                : new OrientationEulerPrediction();
            IContactSearch? search = CreateSearch(parameters, state);
            IContactResponse? response = search == null ? null : CreateResponse(parameters, state);
            IConstraintSolver solver = new GaussSeidelSolver(state, parameters.ConstraintSolverSteps,
                parameters.StretchStiffness, parameters.BendStiffness, parameters.SweepOrder, response);
            ContactRecord? record = null;
            if (search != null)
            {
                record = new ContactRecord(state.SphereCount);
                solver = new ContactSolver(state, parameters.TimeStep, solver, search, response!, record);
                if (parameters.Drive == Drive.Hold)
                {
                    Vector3d asked = origin + parameters.Displacement * Direction(parameters);
                    record.DriveAsked = Math.Abs(parameters.Displacement);
                    record.DriveShortfall = Vector3d.Distance(state.Positions[0], asked);
                }
            }
            return new PositionBasedStep(
                parameters.TimeStep, prediction, orientationPrediction, drive, solver, record);
        }

        private static IContactSearch? CreateSearch(SimulationParameters parameters, RodState state)
        {
            if (parameters.Walls.Length == 0)
            {
                return null;
            }
            double radius = parameters.SphereRadius;
            return parameters.ElementContact == ElementContact.Seed
                ? (IContactSearch)new SeedContactSearch(parameters.Walls, state.ElementCount, radius)
                : new ContactSearch(parameters.Walls, state.ElementCount, state.ElementLength, radius,
                    radius + parameters.CollisionMargin, parameters.ElementContact == ElementContact.Barycentric);
        }

        private static IContactResponse CreateResponse(SimulationParameters parameters, RodState state)
        {
            int walls = parameters.Walls.Length;
            double radius = parameters.SphereRadius;
            double reach = radius + parameters.CollisionMargin;
            double gain = parameters.CollisionStiffness;
            return parameters.ElementContact == ElementContact.Seed
                ? (IContactResponse)new SeedContactResponse(state, walls, radius, reach, gain)
                : new ContactResponse(state, walls, radius, reach, gain);
        }

        private static IDriveMotion? CreateDrive(SimulationParameters parameters, RodState state)
        {
            IDriveMotion? drive = null;
            switch (parameters.Drive)
            {
                case Drive.Hold:
                    state.InverseMasses[0] = 0.0;
                    Vector3d asked = state.Positions[0] + parameters.Displacement * Direction(parameters);
                    state.Place(0, WireStart.Displaced(parameters, state, asked));
                    break;
                case Drive.Displace:
                    state.InverseMasses[0] = 0.0;
                    drive = new FixedAxisDrive(Direction(parameters), parameters.DisplacementPerStep);
                    break;
                case Drive.Push:
                    state.InverseMasses[0] = 0.0;
                    drive = new PushDrive(parameters.DisplacementPerStep);
                    break;
                case Drive.Force:
                    state.Forces[0] = parameters.ExternalForce;
                    break;
                default:
                    throw new ArgumentException("unknown drive " + parameters.Drive);
            }
            if (parameters.Material.ProximalEnd == ProximalEnd.Clamped && parameters.Drive != Drive.Force)
            {
                HoldFrame(state, 0);
            }
            if (parameters.TwistPerStep != 0.0)
            {
                state.OrientationWeights[0] = 0.0;
                drive = new TwistDrive(drive, parameters.TwistPerStep);
            }
            if (parameters.Steering != null)
            {
                state.InverseMasses[0] = 0.0;
                state.OrientationWeights[0] = 0.0;
                drive = new SteeredDrive(parameters.Steering);
            }
            if (parameters.Material.DistalEnd == DistalEnd.Clamped)
            {
                state.InverseMasses[state.ElementCount] = 0.0;
                HoldFrame(state, state.ElementCount - 1);
                drive = new DistalClampDrive(drive, state, parameters);
            }
            return drive;
        }

        // A weight of 0 keeps the sweeps from turning a frame; a spin would go on turning it.
        private static void HoldFrame(RodState state, int element)
        {
            state.OrientationWeights[element] = 0.0;
            state.AngularVelocities[element] = Vector3d.Zero;
        }

        private static Vector3d Direction(SimulationParameters parameters)
        {
            return Vector3d.Normalize(parameters.DisplacementDirection);
        }
    }
}

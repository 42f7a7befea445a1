using System;

namespace Guidewire.Core
{
    /// <summary>Builds the step of a run with gains, once, from its parameters.</summary>
    internal static class GainSetup
    {
        /// <summary>Sets the state to the start, sphere 0 displaced, and returns the step.</summary>
        /// <exception cref="ArgumentException">A drive that is not known.</exception>
        public static TimeStepper Create(SimulationParameters parameters, RodState state)
        {
            Vector3d origin = state.Positions[0];
            IDriveMotion? drive = CreateDrive(parameters, state);
            bool euler = parameters.Method.Integrator == Integrator.Euler
                || parameters.Method.Integrator == Integrator.EulerOrientationVerlet;
            IPositionPrediction prediction = euler
                ? (IPositionPrediction)new EulerPrediction(parameters.Method.Damping, parameters.Scene.Gravity)
                : new VerletPrediction(parameters.Method.Damping, parameters.Scene.Gravity);
            bool orientationVerlet = parameters.Method.Integrator == Integrator.OrientationVerlet
                || parameters.Method.Integrator == Integrator.EulerOrientationVerlet;
            IOrientationPrediction orientationPrediction = orientationVerlet
                ? (IOrientationPrediction)new OrientationVerletPrediction(parameters.Scene.NumberRodElements)
                : new OrientationEulerPrediction();
            IContactRule? rule = parameters.Scene.Walls.Length == 0 ? null
                : parameters.Contact.ElementContact == ElementContact.Seed ? new SeedContactRule(state, parameters)
                : (IContactRule)new ContactRule(state, parameters);
            var solver = new GaussSeidelSolver(state, parameters.Method.ConstraintSolverSteps,
                parameters.Gains.StretchStiffness, parameters.Gains.BendStiffness, parameters.Method.SweepOrder, rule);
            if (rule == null)
            {
                return new PositionBasedStep(parameters.Method.TimeStep, prediction, orientationPrediction, drive,
                    solver);
            }
            var step = new ContactStep(state, parameters, prediction, orientationPrediction, drive, solver, rule);
            if (parameters.Drive.Kind == Drive.Hold)
            {
                Vector3d asked = origin + parameters.Drive.Displacement * Direction(parameters);
                step.Contacts.DriveAsked = Math.Abs(parameters.Drive.Displacement);
                step.Contacts.DriveShortfall = Vector3d.Distance(state.Positions[0], asked);
            }
            return step;
        }

        private static IDriveMotion? CreateDrive(SimulationParameters parameters, RodState state)
        {
            IDriveMotion? drive = null;
            switch (parameters.Drive.Kind)
            {
                case Drive.Hold:
                    state.InverseMasses[0] = 0.0;
                    Vector3d asked = state.Positions[0] + parameters.Drive.Displacement * Direction(parameters);
                    state.Place(0, WireStart.Displaced(parameters, state, asked));
                    break;
                case Drive.Displace:
                    state.InverseMasses[0] = 0.0;
                    drive = new FixedAxisDrive(Direction(parameters), parameters.Drive.DisplacementPerStep);
                    break;
                case Drive.Push:
                    state.InverseMasses[0] = 0.0;
                    drive = new PushDrive(parameters.Drive.DisplacementPerStep);
                    break;
                case Drive.Force:
                    state.Forces[0] = parameters.Drive.ExternalForce;
                    break;
                default:
                    throw new ArgumentException("unknown drive " + parameters.Drive.Kind);
            }
            if (parameters.Scene.ProximalEnd == ProximalEnd.Clamped && parameters.Drive.Kind != Drive.Force)
            {
                HoldFrame(state, 0);
            }
            if (parameters.Drive.TwistPerStep != 0.0)
            {
                state.OrientationWeights[0] = 0.0;
                drive = new TwistDrive(drive, parameters.Drive.TwistPerStep);
            }
            if (parameters.Drive.Steering != null)
            {
                state.InverseMasses[0] = 0.0;
                state.OrientationWeights[0] = 0.0;
                drive = new SteeredDrive(parameters.Drive.Steering);
            }
            if (parameters.Scene.DistalEnd == DistalEnd.Clamped)
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
            return Vector3d.Normalize(parameters.Drive.DisplacementDirection);
        }
    }
}

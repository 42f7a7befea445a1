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
            IContactRule? rule = parameters.Walls.Length == 0 ? null
                : parameters.ElementContact == ElementContact.Seed ? new SeedContactRule(state, parameters)
                : (IContactRule)new ContactRule(state, parameters);
            var scalar = new ScalarSweeps(new StretchConstraint(state, parameters.StretchStiffness),
                new BendTwistConstraint(state, parameters.BendStiffness), parameters.SweepOrder);
            int iterations = parameters.ConstraintSolverSteps;
            ISweeps fastest = SweepChoice.Fastest(scalar, iterations);
            var solver = new GaussSeidelSolver(iterations, scalar, fastest, rule);
            if (rule == null)
            {
                return new PositionBasedStep(parameters.TimeStep, prediction, orientationPrediction, drive, solver);
            }
            var step = new ContactStep(state, parameters, prediction, orientationPrediction, drive, solver, rule);
            if (parameters.Drive == Drive.Hold)
            {
                Vector3d asked = origin + parameters.Displacement * Direction(parameters);
                step.Record.DriveAsked = Math.Abs(parameters.Displacement);
                step.Record.DriveShortfall = Vector3d.Distance(state.Positions[0], asked);
            }
            return step;
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

using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>One step of position-and-orientation-based dynamics (thesis 2.1.3): prediction, the drive's motion,
    /// constraint solver, velocity update.</summary>
    internal sealed class PositionBasedStep : TimeStepper
    {
        private const int StepsThatAreStuck = 10;
        private readonly double _timeStep;
        private readonly IPositionPrediction _prediction;
        private readonly IOrientationPrediction _orientationPrediction;
        private readonly IDriveMotion? _drive;
        private readonly IConstraintSolver _solver;
        private PbdMonitor? _monitor;

        /// <param name="timeStep">dt in s.</param>
        /// <param name="prediction">How positions are predicted.</param>
        /// <param name="orientationPrediction">How orientations are predicted.</param>
        /// <param name="drive">What moves sphere 0 each step, or null where nothing does.</param>
        /// <param name="solver">What corrects the prediction.</param>
        /// <param name="contacts">What the solver notes of its contacts, or null in a scene without walls.</param>
        public PositionBasedStep(double timeStep, IPositionPrediction prediction,
            IOrientationPrediction orientationPrediction, IDriveMotion? drive, IConstraintSolver solver,
            ContactRecord? contacts)
        {
            _timeStep = timeStep;
            _prediction = prediction;
            _orientationPrediction = orientationPrediction;
            _drive = drive;
            _solver = solver;
            Contacts = contacts;
        }

        /// <inheritdoc/>
        public override ContactRecord? Contacts { get; }

        /// <inheritdoc/>
        public override void AddWarnings(List<RunWarning> warnings)
        {
            if (Contacts != null && Contacts.StuckSteps >= StepsThatAreStuck)
            {
                warnings.Add(WarningTable.DriveStuck.With(Contacts.StuckSteps));
            }
            if (_monitor?.LostTurn is RunWarning lost)
            {
                warnings.Add(lost);
            }
        }

        /// <summary>Sets what ends the run before its last step; without it nothing does.</summary>
        public void EndBy(PbdMonitor monitor)
        {
            _monitor = monitor;
            SteadySteps = monitor.Hold;
        }

        /// <inheritdoc/>
        public override void Advance(RodState state)
        {
            _prediction.Predict(state, _timeStep);
            _orientationPrediction.Predict(state, _timeStep);
            _drive?.Move(state);
            Vector3d predictedTip = state.PredictedPositions[state.ElementCount];
            _solver.Solve(state);
            PredictionError = Vector3d.Distance(predictedTip, state.PredictedPositions[state.ElementCount]);
            VelocityUpdate.Apply(state, _timeStep);
            if (_monitor != null)
            {
                _monitor.Update(state, PredictionError);
                Divergence = _monitor.Loss;
                SteadyState = _monitor.SteadyState;
            }
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            PredictionError = snapshot.Serialize(PredictionError);
            _monitor?.Serialize(snapshot);
            snapshot.OptionalSection("distal clamp", _drive is DistalClampDrive clamp ? clamp.Serialize : null);
            _solver.Serialize(snapshot);
            _prediction.Serialize(snapshot, _timeStep);
            _orientationPrediction.Serialize(snapshot, _timeStep);
        }
    }

    /// <summary>Corrects a predicted state towards its constraints.</summary>
    internal interface IConstraintSolver
    {
        /// <summary>Corrects <see cref="RodState.PredictedPositions"/> and
        /// <see cref="RodState.PredictedOrientations"/> in place.</summary>
        void Solve(RodState state);

        /// <summary>Writes into a snapshot, or restores from one, its state between steps.</summary>
        void Serialize(Snapshot snapshot);
    }

    /// <summary>Position-and-orientation-based dynamics (thesis 2.1.2): m iterations, each all stretch constraints,
    /// then all bend-twist constraints, then all contacts. The answer depends on m, because pbd stiffness acts per
    /// iteration.</summary>
    internal sealed class GaussSeidelSolver : IConstraintSolver
    {
        private readonly int _iterations;
        private readonly ScalarIterations _scalar;
        private readonly IIterations _fastest;
        private readonly IContactResponse? _contacts;

        /// <param name="iterations">m, 0 or more.</param>
        /// <param name="scalar">What does them where the others cannot take the contacts.</param>
        /// <param name="fastest">Performs the iterations, bit for bit the same.</param>
        /// <param name="contacts">Contacts, or null in a scene without walls.</param>
        public GaussSeidelSolver(int iterations, ScalarIterations scalar, IIterations fastest,
            IContactResponse? contacts)
        {
            _iterations = iterations;
            _scalar = scalar;
            _fastest = fastest;
            _contacts = contacts;
        }

        /// <inheritdoc/>
        public void Solve(RodState state)
        {
            if (!_fastest.Iterate(state.PredictedPositions, state.PredictedOrientations, _iterations, _contacts))
            {
                _scalar.Iterate(state.PredictedPositions, state.PredictedOrientations, _iterations, _contacts);
            }
        }

        /// <inheritdoc/>
        public void Serialize(Snapshot snapshot) => snapshot.OptionalSection(ContactSolver.SectionKey, null);
    }

    /// <summary>v = (p - x)/dt (thesis eq. 2.4) and omega = (2/dt) Im(q_k* q_{k+1}); the corrected state becomes the
    /// current one.</summary>
    internal static class VelocityUpdate
    {
        /// <summary>Closes a step: velocities follow from the corrected positions.</summary>
        /// <param name="state">The wire; its predicted state has been corrected.</param>
        /// <param name="timeStep">dt in s.</param>
        public static void Apply(RodState state, double timeStep)
        {
            double rate = 1.0 / timeStep;
            for (int i = 0; i < state.SphereCount; i++)
            {
                state.Velocities[i] = rate * (state.PredictedPositions[i] - state.Positions[i]);
            }
            for (int j = 0; j < state.ElementCount; j++)
            {
                Quaterniond turn = state.Orientations[j].Conjugate * state.PredictedOrientations[j];
                state.AngularVelocities[j] = (2.0 * rate) * turn.Imaginary;
            }
            state.Advance();
        }
    }
}

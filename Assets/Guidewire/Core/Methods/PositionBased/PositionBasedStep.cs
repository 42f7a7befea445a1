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
}

using System;

namespace Guidewire.Core
{
    /// <summary>One step of the direct solver: the drive's motion, then all stages of the scheme, each an exact
    /// minimisation over the whole rod.</summary>
    internal sealed class DirectStep : ITimeStep, IReportingStep, IContactStep
    {
        private readonly MaterialScene _scene;
        private readonly RodStatics _statics;
        private readonly RodDynamics _dynamics;
        private readonly MaterialDrive _drive;
        private readonly double _timeStep;
        private readonly double _kept;  // share of its velocity that the wire keeps a step

        /// <summary>A step for this scene.</summary>
        /// <param name="dynamics">The motion, at its start.</param>
        /// <param name="timeStep">dt, s.</param>
        /// <param name="damping">Share of its velocity that the wire loses a step.</param>
        /// <param name="record">Takes the support's force after each step, or null.</param>
        public DirectStep(MaterialScene scene, RodStatics statics, RodDynamics dynamics, MaterialDrive drive,
            double timeStep, double damping, SolverReport report, ContactRecord? record)
        {
            _scene = scene;
            _statics = statics;
            _dynamics = dynamics;
            _drive = drive;
            _timeStep = timeStep;
            _kept = 1.0 - damping;
            Report = report;
            Record = record;
            dynamics.TracksReactions = record != null;
        }

        /// <inheritdoc/>
        public double PredictionError { get; private set; }

        /// <inheritdoc/>
        public string? Failure { get; private set; }

        /// <inheritdoc/>
        public SolverReport Report { get; }

        /// <inheritdoc/>
        public ContactRecord? Record { get; }

        /// <inheritdoc/>
        public void Advance(RodState state)
        {
            int last = state.ElementCount;
            _drive.Prepare(_dynamics.Shape, _dynamics.Time);
            if (_kept != 1.0)
            {
                Damp();
            }
            Vector3d free = _dynamics.Shape.X[last] + _timeStep * _dynamics.Velocities[last]
                + (_timeStep * _timeStep) * _scene.Schedule.Gravity;
            string? failure = _dynamics.Step(_timeStep);
            if (failure != null)
            {
                Failure = "the step to t = " + _dynamics.Time.ToString("G6",
                    System.Globalization.CultureInfo.InvariantCulture) + " s has no solution: " + failure;
                return;
            }
            PredictionError = Vector3d.Distance(free, _dynamics.Shape.X[last]) / _scene.Metres;
            if (Record != null)
            {
                Record.Reaction = _dynamics.MeanReaction;
            }
            _scene.Write(state, _dynamics.Shape, _dynamics.Velocities, _dynamics.Spins);
        }

        /// <inheritdoc/>
        public void CompleteReport()
        {
            Report.Factorisations += _dynamics.Solver.Factorisations;
            Report.KeptSolutions = _dynamics.Solver.KeptSolutions;
            Report.Searches = _dynamics.Solver.Searches;
            Report.Energy = _dynamics.Energy;
            RodShape shape = _dynamics.Shape;
            Report.ProximalForce = _dynamics.ReactionAt(0);
            Report.DistalForce = _scene.Supports.HasDistalJoint ? _dynamics.ReactionAt(shape.ElementCount)
                : Vector3d.Zero;
            Report.ProximalMoment = _statics.Bending.ProximalCouple(shape);
            Report.DistalMoment = _statics.Bending.DistalCouple(shape);
        }

        private void Damp()
        {
            for (int i = 0; i < _dynamics.Velocities.Length; i++)
            {
                _dynamics.Velocities[i] = _kept * _dynamics.Velocities[i];
            }
            for (int j = 0; j < _dynamics.Spins.Length; j++)
            {
                _dynamics.Spins[j] = _kept * _dynamics.Spins[j];
            }
        }
    }
}

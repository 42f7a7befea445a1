using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>One step of the direct solver: the hubs' motion, then all stages of the scheme, each an exact
    /// minimisation over the whole rod. One without a solution leaves everything, hubs and instruments, as it was
    /// before.</summary>
    internal sealed class DirectStep : TimeStepper
    {
        private readonly InstrumentSet _instruments;
        private readonly double _timeStep;      // s
        private readonly StepStart _start;
        private readonly SlippingHubs _hubs;

        /// <summary>A step of these instruments.</summary>
        /// <param name="timeStep">s.</param>
        public DirectStep(InstrumentSet instruments, double timeStep)
        {
            _instruments = instruments;
            _timeStep = timeStep;
            _start = new StepStart(SerializeStep, Dynamics.Terms.Rod);
            _hubs = new SlippingHubs(instruments, _start);
        }

        /// <summary>What it moves.</summary>
        public InstrumentSet Instruments => _instruments;

        /// <summary>The motion of what is simulated at present.</summary>
        public RodDynamics Dynamics => _instruments.Rod.Dynamics;

        /// <inheritdoc/>
        public override ContactRecord? Contacts => _instruments.Contacts;

        /// <inheritdoc/>
        public override void Advance(RodState state)
        {
            if (Step())
            {
                _instruments.Take();
                _instruments.Write(state);
            }
            else
            {
                _start.Restore();
            }
        }

        /// <summary>The step itself, in the parts between which nodes come and go; again while a hub slips.</summary>
        /// <returns>False where it has no solution or has lost an instrument.</returns>
        public bool Step()
        {
            _start.Save();
            _instruments.Work.BeginStep();
            _hubs.BeginStep();
            MonitoredRod rod = _instruments.Rod;
            MaterialDrive hub = _instruments.Drives[0];
            bool isDone;
            do
            {
                (double insertion, double turn) = (hub.Insertion, hub.Turn);
                _instruments.BeginStep();
                double start = Dynamics.Time;
                isDone = true;
                for (double done = 0.0; isDone && done < _timeStep;)
                {
                    double left = _timeStep - done;
                    double length = _instruments.BeginPart(left);
                    rod.BeginStep(length);
                    string? failure = Dynamics.Step(length);
                    isDone = rod.EndStep(failure, length, insertion, turn);
                    done = length == left ? _timeStep : Dynamics.Time - start;
                }
            }
            while (_hubs.NeedAnother(isDone));
            (Failure, Divergence) = (rod.Failure, rod.Divergence);
            (SteadyState, PredictionError) = (rod.SteadyState, rod.PredictionError);
            return isDone;
        }

        /// <inheritdoc/>
        public override void AddWarnings(List<RunWarning> warnings)
        {
            _instruments.AddWarnings(warnings);
        }

        /// <inheritdoc/>
        public override HubRecord? Hub()
        {
            return _instruments.Hub();
        }

        /// <inheritdoc/>
        public override StressRecord? Stress()
        {
            return _instruments.Stress();
        }

        /// <inheritdoc/>
        public override CoaxialRecord? Coaxial()
        {
            return _instruments.Coaxial();
        }

        /// <inheritdoc/>
        public override SolverReport? Report()
        {
            return _instruments.Rod.Report();
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            _instruments.Serialize(snapshot);
        }

        /// <summary>Writes or restores all that <see cref="Step"/> may touch, for a <see cref="StepStart"/>.
        /// </summary>
        public void SerializeStep(Snapshot snapshot)
        {
            _instruments.SerializeStep(snapshot);
        }
    }
}

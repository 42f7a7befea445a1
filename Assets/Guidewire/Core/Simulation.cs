using System;

namespace Guidewire.Core
{
    /// <summary>One run: a wire, the method that steps it and the rule that ends it. It knows no file and no clock; the
    /// same parameters give the same bits on the same runtime.</summary>
    public sealed class Simulation
    {
        private readonly ITimeStep _step;
        private readonly StopRule _stopRule;
        private readonly double _timeStep;
        private int _firstStep;
        private double _firstTime;    // s
        private string? _ownReason;
        private string? _doubt;

        private Simulation(RodState state, ITimeStep step, StopRule stopRule, double timeStep)
        {
            State = state;
            _step = step;
            _stopRule = stopRule;
            _timeStep = timeStep;
        }

        /// <summary>The wire as it is now.</summary>
        public RodState State { get; }

        /// <summary>Steps done.</summary>
        public int StepCount { get; private set; }

        /// <summary>In-game time in s, k dt after k steps.</summary>
        public double Time => _firstTime + (StepCount - _firstStep) * _timeStep;

        /// <summary>Delta_p of the last step in units; 0 before the first.</summary>
        public double PredictionError => _step.PredictionError;

        /// <summary>How the run ended, or Running.</summary>
        public Outcome Outcome { get; private set; }

        /// <summary>One line that says why the run ended, and what is wrong with it; empty while it runs.</summary>
        public string Reason => (_ownReason ?? _stopRule.Reason) + (_doubt == null ? "" : ", but " + _doubt);

        /// <summary>First step of the steady state, or -1.</summary>
        public int SteadyStateStep => _stopRule.SteadyStateStep;

        /// <summary>What contact with walls came to; null in a scene without walls.</summary>
        public ContactRecord? Contacts { get; private set; }

        /// <summary>Builds the wire and chooses every part of the method, once.</summary>
        /// <exception cref="ArgumentException">A value out of the range that the rod allows, or a wire that starts
        /// outside the vessel.</exception>
        public static Simulation Create(SimulationParameters parameters)
        {
            if (parameters.DisplacementDirection.Length == 0.0)
            {
                throw new ArgumentException("the displacement has no direction");
            }
            string? complaint = WireStart.Complaint(parameters);
            if (complaint != null)
            {
                throw new ArgumentException(complaint);
            }
            RodState state = StartOf(parameters);
            if (parameters.Steering != null && parameters.Solver != Solver.Pbd)
            {
                throw new ArgumentException("solver: a hand steers wires with gains only, solver pbd");
            }
            string? failure = null;
            ITimeStep step = parameters.Solver == Solver.Pbd ? GainSetup.Create(parameters, state)
                : MaterialSetup.Create(parameters, state, out failure);
            var stopRule = new StopRule(parameters.DeltaThreshold, parameters.SteadyStateHold,
                parameters.MaxSimulationSteps, state);
            var simulation = new Simulation(state, step, stopRule, parameters.TimeStep)
            {
                Contacts = (step as ContactStep)?.Record,
            };
            if (failure != null)
            {
                simulation.End(Outcome.Failed, failure);
            }
            else if (parameters.Solver != Solver.Pbd && parameters.MaxSimulationSteps == 0
                && parameters.Material.InitialState == InitialState.Equilibrium)
            {
                simulation.End(Outcome.Converged, "the wire is at rest");
            }
            return simulation;
        }

        /// <summary>The wire as the parameters start it, before any displacement.</summary>
        internal static RodState StartOf(SimulationParameters parameters)
        {
            var state = new RodState(parameters.NumberRodElements, parameters.GuidewireLength, parameters.TotalMass,
                parameters.GuidewireOffset);
            if (parameters.Start != null)
            {
                state.Load(parameters.Start);
            }
            return state;
        }

        /// <summary>What the solver says of itself, for a run with a material; null with gains.</summary>
        public SolverReport? CompleteReport()
        {
            var reporting = _step as IReportingStep;
            reporting?.CompleteReport();
            return reporting?.Report;
        }

        /// <summary>One step. Does nothing once the run has ended.</summary>
        public void Step()
        {
            if (Outcome != Outcome.Running)
            {
                return;
            }
            _step.Advance(State);
            StepCount++;
            if (_step.Failure != null)
            {
                End(Outcome.Failed, _step.Failure);
                return;
            }
            string? divergence = (_step as IWatchedStep)?.Divergence;
            if (divergence != null)
            {
                End(Outcome.Diverged, divergence);
                return;
            }
            Outcome = _stopRule.Judge(State, StepCount, PredictionError);
            if (Outcome == Outcome.Finished || Outcome == Outcome.Converged)
            {
                _doubt = (_step as IWatchedStep)?.Doubt;
            }
        }

        /// <summary>A run that goes on from this one's state with other parameters: steps and time go on counting, the
        /// displacement of the start is not made again.</summary>
        /// <param name="parameters">The other parameters, for a wire of as many elements. Their
        /// <see cref="SimulationParameters.Start"/>, <see cref="SimulationParameters.Displacement"/> and, with gains,
        /// the motion of the distal clamp are overwritten.</param>
        /// <exception cref="ArgumentException">As <see cref="Create"/>, and another number of elements.</exception>
        public Simulation Continue(SimulationParameters parameters)
        {
            parameters.Start = new RodStart(State.Positions, State.Orientations, State.Velocities,
                State.AngularVelocities);
            parameters.Displacement = 0.0;
            if (parameters.Solver == Solver.Pbd)
            {
                // A clamp of a wire with gains moves on from where it is; the rest of its way is what it has left.
                MaterialParameters ends = parameters.Material;
                double left = ends.DistalRampTime > Time ? 1.0 - Time / ends.DistalRampTime : 0.0;
                ends.DistalRotation *= left;
                ends.DistalDisplacement *= left;
                ends.DistalRampTime *= left;
            }
            Simulation next = Create(parameters);
            next.StepCount = StepCount;
            next._firstStep = StepCount;
            next._firstTime = Time;
            return next;
        }

        /// <summary>Ends the run where it is.</summary>
        /// <param name="outcome">Any but Running.</param>
        /// <param name="reason">One line.</param>
        public void End(Outcome outcome, string reason)
        {
            _doubt = outcome == Outcome.Interrupted ? (_step as IWatchedStep)?.Doubt : null;
            Outcome = outcome;
            _ownReason = reason;
        }
    }
}

using System;

namespace Guidewire.Core
{
    /// <summary>One run: a wire, the method that steps it and the rule that ends it. It knows no file and no clock; the
    /// same parameters give the same bits on the same runtime.</summary>
    public sealed class Simulation
    {
        private readonly TimeStepper _step;
        private readonly StopRule _stopRule;
        private readonly double _timeStep;
        private int _firstStep;
        private double _firstTime;    // s
        private string? _ownReason;
        private string? _warning;

        private Simulation(RodState state, TimeStepper step, StopRule stopRule, double timeStep)
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
        public string Reason => (_ownReason ?? _stopRule.Reason) + (_warning == null ? "" : ", but " + _warning);

        /// <summary>First step of the steady state, or -1.</summary>
        public int SteadyStateStep => _stopRule.SteadyStateStep;

        /// <summary>What contact with walls came to, and the force at the first sphere; null in a scene without walls
        /// whose parameters do not ask for reactions.</summary>
        public ContactRecord? Contacts { get; private set; }

        /// <summary>Builds the wire and chooses every part of the method, once.</summary>
        /// <exception cref="ArgumentException">A value out of the range that the rod allows, or a wire that starts
        /// outside the vessel.</exception>
        public static Simulation Create(SimulationParameters parameters)
        {
            if (parameters.Drive.DisplacementDirection.Length == 0.0)
            {
                throw new ArgumentException("the displacement has no direction");
            }
            string? complaint = WireStart.FindProblem(parameters);
            if (complaint != null)
            {
                throw new ArgumentException(complaint);
            }
            RodState state = StartOf(parameters);
            if (parameters.Drive.Steering != null && parameters.Method.Solver != Solver.Pbd)
            {
                throw new ArgumentException("solver: a hand steers wires with gains only, solver pbd");
            }
            string? failure = null;
            TimeStepper step = parameters.Method.Solver == Solver.Pbd ? GainSetup.Create(parameters, state)
                : MaterialSetup.Create(parameters, state, out failure);
            var stopRule = new StopRule(parameters.Method.DeltaThreshold, parameters.Method.SteadyStateHold,
                parameters.Method.MaxSimulationSteps, state);
            var simulation = new Simulation(state, step, stopRule, parameters.Method.TimeStep)
            {
                Contacts = step.Contacts,
            };
            if (failure != null)
            {
                simulation.End(Outcome.Failed, failure);
            }
            else if (parameters.Method.Solver != Solver.Pbd && parameters.Method.MaxSimulationSteps == 0
                && parameters.Scene.InitialState == InitialState.Equilibrium)
            {
                simulation.End(Outcome.Converged, "the wire is at rest");
            }
            return simulation;
        }

        /// <summary>The wire as the parameters start it, before any displacement.</summary>
        internal static RodState StartOf(SimulationParameters parameters)
        {
            var state = new RodState(parameters.Scene.NumberRodElements, parameters.Scene.GuidewireLength,
                parameters.Gains.TotalMass, parameters.Scene.GuidewireOffset);
            if (parameters.Scene.Start != null)
            {
                state.Load(parameters.Scene.Start);
            }
            return state;
        }

        /// <summary>What the solver says of itself, for a run with a material; null with gains.</summary>
        public SolverReport? CompleteReport()
        {
            return _step.Report();
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
            if (_step.Divergence != null)
            {
                End(Outcome.Diverged, _step.Divergence);
                return;
            }
            Outcome = _stopRule.Check(State, StepCount, PredictionError);
            if (Outcome == Outcome.Finished || Outcome == Outcome.Converged)
            {
                _warning = _step.AccuracyWarning;
            }
        }

        /// <summary>A run that goes on from this one's state with other parameters: steps and time go on counting, the
        /// displacement of the start is not made again.</summary>
        /// <param name="parameters">The other parameters, for a wire of as many elements. Their
        /// <see cref="SimulationParameters.Start"/> and <see cref="SimulationParameters.Displacement"/> are not looked
        /// at; with gains, a distal clamp only makes what is left of its motion.</param>
        /// <exception cref="ArgumentException">As <see cref="Create"/>, and another number of elements.</exception>
        public Simulation Continue(SimulationParameters parameters)
        {
            SimulationParameters continued = parameters.Copy();
            continued.Scene.Start = new RodStart(State.Positions, State.Orientations, State.Velocities,
                State.AngularVelocities);
            continued.Drive.Displacement = 0.0;
            if (continued.Method.Solver == Solver.Pbd)
            {
                double left = continued.Scene.DistalRampTime > Time ? 1.0 - Time / continued.Scene.DistalRampTime : 0.0;
                continued.Scene.DistalRotation *= left;
                continued.Scene.DistalDisplacement *= left;
                continued.Scene.DistalRampTime *= left;
            }
            Simulation next = Create(continued);
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
            _warning = outcome == Outcome.Interrupted ? _step.AccuracyWarning : null;
            Outcome = outcome;
            _ownReason = reason;
        }
    }
}

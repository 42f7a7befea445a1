using System;
using System.Collections.Generic;
using System.Linq;

namespace Guidewire.Core
{
    /// <summary>One run: a wire, the method that steps it and the rule that ends it. It uses no files and no clock; the
    /// same parameters give the same bits on the same runtime.</summary>
    public sealed class Simulation
    {
        private const double Leap = 1e-6;    // of the wire's length: what rounding makes of a wall that goes on

        private const double Same = 1e-9;    // of an element's length

        private readonly bool _hasMaterial;
        private readonly Vector3d? _givenExit;    // of the sheath
        private readonly CoaxialRecord[] _catheters;
        private readonly double[][] _lengths;    // of the elements of the wire and of each catheter, units
        private readonly string _moving;         // walls
        private readonly WallBeam? _beam;
        private readonly TimeStepper _stepper;
        private readonly StopRule _stopRule;
        private readonly StepClock _clock;
        private readonly RunWarnings _warnings;
        private readonly RodStart _start;    // a state in which the wire may be built, which not every later one is
        private bool _isWritten = true;
        private string? _ownReason;
        private readonly List<RunWarning> _accuracy = new List<RunWarning>();    // of the method, at the run's end

        private Simulation(MethodStart start, SimulationParameters parameters, in Quaterniond proximalFrame,
            in Quaterniond distalFrame)
        {
            _hasMaterial = MethodTable.Of(parameters.Method.Solver).TakesMaterial;
            _givenExit = parameters.Scene.Sheath?.Exit;
            _catheters = new CoaxialRecord[parameters.Scene.Catheters.Count];
            _lengths = LengthsOf(parameters);
            _moving = WallFields.KeyOf(parameters.Scene.Walls);
            _beam = BeamOf(parameters);
            State = start.State;
            _stepper = start.Stepper;
            _warnings = new RunWarnings(parameters, _stepper);
            _stopRule = new StopRule(
                parameters.Drive.Steering == null ? parameters.Method.MaxSimulationSteps : int.MaxValue);
            _clock = new StepClock(parameters.Method.TimeStep);
            _warnings.Begin(State, Coaxial());
            // That of a run that goes on stays as it is: each time it was built from, its bits would change.
            _start = parameters.Scene.Start is RodStart known && known.IsReached ? known
                : State.ToStart(proximalFrame, distalFrame);
            _start.ExitOfSheath = _stepper.ExitOfSheath;
        }

        /// <summary>The wire as it is now.</summary>
        public RodState State { get; }

        /// <summary>Steps done; one that ended the run as Failed for want of a solution is not.</summary>
        public int StepCount => _clock.StepCount;

        /// <summary>In-game time in s, k dt after k steps.</summary>
        public double Time => _clock.Time;

        /// <summary>Delta_p of the last step in units; 0 before the first.</summary>
        public double PredictionError => _stepper.PredictionError;

        /// <summary>How the run ended, or Running.</summary>
        public Outcome Outcome { get; private set; }

        /// <summary>One line that says why the run ended, and what is not accurate in it; empty while it
        /// runs.</summary>
        public string Reason => (_ownReason ?? _stopRule.Reason)
            + (_accuracy.Count == 0 ? "" : ", but " + string.Join("; ", _accuracy));

        /// <summary>Warnings at the run's end, one line each; empty while it runs, and without a step if the start is
        /// no rest shape: there pbd's first sphere has moved ahead of the wire.</summary>
        public IReadOnlyList<string> Warnings => WarningsOfResult().Select(warning => warning.Text).ToArray();

        /// <summary>Whether the result can be trusted, as far as the run can tell: it has converged or finished, and it
        /// has no warning that speaks against its result (<see cref="WarningTable"/>).</summary>
        public bool IsReliable => (Outcome == Outcome.Converged || Outcome == Outcome.Finished)
            && _accuracy.Concat(WarningsOfResult()).All(warning => warning.Kind.IsReliable);

        /// <summary>Whether the state is that after <see cref="StepCount"/> steps, all of it finite: a step that lost
        /// the wire may have left none.</summary>
        public bool HasStateOfStep => _isWritten
            && (Outcome != Outcome.Diverged || StopRule.FindNotFinite(State, StepCount) == null);

        /// <summary>First step of the steady state, or -1.</summary>
        public int SteadyStateStep => _stopRule.SteadyStateStep;

        /// <summary>Points of the wire that passed a wall, and pairs of elements of an instrument that
        /// crossed.</summary>
        public long Passages => (Contacts?.Passages ?? 0) + _warnings.StrandPassages(Contacts);

        /// <summary>What contact with walls came to, and the force at the first sphere; null in a scene without walls
        /// whose parameters do not ask for reactions.</summary>
        public ContactRecord? Contacts => _stepper.Contacts;

        /// <summary>Where a wall is now; null where it stands still. Its time is not to be set.</summary>
        /// <param name="wall">0 the vessel, if there is one.</param>
        public WallField? FieldOf(int wall) => _stepper.FieldOf(wall);

        /// <summary>Builds the wire and chooses every part of the method, once.</summary>
        /// <exception cref="ArgumentException">A value out of the range that the rod allows, one that the method does
        /// not take, or a wire that starts outside the vessel.</exception>
        public static Simulation Create(SimulationParameters parameters)
        {
            ParameterConflict? conflict = ParameterConflict.FindInScene(parameters);
            if (conflict != null)
            {
                throw new ArgumentException(conflict.Key + " needs " + conflict.Needed);
            }
            var scene = new Scene(parameters);
            Quaterniond proximalFrame = scene.Shape.ProximalFrame;    // before the clamps turn
            Quaterniond distalFrame = scene.Shape.DistalFrame;
            MethodStart start = MethodBuilder.Build(parameters, scene);
            var simulation = new Simulation(start, parameters, proximalFrame, distalFrame);
            if (start.Failure != null)
            {
                simulation.End(Outcome.Failed, start.Failure);
            }
            else if (start.IsAtRest && parameters.Method.MaxSimulationSteps == 0)
            {
                simulation.End(Outcome.Converged, "the wire is at rest");
            }
            return simulation;
        }

        /// <summary>What is wrong with the start that the parameters describe between their walls, in one phrase, or
        /// null.</summary>
        /// <exception cref="ArgumentException">There is no such start.</exception>
        public static string? FindProblemOfStart(SimulationParameters parameters)
        {
            if (parameters.Scene.Walls.Length == 0 && parameters.Scene.Start?.Hub == null)
            {
                return null;
            }
            var scene = new Scene(parameters);
            if (!MethodTable.Of(parameters.Method.Solver).TakesMaterial)
            {
                return WireStart.FindProblem(parameters, scene);
            }
            if (parameters.Scene.Catheters.Count > 0)
            {
                return FindProblemInSheath(parameters, scene) ?? CoaxialSetup.FindProblemOfStart(parameters);
            }
            return parameters.Scene.Sheath != null
                ? FindProblemInSheath(parameters, scene) ?? CoaxialSetup.FindProblemOfStart(parameters)
                : MaterialStart.FindProblem(parameters, new MaterialScene(parameters, scene));
        }

        private static string? FindProblemInSheath(SimulationParameters parameters, Scene scene)
        {
            return parameters.Scene.Sheath == null ? null
                : SheathExit.FindProblem(parameters, new MaterialScene(parameters, scene));
        }

        /// <summary>Gives the solver's report on its own work, for a run with a material; null with pbd.</summary>
        public SolverReport? Report() => _stepper.Report();

        /// <summary>Strains and stresses along the wire at the current time; null with pbd. Each call writes the record
        /// anew.</summary>
        public StressRecord? Stress() => _stepper.Stress();

        /// <summary>Energy of motion, that stored in all instruments, and minus the work of the loads that have a
        /// potential, J; null with pbd.</summary>
        public Vector3d? Energies() => _stepper.Energies();

        /// <summary>Results at the hub and the tip at the current time; null if the method does not compute them. Each
        /// call overwrites the record.</summary>
        public HubRecord? Hub() => _stepper.Hub();

        /// <summary>Results of the outermost catheter at the current time; null without one. Each call
        /// writes the record anew.</summary>
        public CoaxialRecord? Coaxial() => _stepper.Coaxial();

        /// <summary>Gives the results of each catheter at the current time, outermost first; as
        /// <see cref="Coaxial"/>.</summary>
        public IReadOnlyList<CoaxialRecord> Catheters()
        {
            int k = 0;
            for (CoaxialRecord? record = Coaxial(); record != null; record = record.Inside)
            {
                _catheters[k++] = record;
            }
            return _catheters;
        }

        /// <summary>Nodes of the wire and then of each catheter, units.</summary>
        public IEnumerable<Vector3d[]> Centrelines()
        {
            yield return State.Positions;
            foreach (CoaxialRecord catheter in Catheters())
            {
                yield return catheter.Positions;
            }
        }

        /// <summary>One step. Does nothing once the run has ended.</summary>
        public void Step()
        {
            if (Outcome != Outcome.Running)
            {
                return;
            }
            Vector3d[] before = State.Positions;
            _stepper.Advance(State);
            _isWritten = State.Positions != before;    // a state that is written replaces the one before
            if (!_isWritten && _stepper.Failure != null)
            {
                // A step without a solution is not done: the state is still that of the step before.
                _isWritten = true;
            }
            else
            {
                _clock.Advance();
            }
            _warnings.Update(State, Contacts, Coaxial(), Time);
            Outcome = _stopRule.Check(State, _stepper, StepCount);
            if (Outcome == Outcome.Finished || Outcome == Outcome.Converged)
            {
                _stepper.AddWarnings(_accuracy);
            }
        }

        /// <summary>A run that continues from where this one is, with the same parameters or with others. With the same
        /// it takes the same steps, bit for bit, as this one would: loads, ramps, twists and drives continue in time,
        /// and what the method remembers of earlier steps is kept. What others make meaningless (a scheme's history
        /// under another step size) starts again.</summary>
        /// <param name="parameters">For a wire of as many elements. Their <see cref="SceneParameters.Start"/>, <see
        /// cref="SceneParameters.InitialState"/> and <see cref="DriveParameters.Displacement"/> are ignored: the start
        /// is over. Instruments with other elements take the place of withdrawn ones; their hubs have the insertion of
        /// those, from a start of their own.</param>
        /// <exception cref="ArgumentException">As <see cref="Create"/>; other elements of an instrument that is not
        /// withdrawn (<see cref="FindInVessel"/>), or that does not fit the others; pbd that goes on as a material, or
        /// the reverse; a sheath where there was none, or the reverse.</exception>
        public Simulation Continue(SimulationParameters parameters)
        {
            if (MethodTable.Of(parameters.Method.Solver).TakesMaterial != _hasMaterial)
            {
                throw new ArgumentException("solver needs to be one for "
                    + (_hasMaterial ? "a material" : "a wire without material, pbd")
                    + ": a run cannot change its wire");
            }
            if ((parameters.Scene.Sheath != null) != (_start.ExitOfSheath != null))
            {
                throw new ArgumentException("sheath: it cannot be added or removed, as a run cannot change its wire");
            }
            if (parameters.Scene.Catheters.Count != _catheters.Length)
            {
                throw new ArgumentException("catheters: their number cannot change during a run");
            }
            if (WallFields.KeyOf(parameters.Scene.Walls) != _moving)
            {
                throw new ArgumentException(_beam == null || BeamOf(parameters) == null
                    ? "vessel: a motion or a beam cannot be added or removed during a run"
                    : FormattableString.Invariant($"vessel.beam: its {_beam.Count} splines cannot become ")
                    + FormattableString.Invariant($"{BeamOf(parameters)!.Count} during a run: give it their spacing, ")
                    + FormattableString.Invariant($"{_beam.Spacing * parameters.Scene.MetresPerUnit:G6} m"));
            }
            double[][] lengths = LengthsOf(parameters);
            bool[] isOther = lengths.Select((own, k) => !AreSame(own, _lengths[k])).ToArray();
            if (Array.Exists(isOther, one => one))
            {
                return Exchange(parameters, isOther);
            }
            var snapshot = new Snapshot();
            Serialize(snapshot);
            RodStart start = State.ToStart(_start.ProximalFrame, _start.DistalFrame);
            start.ExitOfSheath = parameters.Scene.Sheath?.Exit == _givenExit ? _start.ExitOfSheath : null;
            Simulation next = Rebuild(parameters, start, snapshot.ToRead());
            double leap = LeapOfWalls(next, parameters.Scene.Walls.Length);
            return leap <= Leap * parameters.Scene.GuidewireLength ? next : throw new ArgumentException(
                FormattableString.Invariant($"vessel.motion: the wall would leap by up to {leap:G3} units where the ")
                + "wire is: during a run its period or heartRate alone can change");
        }

        // Units: how far nodes are from where they were, as moving walls see them.
        private double LeapOfWalls(Simulation next, int walls)
        {
            double largest = 0.0;
            for (int wall = 0; wall < walls; wall++)
            {
                if (FieldOf(wall) is WallField before && next.FieldOf(wall) is WallField after)
                {
                    largest = Math.Max(largest, State.Positions.Max(x => (before.AtRest(x) - after.AtRest(x)).Length));
                }
            }
            return largest;
        }

        /// <summary>Why another instrument cannot take the place of one now, in one phrase, or null.</summary>
        /// <param name="instrument">0 the wire, k catheter k.</param>
        public string? FindInVessel(int instrument)
        {
            return _catheters.Length == 0 ? "a wire alone cannot be exchanged: the run has to start anew"
                : Instruments.FindInVessel(instrument == 0 ? _catheters.Length : instrument - 1);
        }

        /// <summary>All that the next steps depend on besides the parameters, as bytes for <see
        /// cref="Restore"/>.</summary>
        public byte[] Save()
        {
            var snapshot = new Snapshot();
            int elements = State.ElementCount;
            snapshot.Serialize(ref elements);
            _start.Serialize(snapshot);
            Serialize(snapshot);
            snapshot.Serialize(PredictionError);
            Contacts?.Serialize(snapshot);    // of the last step, as the error before: shown, not used
            SoftWallDisplacements.Serialize(this, snapshot);
            snapshot.Serialize((int)Outcome);
            snapshot.Serialize(Outcome == Outcome.Running ? "" : _ownReason ?? _stopRule.Reason);
            snapshot.Serialize(_accuracy.Count);
            foreach (RunWarning warning in _accuracy)
            {
                snapshot.Serialize(warning.Kind.Name);
                snapshot.Serialize(warning.Text);
            }
            return snapshot.ToBytes();
        }

        /// <summary>The run that was saved: it takes the same steps as the one that was, bit for bit.</summary>
        /// <param name="parameters">Those of the run that was saved.</param>
        /// <param name="saved">What <see cref="Save"/> gave.</param>
        /// <exception cref="ArgumentException">As <see cref="Create"/>; bytes that <see cref="Save"/> did not give for
        /// a run of these parameters.</exception>
        public static Simulation Restore(SimulationParameters parameters, byte[] saved)
        {
            Snapshot snapshot = Snapshot.OfBytes(saved);
            try
            {
                int n = snapshot.Serialize(0);
                if (n != ElementLayout.Count(parameters))
                {
                    throw new ArgumentException("the saved state is that of a wire of " + n + " elements");
                }
                var start = new RodStart(new Vector3d[n + 1], new Quaterniond[n], new Vector3d[n + 1],
                    new Vector3d[n])
                {
                    ExitOfSheath = parameters.Scene.Sheath == null ? (Vector3d?)null : Vector3d.Zero,
                };
                start.Serialize(snapshot);
                Simulation simulation = Rebuild(parameters, start, snapshot);
                simulation._stepper.PredictionError = snapshot.Serialize(0.0);
                simulation.Contacts?.Serialize(snapshot);
                SoftWallDisplacements.Serialize(simulation, snapshot);
                var outcome = (Outcome)snapshot.Serialize(0);
                string reason = snapshot.Serialize("");
                if (outcome != Outcome.Running)
                {
                    simulation.End(outcome, reason);
                }
                simulation._accuracy.Clear();
                for (int count = snapshot.Serialize(0); count > 0; count--)
                {
                    WarningKind kind = WarningTable.Find(snapshot.Serialize(""));
                    simulation._accuracy.Add(new RunWarning(kind, snapshot.Serialize("")));
                }
                return simulation;
            }
            catch (InvalidOperationException error)
            {
                throw new ArgumentException("the saved state does not fit these parameters: " + error.Message, error);
            }
        }

        /// <summary>Ends the run where it is.</summary>
        /// <param name="outcome">Any but Running.</param>
        /// <param name="reason">One line.</param>
        public void End(Outcome outcome, string reason)
        {
            _accuracy.Clear();
            if (outcome == Outcome.Interrupted)
            {
                _stepper.AddWarnings(_accuracy);
            }
            Outcome = outcome;
            _ownReason = reason;
        }

        /// <summary>Whether each instrument has as many elements as in another run, of the same lengths.</summary>
        public bool HasElementsOf(Simulation other)
        {
            return _lengths.Length == other._lengths.Length
                && _lengths.Select((own, k) => AreSame(own, other._lengths[k])).All(isSame => isSame);
        }

        private static WallBeam? BeamOf(SimulationParameters parameters) =>
            parameters.Scene.Walls.Length > 0 ? parameters.Scene.Walls[0].Motion?.Beam : null;

        private static bool AreSame(double[] lengths, double[] others)
        {
            return lengths.Length == others.Length
                && !lengths.Where((length, j) => Math.Abs(length - others[j]) > Same * others[j]).Any();
        }

        private static double[][] LengthsOf(SimulationParameters parameters)
        {
            return parameters.Scene.Catheters.Select(catheter => parameters.OfCatheter(catheter, Vector3d.UnitZ))
                .Prepend(parameters).Select(one => ElementLayout.Lengths(one, 1.0, out _)).ToArray();
        }

        private static Simulation Rebuild(SimulationParameters parameters, RodStart start, Snapshot snapshot)
        {
            start.IsReached = true;
            Simulation next = Create(Continued(parameters, start));
            next.Serialize(snapshot);
            return next;
        }

        private static SimulationParameters Continued(SimulationParameters parameters, RodStart? start)
        {
            SimulationParameters continued = parameters.Copy();
            continued.Scene.Start = start;
            continued.Scene.InitialState = InitialState.Straight;
            continued.Drive.Displacement = 0.0;
            return continued;
        }

        private WireInCatheters Instruments => (WireInCatheters)_stepper;

        // isOther: of the wire and of each catheter.
        private Simulation Exchange(SimulationParameters parameters, bool[] isOther)
        {
            if (_catheters.Length == 0)
            {
                throw new ArgumentException(ElementLayout.Count(parameters) != State.ElementCount
                    ? "numberRodElements needs to leave " + State.ElementCount
                        + " elements: a run cannot change its wire"
                    : "instruments need elements of the lengths that they have: a run cannot change its wire");
            }
            Simulation next = Create(Continued(parameters, null));
            if (next.Outcome != Outcome.Running)
            {
                throw new ArgumentException(next.Reason);
            }
            next.Instruments.ResumeFrom(Instruments, isOther.Skip(1).Append(isOther[0]).ToArray());
            next.Instruments.Write(next.State);
            next.Instruments.Write(next.State);
            var snapshot = new Snapshot();
            _clock.Serialize(snapshot);
            _warnings.Serialize(snapshot, State, Coaxial());
            Snapshot read = snapshot.ToRead();
            next._clock.Serialize(read);
            next._warnings.Serialize(read, next.State, next.Coaxial());
            return next;
        }

        private IEnumerable<RunWarning> WarningsOfResult()
        {
            return HasResult ? _warnings.Of(State, Contacts, Report()?.Extremes, Coaxial())
                : Array.Empty<RunWarning>();
        }

        private bool HasResult => Outcome != Outcome.Running && (StepCount > 0 || Outcome == Outcome.Converged);

        private void Serialize(Snapshot snapshot)
        {
            _clock.Serialize(snapshot);
            State.Serialize(snapshot);
            _stepper.Serialize(snapshot);
            _warnings.Serialize(snapshot, State, Coaxial());
        }
    }
}

using System;
using System.Collections.Generic;
using System.IO;
using Guidewire.Core;
using Guidewire.Io;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Gives a simulation its frames (thesis 3.2.6): fixed dt, as many steps as the pace asks for. The wire is
    /// built from the parameters at the start (3.2.5); the scene knows no n.</summary>
    /// <remarks>A thread makes the steps, and opens the run: a frame waits for neither. Where it is late the wire slows
    /// down (<see cref="Speed"/>). What goes wrong stops the loop and stands in <see cref="Problem"/> and in the
    /// console; <see cref="Load"/> starts anew.</remarks>
    [AddComponentMenu("Guidewire/Simulation Loop"), Manual("the-loop")]
    public sealed class SimulationLoop : MonoBehaviour
    {
        private const int Patience = 100;          // ms, for the thread at the end

        [Tooltip("Parameter file as an asset, such as Assets > Create > Guidewire > Parameters makes.")]
        [SerializeField] private TextAsset? _parameterAsset;

        [Tooltip("Without an asset: parameter file, from the project's folder or, in a player, from the folder that "
            + "holds it.")]
        [SerializeField] private string _parameterFile = "";

        [Tooltip("Instruments and meshes that the parameters name, as assets from anywhere in the project.")]
        [SerializeField] private TextAsset[] _files = Array.Empty<TextAsset>();

        [Tooltip("Vessels of the scene, in addition to those of the parameters.")]
        [SerializeField] private SceneVessel[] _vessels = Array.Empty<SceneVessel>();

        [Tooltip("KEY=VALUE, one per line: parameters that override those of the file.")]
        [SerializeField] private string[] _overrides = Array.Empty<string>();

        [Tooltip("Folder for positions.json, parameters.json and summary.json; empty: the run is not logged.")]
        [SerializeField] private string _logFolder = "";

        [Header("Pace"), Tooltip("Who makes the steps: a thread, or Update or FixedUpdate between two frames.")]
        [SerializeField] private SteppingMode _stepping = SteppingMode.Worker;

        [Tooltip("Simulated seconds per second of real time.")]
        [SerializeField, Range(0.01f, 10f)] private float _pace = 1f;

        [Tooltip("Largest number of steps per frame, without a thread.")]
        [SerializeField, Range(1, 1000)] private int _stepsPerFrame = 100;

        [Tooltip("Largest wall time of the steps of a frame, in ms, without a thread; at least one step is made.")]
        [SerializeField, Range(1f, 100f)] private float _frameBudget = 12f;

        [Header("Steering"), Tooltip("Whether input pushes and turns the wire, instead of the parameter file's drive.")]
        [SerializeField] private bool _isSteered;

        [Tooltip("Speed of the hub at full push, in units per second of simulated time.")]
        [SerializeField, Range(0f, 500f)] private float _pushSpeed = 40f;

        [Tooltip("Rotation speed at full turn, in degrees per second of simulated time.")]
        [SerializeField, Range(0f, 720f)] private float _turnSpeed = 180f;

        private readonly FrameBudget _budget = new FrameBudget();
        private readonly ContactEvents _contacts = new ContactEvents();
        private readonly SpeedMeter _speed = new SpeedMeter();
        private readonly RunReport _report = new RunReport();
        private readonly InputSource _input = new InputSource();
        private readonly PlaceWatch _places = new PlaceWatch();
        private readonly HubCommands _hubs = new HubCommands();
        private WireRun? _run;
        private ShownStates? _opened;       // of the run, once the loop has taken notice of it

        // What says that something is alive is not kept when scripts are compiled anew in Play: the run is not either.
        [NonSerialized] private string[]? _openedWith;   // overrides, of those that were tried
        [NonSerialized] private bool _isLoaded;
        [NonSerialized] private bool _wasAtTarget;

        /// <summary>The run itself, with forces, records and snapshots; null where there is none.</summary>
        /// <exception cref="InvalidOperationException">The loop's thread makes its steps: use <see cref="State"/>, or
        /// <see cref="BetweenSteps"/>.</exception>
        public SimulationSession? Session => _run?.Session;

        /// <summary>The state after the newest step; null where there is no run, or not yet.</summary>
        public WireState? State => _opened?.Newest;

        /// <summary>What this frame shows: between the two newest states.</summary>
        public WireState? Shown => _opened?.Shown;

        /// <summary>The effective parameters, to be read only; null where there is no run, or not yet.</summary>
        public SimulationParameters? Parameters => Description?.Parameters;

        /// <summary>Counts the runs built, so that views know when to rebuild.</summary>
        public int Generation { get; private set; }

        /// <summary>What stopped the loop, in one line; empty where nothing did.</summary>
        public string Problem => _report.Problem;

        /// <summary>What is being done until a run is open; empty otherwise.</summary>
        public string Progress => _run == null || _opened != null || Problem.Length > 0 ? "" : _run.Progress;

        /// <summary>Simulated time over the time that the pace asked for, in the last second: 1 where the steps keep
        /// up.</summary>
        public double Speed => _speed.Speed;

        /// <summary>Real time that the run has been going for, in s, pauses not counted.</summary>
        public double RealTime { get; private set; }

        /// <summary>Whether the loop waits.</summary>
        public bool IsPaused { get; set; }

        /// <summary>Who makes the steps, from the next <see cref="Load"/> on.</summary>
        public SteppingMode Stepping { get => _stepping; set => _stepping = value; }

        /// <summary>Simulated seconds per second of real time.</summary>
        public float Pace { get => _pace; set => _pace = value; }

        /// <summary>Whether input pushes and turns the wire, instead of the parameters' drive; from the next <see
        /// cref="Load"/> on.</summary>
        public bool IsSteered { get => _isSteered; set => _isSteered = value; }

        /// <summary>Speed of a hub at full push, in units per second of simulated time.</summary>
        public float PushSpeed { get => _pushSpeed; set => _pushSpeed = value; }

        /// <summary>Rotation speed of a hub at full turn, in degrees per second of simulated time.</summary>
        public float TurnSpeed { get => _turnSpeed; set => _turnSpeed = value; }

        /// <summary>Goes from -1, pull the steered instrument at full speed, to 1, push; what is beyond counts as
        /// full.</summary>
        public float Push
        {
            get => _hubs.PushOf(SteeredInstrument);
            set => SteerHub(SteeredInstrument, value, Turn);
        }

        /// <summary>Goes from -1, turn the steered instrument left at full speed, to 1, turn right; what is beyond
        /// counts as full.</summary>
        public float Turn
        {
            get => _hubs.TurnOf(SteeredInstrument);
            set => SteerHub(SteeredInstrument, Push, value);
        }

        /// <summary>Whose hub <see cref="Push"/> and <see cref="Turn"/> move: 0 the wire's, k that of catheter
        /// k.</summary>
        public int SteeredInstrument { get; private set; }

        /// <summary>Text asset of the parameters, from the next <see cref="Load"/> on; null: the file.</summary>
        public TextAsset? ParameterAsset { get => _parameterAsset; set => _parameterAsset = value; }

        /// <summary>Parameter file from <see cref="Root"/>, taken without an asset, from the next <see cref="Load"/>
        /// on.</summary>
        public string ParameterFile { get => _parameterFile; set => _parameterFile = value; }

        /// <summary>KEY=VALUE each: what overrides the parameters, from the next <see cref="Load"/> on.</summary>
        public string[] Overrides { get => _overrides; set => _overrides = value; }

        /// <summary>Vessels of the scene, in addition to those of the parameters, from the next <see cref="Load"/>
        /// on.</summary>
        public SceneVessel[] Vessels { get => _vessels; set => _vessels = value; }

        /// <summary>Folder of the results from <see cref="Root"/>, from the next <see cref="Load"/> on; empty: the run
        /// is not logged.</summary>
        public string LogFolder { get => _logFolder; set => _logFolder = value; }

        /// <summary>Instruments and meshes that the parameters name, from the next <see cref="Load"/> on.</summary>
        public TextAsset[] Files { get => _files; set => _files = value; }

        /// <summary>What sets <see cref="Push"/> and <see cref="Turn"/> each frame; null: the first enabled component
        /// of this object that can, or else nobody but their setters.</summary>
        public IWireInput? Input { get; set; }

        /// <summary>Takes what the run is commanded, from the next <see cref="Load"/> on; null: nothing does.</summary>
        public SteeringRecord? Recording { get; set; }

        /// <summary>What the run is commanded instead of what the hand does, from the next <see cref="Load"/>
        /// on.</summary>
        public SteeringRecord? Replay { get; set; }

        /// <summary>Number of spheres, n + 1; 0 without a run.</summary>
        public int SphereCount => State?.Rod.SphereCount ?? 0;

        /// <summary>Raised in the frame in which a wall has begun to act on a sphere.</summary>
        public event Action<WireContact>? ContactBegan;

        /// <summary>Raised in the frame in which a wall has ceased to act on a sphere, with the last force.</summary>
        public event Action<WireContact>? ContactEnded;

        /// <summary>Raised with the tip's place in the world when the wire comes to the target of its
        /// vessel.</summary>
        public event Action<Vector3>? TargetReached;

        /// <summary>Raised once where a run has ended by itself, with how and why.</summary>
        public event Action<Outcome, string>? Ended;

        /// <summary>Folder that paths in the Inspector start from.</summary>
        public static string Root => Path.GetDirectoryName(Application.dataPath) ?? ".";

        /// <summary>What of the run does not change from step to step; null where there is no run, or not
        /// yet.</summary>
        public RunDescription? Description => _opened == null ? null : _run?.Description;

        /// <summary>Whether the Inspector names parameters; without them there is nothing to open.</summary>
        internal bool HasParameters => _parameterAsset || _parameterFile.Length > 0;

        /// <summary>Another text where the next run would be opened from something else.</summary>
        internal string OpeningKey => string.Join("\n", _overrides) + "\n" + _parameterFile + "\n" + _isSteered
            + AssetFiles.Key(_parameterAsset) + string.Concat(Array.ConvertAll(_files, AssetFiles.Key))
            + string.Join("\n", Array.ConvertAll(_vessels, vessel => vessel ? vessel.Key(transform) : ""));

        /// <summary>Whether a view shows where the wire touches: it costs a little of each step.</summary>
        internal bool WantsContactPoints { get; set; }

        /// <summary>Positions of all spheres in the world, as this frame shows them, by this object's transform. No
        /// garbage.</summary>
        /// <param name="positions">Takes them; <see cref="SphereCount"/> long.</param>
        /// <exception cref="ArgumentException">It has another length.</exception>
        public void GetPositions(Vector3[] positions) => WorldFrames.GetPositions(transform, Shown, positions);

        /// <summary>Orientations of all elements in the world: forward is along the wire. No garbage.</summary>
        /// <param name="orientations">Takes them; one less than <see cref="SphereCount"/>.</param>
        /// <exception cref="ArgumentException">It has another length.</exception>
        public void GetOrientations(Quaternion[] orientations) =>
            WorldFrames.GetOrientations(transform, Shown, orientations);

        /// <summary>Steers the next instrument: wire, catheters, wire again. The one before is let go.</summary>
        public void SteerNextInstrument()
        {
            SteerHub(SteeredInstrument, 0f, 0f);
            SteeredInstrument = Description == null ? 0 : (SteeredInstrument + 1) % Description.Titles.Count;
        }

        /// <summary>Says how a hub moves until it is said otherwise; several may move at once.</summary>
        /// <param name="instrument">0 the wire, k catheter k; one that the run does not have does nothing.</param>
        /// <param name="push">From -1, pull at full speed, to 1, push.</param>
        /// <param name="turn">From -1, turn left at full speed, to 1, turn right.</param>
        public void SteerHub(int instrument, float push, float turn) => _hubs.Set(instrument, push, turn);

        /// <summary>Uses the next name of the folders of instruments with which an instrument can be built, and builds
        /// the run anew; does nothing where there is none.</summary>
        /// <param name="instrument">0 the wire, k catheter k.</param>
        public void UseNextInstrument(int instrument)
        {
            if (Description?.NextOf(instrument, _overrides) is { Count: > 0 } choices)
            {
                Load(choices);
            }
        }

        /// <summary>Rebuilds the wire from the parameters. The loop's thread opens it, while frames go on.</summary>
        public void Load() => Load(new[] { _overrides });

        /// <summary>Makes the steps of a frame, or asks the loop's thread for them, and takes over what has been
        /// made.</summary>
        /// <param name="seconds">Real time since the last frame in s.</param>
        public void Advance(float seconds)
        {
            if (_run == null)
            {
                return;
            }
            bool goes = !IsPaused && CanStep();
            double asked = goes ? _pace * (double)seconds : 0.0;
            if (goes)
            {
                RealTime += seconds;
                Steer();
                _run.Ask(asked, Parameters!.Method.TimeStep);
            }
            else if (IsPaused)
            {
                _run.Forget(0.0);
            }
            if (!_run.HasThread)
            {
                _budget.Work(_run, Stepping == SteppingMode.FixedSteps ? int.MaxValue : _stepsPerFrame,
                    Stepping == SteppingMode.FixedSteps ? double.PositiveInfinity : _frameBudget);
            }
            TakeNewest();
            if (_opened != null)
            {
                _speed.Ask(asked, _pace, _opened.Newest.Time);    // over a second
                _opened.Show(IsPaused ? double.PositiveInfinity : _pace * (double)seconds);
            }
        }

        /// <summary>Makes one step, also while the loop is paused.</summary>
        public void Step()
        {
            if (CanStep())
            {
                Steer();
                _run!.AskStep();
                WorkAtOnce();
            }
        }

        /// <summary>Does something with the run between two steps, such as saving or restoring it: on the loop's
        /// thread, or at once where it has none. What it throws stops the loop.</summary>
        public void BetweenSteps(Action<SimulationSession> change)
        {
            _run?.AskChange(change);
            WorkAtOnce();
        }

        /// <summary>Changes a parameter while the wire goes on; a value that is not allowed stops the loop.</summary>
        /// <param name="key">As in a file.</param>
        /// <param name="value">As behind KEY= in the Inspector.</param>
        public void Set(string key, string value) => BetweenSteps(session => session.Set(key, value));

        /// <summary>Ends the run and its log; a thread in the middle of a step ends within 100 ms.</summary>
        public void Close()
        {
            WireRun? run = _run;
            (_run, _opened) = (null, null);
            run?.Stop(Patience);
            run?.Dispose();
        }

        private void Awake()
        {
            enabled &= !PlayerBatch.IsAsked;
            Compilation.Begin(_stepping);
        }

        private void Update()
        {
            if (!_isLoaded && !HasParameters)
            {
                _isLoaded = true;
                Debug.LogWarning("guidewire: " + name + ": choose a Parameter Asset, such as "
                    + "Assets > Create > Guidewire > Parameters makes, or a Parameter File", this);
            }
            if (!_isLoaded)    // the first frame, or the first after scripts were compiled anew in Play Mode
            {
                Load();
            }
            _input.Steer(this);
            _places.Check(this);
            if (_stepping != SteppingMode.FixedSteps)
            {
                Advance(Time.deltaTime);
            }
        }

        private void FixedUpdate()
        {
            if (_isLoaded && _stepping == SteppingMode.FixedSteps)
            {
                Advance(Time.fixedDeltaTime);
            }
        }

        private void OnDisable() => _run?.Forget(0.0);

        private void OnDestroy() => Close();

        private void Load(IReadOnlyList<string[]> choices)
        {
            WireRun? before = _run;
            (_run, _opened) = (null, null);
            _isLoaded = true;
            (RealTime, _openedWith, _wasAtTarget) = (0.0, null, false);
            _places.Begin(this);
            _report.Begin();
            _speed.Begin();
            try
            {
                before?.Dispose();
                RunOpening opening = Opening(isLogged: true);
                _run = new WireRun((report, cancellation) => opening.Open(choices, before, taken => _openedWith = taken,
                    report, cancellation), Recording, Replay);
            }
            catch (Exception error)
            {
                _report.Stop(error);
                Generation++;
                return;
            }
            if (WireRun.TakesThread(_stepping))
            {
                _run.StartThread();
            }
            WorkAtOnce();
        }

        /// <summary>Takes from the scene what a run is opened from.</summary>
        /// <exception cref="ArgumentException">A vessel that is none.</exception>
        internal RunOpening Opening(bool isLogged)
        {
            VesselMesh[] vessels = Array.ConvertAll(_vessels, vessel => vessel ? vessel.Read(transform)
                : throw new ArgumentException("an entry of the vessels names no object"));
            if (!HasParameters)
            {
                throw new ArgumentException("no parameters: choose a Parameter Asset or a Parameter File");
            }
            string log = _logFolder.Length == 0 || !isLogged ? "" : Path.Combine(Root, _logFolder);
            return new RunOpening(_parameterAsset ? _parameterAsset!.name : Path.Combine(Root, _parameterFile),
                _parameterAsset ? _parameterAsset!.text : null, AssetFiles.Read(_files), vessels, log, _isSteered);
        }

        private void Steer()
        {
            _run!.Steer(_hubs, _pushSpeed, _turnSpeed, WantsContactPoints);
            WantsContactPoints = false;    // views ask anew each frame
        }

        // Without a thread: what is asked for beside the frames' steps.
        private void WorkAtOnce()
        {
            if (_run != null && !_run.HasThread)
            {
                while (_run.IsAskedAtOnce && _run.Work())
                {
                }
                TakeNewest();
                _opened?.Show(double.PositiveInfinity);
            }
        }

        private bool CanStep() => _opened != null && Problem.Length == 0 && _opened.Newest.Outcome == Outcome.Running;

        // Takes over what has been made since the last time.
        private void TakeNewest()
        {
            if (_run == null)
            {
                return;
            }
            if (_opened == null && _run.Opened != null)
            {
                _opened = _run.Opened;
                _overrides = _openedWith ?? _overrides;
                SteeredInstrument = SteeredInstrument < Description!.Titles.Count ? SteeredInstrument : 0;
                _contacts.Begin(SphereCount);
                Generation++;
                RunReport.Warn(Description.Warnings);
            }
            if (_run.Failure != null && Problem.Length == 0)
            {
                Generation += _opened == null ? 1 : 0;
                _report.Stop(_run.Failure);
            }
            if (_run.TakeNewest())
            {
                _contacts.Update(this, State!, ContactBegan, ContactEnded);
                if (State!.IsAtTarget && !_wasAtTarget)
                {
                    Vector3 tip = State.Rod.Positions[State.Rod.ElementCount].ToUnity();
                    TargetReached?.Invoke(transform.TransformPoint(tip));
                }
                _wasAtTarget = State.IsAtTarget;
                if (_report.Update(State))
                {
                    Ended?.Invoke(State.Outcome, State.Reason);
                }
            }
        }
    }
}

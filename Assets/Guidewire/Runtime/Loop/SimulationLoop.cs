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

        [Tooltip("Parameter file, from the project's folder or, in a player, from the folder that holds it.")]
        [SerializeField] private string _parameterFile = "params/default.json";

        [Tooltip("Parameter file as an asset, instead of the file.")]
        [SerializeField] private TextAsset? _parameterAsset;

        [Tooltip("Instruments and meshes that the parameters name, as assets from anywhere in the project.")]
        [SerializeField] private TextAsset[] _files = Array.Empty<TextAsset>();

        [Tooltip("Vessels of the scene, in addition to those of the parameters.")]
        [SerializeField] private SceneVessel[] _vessels = Array.Empty<SceneVessel>();

        [Tooltip("KEY=VALUE, one per line: parameters that override those of the file.")]
        [SerializeField] private string[] _overrides = Array.Empty<string>();

        [Tooltip("Folder for positions.json, parameters.json and summary.json; empty: the run is not logged.")]
        [SerializeField] private string _logFolder = "";

        [Tooltip("Parameter file to which a key switches, and back; empty: none.")]
        [SerializeField] private string _alternativeFile = "";

        [Tooltip("That file as an asset, instead of the file.")]
        [SerializeField] private TextAsset? _alternativeAsset;

        [Tooltip("KEY=VALUE, one per line: parameters that override those of that file.")]
        [SerializeField] private string[] _alternativeOverrides = Array.Empty<string>();

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
        private readonly TouchedSpheres _touched = new TouchedSpheres();
        private WireRun? _run;
        private ShownStates? _opened;       // of the run, once the loop has taken notice of it
        private string[]? _taken;           // overrides with which it was opened, of those that were tried
        private readonly SpeedMeter _speed = new SpeedMeter();
        private readonly RunReport _report = new RunReport();
        private readonly InputSource _input = new InputSource();
        private bool _isLoaded;

        /// <summary>The run itself, with forces, records and snapshots; null where there is none.</summary>
        /// <exception cref="InvalidOperationException">The loop's thread makes its steps: use <see cref="State"/>, or
        /// <see cref="Do"/>.</exception>
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

        /// <summary>Goes from -1, pull at full speed, to 1, push; what is beyond counts as full.</summary>
        public float Push { get; set; }

        /// <summary>Goes from -1, turn left at full speed, to 1, turn right; what is beyond counts as full.</summary>
        public float Turn { get; set; }

        /// <summary>Whose hub <see cref="Push"/> and <see cref="Turn"/> move: 0 the wire's, k that of catheter
        /// k.</summary>
        public int Held { get; private set; }

        /// <summary>Instruments and meshes that the parameters name, from the next <see cref="Load"/> on.</summary>
        public TextAsset[] Files { get => _files; set => _files = value; }

        /// <summary>What sets <see cref="Push"/> and <see cref="Turn"/> each frame; null: a component of this object
        /// that is enabled, or else nobody but their setters.</summary>
        public IWireInput? Input { get; set; }

        /// <summary>Takes what the run is commanded, from the next <see cref="Load"/> on; null: nothing does.</summary>
        public SteeringRecord? Record { get; set; }

        /// <summary>What the run is commanded instead of what the hand does, from the next <see cref="Load"/>
        /// on.</summary>
        public SteeringRecord? Played { get; set; }

        /// <summary>Number of spheres, n + 1; 0 without a run.</summary>
        public int SphereCount => State?.Rod.SphereCount ?? 0;

        /// <summary>Raised with a sphere's index in the frame in which a wall has begun to act on it.</summary>
        public event Action<int>? ContactBegan;

        /// <summary>Raised with a sphere's index in the frame in which a wall has ceased to act on it.</summary>
        public event Action<int>? ContactEnded;

        /// <summary>Raised once where a run has ended by itself, with how and why.</summary>
        public event Action<Outcome, string>? Ended;

        /// <summary>Folder that paths in the Inspector start from.</summary>
        public static string Root => Path.GetDirectoryName(Application.dataPath) ?? ".";

        /// <summary>What of the run does not change from step to step.</summary>
        internal RunDescription? Description => _opened == null ? null : _run?.Description;

        /// <summary>Overrides of the parameters, KEY=VALUE each.</summary>
        internal string[] Overrides => _overrides;

        /// <summary>Another text where the next run would be opened from something else.</summary>
        internal string OpeningKey => string.Join("\n", _overrides) + "\n" + _parameterFile + "\n" + _isSteered
            + AssetFiles.Key(_parameterAsset) + string.Concat(Array.ConvertAll(_files, AssetFiles.Key))
            + string.Join("\n", Array.ConvertAll(_vessels, vessel => vessel ? vessel.Key(transform) : ""));

        /// <summary>Whether a view shows where the wire touches: it costs a little of each step.</summary>
        internal bool WantsContactPoints { get; set; }

        /// <summary>Names what the next <see cref="Load"/> reads, instead of the Inspector.</summary>
        /// <param name="parameterFile">Parameter file, from <see cref="Root"/>; empty: the asset.</param>
        /// <param name="overrides">KEY=VALUE each.</param>
        /// <param name="logFolder">Folder of the results; empty for a run that is not logged.</param>
        /// <param name="isSteered">Whether input steers the wire instead of the drive.</param>
        public void Choose(string parameterFile, string[] overrides, string logFolder, bool isSteered)
        {
            _isSteered = isSteered;
            _parameterFile = parameterFile;
            _parameterAsset = parameterFile.Length > 0 ? null : _parameterAsset;
            _overrides = overrides;
            _logFolder = logFolder;
        }

        /// <summary>Names what the next <see cref="Load"/> takes instead of a file.</summary>
        /// <param name="parameters">Text of a parameter file; null: the file.</param>
        /// <param name="vessels">Vessels of the scene, in addition to those of the parameters.</param>
        public void Choose(TextAsset? parameters, params SceneVessel[] vessels)
        {
            _parameterAsset = parameters;
            _vessels = vessels;
        }

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

        /// <summary>Takes the alternative's parameters instead of the present ones, and rebuilds the wire; does
        /// nothing where there is no alternative.</summary>
        public void TakeAlternative()
        {
            if (_alternativeFile.Length == 0 && !_alternativeAsset)
            {
                return;
            }
            (_parameterFile, _alternativeFile) = (_alternativeFile, _parameterFile);
            (_overrides, _alternativeOverrides) = (_alternativeOverrides, _overrides);
            (_parameterAsset, _alternativeAsset) = (_alternativeAsset, _parameterAsset);
            Load();
        }

        /// <summary>Selects the next instrument to steer: wire, catheters, wire again.</summary>
        public void HoldNext() => Held = Description == null ? 0 : (Held + 1) % Description.Titles.Count;

        /// <summary>Takes the next name of the folders of instruments with which an instrument can be built, and builds
        /// the run anew; does nothing where there is none.</summary>
        /// <param name="instrument">0 the wire, k catheter k.</param>
        public void TakeNextInstrument(int instrument)
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
            Take();
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
        public void Do(Action<SimulationSession> change)
        {
            _run?.Do(change);
            WorkAtOnce();
        }

        /// <summary>Changes a parameter while the wire goes on; a value that is not allowed stops the loop.</summary>
        /// <param name="key">As in a file.</param>
        /// <param name="value">As behind KEY= in the Inspector.</param>
        public void Set(string key, string value) => Do(session => session.Set(key, value));

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
            if (!_isLoaded)    // the first frame, or the first after scripts were compiled anew in Play Mode
            {
                Load();
            }
            _input.Steer(this);
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
            (RealTime, _taken) = (0.0, null);
            _report.Begin();
            _speed.Begin();
            try
            {
                before?.Dispose();
                RunOpening opening = Opening(isLogged: true);
                _run = new WireRun((report, cancellation) => opening.Open(choices, before, taken => _taken = taken,
                    report, cancellation), Record, Played);
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
            string log = _logFolder.Length == 0 || !isLogged ? "" : Path.Combine(Root, _logFolder);
            return new RunOpening(_parameterAsset ? _parameterAsset!.name : Path.Combine(Root, _parameterFile),
                _parameterAsset ? _parameterAsset!.text : null, AssetFiles.Read(_files), vessels, log, _isSteered);
        }

        private void Steer()
        {
            float push = Mathf.Clamp(Push, -1f, 1f) * _pushSpeed;
            float turn = Mathf.Clamp(Turn, -1f, 1f) * _turnSpeed;
            _run!.Steer(new SteeringCommand { Held = Held, Push = push, Turn = turn }, WantsContactPoints);
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
                Take();
                _opened?.Show(double.PositiveInfinity);
            }
        }

        private bool CanStep() => _opened != null && Problem.Length == 0 && _opened.Newest.Outcome == Outcome.Running;

        // Takes over what has been made since the last time.
        private void Take()
        {
            if (_run == null)
            {
                return;
            }
            if (_opened == null && _run.Opened != null)
            {
                _opened = _run.Opened;
                _overrides = _taken ?? _overrides;
                Held = Held < Description!.Titles.Count ? Held : 0;
                _touched.Begin(SphereCount);
                Generation++;
                RunReport.Warn(Description.Warnings);
            }
            if (_run.Failure != null && Problem.Length == 0)
            {
                Generation += _opened == null ? 1 : 0;
                _report.Stop(_run.Failure);
            }
            if (_run.Take())
            {
                _touched.Update(State!.ContactForces, ContactBegan, ContactEnded);
                if (_report.Take(State))
                {
                    Ended?.Invoke(State.Outcome, State.Reason);
                }
            }
        }
    }
}

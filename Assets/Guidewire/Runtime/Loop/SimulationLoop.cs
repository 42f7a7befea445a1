using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Linq;
using Guidewire.Core;
using Guidewire.Io;
using Newtonsoft.Json.Linq;
using UnityEngine;
using Debug = UnityEngine.Debug;

namespace Guidewire.Runtime
{
    /// <summary>Gives a simulation its frames (thesis 3.2.6): fixed dt, as many steps a frame as the pace asks for and
    /// the budget allows. The wire is built from the parameter file at the start (3.2.5); the scene knows no
    /// n.</summary>
    /// <remarks>Update, not FixedUpdate: that one catches up on lost time without a limit that knows what a step costs.
    /// What goes wrong stops the loop and stands in <see cref="Problem"/> and in the console; a reset starts
    /// anew.</remarks>
    public sealed class SimulationLoop : MonoBehaviour
    {
        [Tooltip("Parameter file, from the project's folder or, in a player, from the folder that holds it.")]
        [SerializeField] private string _parameterFile = "params/default.json";

        [Tooltip("Parameter file as an asset, instead of the file.")]
        [SerializeField] private TextAsset? _parameterAsset;

        [Tooltip("Vessels of the scene, in addition to those of the parameters.")]
        [SerializeField] private SceneVessel[] _vessels = Array.Empty<SceneVessel>();

        [Tooltip("KEY=VALUE, one per line: parameters that override those of the file.")]
        [SerializeField] private string[] _overrides = Array.Empty<string>();

        [Tooltip("Folder for positions.json, parameters.json and summary.json; empty: the run is not logged.")]
        [SerializeField] private string _logFolder = "";

        [Tooltip("Parameter file to which a key switches, and back; empty: none.")]
        [SerializeField] private string _alternativeFile = "";

        [Tooltip("KEY=VALUE, one per line: parameters that override those of that file.")]
        [SerializeField] private string[] _alternativeOverrides = Array.Empty<string>();

        [Header("Pace")]
        [Tooltip("Simulated seconds per second of real time.")]
        [SerializeField, Range(0.01f, 10f)] private float _pace = 1f;

        [Tooltip("Largest number of steps per frame.")]
        [SerializeField, Range(1, 1000)] private int _stepsPerFrame = 100;

        [Tooltip("Largest wall time of the steps of a frame, in ms; at least one step is made.")]
        [SerializeField, Range(1f, 100f)] private float _frameBudget = 12f;

        [Header("Steering")]
        [Tooltip("Whether keys push and turn the wire, instead of the parameter file's drive.")]
        [SerializeField] private bool _isSteered;

        [Tooltip("Speed of sphere 0 while a push or pull key is down, in units per second of simulated time.")]
        [SerializeField, Range(0f, 500f)] private float _pushSpeed = 40f;

        [Tooltip("Rotation speed while a turn key is down, in degrees per second of simulated time.")]
        [SerializeField, Range(0f, 720f)] private float _turnSpeed = 180f;

        [Header("Parameters while it runs")]
        [SerializeField] private LiveParameters _live = new LiveParameters();

        private readonly Stopwatch _frame = new Stopwatch();
        private double _pending;    // s of in-game time asked for and not simulated
        private readonly TouchedSpheres _touched = new TouchedSpheres();
        private bool _isReported;

        /// <summary>The run, or null where it could not be built.</summary>
        public SimulationSession? Session { get; private set; }

        /// <summary>Counts the runs built, so that views know when to rebuild.</summary>
        public int Generation { get; private set; }

        /// <summary>What stopped the loop, in one line; empty where nothing did.</summary>
        public string Problem { get; private set; } = "";

        /// <summary>Real time that the run has been going for, in s, pauses not counted.</summary>
        public double RealTime { get; private set; }

        /// <summary>Whether the loop waits.</summary>
        public bool IsPaused { get; set; }

        /// <summary>From -1, pull at full speed, to 1, push; what is beyond counts as full.</summary>
        public float Push { get; set; }

        /// <summary>From -1, turn left at full speed, to 1, turn right; what is beyond counts as full.</summary>
        public float Turn { get; set; }

        /// <summary>Whose hub <see cref="Push"/> and <see cref="Turn"/> move: 0 the wire's, k that of catheter
        /// k.</summary>
        public int Held { get; private set; }

        /// <summary>What sets <see cref="Push"/> and <see cref="Turn"/> each frame; null: nobody but their
        /// setters.</summary>
        public IWireInput? Input { get; set; }

        /// <summary>Number of spheres, n + 1; 0 without a run.</summary>
        public int SphereCount => Session?.Simulation.State.SphereCount ?? 0;

        /// <summary>Raised with a sphere's index after a step in which a wall has begun to act on it.</summary>
        public event Action<int>? ContactBegan;

        /// <summary>Raised with a sphere's index after a step in which a wall has ceased to act on it.</summary>
        public event Action<int>? ContactEnded;

        /// <summary>Raised once where a run has ended by itself, with how and why.</summary>
        public event Action<Outcome, string>? Ended;

        /// <summary>The parameters that the Inspector changes.</summary>
        public LiveParameters Live => _live;

        /// <summary>Folder that paths in the Inspector start from.</summary>
        public static string Root => Path.GetDirectoryName(Application.dataPath) ?? ".";

        /// <summary>Names what the next <see cref="Load"/> reads, instead of the Inspector.</summary>
        /// <param name="parameterFile">Parameter file, from <see cref="Root"/>.</param>
        /// <param name="overrides">KEY=VALUE each.</param>
        /// <param name="logFolder">Folder of the results; empty for a run that is not logged.</param>
        /// <param name="isSteered">Whether keys steer the wire instead of the drive.</param>
        public void Choose(string parameterFile, string[] overrides, string logFolder, bool isSteered)
        {
            _isSteered = isSteered;
            _parameterFile = parameterFile;
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

        /// <summary>Positions of all spheres in the world, by this object's transform. No garbage.</summary>
        /// <param name="positions">Takes them; <see cref="SphereCount"/> long.</param>
        /// <exception cref="ArgumentException">It has another length.</exception>
        public void GetPositions(Vector3[] positions)
        {
            CheckLength(positions.Length, SphereCount);
            for (int i = 0; i < positions.Length; i++)
            {
                positions[i] = transform.TransformPoint(Session!.Simulation.State.Positions[i].ToUnity());
            }
        }

        /// <summary>Orientations of all elements in the world: forward is along the wire. No garbage.</summary>
        /// <param name="orientations">Takes them; one less than <see cref="SphereCount"/>.</param>
        /// <exception cref="ArgumentException">It has another length.</exception>
        public void GetOrientations(Quaternion[] orientations)
        {
            CheckLength(orientations.Length, Math.Max(0, SphereCount - 1));
            for (int j = 0; j < orientations.Length; j++)
            {
                orientations[j] = transform.rotation * Session!.Simulation.State.Orientations[j].ToUnity();
            }
        }

        /// <summary>Takes the alternative's parameters instead of the present ones, and rebuilds the wire; does
        /// nothing where there is no alternative.</summary>
        public void TakeAlternative()
        {
            if (_alternativeFile.Length == 0)
            {
                return;
            }
            (_parameterFile, _alternativeFile) = (_alternativeFile, _parameterFile);
            (_overrides, _alternativeOverrides) = (_alternativeOverrides, _overrides);
            _parameterAsset = null;
            Load();
        }

        /// <summary>Selects the next instrument to steer: wire, catheters, wire again.</summary>
        public void HoldNext()
        {
            Held = Session == null ? 0 : (Held + 1) % Session.InstrumentCount;
        }

        /// <summary>Takes the next name of the folders of instruments with which an instrument can be built, and builds
        /// the run anew; does nothing where there is none.</summary>
        /// <param name="instrument">0 the wire, k catheter k.</param>
        public void TakeNextInstrument(int instrument)
        {
            IReadOnlyList<string>? names = Session?.ChoicesOf(instrument);
            if (names == null || names.Count == 0)
            {
                return;
            }
            string now = Session!.NameOf(instrument);
            int first = 0;
            for (int k = 0; k < names.Count; k++)
            {
                first = names[k] == now ? k + 1 : first;
            }
            string key = SimulationSession.KeyOf(instrument) + "=";
            var others = new List<string>(_overrides);
            others.RemoveAll(one => one.StartsWith(key, StringComparison.Ordinal));
            for (int k = 0; k == 0 || (k < names.Count && Problem.Length > 0); k++)
            {
                _overrides = others.Append(key + names[(first + k) % names.Count]).ToArray();
                Load();
            }
        }

        /// <summary>Rebuilds the wire from the parameter file.</summary>
        public void Load()
        {
            Close();
            Problem = "";
            RealTime = 0.0;
            _pending = 0.0;
            _isReported = false;
            try
            {
                string log = _logFolder.Length == 0 ? "" : Path.Combine(Root, _logFolder);
                ParameterSource source = _parameterAsset
                    ? ParameterSource.OfText(_parameterAsset!.name, _parameterAsset.text)
                    : ParameterSource.OfFile(Path.Combine(Root, _parameterFile));
                Session = SimulationSession.Open(
                    source.With(Array.ConvertAll(_vessels, vessel => vessel.Create(transform))), _overrides, log,
                    _isSteered);
                Held = Held < Session.InstrumentCount ? Held : 0;
                _touched.Begin(SphereCount);
                _live.Read(Session.Parameters);
                foreach (string warning in Session.Warnings)
                {
                    Debug.LogWarning("guidewire: " + warning);
                }
            }
            catch (Exception error)
            {
                Stop(error);
            }
            Generation++;
        }

        /// <summary>Makes the steps of a frame.</summary>
        /// <param name="seconds">Real time since the last frame in s.</param>
        public void Advance(float seconds)
        {
            if (!CanStep() || IsPaused)
            {
                return;
            }
            RealTime += seconds;
            _pending += _pace * seconds;
            _frame.Restart();
            int steps = 0;
            while (CanStep() && _pending >= Session!.Parameters.Method.TimeStep && steps < _stepsPerFrame
                && (steps == 0 || _frame.Elapsed.TotalMilliseconds < _frameBudget))
            {
                _pending -= Session.Parameters.Method.TimeStep;
                Step();
                steps++;
            }

            // A frame that was too slow is not made up for: the wire would only become slower still.
            _pending = Math.Min(_pending, Session!.Parameters.Method.TimeStep);
        }

        /// <summary>Makes one step, also while the loop is paused.</summary>
        public void Step()
        {
            if (!CanStep())
            {
                return;
            }
            try
            {
                double dt = Session!.Parameters.Method.TimeStep;
                Session.Step(Mathf.Clamp(Push, -1f, 1f) * _pushSpeed * dt,
                    Mathf.Clamp(Turn, -1f, 1f) * _turnSpeed * dt * Math.PI / 180.0, Held);
                _touched.Update(Session.Simulation.Contacts, ContactBegan, ContactEnded);
                Report(Session.Simulation);
            }
            catch (Exception error)
            {
                Stop(error);
            }
        }

        /// <summary>Changes a parameter while the wire goes on; a value that is not allowed stops the loop.</summary>
        public void Set(string key, JToken value)
        {
            try
            {
                Session?.Set(key, value);
            }
            catch (Exception error)
            {
                Stop(error);
            }
        }

        /// <summary>Takes over what the Inspector has changed.</summary>
        internal void TakeLive()
        {
            string? key;
            while (Session != null && Problem.Length == 0
                && (key = _live.FirstChange(Session.Parameters, out JToken? value)) != null)
            {
                Set(key, value!);
            }
        }

        /// <summary>Ends the run and its log.</summary>
        public void Close()
        {
            try
            {
                Session?.Dispose();
            }
            finally
            {
                Session = null;
            }
        }

        private void Awake()
        {
            Input ??= GetComponent<IWireInput>();
            if (PlayerBatch.IsAsked)
            {
                enabled = false;
                return;
            }
            Application.runInBackground = true;
            QualitySettings.vSyncCount = 0;
            Application.targetFrameRate = 60;
        }

        private void Start()
        {
            Load();
        }

        private void Update()
        {
            if (Input != null)
            {
                Push = Input.Push;
                Turn = Input.Turn;
            }
            TakeLive();
            Advance(Time.deltaTime);
        }

        private void OnDestroy()
        {
            Close();
        }

        private static void CheckLength(int given, int needed)
        {
            if (given != needed)
            {
                throw new ArgumentException("an array of length " + given + " is given, and " + needed + " are needed");
            }
        }

        private bool CanStep()
        {
            return Session != null && Problem.Length == 0 && Session.Simulation.Outcome == Outcome.Running;
        }

        private void Report(Simulation simulation)
        {
            if (simulation.Outcome == Outcome.Running || _isReported)
            {
                return;
            }
            _isReported = true;
            string line = simulation.Outcome.ToString().ToLowerInvariant() + ": " + simulation.Reason;
            if (simulation.Outcome == Outcome.Diverged || simulation.Outcome == Outcome.Failed)
            {
                Problem = line;
                Debug.LogError("guidewire: " + line);
            }
            else
            {
                Debug.Log("guidewire: " + line);
            }
            Ended?.Invoke(simulation.Outcome, simulation.Reason);
        }

        private void Stop(Exception error)
        {
            bool isExpected = error is ParameterException || error is ArgumentException;
            Problem = isExpected ? error.Message : "internal error: " + error.Message;
            Debug.LogError("guidewire: " + (isExpected ? error.Message : error.ToString()));
        }
    }
}

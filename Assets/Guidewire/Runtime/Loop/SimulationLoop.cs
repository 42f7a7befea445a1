using System;
using System.Diagnostics;
using System.IO;
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

        [Tooltip("KEY=VALUE, one a line: parameters that count instead of the file's.")]
        [SerializeField] private string[] _overrides = Array.Empty<string>();

        [Tooltip("Folder that takes positions.json, parameters.json and summary.json; empty: the run is not logged.")]
        [SerializeField] private string _logFolder = "";

        [Tooltip("Parameter file that a key swaps with this one, and back; empty: none.")]
        [SerializeField] private string _alternativeFile = "";

        [Tooltip("KEY=VALUE, one a line: parameters that count instead of that file's.")]
        [SerializeField] private string[] _alternativeOverrides = Array.Empty<string>();

        [Header("Pace")]
        [Tooltip("In-game seconds a second of real time.")]
        [SerializeField, Range(0.01f, 10f)] private float _pace = 1f;

        [Tooltip("Steps a frame at most.")]
        [SerializeField, Range(1, 1000)] private int _stepsPerFrame = 100;

        [Tooltip("Wall time a frame for steps at most, in ms; at least one step is made.")]
        [SerializeField, Range(1f, 100f)] private float _frameBudget = 12f;

        [Header("Steering")]
        [Tooltip("Whether keys push and turn the wire, instead of the parameter file's drive.")]
        [SerializeField] private bool _isSteered;

        [Tooltip("Speed of sphere 0 while a push or pull key is down, in units a second of in-game time.")]
        [SerializeField, Range(0f, 500f)] private float _pushSpeed = 40f;

        [Tooltip("Speed of turning while a turn key is down, in degrees a second of in-game time.")]
        [SerializeField, Range(0f, 720f)] private float _turnSpeed = 180f;

        [Header("Parameters while it runs")]
        [SerializeField] private LiveParameters _live = new LiveParameters();

        private readonly Stopwatch _frame = new Stopwatch();
        private double _pending;    // s of in-game time asked for and not simulated
        private bool _isReported;

        /// <summary>The run, or null where it could not be built.</summary>
        public SimulationSession? Session { get; private set; }

        /// <summary>Counts the runs built, so that views know when to build anew.</summary>
        public int Generation { get; private set; }

        /// <summary>What stopped the loop, in one line; empty where nothing did.</summary>
        public string Problem { get; private set; } = "";

        /// <summary>Real time that the run has been going for, in s, pauses not counted.</summary>
        public double RealTime { get; private set; }

        /// <summary>Whether the loop waits.</summary>
        public bool IsPaused { get; set; }

        /// <summary>-1 pull, 0, 1 push.</summary>
        public int Push { get; set; }

        /// <summary>-1 turn left, 0, 1 turn right.</summary>
        public int Turn { get; set; }

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

        /// <summary>Takes the alternative's parameters instead of the present ones, and builds the wire anew; does
        /// nothing where there is no alternative.</summary>
        public void TakeAlternative()
        {
            if (_alternativeFile.Length == 0)
            {
                return;
            }
            (_parameterFile, _alternativeFile) = (_alternativeFile, _parameterFile);
            (_overrides, _alternativeOverrides) = (_alternativeOverrides, _overrides);
            Load();
        }

        /// <summary>Builds the wire anew from the parameter file.</summary>
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
                Session = SimulationSession.Open(Path.Combine(Root, _parameterFile), _overrides, log,
                    _isSteered);
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

        /// <summary>Simulates what a frame asks for.</summary>
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
                Session.Step(Push * _pushSpeed * dt, Turn * _turnSpeed * dt * Math.PI / 180.0);
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
        public void TakeLive()
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
            TakeLive();
            Advance(Time.deltaTime);
        }

        private void OnDestroy()
        {
            Close();
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
        }

        private void Stop(Exception error)
        {
            bool isExpected = error is ParameterException || error is ArgumentException;
            Problem = isExpected ? error.Message : "internal error: " + error.Message;
            Debug.LogError("guidewire: " + (isExpected ? error.Message : error.ToString()));
        }
    }
}

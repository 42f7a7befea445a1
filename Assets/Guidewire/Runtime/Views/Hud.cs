using System;
using System.Collections.Generic;
using System.Globalization;
using System.Text;
using Guidewire.Core;
using Guidewire.Io;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Times, errors and outcome as text, and buttons for what can be switched while the wire goes on. The
    /// text is made a few times a second, because each making leaves garbage.</summary>
    public sealed class Hud : MonoBehaviour
    {
        private const float Every = 0.2f;     // s between two texts
        private const float Width = 380f;     // pixels
        private const float Line = 18f;

        private static readonly string[] Units = { "", "", "1/unit", "rad/unit" };    // of each colouring

        // Keys with a few words each that a wire can be switched between while it goes on.
        private static readonly string[] Switchable = { "solver", "integrator", "sweepOrder", "elementContact" };

        [SerializeField] private SimulationLoop _loop = null!;
        [SerializeField] private WireView _wire = null!;

        private readonly StringBuilder _builder = new StringBuilder(512);
        private readonly List<ParameterEntry> _switches = new List<ParameterEntry>();
        private readonly List<string> _labels = new List<string>();
        private float _age = Every;
        private int _lines;
        private bool _hasInput;

        /// <summary>Whether the keys are listed.</summary>
        [field: SerializeField] public bool ShowsHelp { get; set; } = true;

        /// <summary>The text as it stands on the screen.</summary>
        public string Text { get; private set; } = "";

        /// <summary>Makes the text anew.</summary>
        public void Refresh()
        {
            _age = 0f;
            _builder.Clear();
            _lines = 0;
            SimulationSession? session = _loop.Session;
            if (session != null)
            {
                Write(session);
                for (int i = 0; i < _switches.Count; i++)
                {
                    _labels[i] = _switches[i].Key + ": " + session.Get(_switches[i].Key);
                }
            }
            if (_loop.Problem.Length > 0)
            {
                Append("STOPPED: {0}", _loop.Problem);
                Append("R starts anew");
            }
            if (!_hasInput)
            {
                Append("no keys, no mouse: set Project Settings > Player >");
                Append("Active Input Handling to Input Manager (Old) or Both");
            }
            Text = _builder.ToString();
        }

        private void Awake()
        {
            _hasInput = LegacyInput.IsThere();
            foreach (string key in Switchable)
            {
                ParameterEntry? entry = ParameterTable.Find(key);
                if (entry != null)
                {
                    _switches.Add(entry);
                    _labels.Add(key);
                }
            }
        }

        private void Update()
        {
            _age += Time.deltaTime;
            if (_age >= Every || _loop.Problem.Length > 0 != Text.Contains("STOPPED"))
            {
                Refresh();
            }
        }

        private void OnGUI()
        {
            float height = Line * (_lines + 1);
            GUI.Box(new Rect(8f, 8f, Width, height), GUIContent.none);
            GUI.Label(new Rect(16f, 12f, Width - 16f, height), Text);
            float y = 12f + height;
            for (int i = 0; i < _switches.Count; i++)
            {
                if (GUI.Button(new Rect(8f, y, 0.5f * Width, Line + 4f), _labels[i]) && _loop.Session != null)
                {
                    bool isSwitched = _loop.Session.Switch(_switches[i].Key);
                    Refresh();
                    _labels[i] += isSwitched ? "" : " (only)";
                }
                y += Line + 6f;
            }
            if (ShowsHelp)
            {
                GUI.Label(new Rect(16f, Screen.height - 8f * Line, 2f * Width, 8f * Line), KeyboardControl.Help);
            }
        }

        private void Write(SimulationSession session)
        {
            Simulation simulation = session.Simulation;
            Append("in-game time {0:0.000} s   real time {1:0.0} s", simulation.Time, _loop.RealTime);
            Append("step {0}   {1:0.000} ms a step", simulation.StepCount, session.StepTime);
            Append("prediction error {0:0.0e+0} units", simulation.PredictionError);
            Append("{0}{1}   {2} elements", simulation.Outcome.ToString().ToLowerInvariant(),
                _loop.IsPaused ? " (paused)" : "", simulation.State.ElementCount);
            if (simulation.Outcome != Outcome.Running)
            {
                Append("{0}", simulation.Reason);
            }
            ContactRecord? contacts = simulation.Contacts;
            if (contacts != null)
            {
                Append("walls: force {0:0.00e+0}, user: force {1:0.00e+0} {2}", contacts.Total.Length,
                    contacts.Reaction.Length, HasMaterial(session) ? "N" : "mass unit unit/s\u00b2");
                Append("asked of sphere 0: {0:0.0} units, not given: {1:0.0}   passages {2}", contacts.DriveAsked,
                    contacts.DriveShortfall, contacts.Passages);
            }
            HubRecord? hub = simulation.Hub();
            if (hub != null)
            {
                Append("hub: {0:0.0} mm in, turned by {1:0} degrees", 1e3 * hub.Insertion,
                    180.0 / Math.PI * hub.Turn);
                Append("push {0:0.0} mN, torque {1:0.000} mN m", 1e3 * hub.Force, 1e3 * hub.Torque);
                Append("largest curvature {0:0.0} 1/m", hub.LargestCurvature);
            }
            if (_wire.Colouring != Colouring.Plain)
            {
                Append("colour: {0}, red at {1} {2}", _wire.Colouring.ToString().ToLowerInvariant(), _wire.Range,
                    Units[(int)_wire.Colouring]);
            }
        }

        private static bool HasMaterial(SimulationSession session)
        {
            return MethodTable.Of(session.Parameters.Method.Solver).TakesMaterial;
        }

        private void Append(string format, params object[] values)
        {
            _builder.AppendFormat(CultureInfo.InvariantCulture, format, values).Append('\n');
            _lines++;
        }
    }
}

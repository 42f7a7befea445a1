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
        private readonly List<string> _instruments = new List<string>();    // buttons that take the next one
        private float _age = Every;
        private int _lines;
        private int _labelled;    // generation of the buttons of instruments
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
                LabelInstruments(session);
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

        private void LabelInstruments(SimulationSession session)
        {
            if (_labelled == _loop.Generation)
            {
                return;
            }
            _labelled = _loop.Generation;
            _instruments.Clear();
            for (int k = 0; k < session.InstrumentCount; k++)
            {
                int names = session.ChoicesOf(k).Count;
                if (names > 0)
                {
                    _instruments.Add((k == 0 ? "wire: " : "catheter: ") + session.TitleOf(k) + " (1 of " + names + ")");
                }
            }
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
            for (int k = 0; k < _instruments.Count; k++)
            {
                if (GUI.Button(new Rect(8f, y, 0.8f * Width, Line + 4f), _instruments[k]))
                {
                    _loop.TakeNextInstrument(k);
                    Refresh();
                }
                y += Line + 6f;
            }
            if (ShowsHelp)
            {
                GUI.Label(new Rect(16f, Screen.height - 9f * Line, 2f * Width, 9f * Line), KeyboardControl.Help);
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
                Append("drive: {0:0.0} units, shortfall: {1:0.0}   passages {2}", contacts.DriveAsked,
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
            WriteCatheters(session);
            if (_wire.Colouring != Colouring.Plain)
            {
                Append("colour: {0}, red at {1} {2}", _wire.Colouring.ToString().ToLowerInvariant(), _wire.Range,
                    Units[(int)_wire.Colouring]);
            }
        }

        private void WriteCatheters(SimulationSession session)
        {
            IReadOnlyList<CoaxialRecord> catheters = session.Simulation.Catheters();
            for (int k = 0; k < catheters.Count; k++)
            {
                CoaxialRecord one = catheters[k];
                Append("{0}: {1:0.0} mm in, turned by {2:0} degrees", session.TitleOf(k + 1), 1e3 * one.Insertion,
                    180.0 / Math.PI * one.Turn);
                Append("push {0:0.0} mN, torque {1:0.000} mN m, overlap {2:0.0} mm", 1e3 * one.Force,
                    1e3 * one.Torque, 1e3 * one.Overlap);
            }
            if (catheters.Count > 0 && session.IsSteered)
            {
                Append("the hand holds {0}", session.TitleOf(_loop.Held));
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

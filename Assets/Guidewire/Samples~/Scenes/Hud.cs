using System;
using System.Globalization;
using System.Text;
using Guidewire.Core;
using Guidewire.Runtime;
using UnityEngine;

/// <summary>Times, forces and outcome as text, and buttons for what can be switched while the wire goes on. The
/// text is made a few times a second, because each making leaves garbage.</summary>
public sealed class Hud : LoopView
{
    private const float Every = 0.2f;     // s between two texts
    private const float Width = 380f;     // pixels of a screen of 96 dots per inch
    private const float Line = 18f;
    private const float Dots = 96f;       // per inch
    private const double Slow = 0.95;     // of the pace, below which the text says so

    private static readonly string[] Units = { "", "", "1/unit", "rad/unit" };    // of each colouring

    [Tooltip("Whose colours are explained; empty: none.")]
    [SerializeField] private WireView? _wire = null;

    [Tooltip("Size of the text; on a screen of 96 dots per inch 1 is 18 pixels a line.")]
    [SerializeField, Min(0.5f)] private float _size = 1f;

    private readonly StringBuilder _builder = new StringBuilder(512);
    private float _age = Every;
    private int _lines;
    private RunDescription? _description;
    private KeyboardControl? _keys;    // of this object
    private HostInput _input;

    /// <summary>Whether the keys are listed.</summary>
    [field: SerializeField, Tooltip("Whether the keys are listed.")] public bool ShowsHelp { get; set; } = true;

    /// <summary>The text as it stands on the screen.</summary>
    public string Text { get; private set; } = "";

    /// <summary>Pixels of the screen for one of a screen of 96 dots per inch.</summary>
    public float Scale => _size * (Screen.dpi > 0f ? Mathf.Max(1f, Screen.dpi / Dots) : 1f);

    /// <summary>Makes the text anew.</summary>
    public void Refresh()
    {
        _age = 0f;
        _builder.Clear();
        _lines = 0;
        SimulationLoop? loop = Loop;
        _description = loop == null ? null : loop.Description;
        if (loop == null)
        {
            Append("no loop");
        }
        else if (loop.State != null)
        {
            Write(loop, loop.State, _description!);
        }
        else if (loop.Progress.Length > 0)
        {
            Append("{0} ...", loop.Progress);
        }
        if (loop != null && loop.Problem.Length > 0)
        {
            Append("STOPPED: {0}", loop.Problem);
            if (_keys)
            {
                Append("R starts anew");
            }
        }
        if (!_input.IsThere)
        {
            Append("no keys, no mouse: see Project Settings > Player >");
            Append("Active Input Handling, or add the Input System package");
        }
        Text = _builder.ToString();
    }

    private void OnEnable()
    {
        _input = HostInput.Find();
        TryGetComponent(out _keys);
    }

    private void Update()
    {
        _age += Time.deltaTime;
        bool isStopped = Loop != null && Loop.Problem.Length > 0;
        if (_age >= Every || isStopped != Text.Contains("STOPPED"))
        {
            Refresh();
        }
    }

    private void OnGUI()
    {
        Matrix4x4 before = GUI.matrix;
        GUI.matrix = Matrix4x4.TRS(Vector3.zero, Quaternion.identity, new Vector3(Scale, Scale, 1f));
        float height = Line * (_lines + 1);
        GUI.Box(new Rect(8f, 8f, Width, height), GUIContent.none);
        GUI.Label(new Rect(16f, 12f, Width - 16f, height), Text);
        float y = 12f + height;
        for (int i = 0; _description != null && i < _description.Switches.Count; i++)
        {
            if (GUI.Button(new Rect(8f, y, 0.5f * Width, Line + 4f), _description.Switches[i].Label))
            {
                Switch(_description.Switches[i].Key);
            }
            y += Line + 6f;
        }
        for (int k = 0; _description != null && k < _description.Choices.Count; k++)
        {
            if (_description.Choices[k].Length > 0)
            {
                if (GUI.Button(new Rect(8f, y, 0.8f * Width, Line + 4f), _description.Choices[k]))
                {
                    Loop!.UseNextInstrument(k);
                    Refresh();
                }
                y += Line + 6f;
            }
        }
        if (ShowsHelp && _keys && _keys!.isActiveAndEnabled)
        {
            GUI.Label(new Rect(16f, Screen.height / Scale - 9f * Line, 2f * Width, 9f * Line),
                _keys.Help);
        }
        GUI.matrix = before;
    }

    private void Switch(string key)
    {
        Loop!.BetweenSteps(session => session.Switch(key));
        Refresh();
    }

    private void Write(SimulationLoop loop, WireState state, RunDescription description)
    {
        Append("in-game time {0:0.000} s   real time {1:0.0} s", state.Time, loop.RealTime);
        Append("step {0}   {1:0.000} ms a step", state.StepCount, state.StepTime);
        if (loop.Speed < Slow && !loop.IsPaused)
        {
            Append("the steps take too long: {0:0} % of the speed", 100.0 * loop.Speed);
        }
        Append("prediction error {0:0.0e+0} units", state.PredictionError);
        Append("{0}{1}   {2} elements", state.Outcome.ToString().ToLowerInvariant(),
            loop.IsPaused ? " (paused)" : "", state.Rod.ElementCount);
        if (state.Outcome != Outcome.Running)
        {
            Append("{0}", state.Reason);
        }
        if (state.ContactForces.Length > 0)
        {
            bool hasMaterial = MethodTable.Of(description.Parameters.Method.Solver).TakesMaterial;
            Append("walls: force {0:0.00e+0}, user: force {1:0.00e+0} {2}", state.ContactForce.Length,
                state.Reaction.Length, hasMaterial ? "N" : "mass unit unit/s\u00b2");
            Append("passages {0}", state.Passages);
        }
        if (state.Hub != null)
        {
            WriteHub("hub", state.Hub.Value);
            Append("largest curvature {0:0.0} 1/m", state.LargestCurvature);
        }
        for (int k = 0; k < state.Catheters.Count; k++)
        {
            WriteHub(description.Titles[k + 1], state.Catheters[k].Hub);
            Append("overlap {0:0.0} mm", 1e3 * state.Catheters[k].Overlap);
        }
        if (state.Catheters.Count > 0 && description.IsSteered)
        {
            Append("the hand holds {0}", description.Titles[loop.SteeredInstrument]);
        }
        if (state.IsJammed)
        {
            Append("JAMMED: the hub slips; pulling back frees it");
        }
        if (_wire && _wire!.Colouring != Colouring.Plain)
        {
            Append("colour: {0}, red at {1} {2}", _wire.Colouring.ToString().ToLowerInvariant(), _wire.Range,
                Units[(int)_wire.Colouring]);
        }
    }

    private void WriteHub(string name, in HubState hub)
    {
        Append("{0}: {1:0.0} mm in, turned by {2:0} degrees", name, 1e3 * hub.Insertion,
            180.0 / Math.PI * hub.Turn);
        Append("push {0:0.0} mN, torque {1:0.000} mN m, slipped {2:0.0} mm", 1e3 * hub.Force, 1e3 * hub.Torque,
            1e3 * hub.Shortfall);
    }

    private void Append(string format, params object[] values)
    {
        _builder.AppendFormat(CultureInfo.InvariantCulture, format, values).Append('\n');
        _lines++;
    }
}

using Guidewire.Runtime;
using UnityEngine;

/// <summary>Keys that steer the wire and the loop. <see cref="Help"/> lists them all.</summary>
[DefaultExecutionOrder(-100)]    // before the loop, so that a key acts in the frame in which it goes down
public sealed class KeyboardControl : MonoBehaviour
{
    /// <summary>The keys that do something here, as the HUD shows them.</summary>
    public string Help { get; private set; } = "";

    [Tooltip("What the keys steer; empty: the loop of this object, or of the nearest above.")]
    [SerializeField] private SimulationLoop _loop = null!;

    [Tooltip("View of the wire; empty: C, B and G do nothing.")]
    [SerializeField] private WireView _wire = null!;

    [Tooltip("View of contacts; empty: F does nothing.")]
    [SerializeField] private ContactView _contacts = null!;

    [Tooltip("Text on the screen; empty: H does nothing.")]
    [SerializeField] private Hud _hud = null!;

    [Tooltip("Camera; empty: T does nothing.")]
    [SerializeField] private OrbitCamera _camera = null!;

    [Tooltip("Parameter file that M takes in place of the loop's, and back; empty: M does nothing.")]
    [SerializeField] private TextAsset? _alternativeAsset;

    [Tooltip("KEY=VALUE, one per line: parameters that override those of that file.")]
    [SerializeField] private string[] _alternativeOverrides = System.Array.Empty<string>();

    private readonly KeyAxis _push = new KeyAxis(KeyCode.W, KeyCode.UpArrow, KeyCode.S, KeyCode.DownArrow);
    private readonly KeyAxis _turn = new KeyAxis(KeyCode.D, KeyCode.RightArrow, KeyCode.A, KeyCode.LeftArrow);
    private HostInput _input;

    private void OnEnable()
    {
        _input = HostInput.Find();
        if (!_loop)
        {
            _loop = GetComponentInParent<SimulationLoop>();
        }
        Help = (_loop && _loop.IsSteered ? "W / S  or up / down: push / pull\nA / D  or left / right: turn\n" : "")
            + (_loop ? "space: pause     N: one step     R: reset\nI: select the next instrument\n" : "")
            + (_alternativeAsset ? "M: the other parameters\n" : "")
            + (_wire ? "C: colour     B: spheres     G: directors\n" : "")
            + (_contacts ? "F: contact forces     " : "") + (_hud ? "H: this text\n" : "")
            + (_camera ? "right mouse button: orbit     wheel: zoom     T: look at the tip" : "");
    }

    private void OnDisable()
    {
        if (_loop)
        {
            _loop.Push = 0f;
            _loop.Turn = 0f;
        }
    }

    private void Update()
    {
        if (!_input.IsThere)
        {
            return;
        }
        if (_loop)
        {
            SteerLoop(_loop);
        }
        if (_wire)
        {
            _wire.ShowsSpheres ^= _input.WasPressed(KeyCode.B);
            _wire.ShowsDirectors ^= _input.WasPressed(KeyCode.G);
            if (_input.WasPressed(KeyCode.C))
            {
                _wire.NextColouring();
            }
        }
        if (_contacts)
        {
            _contacts.IsShown ^= _input.WasPressed(KeyCode.F);
        }
        if (_hud)
        {
            _hud.ShowsHelp ^= _input.WasPressed(KeyCode.H);
        }
        if (_camera)
        {
            _camera.FollowsTip ^= _input.WasPressed(KeyCode.T);
        }
    }

    private void SteerLoop(SimulationLoop loop)
    {
        loop.Push = _push.Value(_input);
        loop.Turn = _turn.Value(_input);
        loop.IsPaused ^= _input.WasPressed(KeyCode.Space);
        if (_input.WasPressed(KeyCode.N))
        {
            loop.IsPaused = true;
            loop.Step();
        }
        if (_input.WasPressed(KeyCode.R))
        {
            loop.Load();
        }
        if (_input.WasPressed(KeyCode.I))
        {
            loop.SteerNextInstrument();
        }
        if (_input.WasPressed(KeyCode.M) && _alternativeAsset)
        {
            (loop.ParameterAsset, _alternativeAsset) = (_alternativeAsset, loop.ParameterAsset);
            (loop.Overrides, _alternativeOverrides) = (_alternativeOverrides, loop.Overrides);
            loop.Load();
        }
    }
}

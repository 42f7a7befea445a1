using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Keys that steer the wire and the loop. <see cref="Help"/> lists them all.</summary>
    [AddComponentMenu("Guidewire/Keyboard Control"), Manual("input")]
    [DefaultExecutionOrder(-100)]    // before the loop, so that a key acts in the frame in which it goes down
    public sealed class KeyboardControl : MonoBehaviour
    {
        /// <summary>The keys, one a line, as the HUD shows them.</summary>
        public const string Help = "W / S  or up / down: push / pull\nA / D  or left / right: turn\n"
            + "space: pause     N: one step     R: reset     M: pbd or material\n"
            + "I: select the next instrument\nC: colour     B: spheres     G: directors\nF: contact forces     H: this "
            + "text\nright mouse button: orbit     wheel: zoom     T: look at the tip";

        [Tooltip("What the keys steer; empty: the loop of this object, or of the nearest above.")]
        [SerializeField] private SimulationLoop _loop = null!;

        [SerializeField] private WireView _wire = null!;
        [SerializeField] private ContactView _contacts = null!;
        [SerializeField] private Hud _hud = null!;
        [SerializeField] private OrbitCamera _camera = null!;

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
                loop.HoldNext();
            }
            if (_input.WasPressed(KeyCode.M))
            {
                loop.TakeAlternative();
            }
        }
    }
}

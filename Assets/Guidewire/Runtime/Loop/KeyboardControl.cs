using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Keys that steer the wire and the loop. <see cref="Help"/> lists them all.</summary>
    [DefaultExecutionOrder(-100)]    // before the loop, so that a key acts in the frame in which it goes down
    public sealed class KeyboardControl : MonoBehaviour
    {
        /// <summary>The keys, one a line, as the HUD shows them.</summary>
        public const string Help = "W / S  or up / down: push / pull\nA / D  or left / right: turn\n"
            + "space: pause     N: one step     R: reset     M: pbd or material\n"
            + "I: select the next instrument\nC: colour     B: spheres     G: directors\nF: contact forces     H: this "
            + "text\nright mouse button: orbit     wheel: zoom     T: look at the tip";

        [SerializeField] private SimulationLoop _loop = null!;
        [SerializeField] private WireView _wire = null!;
        [SerializeField] private ContactView _contacts = null!;
        [SerializeField] private Hud _hud = null!;
        [SerializeField] private OrbitCamera _camera = null!;

        private readonly KeyAxis _push = new KeyAxis(KeyCode.W, KeyCode.UpArrow, KeyCode.S, KeyCode.DownArrow);
        private readonly KeyAxis _turn = new KeyAxis(KeyCode.D, KeyCode.RightArrow, KeyCode.A, KeyCode.LeftArrow);

        private void Awake()
        {
            enabled = LegacyInput.IsThere();
        }

        private void Update()
        {
            _loop.Push = _push.Value;
            _loop.Turn = _turn.Value;
            _loop.IsPaused ^= Input.GetKeyDown(KeyCode.Space);
            _wire.ShowsSpheres ^= Input.GetKeyDown(KeyCode.B);
            _wire.ShowsDirectors ^= Input.GetKeyDown(KeyCode.G);
            _contacts.IsShown ^= Input.GetKeyDown(KeyCode.F);
            _hud.ShowsHelp ^= Input.GetKeyDown(KeyCode.H);
            _camera.FollowsTip ^= Input.GetKeyDown(KeyCode.T);
            if (Input.GetKeyDown(KeyCode.C))
            {
                _wire.NextColouring();
            }
            if (Input.GetKeyDown(KeyCode.N))
            {
                _loop.IsPaused = true;
                _loop.Step();
            }
            if (Input.GetKeyDown(KeyCode.R))
            {
                _loop.Load();
            }
            if (Input.GetKeyDown(KeyCode.I))
            {
                _loop.HoldNext();
            }
            if (Input.GetKeyDown(KeyCode.M))
            {
                _loop.TakeAlternative();
            }
        }
    }
}

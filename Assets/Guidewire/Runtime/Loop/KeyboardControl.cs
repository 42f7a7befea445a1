using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Keys that steer the wire and the loop. <see cref="Help"/> lists them all.</summary>
    [DefaultExecutionOrder(-100)]    // before the loop, so that a key acts in the frame in which it goes down
    public sealed class KeyboardControl : MonoBehaviour
    {
        /// <summary>The keys, one a line, as the HUD shows them.</summary>
        public const string Help = "W / S  or up / down: push / pull\nA / D  or left / right: turn\n"
            + "space: pause     N: one step     R: reset\nC: colour     B: spheres     G: directors\nF: contact forces     H: this text\n"
            + "right mouse button: orbit     wheel: zoom     T: look at the tip";

        [SerializeField] private SimulationLoop _loop = null!;
        [SerializeField] private WireView _wire = null!;
        [SerializeField] private Hud _hud = null!;
        [SerializeField] private OrbitCamera _camera = null!;

        private void Update()
        {
            _loop.Push = Axis(KeyCode.W, KeyCode.UpArrow, KeyCode.S, KeyCode.DownArrow);
            _loop.Turn = Axis(KeyCode.D, KeyCode.RightArrow, KeyCode.A, KeyCode.LeftArrow);
            if (Input.GetKeyDown(KeyCode.Space))
            {
                _loop.IsPaused = !_loop.IsPaused;
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
            if (Input.GetKeyDown(KeyCode.C))
            {
                _wire.NextColouring();
            }
            if (Input.GetKeyDown(KeyCode.B))
            {
                _wire.ShowsSpheres = !_wire.ShowsSpheres;
            }
            if (Input.GetKeyDown(KeyCode.G))
            {
                _wire.ShowsDirectors = !_wire.ShowsDirectors;
            }
            if (Input.GetKeyDown(KeyCode.H))
            {
                _hud.ShowsHelp = !_hud.ShowsHelp;
            }
            if (Input.GetKeyDown(KeyCode.T))
            {
                _camera.FollowsTip = !_camera.FollowsTip;
            }
        }

        private static int Axis(KeyCode up, KeyCode alsoUp, KeyCode down, KeyCode alsoDown)
        {
            int sum = Input.GetKey(up) || Input.GetKey(alsoUp) ? 1 : 0;
            return sum - (Input.GetKey(down) || Input.GetKey(alsoDown) ? 1 : 0);
        }
    }
}

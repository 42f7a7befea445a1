using System;
using System.Diagnostics;
using System.Linq;
using System.Reflection;
using System.Threading;
using Guidewire.Editor;
using UnityEditor;

namespace Guidewire.Unity.Tests
{
    /// <summary>The twelve steps of the manual's First steps, in their order, with what must appear after each.
    /// </summary>
    public sealed class FirstMinutesTests
    {
        private const int Patience = 60_000;    // ms

        private static readonly Type Gizmos = typeof(LoopInspector).Assembly.GetType("Guidewire.Editor.LoopGizmos")!;

        private GameObject _wire = null!;
        private SimulationLoop _loop = null!;
        private LoopInspector _inspector = null!;

        [SetUp]
        public void NewScene()
        {
            Engine.Reset(Stage.Root);
            Application.isPlaying = false;
            SceneView.lastActiveSceneView = new SceneView();
            EditorGUILayout.Typed = null;
            Undo.Created.Clear();
        }

        [TearDown]
        public void Leave()
        {
            Application.isPlaying = true;
            Engine.Unload();
        }

        private static string Menu(string method)
        {
            MenuItem item = EditorTests.Menu.GetMethod(method, BindingFlags.Static | BindingFlags.NonPublic)!
                .GetCustomAttribute<MenuItem>()!;
            return item.menuItem + " " + item.priority;
        }

        // The Inspector, again and again until it has its answer; its text.
        private string Look(SimulationLoop loop, string click = "")
        {
            _inspector = UnityEditor.Editor.Make<LoopInspector>(loop);
            Engine.Click = click.Length == 0 ? null : click;
            var clock = Stopwatch.StartNew();
            do
            {
                Engine.Labels.Clear();
                _inspector.OnInspectorGUI();
                Thread.Sleep(5);
            }
            while (StartCheck.Of(loop).IsAtWork && clock.ElapsedMilliseconds < Patience);
            Engine.Labels.Clear();
            _inspector.OnInspectorGUI();
            return string.Join("\n", Engine.Labels);
        }

        // What the scene view shows of the wire before Play, in the world.
        private Vector3[] ShownStart(WireView view)
        {
            Look(_loop);
            EditorTests.Call(Gizmos, "ShowStart", view, GizmoType.Selected);
            EditorApplication.CallDelayed();
            Engine.Frame(Stage.Frame);
            Assert.That(Engine.Drawn, Has.Count.EqualTo(1));
            return Engine.Drawn[0].Mesh.vertices.Select(Engine.Drawn[0].Place.MultiplyPoint3x4).ToArray();
        }

        private static Vector3 Middle(Vector3[] points) =>
            (1f / points.Length) * points.Aggregate(Vector3.zero, (sum, point) => sum + point);

        [Test]
        public void FirstSteps_ShowWhatTheManualSays()
        {
            var camera = new GameObject("Main Camera") { tag = "MainCamera" };
            camera.AddComponent<Camera>();
            MakeAWire_2_3(camera);
            Play_4_6(camera);
            Inspector_7_9(camera);
            MakeAFileAndALoop_10_12();
        }

        private void MakeAWire_2_3(GameObject camera)
        {
            Assert.That(Menu("CreateWire"), Is.EqualTo("GameObject/Guidewire/Wire in a vessel 10"));
            EditorTests.Call(EditorTests.Menu, "CreateWire", new MenuCommand(null));
            _wire = (GameObject)Selection.activeObject;
            _loop = _wire.GetComponent<SimulationLoop>();
            Assert.That(_wire.name, Does.StartWith("Wire"));
            Vector3[] tube = ShownStart(_wire.GetComponent<WireView>());
            Bounds framed = SceneView.lastActiveSceneView.Framed;
            Assert.That(tube, Has.All.Matches<Vector3>(point =>
                (point - framed.center).magnitude < 0.9f * framed.size.x), "the wire is in the framed cube's sphere");
            Assert.That(Middle(tube).z, Is.EqualTo(-0.07f).Within(1e-3f), "from -130 to -10 mm");
            OrbitCamera orbit = camera.GetComponent<OrbitCamera>();
            Assert.That(orbit.Loop, Is.EqualTo(_loop));
            Vector3 towards = Middle(tube) - camera.transform.position;
            Assert.That(Vector3.Dot(towards.normalized, camera.transform.rotation * Vector3.forward),
                Is.GreaterThan(Mathf.Cos(0.45f)), "within the 60 degrees of a new camera");
            Assert.That(camera.GetComponent<Camera>().nearClipPlane, Is.LessThan(0.5f * towards.magnitude));
        }

        private void Play_4_6(GameObject camera)
        {
            _loop.Stepping = SteppingMode.Frames;
            Engine.EnterPlay(_wire, camera);
            Stage.Frames(10);
            Assert.That(_loop.Problem, Is.Empty);
            Assert.That(Engine.Drawn.Take(2).Select(one => one.Mesh.name), Is.EqualTo(new[] { "Wire", "Wall" }));
            Assert.That(Engine.Drawn.Select(one => one.Material.shader.name), Has.All.EqualTo("Guidewire/Surface"));
            double before = _loop.State!.Hub!.Value.Insertion;
            Engine.Press(KeyCode.W);
            Stage.Frames(180);
            Engine.Release(KeyCode.W);
            Assert.That(_loop.State.Hub!.Value.Insertion - before, Is.EqualTo(0.12).Within(5e-3), "3 s at 40 mm/s");
            Assert.That(_loop.Shown!.Rod.Positions[24].Y, Is.GreaterThan(10.0), "into the bend");
            Assert.That(Engine.Drawn.Count(one => one.Mesh.name == "Ball"), Is.GreaterThan(5), "forces of the wall");
            Engine.Press(KeyCode.D);
            Stage.Frames(30);
            Engine.Release(KeyCode.D);
            Assert.That(_loop.State.Hub!.Value.Turn, Is.EqualTo(Math.PI / 2.0).Within(0.15));
            Vector3 place = camera.transform.position;
            Engine.Mouse(100f, 100f, 1, 0f);
            Stage.Frames(1);
            Engine.Mouse(200f, 100f, 1, 1f);
            Stage.Frames(1);
            Assert.That((camera.transform.position - place).magnitude, Is.GreaterThan(0.1f));
            Assert.That(camera.GetComponent<OrbitCamera>().Distance, Is.LessThan(400f));
            Assert.That(Engine.Console, Is.Empty);
        }

        private void Inspector_7_9(GameObject camera)
        {
            Look(_loop, "Pause");
            Assert.That(_loop.IsPaused, Is.True);
            int steps = _loop.State!.StepCount;
            Look(_loop, "Step");
            Assert.That(_loop.State.StepCount, Is.EqualTo(steps + 1));
            Look(_loop, "Go on");
            Stage.Frames(10);
            Assert.That(_loop.State.StepCount, Is.GreaterThan(steps + 5));
            Engine.Click = "Parameters: material";
            _inspector.OnInspectorGUI();
            EditorGUILayout.Typed = ("youngsModulus (Pa)", "30e9");
            _inspector.OnInspectorGUI();
            Assert.That(_loop.Problem, Is.Empty);
            Assert.That(_loop.Parameters!.Material.YoungsModulus, Is.EqualTo(30e9));
            Assert.That(_loop.State.StepCount, Is.GreaterThan(steps + 5), "the wire goes on");
            Look(_loop, "Restart");
            Assert.That(_loop.State.StepCount, Is.Zero);
            Engine.Unload();
            Assert.That(_loop.State, Is.Null, "Play is left: the run has ended with its objects");
        }

        private void MakeAFileAndALoop_10_12()
        {
            Application.isPlaying = false;
            Assert.That(Menu("CreateParameters"), Does.StartWith("Assets/Create/Guidewire/Parameters"));
            EditorTests.Call(EditorTests.Menu, "CreateParameters");
            var file = new TextAsset(ProjectWindowUtil.Last!.Value.Content) { name = "Parameters" };
            _wire = new GameObject("GameObject");
            _loop = _wire.AddComponent<SimulationLoop>();
            Assert.That(Look(_loop), Does.Contain("Info: Choose a Parameter Asset").And.Not.Contain("Error"));
            _loop.ParameterAsset = file;
            Assert.That(Look(_loop), Does.Contain("Parameters: material").And.Not.Contain("Error")
                .And.Not.Contain("Choose"));
            WireView view = _wire.AddComponent<WireView>();
            _wire.AddComponent<KeyInput>();
            (_loop.IsSteered, _loop.Stepping) = (true, SteppingMode.Frames);
            Assert.That(ShownStart(view), Is.Not.Empty);
            _loop.Overrides = new[] { "timeStep=0" };
            Assert.That(Look(_loop), Does.Contain("Error: ").And.Contain("timeStep"));
            EditorTests.Call(Gizmos, "ShowStart", view, GizmoType.Selected);
            EditorApplication.CallDelayed();
            Engine.Frame(Stage.Frame);
            Assert.That(Engine.Drawn, Is.Empty, "what cannot start is not shown");
            _loop.Overrides = Array.Empty<string>();
            Assert.That(ShownStart(view), Is.Not.Empty);
            Engine.EnterPlay(_wire);
            Engine.Press(KeyCode.W);
            Stage.Frames(60);
            Assert.That(_loop.Problem, Is.Empty);
            Assert.That(_loop.State!.Hub!.Value.Insertion, Is.EqualTo(0.04).Within(2e-3));
            Assert.That(Engine.Drawn.Select(one => one.Mesh.name), Is.EqualTo(new[] { "Wire" }));
            Assert.That(Engine.Console.Where(line => line.Type == LogType.Error), Is.Empty);
        }
    }
}

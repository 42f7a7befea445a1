using System;
using System.Diagnostics;
using System.Linq;
using System.Reflection;
using System.Threading;
using Guidewire.Editor;
using UnityEditor;

namespace Guidewire.Unity.Tests
{
    /// <summary>Inspector, menus, gizmos and the step of a player's build.</summary>
    public sealed class EditorTests
    {
        private const int Patience = 60_000;    // ms

        [SetUp]
        public void Enter()
        {
            Engine.Reset(Stage.Root);
            Application.isPlaying = false;
            EditorGUILayout.Typed = null;
        }

        [TearDown]
        public void Leave()
        {
            Application.isPlaying = true;
            Engine.Unload();
        }

        private static SimulationLoop Made(string file, params string[] overrides)
        {
            SimulationLoop loop = new GameObject("Wire").AddComponent<SimulationLoop>();
            loop.Choose(file, overrides, "", isSteered: true);
            return loop;
        }

        // As the Inspector window does it: again and again.
        private static string Draw(SimulationLoop loop)
        {
            LoopInspector inspector = UnityEditor.Editor.Make<LoopInspector>(loop);
            var clock = Stopwatch.StartNew();
            do
            {
                Engine.Labels.Clear();
                inspector.OnInspectorGUI();
                Thread.Sleep(5);
            }
            while (StartCheck.Of(loop).IsAtWork && clock.ElapsedMilliseconds < Patience);
            foreach (string group in new[] { "method", "drive", "" })
            {
                Engine.Labels.Clear();
                Engine.Click = group.Length == 0 ? null : "Parameters: " + group;
                inspector.OnInspectorGUI();
            }
            return string.Join("\n", Engine.Labels);
        }

        [Test]
        public void Inspector_ShowsTheKeysOfTheSolver_WithValuesUnitsAndRanges()
        {
            string text = Draw(Made("params/insertion-accurate.json"));
            Assert.That(text, Does.Contain("timeStep (s) = 0.01\n").And.Contain("a number > 0"));
            Assert.That(text, Does.Not.Contain("constraintSolverSteps"), "a key of pbd");
            Assert.That(Draw(Made("params/insertion.json")),
                Does.Contain("constraintSolverSteps").And.Contain(" = 100\n"));
        }

        [Test]
        public void Inspector_TellsProblemsOfTheStart_BeforePlay()
        {
            string text = Draw(Made("params/insertion-accurate.json", "guidewireOffset=-900"));
            Assert.That(text, Does.StartWith("Error: ").And.Contain("outside"));
            Assert.That(Draw(Made("params/nowhere.json")), Does.Contain("nowhere.json"));
        }

        [Test]
        public void Inspector_WritesOverrides_AndTakesThemBack()
        {
            SimulationLoop loop = Made("params/catheter.json");
            Draw(loop);
            LoopInspector inspector = UnityEditor.Editor.Make<LoopInspector>(loop);
            EditorGUILayout.Typed = ("Catheter 1", "catheter-guide-6f");
            inspector.OnInspectorGUI();
            Assert.That(loop.Overrides, Is.EqualTo(new[] { "catheters[0].instrument=catheter-guide-6f" }));
            Assert.That(Draw(loop), Does.Contain("Catheter 1: catheter-guide-6f"));
            EditorGUILayout.Typed = ("Catheter 1", "(numbers of the parameters)");
            inspector.OnInspectorGUI();
            Assert.That(loop.Overrides, Is.Empty);
        }

        [Test]
        public void Inspector_OfSeveralLoops_HasTheirFieldsAlone()
        {
            Engine.Labels.Clear();
            UnityEditor.Editor.Make<LoopInspector>(Made("params/catheter.json"), Made("params/sheath.json"))
                .OnInspectorGUI();
            Assert.That(Engine.Labels, Is.Empty, "instruments and keys are those of one loop");
        }

        [Test]
        public void TooltipOfAKey_NamesUnitAndRange()
        {
            string tooltip = LoopInspector.Tooltip("timeStep");
            Assert.That(tooltip, Does.Contain("> 0").And.Contain("(s)").And.Contain("0.01"));
        }

        internal static void Call(Type type, string method, params object?[] arguments) =>
            type.GetMethods(BindingFlags.Static | BindingFlags.NonPublic).Single(
                one => one.Name == method && one.GetParameters().Length == arguments.Length).Invoke(null, arguments);

        internal static readonly Type Menu = typeof(LoopInspector).Assembly.GetType("Guidewire.Editor.CreateMenu")!;

        [Test]
        public void MenuMakesAWire_BelowWhatIsSelected_InThePicture()
        {
            var parent = new GameObject("Patient");
            parent.transform.localPosition = new Vector3(1f, 2f, 3f);
            Undo.Created.Clear();
            SceneView.lastActiveSceneView = new SceneView();
            Application.isPlaying = true;
            Call(Menu, "CreateWire", new MenuCommand(parent));
            var made = (GameObject)Selection.activeObject;
            Camera camera = Camera.main;
            Assert.That(Undo.Created, Is.EqualTo(new[] { made, camera.gameObject }), "wire and camera");
            Bounds framed = SceneView.lastActiveSceneView.Framed;
            Assert.That((framed.center - parent.transform.position).magnitude, Is.LessThan(0.05f));
            Assert.That(framed.size.x, Is.EqualTo(0.26f).Within(1e-4f));
            Vector3 towards = framed.center - camera.transform.position;
            Assert.That(towards.magnitude, Is.EqualTo(0.4f).Within(1e-3f), "before Play already");
            Assert.That(Vector3.Dot(towards.normalized, camera.transform.rotation * Vector3.forward),
                Is.EqualTo(1f).Within(1e-4f));
            Assert.That(camera.nearClipPlane, Is.LessThan(0.1f * towards.magnitude));
            Assert.That(made.transform.parent, Is.EqualTo(parent.transform));
            Call(Menu, "CreateWire", new MenuCommand(null));
            Assert.That(camera.GetComponents<OrbitCamera>(), Has.Length.EqualTo(1), "that of the first wire");
        }

        [Test]
        public void MenuMakesFiles_ThatCanBeRead()
        {
            Call(Menu, "CreateParameters");
            Assert.That(ProjectWindowUtil.Last!.Value.Path, Is.EqualTo("Parameters.json"));
            SimulationLoop loop = Made("");
            loop.Choose(new TextAsset(ProjectWindowUtil.Last.Value.Content) { name = "Parameters" });
            loop.Stepping = SteppingMode.Frames;
            loop.Load();
            Assert.That(loop.Problem, Is.Empty);
            loop.Close();
            Call(Menu, "CreateInstrument");
            string folder = Path.Combine(TestContext.CurrentContext.WorkDirectory, "made");
            Directory.CreateDirectory(Path.Combine(folder, "instruments"));
            File.WriteAllText(Path.Combine(folder, "instruments", "mine.json"), ProjectWindowUtil.Last.Value.Content);
            string file = Path.Combine(folder, "p.json");
            File.WriteAllText(file, "{\"solver\": \"direct\", \"instrument\": \"mine\", \"guidewireLength\": 100}");
            loop.Choose(null);
            loop.Choose(file, Array.Empty<string>(), "", false);
            loop.Load();
            Assert.That(loop.Problem, Is.Empty);
            loop.Close();
        }

        [Test]
        public void Gizmos_ShowStartSheathAndTarget_BeforePlay()
        {
            SimulationLoop loop = Made("params/sheath.json");
            loop.transform.localScale = 0.001f * Vector3.one;
            Type gizmos = typeof(LoopInspector).Assembly.GetType("Guidewire.Editor.LoopGizmos")!;
            var clock = Stopwatch.StartNew();
            do
            {
                Gizmos.Drawn.Clear();
                Call(gizmos, "Draw", loop, GizmoType.Selected);
                Thread.Sleep(5);
            }
            while (Gizmos.Drawn.Count == 0 && clock.ElapsedMilliseconds < Patience);
            Assert.That(Gizmos.Drawn[0].From.z, Is.EqualTo(-1.775f).Within(1e-5f));
            Assert.That(Gizmos.Drawn[0].To.z, Is.EqualTo(0.025f).Within(1e-5f));
            Assert.That(Gizmos.Drawn, Has.Some.Matches<(string What, Vector3 From, Vector3 To)>(
                drawn => drawn.What == "line" && Math.Abs(drawn.To.z + 0.005f) < 1e-5f), "the sheath's exit");
        }

        [Test]
        public void LinkerStep_KeepsWhatKeysNameByReflection()
        {
            string text = File.ReadAllText(new LinkerStep().GenerateAdditionalLinkXmlFile(null!, null!));
            Assert.That(text, Does.Contain("Guidewire.Core").And.Contain("Guidewire.Io")
                .And.Contain("preserve=\"all\""));
        }
    }
}

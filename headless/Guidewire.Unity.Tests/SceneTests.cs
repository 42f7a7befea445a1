using System.Linq;
using System.Text.RegularExpressions;

namespace Guidewire.Unity.Tests
{
    /// <summary>The scenes as the package has them: its sample, imported into a project that has nothing else. This
    /// project's own are the same files.</summary>
    public sealed class SceneTests
    {
        private const int Frames = 300;
        private const float Rounding = 1e-3f;    // units: float at 300 units has steps of 3e-5

        private EmptyProject _project = null!;
        private string _sample = "";

        private static IEnumerable<string> Scenes => Stage.Scenes().Select(scene => Path.GetFileName(scene));

        [OneTimeSetUp]
        public void Import()
        {
            _project = new EmptyProject("scenes");
            _sample = _project.Import("Scenes");
        }

        [OneTimeTearDown]
        public void Remove() => _project.Delete();

        [TearDown]
        public void Leave() => Engine.Unload();

        [Test]
        public void InsertionComesFirst_AndThereAreFour()
        {
            Assert.That(Stage.Scenes(), Has.Exactly(4).Items);
            Assert.That(new List<string>(Stage.Scenes())[0], Does.EndWith("Insertion.unity"));
        }

        [Test]
        public void TheSample_HasThisProjectsFiles_AndWhateverTheyReferTo()
        {
            string[] own = Directory.GetFiles(Path.Combine(Stage.Root, "Assets/Scenes"));
            string sample = Path.Combine(_project.Root, _sample);
            Assert.That(Directory.GetFiles(sample), Has.Length.EqualTo(own.Length));
            var known = new HashSet<string>(SceneFile.Seen(_project.Root, "*.meta").Select(file => Guid(file)[0]));
            foreach (string file in own)
            {
                string copy = Path.Combine(sample, Path.GetFileName(file));
                Assert.That(File.ReadAllBytes(copy), Is.EqualTo(File.ReadAllBytes(file)), file);
                foreach (string guid in file.EndsWith(".unity", System.StringComparison.Ordinal) ? Guid(copy)
                    : System.Array.Empty<string>())
                {
                    bool isUnitys = guid.StartsWith("0000000000000000", System.StringComparison.Ordinal);
                    Assert.That(isUnitys || known.Contains(guid), file + " refers to " + guid);
                }
            }
        }

        private static string[] Guid(string file)
        {
            return Regex.Matches(File.ReadAllText(file), "guid: ([0-9a-f]{32})").Select(one => one.Groups[1].Value)
                .ToArray();
        }

        [TestCaseSource(nameof(Scenes))]
        public void Scene_RunsAndItsMeshFollowsTheWire(string scene)
        {
            Stage.Open(_sample + "/" + scene, _project.Root);
            Stage.Frames(1);
            Assert.That(Stage.Loop.Problem, Is.Empty);
            for (int frame = 0; frame < Frames; frame++)
            {
                Stage.Frames(1);
                AssertMeshFollows();
            }
            Assert.That(Stage.Loop.Problem, Is.EqualTo(""));
            Assert.That(Stage.Loop.Session!.Simulation.StepCount, Is.GreaterThan(Frames / 2));
            Assert.That(Engine.Console.FindAll(line => line.Type == LogType.Error), Is.Empty);
        }

        private static readonly object[] Others =
        {
            new object[] { "Own vessel", "OwnVessel.unity", 0.2 },
            new object[] { "Input System", "InputSystem.unity", 0.2 },
            new object[] { "Tracked handle", "TrackedHandle.unity", 0.08 },
        };

        [TestCaseSource(nameof(Others))]
        public void AnotherSample_HasASceneOfItsOwn_ThatIsSteered(string name, string scene, double meters)
        {
            string folder = _project.Import(name);
            string path = folder + "/" + scene;
            Assert.That(SceneRules.Problems(path, File.ReadAllText(Path.Combine(_project.Root, path)),
                SceneFile.Paths(_project.Root)), Is.Empty);
            Stage.Open(path, _project.Root);
            Stage.Frames(2);
            Engine.Press(KeyCode.W);
            if (Engine.Find<InputSystemWire>() is { } device)
            {
                ((UnityEngine.InputSystem.InputAction)typeof(InputSystemWire).GetField("_push",
                    System.Reflection.BindingFlags.Instance | System.Reflection.BindingFlags.NonPublic)!
                    .GetValue(device)!).Value = 1f;
            }
            Stage.Frames(300);
            Assert.That(Stage.Loop.Problem, Is.Empty);
            double expected = scene == "TrackedHandle.unity" ? meters * (0.5 - 0.5 * System.Math.Cos(
                2.0 * System.Math.PI * 5.0 / 12.0)) : meters;
            Assert.That(Stage.Loop.State!.Hub!.Value.Insertion, Is.EqualTo(expected).Within(6e-3), "5 s");
            Assert.That(Engine.Console, Is.Empty);
            Assert.That(Engine.Drawn, Has.Some.Matches<(Mesh Mesh, Matrix4x4 Place, Material Material, int Layer)>(
                one => one.Mesh.name == (name == "Own vessel" ? "Tube" : "Wire")));
            if (Engine.Find<WireAttachment>() is { } tip)
            {
                var points = new Vector3[Stage.Loop.SphereCount];
                Stage.Loop.GetPositions(points);
                Assert.That(Vector3.Distance(tip.transform.position, points[points.Length - 1]), Is.LessThan(1e-6f));
            }
        }

        private static void AssertMeshFollows()
        {
            RodState state = Stage.Shown;
            TubeMesh tube = Stage.Wire.Tube!;
            Mesh mesh = Stage.Wire.Mesh!;
            Vector3[] vertices = mesh.vertices;
            int sides = tube.RingOf(1) - tube.RingOf(0) == 0 ? 0 : (tube.RingOf(1) - tube.RingOf(0)) / 4;
            Assert.That(vertices, Has.Length.EqualTo(tube.Vertices.Length));
            foreach (Vector3 vertex in vertices)
            {
                Assert.That(vertex.IsFinite(), Is.True);
            }
            for (int i = 0; i < state.SphereCount; i++)
            {
                Vector3 sum = Vector3.zero;
                for (int k = 0; k < sides; k++)
                {
                    sum += vertices[tube.RingOf(i) + k];
                }
                Assert.That(Vector3.Distance(sum / sides, state.Positions[i].ToUnity()), Is.LessThan(Rounding));
            }
        }
    }
}

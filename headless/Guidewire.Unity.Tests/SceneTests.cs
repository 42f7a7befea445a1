namespace Guidewire.Unity.Tests
{
    public sealed class SceneTests
    {
        private const int Frames = 300;
        private const float Rounding = 1e-3f;    // units: float at 300 units has steps of 3e-5

        private static IEnumerable<string> Scenes => Stage.Scenes();

        [TearDown]
        public void Leave()
        {
            Engine.Unload();
        }

        [Test]
        public void InsertionComesFirst_AndThereAreFour()
        {
            Assert.That(Stage.Scenes(), Has.Exactly(4).Items);
            Assert.That(new List<string>(Stage.Scenes())[0], Does.EndWith("Insertion.unity"));
        }

        [TestCaseSource(nameof(Scenes))]
        public void Scene_RunsAndItsMeshFollowsTheWire(string scene)
        {
            Stage.Open(scene);
            for (int frame = 0; frame < Frames; frame++)
            {
                Stage.Frames(1);
                AssertMeshFollows();
            }
            Assert.That(Stage.Loop.Problem, Is.EqualTo(""));
            Assert.That(Stage.Loop.Session!.Simulation.StepCount, Is.GreaterThan(Frames / 2));
            Assert.That(Engine.Console.FindAll(line => line.Type == LogType.Error), Is.Empty);
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

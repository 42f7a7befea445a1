using System;
using System.Linq;
using Guidewire.Io;

namespace Guidewire.Unity.Tests
{
    /// <summary>The lines of plain C# in docs/unity.md and in the manual, as they stand there.</summary>
    public sealed class PlainCodeTests
    {
        // A closed box from -100 to 100 along z.
        private static readonly Vector3d[] Corners = Enumerable.Range(0, 8).Select(k => new Vector3d(
            k % 2 == 0 ? -8.0 : 8.0, k / 2 % 2 == 0 ? -8.0 : 8.0, k / 4 == 0 ? -100.0 : 100.0)).ToArray();

        private static readonly int[] Sides =
        {
            0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5,
        };

        private static Simulation Build(Vector3d[] vertices, int[] triangles, double start)
        {
            // begin
            SimulationParameters parameters = SimulationParameters.DefaultsOf(Solver.Direct);
            parameters.Scene.GuidewireOffset = start;
            parameters.Scene.GuidewireLength = 80.0;
            parameters.Scene.NumberRodElements = 16;
            parameters.Scene.ProximalEnd = ProximalEnd.Clamped;
            parameters.Method.Integrator = MethodTable.Of(Solver.Direct).IntegratorBetweenWalls!.Value;
            parameters.Drive.Steering = new Steering { Push = 0.5 };
            TriangleMesh mesh = TriangleMesh.Create(vertices, triangles, Array.Empty<Vector3d>());
            parameters.Scene.Walls = new ContactShape[] { new MeshShape(mesh) };
            Simulation simulation = Simulation.Create(parameters);
            simulation.Step();
            // end
            return simulation;
        }

        [Test]
        public void TheLines_PushAWireInAMesh()
        {
            Simulation simulation = Build(Corners, Sides, -90.0);
            for (int k = 1; k < 20; k++)
            {
                simulation.Step();
            }
            Assert.That(simulation.State.Positions[0].Z, Is.EqualTo(-80.0).Within(0.1), "20 steps of half a unit");
            Assert.That(simulation.State.Positions[16].Z, Is.EqualTo(0.0).Within(0.5));
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Running));
        }

        [Test]
        public void AWireThatStartsOutside_IsRefused()
        {
            ArgumentException error = Assert.Throws<ArgumentException>(() => Build(Corners, Sides, -300.0))!;
            Assert.That(error.Message, Does.Contain("outside"));
        }

        [Test]
        public void TheLinesOfAWholeRun_LeaveItsResults()
        {
            string file = Path.Combine(Stage.Root, "params/default.json");
            string folder = Path.Combine(TestContext.CurrentContext.WorkDirectory, "five-lines");
            // five
            CommandLine line = CommandLineHandler.Read(new[] { "-parameters", file, "-out", folder }, false);
            ParameterHandler handler = ParameterHandler.Load(line.ParameterFile, new[] { "maxSimulationSteps=20" });
            var run = new SimulationRun(handler, line.Out, null);
            RunResult result = run.Execute(Existing.Replace);
            Debug.Log(result.Outcome + ": " + result.Reason);
            // end
            Assert.That(result.Outcome, Is.EqualTo(Outcome.Finished));
            Assert.That(File.ReadAllText(Path.Combine(folder, "positions.json")), Does.Contain("20"));
        }

        [TestCase("begin", 11, "docs/unity.md")]
        [TestCase("five", 5, "Assets/Guidewire/Documentation~/index.md")]
        public void ThePageShowsTheLines(string marker, int count, string page)
        {
            string own = File.ReadAllText(Path.Combine(Stage.Root, "headless/Guidewire.Unity.Tests/PlainCodeTests.cs"));
            string[] lines = own.Split('\n').SkipWhile(line => line.Trim() != "// " + marker).Skip(1)
                .TakeWhile(line => line.Trim() != "// end").Select(line => line.Trim()).ToArray();
            Assert.That(lines.Length, Is.EqualTo(count));
            Assert.That(File.ReadAllText(Path.Combine(Stage.Root, page)),
                Does.Contain(string.Join("\n", lines)));
        }
    }
}

namespace Guidewire.Unity.Tests
{
    /// <summary>What a user can do wrong: the scene stops with a message on the screen and in the console, and a reset
    /// makes it usable again.</summary>
    public sealed class TroubleTests
    {
        [SetUp]
        public void Open() => Stage.OpenInsertion();

        [TearDown]
        public void Leave() => Engine.Unload();

        private static void AssertStopped(string words)
        {
            Stage.Frames(2);
            Assert.That(Stage.Loop.Problem, Does.Contain(words));
            Assert.That(string.Join("\n", Engine.Labels), Does.Contain("STOPPED").And.Contain(words));
            Stage.AssertLogged(LogType.Error, words);
            int errors = Engine.Console.FindAll(line => line.Type == LogType.Error).Count;
            Stage.Frames(30);
            Assert.That(Engine.Console.FindAll(line => line.Type == LogType.Error), Has.Count.EqualTo(errors),
                "said once, not every frame");
        }

        private static void AssertResetWorks()
        {
            Stage.Loop.Choose("params/default.json", System.Array.Empty<string>(), "", false);
            Stage.Tap(KeyCode.R);
            Stage.Frames(20);
            Assert.That(Stage.Loop.Problem, Is.EqualTo(""));
            Assert.That(Stage.Loop.Session!.Simulation.StepCount, Is.GreaterThan(0));
            Assert.That(string.Join("\n", Engine.Labels), Does.Not.Contain("STOPPED"));
        }

        [Test]
        public void MissingParameterFile()
        {
            Stage.Loop.Choose("params/nowhere.json", System.Array.Empty<string>(), "", false);
            AssertStopped("nowhere.json");
            Assert.That(Stage.Loop.Session, Is.Null);
            AssertResetWorks();
        }

        [Test]
        public void FileThatIsNotJson()
        {
            string file = Path.Combine(TestContext.CurrentContext.WorkDirectory, "broken.json");
            File.WriteAllText(file, "{\"timeStep\": 0.01,}");
            Stage.Loop.Choose(file, System.Array.Empty<string>(), "", false);
            AssertStopped("broken.json");
            AssertResetWorks();
        }

        [TestCase("timeStep=0", "timeStep")]
        [TestCase("numberRodElements=0", "numberRodElements")]
        [TestCase("timestep=0.01", "did you mean '-timeStep'")]
        [TestCase("timeStep", "is not KEY=VALUE")]
        public void OverrideThatIsNotAllowed(string line, string words)
        {
            Stage.Loop.Choose("params/default.json", new[] { line }, "", false);
            AssertStopped(words);
            AssertResetWorks();
        }

        [TestCase("NaN")]
        [TestCase("-1.0")]
        [TestCase("0")]
        public void LiveValueOutOfRange(string value)
        {
            Stage.Frames(5);
            Stage.Loop.Set("timeStep", value);
            AssertStopped("timeStep");
            AssertResetWorks();
        }

        [Test]
        public void DivergedRun()
        {
            string[] beyond = { "stretchStiffness=2.1", "displacementDirection=[0,1,0]" };
            Stage.Loop.Choose("params/default.json", beyond, "", false);
            for (int k = 0; k < 2000 && Stage.Loop.Problem.Length == 0; k++)
            {
                Stage.Frames(1);
            }
            AssertStopped("diverged");
            Assert.That(Stage.Loop.Session!.Simulation.Outcome, Is.EqualTo(Outcome.Diverged));
            AssertResetWorks();
        }

        [Test]
        public void LogFolderThatCannotBeWritten()
        {
            string file = Path.Combine(TestContext.CurrentContext.WorkDirectory, "a-file");
            File.WriteAllText(file, "");
            Stage.Loop.Choose("params/default.json", System.Array.Empty<string>(), Path.Combine(file, "log"),
                false);
            AssertStopped("cannot be written");
            AssertResetWorks();
        }

        [Test]
        public void ConvergedRun_IsSaidWithoutAnError()
        {
            Stage.Loop.Choose("params/default.json", new[] { "maxSimulationSteps=3" }, "", false);
            Stage.Frames(30);
            Assert.That(Stage.Loop.Problem, Is.EqualTo(""));
            Stage.AssertLogged(LogType.Log, "finished");
            Assert.That(string.Join("\n", Engine.Labels), Does.Contain("finished"));
        }
    }
}

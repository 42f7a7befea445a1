using System;
using System.Diagnostics;
using System.Linq;
using System.Reflection;
using System.Text.RegularExpressions;
using Guidewire.Editor;
using Newtonsoft.Json.Linq;

namespace Guidewire.Unity.Tests
{
    /// <summary>Runs without frames: the same results and exit codes as the console program's.</summary>
    public sealed class BatchTests
    {
        private static readonly Regex WallTime = new Regex("\"elapsedMilliseconds\": [^,]+");

        private string _folder = "";

        [SetUp]
        public void Make()
        {
            Engine.Reset(Stage.Root);
            _folder = Path.Combine(Path.GetTempPath(), "guidewire-" + Guid.NewGuid().ToString("N"));
            Directory.CreateDirectory(_folder);
        }

        [TearDown]
        public void Clean()
        {
            Engine.Unload();
            Directory.Delete(_folder, true);
        }

        private static string Parameters(string name) => Path.Combine(Stage.Root, "params", name);

        private static string[] Unity(params string[] own)
        {
            var all = new List<string> { "Unity", "-batchmode", "-logFile", "-", "-projectPath", ".", "-guidewire" };
            all.AddRange(own);
            return all.ToArray();
        }

        private static string[] With(string[] own, string folder) => new List<string>(own) { "-out", folder }.ToArray();

        /// <summary>The console program as it was built: it is in Tests.slnf.</summary>
        private static int Console(params string[] own)
        {
            string folder = Path.GetFileName(TestContext.CurrentContext.TestDirectory.TrimEnd('/', '\\'));
            string configuration = Path.GetFileName(Path.GetDirectoryName(TestContext.CurrentContext.TestDirectory))!;
            var start = new ProcessStartInfo("dotnet") { RedirectStandardOutput = true, RedirectStandardError = true };
            start.ArgumentList.Add(Path.Combine(Stage.Root, "headless", "Guidewire.Cli", "bin",
                configuration, folder, "Guidewire.Cli.dll"));
            foreach (string argument in own)
            {
                start.ArgumentList.Add(argument);
            }
            using Process process = Process.Start(start)!;
            process.StandardError.ReadToEnd();
            process.WaitForExit();
            return process.ExitCode;
        }

        private static JObject Summary(string folder)
        {
            JObject summary = JObject.Parse(File.ReadAllText(Path.Combine(folder, "summary.json")));
            foreach (string wall in new[]
            {
                "setUpTime", "computationTime", "wallTime", "averageStepTime", "medianStepTime",
            })
            {
                Assert.That(summary.Remove(wall), Is.True, wall);
            }
            return summary;
        }

        [TestCase("default.json", 200)]
        [TestCase("transversal.json", 100)]
        public void BatchEntry_GivesTheConsoleProgramsLog_InAllButWallTimes(string file, int steps)
        {
            string unity = Path.Combine(_folder, "unity");
            string console = Path.Combine(_folder, "console");
            string count = steps.ToString(System.Globalization.CultureInfo.InvariantCulture);
            string[] own =
            {
                "-parameters", Parameters(file), "-maxSimulationSteps", count, "-logOrientations", "true",
            };
            Assert.That(BatchRun.Execute(Unity(With(own, unity))), Is.EqualTo(0));
            Assert.That(Console(With(own, console)), Is.EqualTo(0));
            string[] here = File.ReadAllLines(Path.Combine(unity, "positions.json"));
            string[] there = File.ReadAllLines(Path.Combine(console, "positions.json"));
            Assert.That(here, Has.Length.EqualTo(there.Length).And.Length.GreaterThan(steps));
            for (int k = 0; k < here.Length; k++)
            {
                Assert.That(WallTime.Replace(here[k], ""), Is.EqualTo(WallTime.Replace(there[k], "")), "line " + k);
            }
            Assert.That(File.ReadAllText(Path.Combine(unity, "parameters.json")),
                Is.EqualTo(File.ReadAllText(Path.Combine(console, "parameters.json"))));
            Assert.That(Summary(unity), Is.EqualTo(Summary(console)));
        }

        [Test]
        public void LoggedScene_GivesTheConsoleProgramsLog_WhenNobodySteers()
        {
            string scene = Path.Combine(_folder, "scene");
            string console = Path.Combine(_folder, "console");
            Stage.Open("Assets/Scenes/Longitudinal.unity");
            Stage.Loop.Choose(Parameters("default.json"), new[] { "maxSimulationSteps=60" }, scene, false);
            Stage.Frames(400);
            Assert.That(Stage.Loop.Session!.Simulation.StepCount, Is.EqualTo(60));
            Engine.Unload();
            string[] own = { "-parameters", Parameters("default.json"), "-maxSimulationSteps", "60" };
            Assert.That(Console(With(own, console)), Is.EqualTo(0));
            Assert.That(WallTime.Replace(File.ReadAllText(Path.Combine(scene, "positions.json")), ""),
                Is.EqualTo(WallTime.Replace(File.ReadAllText(Path.Combine(console, "positions.json")), "")));
            Assert.That(Summary(scene), Is.EqualTo(Summary(console)));
        }

        [Test]
        public void SteeredScene_LogsThatItsParametersDidNotMakeIt()
        {
            string scene = Path.Combine(_folder, "scene");
            Stage.OpenInsertion();
            Stage.Loop.Choose(Parameters("default.json"), new[] { "displacement=0", "deltaThreshold=0" }, scene, true);
            Engine.Press(KeyCode.W);
            Stage.Frames(20);
            int steps = Stage.Loop.Session!.Simulation.StepCount;
            Engine.Unload();
            JObject summary = Summary(scene);
            Assert.That((string?)summary["outcome"], Is.EqualTo("interrupted"));
            Assert.That((int)summary["steps"]!, Is.EqualTo(steps));
            Assert.That(summary["parameterHash"]!.Type, Is.EqualTo(JTokenType.Null));
            Assert.That((string?)summary["notes"]![0], Does.Contain("steered by hand"));
        }

        [TestCase(2, "-parameters is missing", "-out")]
        [TestCase(2, "nowhere.json", "-parameters", "nowhere.json", "-out", "OUT")]
        [TestCase(2, "timeStep", "-timeStep", "0", "-out", "OUT")]
        [TestCase(2, "unknown key '-logFile'", "-logFile", "x", "-out", "OUT")]
        [TestCase(2, "no folder for the results", "-timeStep", "0.01")]
        [TestCase(4, "diverged", "-stretchStiffness", "2.1", "-displacementDirection", "[0,1,0]", "-out", "OUT")]
        [TestCase(0, "finished", "-maxSimulationSteps", "2", "-out", "OUT")]
        public void ExitCode_IsThatOfTheOutcome(int code, string words, params string[] own)
        {
            int place = Array.IndexOf(own, "OUT");
            if (place >= 0)
            {
                own[place] = Path.Combine(_folder, "run");
            }
            Assert.That(BatchRun.Execute(Unity(own)), Is.EqualTo(code));
            if (words != "-parameters is missing")
            {
                Assert.That(Engine.Console.Exists(line => line.Text.Contains(words)), Is.True,
                    string.Join(" | ", Engine.Console));
            }
            Assert.That(Directory.Exists(Path.Combine(_folder, "run")), Is.EqualTo(code != 2), "nothing half-written");
        }

        [Test]
        public void WithoutTheMarker_NothingIsRun()
        {
            Assert.That(BatchRun.Execute(new[] { "Unity", "-batchmode" }), Is.EqualTo(2));
            Stage.AssertLogged(LogType.Error, "-guidewire is missing");
        }

        [TestCase("3", 0)]
        [TestCase("-3", 2)]
        public void PlayerInBatchMode_RunsAndEndsWithTheExitCode(string steps, int code)
        {
            Application.isBatchMode = true;
            Application.isEditor = false;
            PlayerBatch.Run(Unity("-maxSimulationSteps", steps, "-out", Path.Combine(_folder, "run")));
            Assert.That(Engine.ExitCode, Is.EqualTo(code));
        }

        [Test]
        public void APlayer_AsksForARun_BeforeItsFirstScene()
        {
            MethodInfo method = Engine.Initializers(typeof(PlayerBatch).Assembly).Single();
            Assert.That(method.DeclaringType, Is.EqualTo(typeof(PlayerBatch)));
            Assert.That(method.GetCustomAttribute<RuntimeInitializeOnLoadMethodAttribute>()!.loadType,
                Is.EqualTo(RuntimeInitializeLoadType.BeforeSceneLoad));
            method.Invoke(null, null);
            Assert.That(Engine.ExitCode, Is.Null, "this process has no -guidewire among its arguments");
        }

        [TestCase(false, false)]
        [TestCase(true, true)]
        public void PlayerWithAScreen_AndTheEditor_AreLeftAlone(bool isBatch, bool isEditor)
        {
            Application.isBatchMode = isBatch;
            Application.isEditor = isEditor;
            PlayerBatch.Run(Unity("-maxSimulationSteps", "3", "-out", Path.Combine(_folder, "run")));
            Assert.That(Engine.ExitCode, Is.Null);
            Assert.That(Directory.Exists(Path.Combine(_folder, "run")), Is.False);
        }

        [Test]
        public void EditorEntry_AlwaysEndsTheEditor()
        {
            BatchEntry.Run();
            Assert.That(Engine.ExitCode, Is.EqualTo(2), "this process has no -guidewire among its arguments");
        }

        [Test]
        public void FullDisk_IsFailedNotFinished()
        {
            if (!File.Exists("/dev/full"))
            {
                Assert.Ignore("needs /dev/full");
            }
            string run = Path.Combine(_folder, "run");
            Directory.CreateDirectory(run);
            File.CreateSymbolicLink(Path.Combine(run, "positions.json.partial"), "/dev/full");
            int code = BatchRun.Execute(Unity("-maxSimulationSteps", "100", "-out", run));
            Assert.That(code, Is.EqualTo(5));
            Stage.AssertLogged(LogType.Error, "failed");
        }
    }
}

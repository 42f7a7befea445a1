using Guidewire.Editor;
using UnityEditor;
using UnityEditor.Build.Reporting;

namespace Guidewire.Unity.Tests
{
    public sealed class PlayerBuildTests
    {
        private string _before = "";

        [SetUp]
        public void Enter()
        {
            Engine.Reset(Stage.Root);
            Application.isBatchMode = true;
            _before = Directory.GetCurrentDirectory();
            string project = Path.Combine(TestContext.CurrentContext.WorkDirectory, "project");
            Directory.CreateDirectory(Path.Combine(project, "params", "vessels"));
            File.WriteAllText(Path.Combine(project, "params", "a.json"), "{}");
            File.WriteAllText(Path.Combine(project, "params", "vessels", "b.obj"), "");
            Directory.CreateDirectory(Path.Combine(project, "instruments"));
            File.WriteAllText(Path.Combine(project, "instruments", "c.json"), "{}");
            Directory.SetCurrentDirectory(project);
            EditorBuildSettings.scenes = new[]
            {
                new EditorBuildSettingsScene("One.unity", true), new EditorBuildSettingsScene("Two.unity", false),
            };
        }

        [TearDown]
        public void Leave() => Directory.SetCurrentDirectory(_before);

        [Test]
        public void Linux_TakesTheEnabledScenesTheParametersAndTheInstruments()
        {
            BuildPipeline.Next = BuildResult.Succeeded;
            PlayerBuild.Linux();
            Assert.That(Engine.ExitCode, Is.EqualTo(0));
            Assert.That(BuildPipeline.Last.scenes, Is.EqualTo(new[] { "One.unity" }));
            Assert.That(BuildPipeline.Last.target, Is.EqualTo(BuildTarget.StandaloneLinux64));
            Assert.That(File.Exists("Build/Linux/params/a.json"), Is.True);
            Assert.That(File.Exists("Build/Linux/params/vessels/b.obj"), Is.True);
            Assert.That(File.Exists("Build/Linux/instruments/c.json"), Is.True);
        }

        [Test]
        public void AProjectWithoutTheFolders_IsBuiltAllTheSame()
        {
            Directory.Delete("params", true);
            Directory.Delete("instruments", true);
            BuildPipeline.Next = BuildResult.Succeeded;
            PlayerBuild.Linux();
            Assert.That(Engine.ExitCode, Is.EqualTo(0));
        }

        [TestCase(BuildResult.Failed)]
        [TestCase(BuildResult.Cancelled)]
        [TestCase(BuildResult.Unknown)]
        [TestCase(null)]
        public void FailedBuild_NeverEndsWith0(BuildResult? result)
        {
            BuildPipeline.Next = result;
            PlayerBuild.Windows();
            Assert.That(Engine.ExitCode, Is.EqualTo(70));
        }
    }
}

using System.Reflection;
using System.Text.RegularExpressions;
using Guidewire.Io;
using UnityEngine.TestTools;

namespace Guidewire.Unity.Tests
{
    /// <summary>The stand-in does what Unity does where a test that passes here could fail there.</summary>
    public sealed class StandInTests
    {
        [SetUp]
        public void Enter()
        {
            Engine.Reset(Stage.Root);
            LogAssert.Begin();
        }

        [TearDown]
        public void Leave()
        {
            LogAssert.Begin();
            Engine.Unload();
        }

        [TestCase(LogType.Error, "unhandled log: broken")]
        [TestCase(LogType.Warning, "")]
        public void LogAssert_FailsOnAnErrorThatNobodyExpected(LogType type, string problem)
        {
            Engine.Write(type, "broken");
            Assert.That(LogAssert.Problem(), Is.EqualTo(problem));
        }

        [Test]
        public void LogAssert_FailsOnALineThatDidNotCome()
        {
            LogAssert.Expect(LogType.Error, new Regex("timeStep"));
            Assert.That(LogAssert.Problem(), Does.Contain("did not appear").And.Contain("timeStep"));
            Debug.LogError("timeStep = -1");
            Assert.That(LogAssert.Problem(), Is.Empty);
            Debug.LogError("timeStep = -1");
            Assert.That(LogAssert.Problem(), Does.StartWith("unhandled log"), "one expectation takes one line");
        }

        [Test]
        public void Destroy_IsAnErrorInEditMode_AndWorksInPlayMode()
        {
            Application.isPlaying = false;
            var kept = new GameObject("kept");
            UnityEngine.Object.Destroy(kept);
            Assert.That(kept == null, Is.False);
            Assert.That(LogAssert.Problem(), Does.Contain("edit mode"));
            Application.isPlaying = true;
            UnityEngine.Object.Destroy(kept);
            Assert.That(kept == null, Is.True);
        }

        [Test]
        public void UnitysObjects_AreTheMainThreadsAlone()
        {
            var made = new GameObject("made");
            var text = new TextAsset("x");
            foreach (TestDelegate call in new TestDelegate[]
            {
                () => _ = new Mesh(), () => _ = made.transform, () => _ = text.text, () => _ = Time.deltaTime,
                () => _ = Application.dataPath, () => Resources.Load<Material>("Guidewire/Wire"),
            })
            {
                System.Exception? thrown = null;
                var other = new System.Threading.Thread(() => thrown = Assert.Catch(call));
                other.Start();
                other.Join();
                Assert.That(thrown, Is.TypeOf<UnityException>());
            }
        }

        [Test]
        public void LogsNameTheVersionOfTheSources()
        {
            string built = typeof(RunSummary).Assembly.GetCustomAttribute<AssemblyInformationalVersionAttribute>()!
                .InformationalVersion;
            Assert.That(RunSummary.Version, Is.EqualTo(built));
            Assert.That(typeof(Guidewire.Core.Simulation).Assembly.GetName().Version!.ToString(3), Is.EqualTo(built));
        }
    }
}

using System.Reflection;
using System.Text.RegularExpressions;
using Guidewire.Io;
using UnityEngine.Serialization;
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
        public void SceneFile_HonoursFormerNames()
        {
            string root = Path.Combine(TestContext.CurrentContext.WorkDirectory, "former");
            Directory.CreateDirectory(Path.Combine(root, "Assets"));
            string guid = new string('a', 32);
            File.WriteAllText(Path.Combine(root, "Assets", "Renamed.cs.meta"), "guid: " + guid + "\n");
            File.WriteAllText(Path.Combine(root, "Assets", "A.unity"), "--- !u!1 &1\nGameObject:\n  m_Component:\n"
                + "  - component: {fileID: 2}\n  - component: {fileID: 3}\n  m_Name: A\n--- !u!4 &2\nTransform:\n"
                + "  m_LocalPosition: {x: 0, y: 0, z: 0}\n--- !u!114 &3\nMonoBehaviour:\n"
                + "  m_Script: {fileID: 11500000, guid: " + guid + ", type: 3}\n  _older: 2.5\n");
            List<GameObject> objects = SceneFile.Read(root, "Assets/A.unity", typeof(Renamed).Assembly);
            Assert.That(objects[0].GetComponent<Renamed>().Newer, Is.EqualTo(2.5f));
        }

        [Test]
        public void LogsNameTheVersionOfTheSources()
        {
            string built = typeof(RunSummary).Assembly.GetCustomAttribute<AssemblyInformationalVersionAttribute>()!
                .InformationalVersion;
            Assert.That(RunSummary.Version, Is.EqualTo(built));
            Assert.That(typeof(Guidewire.Core.Simulation).Assembly.GetName().Version!.ToString(3), Is.EqualTo(built));
        }

        internal sealed class Renamed : MonoBehaviour
        {
            [FormerlySerializedAs("_older"), SerializeField] private float _newer = 1f;

            public float Newer => _newer;
        }
    }
}

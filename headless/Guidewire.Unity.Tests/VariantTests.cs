using System;
using System.Globalization;
using System.Text.RegularExpressions;

namespace Guidewire.Unity.Tests
{
    /// <summary>Variants of the package's prefab in a project of somebody else, in the form in which Unity writes
    /// them: what is not as in the prefab stands by the path of its field.</summary>
    public sealed class VariantTests
    {
        private const string Variant = "11111111111111111111111111111111";
        private const string Room = "22222222222222222222222222222222";
        private const string Instance = "&1000\nPrefabInstance:\n  m_ObjectHideFlags: 0\n  serializedVersion: 2\n"
            + "  m_Modification:\n    serializedVersion: 3\n";
        private const string Head = "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n";

        private static readonly string Prefab = Path.Combine(Stage.Root,
            "Assets/Guidewire/Prefabs/WireInVessel.prefab");

        private EmptyProject _project = null!;

        [SetUp]
        public void Make()
        {
            _project = new EmptyProject("variants");
            string source = GuidOf(Prefab);
            string changes = Change(102, "_pace", "0.5") + Change(102, "_overrides.Array.size", "1")
                + Change(102, "_overrides.Array.data[0]", "numberRodElements=12")
                + Change(101, "m_LocalPosition.y", "3");
            _project.Write("Assets/Variant.prefab", Head + "--- !u!1001 " + Instance
                + "    m_TransformParent: {fileID: 0}\n    m_Modifications:\n" + changes
                + "    m_RemovedComponents:\n    - {fileID: 103, guid: " + source + ", type: 3}\n"
                + "    m_RemovedGameObjects: []\n    m_AddedGameObjects: []\n    m_AddedComponents:\n"
                + "    - targetCorrespondingSourceObject: {fileID: 100, guid: " + source + ", type: 3}\n"
                + "      insertIndex: -1\n      addedObject: {fileID: 2001}\n"
                + "  m_SourcePrefab: {fileID: 100100000, guid: " + source + ", type: 3}\n"
                + Stripped(1, 2000, "GameObject", 100, source)
                + "--- !u!114 &2001\nMonoBehaviour:\n  m_ObjectHideFlags: 0\n  m_GameObject: {fileID: 2000}\n"
                + "  m_Enabled: 1\n  m_Script: {fileID: 11500000, guid: "
                + GuidOf(Path.Combine(Stage.Root, "Assets/Guidewire/Runtime/Views/Hud.cs")) + ", type: 3}\n"
                + "  _loop: {fileID: 0}\n", Variant);
            // A room of twice the size with the variant in it: of the variant's objects the ids are mixed with its own.
            string wire = PrefabInstanceId(101, 1000);
            _project.Write("Assets/Room.prefab", Head
                + "--- !u!1 &1\nGameObject:\n  m_Component:\n  - component: {fileID: 2}\n  m_Name: Room\n"
                + "--- !u!4 &2\nTransform:\n  m_GameObject: {fileID: 1}\n  m_LocalPosition: {x: 1, y: 0, z: 0}\n"
                + "  m_LocalScale: {x: 2, y: 2, z: 2}\n"
                + "--- !u!1001 " + Instance + "    m_TransformParent: {fileID: 2}\n    m_Modifications:\n"
                + Change(PrefabInstanceId(102, 1000), "_overrides.Array.data[0]", "numberRodElements=16", Variant)
                + Change(wire, "m_LocalPosition.y", "1", Variant)
                + "    m_RemovedComponents: []\n"
                + "  m_SourcePrefab: {fileID: 100100000, guid: " + Variant + ", type: 3}\n", Room);
        }

        [TearDown]
        public void Leave()
        {
            Engine.Unload();
            _project.Delete();
        }

        private static string GuidOf(string file)
        {
            return Regex.Match(File.ReadAllText(file + ".meta"), "guid: (\\w+)").Groups[1].Value;
        }

        private static string Change(object target, string path, string value, string? source = null)
        {
            return string.Format(CultureInfo.InvariantCulture, "    - target: {{fileID: {0}, guid: {1}, type: 3}}\n"
                + "      propertyPath: {2}\n      value: {3}\n      objectReference: {{fileID: 0}}\n", target,
                source ?? GuidOf(Prefab), path, value);
        }

        private static string Stripped(int type, int id, string name, int source, string prefab)
        {
            return "--- !u!" + type + " &" + id + " stripped\n" + name + ":\n  m_CorrespondingSourceObject: {fileID: "
                + source + ", guid: " + prefab + ", type: 3}\n  m_PrefabInstance: {fileID: 1000}\n";
        }

        // Unity's rule for what stands in a nested prefab.
        private static string PrefabInstanceId(long source, long instance)
        {
            return ((source ^ instance) & long.MaxValue).ToString(CultureInfo.InvariantCulture);
        }

        private SimulationLoop Play(string prefab)
        {
            Engine.Reset(_project.Root);
            List<GameObject> objects = SceneFile.Read(_project.Root, prefab, typeof(SimulationLoop).Assembly);
            SimulationLoop loop = objects.ConvertAll(one => one.GetComponent<SimulationLoop>()).Find(one => one)!;
            loop.Stepping = SteppingMode.Frames;
            Engine.Enter(objects);
            Engine.Press(KeyCode.W);
            Stage.Frames(61);
            Assert.That(loop.Problem, Is.Empty);
            Assert.That(Engine.Console.FindAll(line => line.Type == LogType.Error), Is.Empty);
            return loop;
        }

        [Test]
        public void AVariant_HasItsFields_ItsAddedComponent_AndNotTheRemovedOne()
        {
            SimulationLoop loop = Play("Assets/Variant.prefab");
            Assert.That(loop.SphereCount, Is.EqualTo(13), "an override that the prefab has not");
            Assert.That(loop.State!.Time, Is.EqualTo(0.5).Within(0.03), "half the pace");
            Assert.That(loop.GetComponent<KeyInput>() == null, Is.True);
            Assert.That(loop.State.Hub!.Value.Insertion, Is.Zero, "nothing reads the key");
            loop.Push = 1f;
            Stage.Frames(60);
            Assert.That(loop.State.Hub!.Value.Insertion, Is.EqualTo(0.5 * 0.04).Within(0.002), "scripts still steer");
            Hud hud = loop.GetComponent<Hud>();
            hud.Refresh();
            Assert.That(hud.Loop, Is.EqualTo(loop));
            Assert.That(hud.Text, Does.Contain("hub: "));
            Assert.That(loop.transform.position.y, Is.EqualTo(3f));
            Assert.That(Engine.Drawn, Is.Not.Empty, "its views are the prefab's");
        }

        [Test]
        public void ThePrefabItself_IsAsItWas()
        {
            SimulationLoop loop = Play("Packages/org.guidewire.simulation/Prefabs/WireInVessel.prefab");
            Assert.That(loop.SphereCount, Is.EqualTo(25));
            Assert.That(loop.State!.Hub!.Value.Insertion, Is.EqualTo(0.04).Within(0.002));
        }

        [Test]
        public void AVariantWithinAPrefab_IsOverriddenOnceMore_AndHangsBelowIt()
        {
            SimulationLoop loop = Play("Assets/Room.prefab");
            Assert.That(loop.SphereCount, Is.EqualTo(17));
            Assert.That(loop.transform.parent.gameObject.name, Is.EqualTo("Room"));
            var positions = new Vector3[17];
            loop.GetPositions(positions);
            Vector3 last = loop.Shown!.Rod.Positions[16].ToUnity();
            Vector3 expected = new Vector3(1f, 2f, 0f) + 0.002f * last;
            Assert.That((positions[16] - expected).magnitude, Is.LessThan(1e-5f),
                "millimetres in a room of twice the size");
            Assert.That(loop.GetComponent<KeyInput>() == null, Is.True, "as in the variant");
        }
    }
}

using System.Linq;
using System.Text.RegularExpressions;

namespace Guidewire.Unity.Tests
{
    public sealed class SceneRuleTests
    {
        private const string Insertion = "Assets/Scenes/Insertion.unity";
        private const string Prefab = "Assets/Guidewire/Prefabs/WireInVessel.prefab";

        private static readonly Dictionary<string, string> Assets = SceneFile.Paths(Stage.Root);

        private static readonly string Hud = GuidOf("Hud.cs");

        private static string GuidOf(string file) => Assets.Single(asset => Path.GetFileName(asset.Value) == file).Key;

        private static IReadOnlyList<string> Problems(string path, string text) =>
            SceneRules.Problems(path, text, Assets);

        [Test]
        public void EveryFile_KeepsEveryRule()
        {
            string[] files = new[] { "*.unity", "*.prefab", "*.mat", "*.asset" }
                .SelectMany(ending => SceneFile.Seen(Stage.Root, ending))
                .Concat(Directory.GetFiles(Path.Combine(Stage.Root, "ProjectSettings"), "*.asset")).ToArray();
            Assert.That(files, Has.Length.GreaterThanOrEqualTo(10));
            foreach (string file in files)
            {
                Assert.That(Problems(file, File.ReadAllText(file)), Is.Empty, file);
            }
        }

        [TestCase("  _pace: 1", "  _pace 1", "line ")]
        [TestCase("  _pace: 1\n", "  _pace: 1\n  _pace: 1\n", "_pace stands twice")]
        [TestCase("--- !u!1 &200", "--- !u!1 &101", "used twice")]
        [TestCase(@"_hud: \{fileID: 304\}", "_hud: {fileID: 3040}", "is not in this file")]
        [TestCase("guid: HUD", "guid: 33333333333333333333333333333333", "belongs to no asset")]
        [TestCase("HUD, type: 3", "HUD, type: 2", "is no reference to a file such as Hud.cs")]
        [TestCase(@"\{fileID: 11500000", "{fileID: 1150000", "is no reference to a file")]
        [TestCase(@"\{fileID: 4900000", "{fileID: 490000", "is no reference to a file")]
        [TestCase("guid: HUD", "guid: TUBE", "TubeMesh is no behaviour")]
        [TestCase("_distance: ", "_distanse: ", "OrbitCamera stores no field _distanse")]
        [TestCase(@"--- !u!157 &3\n.*?(?=---)", "", "settings missing")]
        [TestCase(@"(  - component: \{fileID: 401\}\n)(  - component: \{fileID: 402\}\n)", "$2$1", "is no Transform")]
        [TestCase(@"(  - component: \{fileID: 402\}\n)", "$1  - component: {fileID: 502}\n", "m_Component")]
        [TestCase(@"  - component: \{fileID: 304\}\n", "", "m_Component")]
        [TestCase(@"(&301\n.*?)m_Father: \{fileID: 0\}", "$1m_Father: {fileID: 301}", "m_Father and m_Children")]
        [TestCase(@"(&301\n.*?)m_Children: \[\]", "$1m_Children:\n  - {fileID: 401}", "m_Father and m_Children")]
        [TestCase(@"(  - \{fileID: 401\}\n)", "$1$1", "SceneRoots")]
        [TestCase(@"  - \{fileID: 401\}\n", "", "SceneRoots")]
        [TestCase("_isSteered: ", "_isStered: ", "SimulationLoop stores no field _isStered", Prefab)]
        [TestCase("m_Shader: .*?$", "m_Shader: {fileID: 45, guid: 0000000000000000f000000000000000, type: 0}",
            "m_Shader is no shader", "Assets/Guidewire/Runtime/Resources/Guidewire/Wire.mat")]
        [TestCase(@"m_Shader: \{fileID: 4800000", "m_Shader: {fileID: 4800001", "is no reference",
            "Assets/Guidewire/Runtime/Resources/Guidewire/Vessel.mat")]
        [TestCase("path: Assets/Scenes/Ins", "path: Assets/Scenes/ins", "has another GUID",
            "ProjectSettings/EditorBuildSettings.asset")]
        public void WhatIsWrong_IsNamed(string old, string changed, string words, string path = Insertion)
        {
            string text = File.ReadAllText(Path.Combine(Stage.Root, path));
            var pattern = new Regex(old.Replace("HUD", Hud), RegexOptions.Singleline | RegexOptions.Multiline);
            string broken = pattern.Replace(text,
                changed.Replace("HUD", Hud).Replace("TUBE", GuidOf("TubeMesh.cs")), 1);
            Assert.That(broken, Is.Not.EqualTo(text));
            Assert.That(Problems(path, broken), Has.Some.Contains(words));
        }

        [Test]
        public void FilesBesideTheScenes_AreThoseOfParams()
        {
            foreach (string file in Directory.GetFiles(Path.Combine(Stage.Root, "Assets/Scenes"), "*.*")
                .Where(file => Regex.IsMatch(file, @"\.(json|obj\.txt)$")))
            {
                string name = Path.GetFileName(file).Replace(".obj.txt", ".obj");
                string own = Path.Combine(Stage.Root, "params", name.EndsWith(".obj") ? "meshes" : "", name);
                Assert.That(File.ReadAllBytes(file), Is.EqualTo(File.ReadAllBytes(own)), file);
            }
        }
    }
}

using System;
using System.Globalization;
using System.Linq;
using System.Text.RegularExpressions;

namespace Guidewire.Unity.Tests
{
    /// <summary>What Unity would refuse of a scene, a prefab or another file of its YAML, or pass over without a
    /// word.</summary>
    internal sealed class SceneRules
    {
        private const int Object = 1;
        private const int Transform = 4;
        private const int Behaviour = 114;
        private const int Roots = 1660057539;

        /// <summary>Classes of the documents that every scene begins with, 1 to 4.</summary>
        private static readonly int[] Settings = { 29, 104, 157, 196 };

        private static readonly Regex Reference =
            new Regex(@"\{fileID: ([^,}]*)(?:, guid: ([^,}]*)(?:, type: (\d))?)?\}");

        /// <summary>Type and file ID of a reference to a file, by its ending.</summary>
        private static readonly Dictionary<string, (string Type, string Id)> Ends =
            new Dictionary<string, (string Type, string Id)>
            {
                { ".cs", ("3", "11500000") }, { ".mat", ("2", "2100000") }, { ".json", ("3", "4900000") },
                { ".txt", ("3", "4900000") }, { ".shader", ("3", "4800000") },
            };

        /// <summary>Keys of a behaviour that are Unity's.</summary>
        private static readonly string[] OwnKeys =
        {
            "m_ObjectHideFlags", "m_CorrespondingSourceObject", "m_PrefabInstance", "m_PrefabAsset", "m_GameObject",
            "m_Enabled", "m_EditorHideFlags", "m_Script", "m_Name", "m_EditorClassIdentifier", "serializedVersion",
            "references",
        };

        private readonly Dictionary<string, string> _assets;
        private readonly List<string> _problems = new List<string>();
        private readonly Dictionary<long, SceneFile.Document> _seen = new Dictionary<long, SceneFile.Document>();

        private SceneRules(Dictionary<string, string> assets)
        {
            _assets = assets;
        }

        /// <summary>What is wrong with a file.</summary>
        /// <param name="path">Its path; the ending says what it is.</param>
        /// <param name="text">Its text.</param>
        /// <param name="assets">Path of each asset by GUID.</param>
        public static IReadOnlyList<string> Problems(string path, string text, Dictionary<string, string> assets)
        {
            List<SceneFile.Document> documents;
            try
            {
                documents = SceneFile.Parse(text.Split('\n'));
            }
            catch (FormatException error)
            {
                return new[] { error.Message };
            }
            var rules = new SceneRules(assets);
            foreach (SceneFile.Document one in documents)
            {
                rules.Report(one.Id == 0 || !rules._seen.TryAdd(one.Id, one), $"&{one.Id} is zero or used twice");
            }
            rules.CheckReferences(text);
            rules.CheckShader(text);
            rules.CheckComponents();
            rules.CheckFamilies();
            foreach (SceneFile.Document one in documents.Where(one => one.Class == Behaviour))
            {
                rules.CheckScript(one);
            }
            if (path.EndsWith(".unity", StringComparison.Ordinal))
            {
                rules.Report(!documents.Take(4).Select(one => one.Class).SequenceEqual(Settings), "settings missing");
                rules.CheckRoots(documents.FindAll(one => one.Class == Roots));
            }
            return rules._problems;
        }

        private static long IdOf(string text)
        {
            return long.TryParse(Reference.Match(text).Groups[1].Value, NumberStyles.AllowLeadingSign,
                CultureInfo.InvariantCulture, out long id) ? id : 0;
        }

        private static long IdOf(SceneFile.Document document, string key) =>
            document.Values.TryGetValue(key, out string? text) ? IdOf(text) : 0;

        private static IEnumerable<long> IdsOf(SceneFile.Document document, string key) =>
            document.Lists.TryGetValue(key, out List<string>? list) ? list.Select(IdOf) : Array.Empty<long>();

        private void Report(bool isWrong, string message)
        {
            if (isWrong)
            {
                _problems.Add(message);
            }
        }

        private void CheckReferences(string text)
        {
            foreach (Match one in Reference.Matches(text))
            {
                string guid = one.Groups[2].Value;
                if (guid.Length == 0)
                {
                    bool isHere = one.Value == "{fileID: 0}" || _seen.ContainsKey(IdOf(one.Value));
                    Report(!isHere, one.Value + " is not in this file");
                }
                else if (_assets.TryGetValue(guid, out string? path))
                {
                    bool isRight = !Ends.TryGetValue(Path.GetExtension(path), out (string Type, string Id) end)
                        || end == (one.Groups[3].Value, one.Groups[1].Value);
                    Report(!isRight, one.Value + " is no reference to a file such as " + Path.GetFileName(path));
                }
                else
                {
                    bool isUnitys = Regex.IsMatch(guid, "^0{16}[0-9a-f]0{15}$") && one.Groups[3].Value == "0";
                    Report(!isUnitys, one.Value + " belongs to no asset");
                }
            }
            foreach (Match one in Regex.Matches(text, @"^    path: (.+)\n    guid: (.+)$", RegexOptions.Multiline))
            {
                bool isThere = _assets.TryGetValue(one.Groups[2].Value, out string? path)
                    && path.Replace('\\', '/').EndsWith("/" + one.Groups[1].Value, StringComparison.Ordinal);
                Report(!isThere, one.Groups[1].Value + " has another GUID");
            }
        }

        /// <summary>A shader of Unity's own may be in no player.</summary>
        private void CheckShader(string text)
        {
            Match named = Regex.Match(text, "^  m_Shader: (.*)$", RegexOptions.Multiline);
            string guid = Reference.Match(named.Groups[1].Value).Groups[2].Value;
            bool isOwn = _assets.GetValueOrDefault(guid, "").EndsWith(".shader", StringComparison.Ordinal);
            Report(named.Success && !isOwn, "m_Shader is no shader of the package");
        }

        /// <summary>Objects and components name each other, as often; the Transform comes first.</summary>
        private void CheckComponents()
        {
            var listed = new List<(long Object, long Component)>();
            foreach (SceneFile.Document one in _seen.Values.Where(one => one.Class == Object))
            {
                long[] own = IdsOf(one, "m_Component").ToArray();
                listed.AddRange(own.Select(id => (one.Id, id)));
                bool isFirst = own.Length > 0 && _seen.TryGetValue(own[0], out SceneFile.Document? first)
                    && first.Class == Transform;
                Report(!isFirst, $"the first component of &{one.Id} is no Transform");
            }
            IEnumerable<(long Object, long Component)> named = _seen.Values
                .Where(one => one.Values.ContainsKey("m_GameObject"))
                .Select(one => (IdOf(one, "m_GameObject"), one.Id));
            Report(!listed.OrderBy(pair => pair).SequenceEqual(named.OrderBy(pair => pair)),
                "the lists m_Component and what m_GameObject names do not agree");
        }

        private void CheckFamilies()
        {
            SceneFile.Document[] all = _seen.Values.Where(one => one.Class == Transform).ToArray();
            IEnumerable<(long Father, long Child)> down = all.SelectMany(
                one => IdsOf(one, "m_Children").Select(child => (one.Id, child)));
            IEnumerable<(long Father, long Child)> up = all.Select(one => (IdOf(one, "m_Father"), one.Id))
                .Where(pair => pair.Item1 != 0);
            Report(!down.OrderBy(pair => pair).SequenceEqual(up.OrderBy(pair => pair)),
                "m_Father and m_Children do not agree");
        }

        private void CheckRoots(List<SceneFile.Document> roots)
        {
            IEnumerable<long> tops = _seen.Values.Where(one => one.Class == Transform && IdOf(one, "m_Father") == 0)
                .Select(one => one.Id);
            bool agrees = roots.Count == 1
                && IdsOf(roots[0], "m_Roots").OrderBy(id => id).SequenceEqual(tops.OrderBy(id => id));
            Report(!agrees, "SceneRoots must list each Transform without a father once");
        }

        private void CheckScript(SceneFile.Document document)
        {
            string guid = Reference.Match(document.Values["m_Script"]).Groups[2].Value;
            string name = Path.GetFileNameWithoutExtension(_assets.GetValueOrDefault(guid, ""));
            Type? type = new[] { typeof(SimulationLoop), typeof(Stage) }.SelectMany(one => one.Assembly.GetTypes())
                .SingleOrDefault(one => one.Name == name);
            if (!typeof(MonoBehaviour).IsAssignableFrom(type))
            {
                _problems.Add($"&{document.Id}: {name} is no behaviour");
                return;
            }
            foreach (string key in document.Values.Keys.Except(OwnKeys).Except(ScriptRules.Stored(type)))
            {
                _problems.Add($"&{document.Id}: {name} stores no field {key}");
            }
        }
    }
}

using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Text.RegularExpressions;
using UnityEngine;

namespace UnityStubs
{
    /// <summary>Reads a scene as Unity does: objects, components, and the serialized fields of scripts by exact
    /// name.</summary>
    public sealed class SceneFile
    {
        private const BindingFlags Fields = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic;
        private static readonly string[] Texts = { ".json", ".txt", ".bytes", ".csv" };
        private static readonly Regex Header = new Regex(@"^--- !u!(\d+) &(-?\d+)( stripped)?$");
        private static readonly Regex Entry = new Regex(@"^  ([^ :{}-][^:{}]*):(?: (.*))?$");
        // The first two lines, an object's type, and what stands within a key.
        private static readonly Regex Other = new Regex(@"^(%.*|\w+:|    .*|)$");
        private static readonly Regex FileId = new Regex(@"\{fileID: (-?\d+)");
        private static readonly Regex Named = new Regex("^Shader \"(.*)\"", RegexOptions.Multiline);
        private static readonly Regex Queue = new Regex(@"m_CustomRenderQueue: (-?\d+)");
        private static readonly Regex Guid = new Regex(@"guid: ([0-9a-f]{32})");

        /// <summary>One object: its class and number in the file, its keys, and their lists.</summary>
        public sealed class Document
        {
            public int Class;
            public long Id;
            public readonly Dictionary<string, string> Values = new Dictionary<string, string>();
            public readonly Dictionary<string, List<string>> Lists = new Dictionary<string, List<string>>();
        }

        private static readonly Dictionary<string, Dictionary<string, string>> Known =
            new Dictionary<string, Dictionary<string, string>>();

        private readonly string _root;
        private readonly Assembly[] _scripts;
        private Dictionary<string, string> _paths = new Dictionary<string, string>();
        private readonly Dictionary<long, UnityEngine.Object> _objects = new Dictionary<long, UnityEngine.Object>();

        private SceneFile(string root, Assembly[] scripts)
        {
            _root = root;
            _scripts = scripts;
            if (Known.TryGetValue(root, out Dictionary<string, string> paths))
            {
                _paths = paths;
            }
        }

        // Of the asset with a GUID; a project's metas are read once, and again where one is not among them.
        private string PathOf(string guid)
        {
            if (!_paths.ContainsKey(guid))
            {
                _paths = Known[_root] = Paths(_root);
            }
            return _paths[guid];
        }

        /// <summary>Path of each asset of a project by GUID.</summary>
        public static Dictionary<string, string> Paths(string root)
        {
            var paths = new Dictionary<string, string>();
            foreach (string file in Seen(root, "*.meta"))
            {
                paths[Guid.Match(File.ReadAllText(file)).Groups[1].Value] = file.Substring(0, file.Length - 5);
            }
            return paths;
        }

        /// <summary>Files that Unity imports, of the project and of packages that lie in it.</summary>
        public static IEnumerable<string> Seen(string root, string pattern)
        {
            return new[] { "Assets", "Packages" }.Select(folder => Path.Combine(root, folder))
                .Where(Directory.Exists)
                .SelectMany(folder => Directory.GetFiles(folder, pattern, SearchOption.AllDirectories))
                .Where(file => !file.Contains("~" + Path.DirectorySeparatorChar, StringComparison.Ordinal));
        }

        /// <summary>The root of a prefab, its fields set, not in any scene.</summary>
        internal static GameObject Prefab(string root, string path)
        {
            Assembly scripts = Assembly.Load("Guidewire.Runtime");
            GameObject made = Read(root, path, scripts)[0];
            made.name = Path.GetFileNameWithoutExtension(path);
            (made.prefabRoot, made.prefabPath) = (root, path);
            return made;
        }

        /// <summary>Another object of a prefab, in the scene.</summary>
        internal static GameObject Copy(GameObject prefab)
        {
            GameObject copy = Prefab(prefab.prefabRoot, prefab.prefabPath);
            Engine.Enter(new[] { copy });
            return copy;
        }

        /// <summary>A material below a folder Resources.</summary>
        internal static UnityEngine.Object Resource(string path)
        {
            string root = Path.GetDirectoryName(Application.dataPath);
            string found = Seen(root, Path.GetFileName(path) + ".mat").FirstOrDefault(file =>
                file.EndsWith("Resources/" + path + ".mat", StringComparison.Ordinal));
            return found == null ? null : new SceneFile(root, null).Asset(found);
        }

        /// <summary>The objects of a scene, their fields set, not awake yet.</summary>
        /// <param name="root">Folder that holds Assets.</param>
        /// <param name="scene">Path of the scene from there.</param>
        /// <param name="scripts">The assemblies that hold the scripts' classes.</param>
        public static List<GameObject> Read(string root, string scene, params Assembly[] scripts) =>
            new SceneFile(root, scripts).Read(Parse(File.ReadLines(Path.Combine(root, scene))));

        /// <summary>The objects of a file in Unity's YAML, blocks within a key left aside.</summary>
        /// <exception cref="FormatException">A line has another form than Unity's, or a key stands twice.</exception>
        public static List<Document> Parse(IEnumerable<string> lines)
        {
            var documents = new List<Document>();
            Document document = null;
            List<string> list = null;
            int number = 0;
            foreach (string line in lines)
            {
                number++;
                Match header = Header.Match(line);
                Match entry = Entry.Match(line);
                if (header.Success)
                {
                    document = new Document
                    {
                        Class = int.Parse(header.Groups[1].Value, CultureInfo.InvariantCulture),
                        Id = long.Parse(header.Groups[2].Value, CultureInfo.InvariantCulture),
                    };
                    documents.Add(document);
                    list = null;
                }
                else if (entry.Success && document != null)
                {
                    if (!document.Values.TryAdd(entry.Groups[1].Value, entry.Groups[2].Value))
                    {
                        throw new FormatException("line " + number + ": " + entry.Groups[1].Value + " stands twice");
                    }
                    list = document.Lists[entry.Groups[1].Value] = new List<string>();
                }
                else if (line.StartsWith("  - ", StringComparison.Ordinal) && list != null)
                {
                    list.Add(line.Substring(4));
                }
                else if (!Other.IsMatch(line))
                {
                    throw new FormatException("line " + number + ": '" + line + "' has no form of Unity's");
                }
            }
            return documents;
        }

        private List<GameObject> Read(List<Document> documents)
        {
            var created = new List<GameObject>();
            foreach (Document document in documents.Where(document => document.Class == 1))
            {
                var gameObject = new GameObject(document.Values["m_Name"]);
                _objects[document.Id] = gameObject;
                created.Add(gameObject);
                foreach (string component in document.Lists["m_Component"])
                {
                    long id = long.Parse(FileId.Match(component).Groups[1].Value, CultureInfo.InvariantCulture);
                    Document own = documents.Single(candidate => candidate.Id == id);
                    _objects[id] = own.Class == 4 ? gameObject.transform : gameObject.Attach(TypeOf(own));
                }
            }
            foreach (Document document in documents)
            {
                if (document.Class == 4)
                {
                    var transform = (Transform)_objects[document.Id];
                    transform.localPosition = (Vector3)Value(typeof(Vector3), document.Values["m_LocalPosition"], null);
                    if (document.Values.TryGetValue("m_LocalScale", out string scale))
                    {
                        transform.localScale = (Vector3)Value(typeof(Vector3), scale, null);
                    }
                }
                if (document.Class == 4 && document.Values.TryGetValue("m_Father", out string father)
                    && _objects.TryGetValue(long.Parse(FileId.Match(father).Groups[1].Value,
                        CultureInfo.InvariantCulture), out UnityEngine.Object above))
                {
                    ((Transform)_objects[document.Id]).SetParent((Transform)above, false);
                }
                if (document.Class == 1)
                {
                    ((GameObject)_objects[document.Id]).tag = document.Values["m_TagString"];
                }
                if (_objects.TryGetValue(document.Id, out UnityEngine.Object made) && made is Renderer renderer)
                {
                    string own = Guid.Match(document.Lists["m_Materials"][0]).Groups[1].Value;
                    renderer.sharedMaterial = (Material)Asset(PathOf(own));
                }
                if (document.Class == 114)
                {
                    SetFields(_objects[document.Id], document);
                }
            }
            return created;
        }

        private Type TypeOf(Document document)
        {
            switch (document.Class)
            {
                case 20:
                    return typeof(Camera);
                case 23:
                    return typeof(MeshRenderer);
                case 33:
                    return typeof(MeshFilter);
                case 120:
                    return typeof(LineRenderer);
                case 108:
                    return typeof(Light);
                case 114:
                    string path = PathOf(Guid.Match(document.Values["m_Script"]).Groups[1].Value);
                    string name = Path.GetFileNameWithoutExtension(path);
                    return _scripts.SelectMany(one => one.GetTypes()).Single(type => type.Name == name);
                default:
                    throw new NotSupportedException("class " + document.Class);
            }
        }

        private void SetFields(object target, Document document)
        {
            foreach (KeyValuePair<string, string> pair in document.Values)
            {
                FieldInfo field = FieldOf(target, pair.Key);
                if (field != null)
                {
                    field.SetValue(target, Value(field.FieldType, pair.Value, document.Lists[pair.Key]));
                }
            }
        }

        // As in Unity, a name that the class does not have is skipped: a test finds it.
        private static FieldInfo FieldOf(object target, string name)
        {
            FieldInfo field = null;
            for (Type type = target.GetType(); type != null && field == null; type = type.BaseType)
            {
                field = type.GetField(name, Fields);
            }
            return field;
        }

        private object Value(Type type, string text, List<string> list)
        {
            if (type == typeof(bool))
            {
                return text == "1";
            }
            if (type == typeof(string))
            {
                return text;
            }
            if (type.IsArray)
            {
                var array = Array.CreateInstance(type.GetElementType(), list.Count);
                for (int i = 0; i < array.Length; i++)
                {
                    array.SetValue(Value(type.GetElementType(), list[i], null), i);
                }
                return array;
            }
            if (type.IsEnum)
            {
                return Enum.ToObject(type, int.Parse(text, CultureInfo.InvariantCulture));
            }
            if (type == typeof(Vector3))
            {
                float[] parts = Regex.Matches(text, @"[xyz]: ([^,}]+)").Cast<Match>()
                    .Select(match => float.Parse(match.Groups[1].Value, CultureInfo.InvariantCulture)).ToArray();
                return new Vector3(parts[0], parts[1], parts[2]);
            }
            if (typeof(UnityEngine.Object).IsAssignableFrom(type))
            {
                Match guid = Guid.Match(text);
                if (text.StartsWith("{fileID: 0", StringComparison.Ordinal))
                {
                    return null;
                }
                return guid.Success ? Asset(PathOf(guid.Groups[1].Value))
                    : _objects[long.Parse(FileId.Match(text).Groups[1].Value, CultureInfo.InvariantCulture)];
            }
            return Convert.ChangeType(text, type, CultureInfo.InvariantCulture);
        }

        private UnityEngine.Object Asset(string path)
        {
            if (Array.IndexOf(Texts, Path.GetExtension(path)) >= 0)
            {
                return new TextAsset(File.ReadAllBytes(path)) { name = Path.GetFileNameWithoutExtension(path) };
            }
            if (!path.EndsWith(".mat", StringComparison.Ordinal))
            {
                throw new NotSupportedException(path);
            }
            string text = File.ReadAllText(path);
            string shader = PathOf(Guid.Match(text.Substring(text.IndexOf("m_Shader:", StringComparison.Ordinal)))
                .Groups[1].Value);
            var material = new Material(Shader.Find(Named.Match(File.ReadAllText(shader)).Groups[1].Value));
            material.name = Path.GetFileNameWithoutExtension(path);
            int queue = int.Parse(Queue.Match(text).Groups[1].Value, CultureInfo.InvariantCulture);
            material.renderQueue = queue < 0 ? 2000 : queue;
            return material;
        }
    }
}

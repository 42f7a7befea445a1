"""Breakages of scripts: fields that are not stored, messages that are not sent, calls by a name that is not there."""

from __future__ import annotations

from tools.unitycheck.tests.breakages import HUD, LOOP, ODD, RUNTIME, WIRE_VIEW, Breakage, behaviour, insert, move, odd
from tools.unitycheck.tests.breakages import replace, write

AXIS = f"{RUNTIME}/Loop/KeyAxis.cs"
INPUT = f"{RUNTIME}/Loop/KeyInput.cs"
BATCH = f"{RUNTIME}/Batch/PlayerBatch.cs"
KEYS = f"{RUNTIME}/Loop/KeyboardControl.cs"


def stored(field: str) -> Breakage:
    return odd(field, "field-stored")


BREAKAGES = {
    # Fields that Unity leaves out without a word
    "SerializeField on a property": stored("[SerializeField] private float Speed { get; set; }"),
    "SerializeField on a computed property": stored("[SerializeField] private float Speed => 3f;"),
    "field: SerializeField without a setter": stored("[field: SerializeField] public float Speed { get; } = 3f;"),
    "SerializeField and readonly": stored("[SerializeField] private readonly float _speed = 3f;"),
    "SerializeField and static": stored("[SerializeField] private static float _speed = 3f;"),
    "SerializeField and const": stored("[SerializeField] private const float Speed = 3f;"),
    "SerializeField and NonSerialized": stored("[SerializeField, System.NonSerialized] public float _speed;"),
    "Dictionary": stored("[SerializeField] private Dictionary<string, int> _table;"),
    "HashSet": stored("[SerializeField] private HashSet<int> _set;"),
    "two-dimensional array": stored("[SerializeField] private int[,] _grid;"),
    "array of arrays": stored("[SerializeField] private int[][] _grid;"),
    "list of lists": stored("[SerializeField] private List<List<int>> _grid;"),
    "list of arrays": stored("[SerializeField] private List<int[]> _grid;"),
    "interface of the library": stored("[SerializeField] private IReadOnlyList<int> _list;"),
    "interface of ours": stored("[SerializeField] private ISpin _spin; public interface ISpin { }"),
    "struct without Serializable": stored("[SerializeField] private Pair _pair; public struct Pair { public int A; }"),
    "class without Serializable": stored("[SerializeField] private Pair _pair; public class Pair { public int A; }"),
    "list of a struct without Serializable": stored("[SerializeField] private List<Pair> _pairs;"
                                                    " public struct Pair { public int A; }"),
    "abstract class": stored("[SerializeField] private Pair _pair;"
                             " [System.Serializable] public abstract class Pair { public int A; }"),
    "vector of Core's": stored("[SerializeField] private Guidewire.Core.Vector3d _place;"),
    "number that may be missing": stored("[SerializeField] private int? _count;"),
    "decimal": stored("[SerializeField] private decimal _cost;"),
    "time": stored("[SerializeField] private System.DateTime _date;"),
    "tuple": stored("[SerializeField] private (int A, int B) _pair;"),
    "delegate": stored("[SerializeField] private System.Action<int> _call;"),
    "object": stored("[SerializeField] private object _thing;"),
    "Tooltip on a field that is not stored": stored('[Tooltip("x")] private float _speed;'),
    "Header on a property": stored('[Header("x")] public float Speed { get; set; }'),
    "key axis no longer Serializable": Breakage(replace(AXIS, r"    \[Serializable\]\n", ""), INPUT, "field-stored"),
    "key readonly": Breakage(replace(AXIS, "private KeyCode _up;", "private readonly KeyCode _up;"), AXIS,
                             "field-stored"),
    "loop field a property": Breakage(replace(LOOP, r"private float _pace = 1f;", "private float _pace { get; set; }"),
                                      LOOP, "field-stored"),
    "SerializeField where nothing is stored": Breakage(
        insert(f"{RUNTIME}/Views/TubeMesh.cs", "[SerializeField] private int _count;"), f"{RUNTIME}/Views/TubeMesh.cs",
        "field-stored"),
    "field of the base, too": Breakage(write(ODD, behaviour(
        "[SerializeField] private int _a;").replace("sealed class Odd : MonoBehaviour", "class Odd : OddBase")
        + "\nnamespace Guidewire.Runtime\n{\n    public abstract class OddBase : UnityEngine.MonoBehaviour\n    {\n"
          "        [UnityEngine.SerializeField] private int _a;\n    }\n}\n"), ODD, "field-stored"),
    # Attributes and initialisers
    "Range on text": odd("[SerializeField, Range(0f, 1f)] private string _name;", "field-attribute"),
    "Range on a bool": odd("[SerializeField, Range(0f, 1f)] private bool _on;", "field-attribute"),
    "Range on a vector": odd("[Range(0f, 1f)] public Vector3 Place;", "field-attribute"),
    "Range upside down": Breakage(replace(LOOP, r"Range\(1, 1000\)", "Range(1000, 1)"), LOOP, "field-attribute"),
    "TextArea on a number": odd("[SerializeField, TextArea] private int _count;", "field-attribute"),
    "ColorUsage on a number": odd("[SerializeField, ColorUsage(true)] private float _red;", "field-attribute"),
    "Time in an initialiser": odd("private float _start = Time.time;", "field-initialiser"),
    "Screen in an initialiser": odd("private readonly int _width = 2 * Screen.width;", "field-initialiser"),
    "Material in an initialiser": odd("private Material _m = new Material(null);", "field-initialiser"),
    "path in a static initialiser": odd("private static readonly string Root = Application.dataPath;",
                                        "field-initialiser"),
    "Random in an initialiser": odd("private float _x = Random.value;", "field-initialiser"),
    "search in an initialiser": odd("private Camera _c = FindObjectOfType<Camera>();", "field-initialiser"),
    "resource in an initialiser": odd('private Mesh _m = Resources.Load<Mesh>("a");', "field-initialiser"),
    "Mesh made in an initialiser": Breakage(replace(WIRE_VIEW, r"private Mesh\? _ball",
                                                    "private Mesh? _ball = new Mesh()"),
                                            WIRE_VIEW, "field-initialiser"),
    "key from the clock": Breakage(replace(AXIS, "private KeyCode _up;", "private KeyCode _up = (KeyCode)"
                                           "UnityEngine.Time.deltaTime;"), AXIS, "field-initialiser"),
    # Scripts
    "behaviour nested": Breakage(insert(HUD, "public sealed class Inner : MonoBehaviour { }"), HUD, "script-name"),
    "second behaviour in a file": Breakage(replace(HUD, r"^namespace Guidewire.Runtime\n\{",
                                                   "namespace Guidewire.Runtime"
                                                   "\n{\n    public sealed class Other : MonoBehaviour { }\n"), HUD,
                                           "script-name"),
    "file of another name": Breakage(move(HUD, HUD.replace("Hud", "HeadUp")), HUD.replace("Hud", "HeadUp"),
                                     "script-name"),
    "behaviour internal": Breakage(replace(HUD, "public sealed class", "internal sealed class"), HUD, "script-form"),
    "behaviour generic": Breakage(replace(HUD, "class Hud :", "class Hud<T> :"), HUD, "script-form"),
    "behaviour static": Breakage(replace(HUD, "public sealed class", "public static class"), HUD, "script-form"),
    "constructor": Breakage(insert(HUD, "public Hud() { }"), HUD, "script-constructor"),
    "behaviour made with new": Breakage(insert(LOOP, "private void Awake2() { var hud = new Hud(); }"), LOOP,
                                        "script-constructor"),
    "behaviour in the editor's assembly": Breakage(
        write("Assets/Guidewire/Editor/Odd.cs", behaviour("", namespace="Guidewire.Editor")),
        "Assets/Guidewire/Editor/Odd.cs", "script-form"),
    "initialise with an overload": Breakage(replace(BATCH, r"void RunIfRequested\(\)", "void Run()"), BATCH,
                                            "initialize-method"),
    "initialise not static": Breakage(replace(BATCH, "private static void RunIfRequested", "private void RunIfRequested"),
                                      BATCH,
                                      "initialize-method"),
    "initialise with a parameter": Breakage(replace(BATCH, r"void RunIfRequested\(\)", "void RunIfRequested(int a)"), BATCH,
                                            "initialize-method"),
    # Messages
    "message with a letter exchanged": Breakage(replace(LOOP, r"void Update\(\)", "void Udpate()"), LOOP,
                                                "script-message"),
    "message with a letter lost": Breakage(replace(LOOP, r"void OnDestroy\(\)", "void OnDestoy()"), LOOP,
                                           "script-message"),
    "message with a letter more": Breakage(replace(WIRE_VIEW, r"void LateUpdate\(\)", "void LateUpdates()"), WIRE_VIEW,
                                           "script-message"),
    "message in small letters": Breakage(replace(LOOP, r"void Awake\(\)", "void awake()"), LOOP, "script-message"),
    "public message misspelt": odd("public void OnEnabled() { }", "script-message"),
    "message with a parameter": Breakage(replace(LOOP, r"void Update\(\)", "void Update(float dt)"), LOOP,
                                         "script-message"),
    "message with the wrong parameter": odd("private void OnCollisionEnter(Collider other) { }", "script-message"),
    "pause without its bool": odd("private void OnApplicationPause(int pause) { }", "script-message"),
    "static message": Breakage(replace(LOOP, r"private void Awake\(\)", "private static void Awake()"), LOOP,
                               "script-message"),
    "message that returns a number": Breakage(replace(LOOP, r"void Awake\(\)", "int Awake()"), LOOP, "script-message"),
    "Update as a coroutine": Breakage(replace(LOOP, r"private void Update\(\)",
                                              "private System.Collections.IEnumerator "
                                              "Update()"), LOOP, "script-message"),
    "OnGUI as a coroutine": odd("private IEnumerator OnGUI() { yield return null; }", "script-message"),
    "message that nobody calls": Breakage(insert(LOOP, "private void StartIO() { }"), LOOP, "script-message"),
    "generic message": odd("private void Awake<T>() { }", "script-message"),
    # Coroutines and calls by name
    "coroutine never started": odd("private IEnumerator Blink() { yield return null; }", "script-coroutine"),
    "coroutine called like a method": odd("private void Start() { Blink(); }"
                                          " private IEnumerator Blink() { yield return null; }", "script-coroutine"),
    "Invoke of no method": odd('private void Start() { Invoke("Blnk", 1f); } private void Blink() { }',
                               "script-invoke"),
    "InvokeRepeating of no method": odd('private void Start() { InvokeRepeating("Tick", 1f, 1f); }', "script-invoke"),
    "Invoke of a method with a parameter": odd('private void Start() { Invoke("Tick", 1f); }'
                                               " private void Tick(int a) { }", "script-invoke"),
    "StartCoroutine of no method": odd('private void Start() { StartCoroutine("Blink"); }', "script-invoke"),
    "StartCoroutine of no coroutine": odd('private void Start() { StartCoroutine("Blink"); } private void Blink() { }',
                                          "script-invoke"),
    "StopCoroutine of no method": odd('private void Start() { StopCoroutine("Blink"); }', "script-invoke"),
    "SendMessage to nobody": odd('private void Start() { SendMessage("Blink"); }', "script-invoke"),
    "key control's message renamed": Breakage(replace(KEYS, r"void Update\(\)", "void Updates()"), KEYS,
                                              "script-message"),
    "scene that is not there": odd("private void Start() { UnityEngine.SceneManagement.SceneManager.LoadScene("
                                   '"Nowhere"); }', "name-unknown"),
    "tag that is not there": odd('private void Start() { GameObject.FindWithTag("Wires"); }', "name-unknown"),
    "layer that is not there": odd('private int L() { return LayerMask.NameToLayer("Wires"); }', "name-unknown"),
    "axis that is not there": odd('private void Update() { Input.GetAxis("Horizontl"); }', "name-unknown"),
    "resource that is not there": odd('private void Start() { Resources.Load<Mesh>("wire"); }', "name-unknown"),
    "enum of 64 bits": stored("[SerializeField] private E _e; public enum E : long { A }"),
    "Unity's editor in a player": Breakage(insert(LOOP, "private void Log() { UnityEditor.AssetDatabase.Refresh(); }"),
                                           LOOP, "editor-in-player"),
    "editor under the wrong condition": Breakage(replace(
        LOOP, "^using UnityEngine;", "#if !UNITY_EDITOR\nusing UnityEditor;\n#endif\nusing UnityEngine;"), LOOP,
        "editor-in-player"),
}

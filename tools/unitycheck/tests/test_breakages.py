"""The checker against this repository: clean as it is, and each of many seeded breakages found and named.

A breakage is laid over the project in memory: the files on disk are read once and never touched.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from guidewire.runs import building
from tools.unitycheck import checks, metas, sources
from tools.unitycheck.project import Project

ROOT = Path(__file__).resolve().parents[3]
HOME = "Assets/Guidewire"
RUNTIME, EDITOR, TESTS = f"{HOME}/Runtime", f"{HOME}/Editor", f"{HOME}/Tests/Core"
CORE_ASMDEF = f"{HOME}/Core/Guidewire.Core.asmdef"
IO_ASMDEF = f"{HOME}/Io/Guidewire.Io.asmdef"
RUNTIME_ASMDEF = f"{RUNTIME}/Guidewire.Runtime.asmdef"
EDITOR_ASMDEF = f"{EDITOR}/Guidewire.Editor.asmdef"
TESTS_ASMDEF = f"{TESTS}/Guidewire.Core.Tests.asmdef"
VECTOR = f"{HOME}/Core/Numbers/Vector3d.cs"
LOOP, HUD, CAMERA = f"{RUNTIME}/Loop/SimulationLoop.cs", f"{RUNTIME}/Views/Hud.cs", f"{RUNTIME}/Views/OrbitCamera.cs"
SCENE, PREFAB = "Assets/Scenes/Insertion.unity", f"{HOME}/Prefabs/WireInVessel.prefab"
WIRE = f"{RUNTIME}/Resources/Guidewire/Wire.mat"
MANIFEST, PACKAGE = "Packages/manifest.json", f"{HOME}/package.json"
GUID = metas.stable_guid
REFERENCES = r'"references": \[\]'

# What is changed: file, regular expression over its lines, what takes its place, the rule; the file that is named, if
# it is another.
EDITS = {
    # Assembly definitions
    "cycle": (CORE_ASMDEF, REFERENCES, '"references": ["Guidewire.Io"]', "asmdef-cycle"),
    "reference misspelt": (IO_ASMDEF, '"Guidewire.Core"', '"Guidewire.Kore"', "asmdef-reference"),
    "reference by an unknown guid": (IO_ASMDEF, '"Guidewire.Core"', f'"GUID:{32 * "3"}"', "asmdef-reference"),
    "reference twice, by name and by guid": (
        IO_ASMDEF, '"Guidewire.Core"', f'"Guidewire.Core", "GUID:{GUID(CORE_ASMDEF)}"', "asmdef-reference"),
    "reference to a package that is not there": (
        RUNTIME_ASMDEF, '"Guidewire.Io"', '"Guidewire.Io", "Unity.Burst"', "asmdef-reference"),
    "reference gone": (EDITOR_ASMDEF, r',\s*"Guidewire.Runtime"', "", "CS0234", f"{EDITOR}/BatchEntry.cs"),
    "player needs the editor": (RUNTIME_ASMDEF, '"Guidewire.Io"', '"Guidewire.Io", "Guidewire.Editor"',
                                "asmdef-editor"),
    "player needs the tests": (RUNTIME_ASMDEF, '"Guidewire.Io"', '"Guidewire.Io", "Guidewire.Unity.PlayTests"',
                               "asmdef-test"),
    "Core needs Runtime": (CORE_ASMDEF, REFERENCES, '"references": ["Guidewire.Runtime"]', "asmdef-engine"),
    "wall around Core opened": (CORE_ASMDEF, '"noEngineReferences": true', '"noEngineReferences": false',
                                "asmdef-engine"),
    "library that is not there": (IO_ASMDEF, "Newtonsoft.Json.dll", "NewtonSoft.Json.dll", "asmdef-precompiled"),
    "libraries that do not count": (IO_ASMDEF, '"overrideReferences": true', '"overrideReferences": false',
                                    "asmdef-precompiled"),
    "package of a library gone": (MANIFEST, r'    "com.unity.nuget.newtonsoft-json": "3.2.1",\n', "",
                                  "asmdef-precompiled", IO_ASMDEF),
    "tests without NUnit": (TESTS_ASMDEF, r'"nunit.framework.dll",\s*', "", "asmdef-test"),
    "tests of the editor in PlayMode": (
        TESTS_ASMDEF, r'"includePlatforms": \[\s*"Editor"\s*\]', '"includePlatforms": []', "asmdef-test"),
    "tests in players": (TESTS_ASMDEF, '"UNITY_INCLUDE_TESTS"', "", "asmdef-constraint"),
    "constraint that never holds": (RUNTIME_ASMDEF, r'"defineConstraints": \[\]', '"defineConstraints": ["NEVER"]',
                                    "asmdef-constraint"),
    "platform left out": (CORE_ASMDEF, r'"excludePlatforms": \[\]', '"excludePlatforms": ["Editor"]',
                          "asmdef-platform"),
    "name unlike the file": (EDITOR_ASMDEF, '"name": "Guidewire.Editor"', '"name": "Guidewire.Editing"', "asmdef-name"),
    "key misspelt": (IO_ASMDEF, "noEngineReferences", "noEngineReference", "asmdef-form"),
    "number for a switch": (IO_ASMDEF, '"autoReferenced": true', '"autoReferenced": 1', "asmdef-form"),
    "number among the references": (IO_ASMDEF, '"Guidewire.Core"', '"Guidewire.Core", 3', "asmdef-form"),
    "key twice": (IO_ASMDEF, '"autoReferenced": true', '"autoReferenced": true, "autoReferenced": true', "json"),
    "trailing comma": (IO_ASMDEF, "true\n}", "true,\n}", "json"),
    "list for an object": (EDITOR_ASMDEF, r"\A.*\Z", "[]", "json"),
    "nullable switched off": (f"{RUNTIME}/csc.rsp", "enable", "disable", "nullable"),
    # Packages and settings
    "unknown module": (MANIFEST, r"modules\.imgui", "modules.imgu", "package-unknown"),
    "older version": (MANIFEST, '"3.2.1"', '"3.0.2"', "package-version"),
    "version that is none": (MANIFEST, '"3.2.1"', '"latest"', "package-version"),
    "package gone": (MANIFEST, r',\s*"com.unity.test-framework": "1.5.1"', "", "package-missing"),
    "module gone": (MANIFEST, r'    "com.unity.modules.imgui": "1.0.0",\n', "", "module-missing", HUD),
    "package's own name": (PACKAGE, "org.guidewire.simulation", "Guidewire", "package-file"),
    "package's dependency": (PACKAGE, "3.2.1", "3.2.0", "package-version"),
    "package's sample": (PACKAGE, "Samples~/OwnVessel", "Samples~/Own", "package-file"),
    "editor too old": ("ProjectSettings/ProjectVersion.txt", r"6000\.0\.58f2", "2022.3.62f2", "settings"),
    "binary serialization": ("ProjectSettings/EditorSettings.asset", "Mode: 2", "Mode: 1", "settings"),
    "metas hidden": ("ProjectSettings/VersionControlSettings.asset", "Visible", "Hidden", "settings"),
    # Metas
    "guid changed": (f"{VECTOR}.meta", "^guid: .", "guid: 0", "guid-changed"),
    "guid of wrong form": (f"{VECTOR}.meta", "^guid: .", "guid: X", "guid-form"),
    "guid of Unity's own": (f"{VECTOR}.meta", r"^guid: \w+", "guid: 0000000000000000f000000000000000", "guid-form"),
    "guid of another": (f"{HUD}.meta", r"^guid: \w+", f"guid: {GUID(VECTOR)}", "guid-twice"),
    "guid stated twice": (f"{VECTOR}.meta", r"^(guid: \w+\n)", r"\1\1", "meta-form"),
    "meta of another format": (f"{VECTOR}.meta", "Version: 2", "Version: 3", "meta-form"),
    "wrong importer": (f"{CORE_ASMDEF}.meta", "AssemblyDefinitionImporter", "DefaultImporter", "meta-importer"),
    "folder's meta for a file": (f"{HOME}/Core.meta", "folderAsset: yes\n", "", "meta-importer"),
    # Texts
    "conflict": (f"{VECTOR}.meta", "^guid: ", "<<<<<<< HEAD\nguid: ", "text-conflict"),
    "CRLF": (VECTOR, "^using System;", "using System;\r", "text-crlf"),
    "tab": (SCENE, "^  _pace", "\t_pace", "text-tab"),
    "byte order mark": (VECTOR, r"\A", "\ufeff", "text-bom"),
    "line of 130 columns": (VECTOR, "^    public", 110 * " " + "/* wide */ public", "text-wide"),
    "header": (WIRE, "%YAML 1.1", "%YAML 1.2", "yaml-header"),
    # Scenes and prefabs
    "key without a colon": (SCENE, "  _pace: 1", "  _pace 1", "yaml-form"),
    "key twice in a scene": (SCENE, "  _pace: 1\n", "  _pace: 1\n  _pace: 1\n", "yaml-form"),
    "file ID twice": (SCENE, "^--- !u!1 &200", "--- !u!1 &101", "file-id"),
    "reference to nothing there": (SCENE, r"_hud: \{fileID: 304\}", "_hud: {fileID: 3040}", "reference-local"),
    "guid of no asset": (SCENE, GUID(HUD), 32 * "3", "guid-unknown"),
    "reference's type": (SCENE, f"{GUID(HUD)}, type: 3", f"{GUID(HUD)}, type: 2", "reference-type"),
    "reference's file ID": (SCENE, r"\{fileID: 11500000", "{fileID: 1150000", "reference-fileid"),
    "script that is no behaviour": (SCENE, GUID(HUD), GUID(f"{RUNTIME}/Views/TubeMesh.cs"), "scene-script"),
    "field misspelt": (SCENE, "_distance: ", "_distanse: ", "field-unknown"),
    "field misspelt in the prefab": (PREFAB, "_isSteered: ", "_isStered: ", "field-unknown"),
    "field renamed in the source": (CAMERA, "float _distance", "float _far", "field-unknown", SCENE),
    "behaviour without its base": (LOOP, "SimulationLoop : MonoBehaviour", "SimulationLoop", "scene-script", SCENE),
    "settings document gone": (SCENE, r"--- !u!157 &3\n.*?(?=---)", "", "scene-settings"),
    "Transform second": (SCENE, r"(  - component: \{fileID: 401\}\n)(  - component: \{fileID: 402\}\n)", r"\2\1",
                         "scene-transform"),
    "component of two objects": (SCENE, r"(  - component: \{fileID: 402\}\n)", r"\1  - component: {fileID: 502}\n",
                                 "scene-component"),
    "component that no object lists": (SCENE, r"  - component: \{fileID: 304\}\n", "", "scene-component"),
    "its own father": (SCENE, r"(&301\n.*?)m_Father: \{fileID: 0\}", r"\1m_Father: {fileID: 301}", "scene-parent"),
    "child that does not know": (SCENE, r"(&301\n.*?)m_Children: \[\]", r"\1m_Children:\n  - {fileID: 401}",
                                 "scene-parent"),
    "root listed twice": (SCENE, r"(  - \{fileID: 401\}\n)", r"\1\1", "scene-roots"),
    "root not listed": (SCENE, r"  - \{fileID: 401\}\n", "", "scene-roots"),
    # The wall, and what is called by its name
    "UnityEngine in Core": (VECTOR, "^using System;", "using UnityEngine;\nusing System;", "CS0246"),
    "message misspelt": (CAMERA, r"void LateUpdate\(\)", "void LateUpdates()", "script-message"),
    "message in small letters": (LOOP, r"void Awake\(\)", "void awake()", "script-message"),
    "message with a parameter": (LOOP, r"void Update\(\)", "void Update(float dt)", "script-message"),
    "static message": (LOOP, r"private void Awake\(\)", "private static void Awake()", "script-message"),
    "type of a stored list no longer Serializable": (f"{RUNTIME}/Loop/KeyAxis.cs", r"    \[Serializable\]\n", "",
                                                     "field-stored", f"{RUNTIME}/Loop/KeyInput.cs"),
    "command line's method renamed": (f"{EDITOR}/BatchEntry.cs", r"void Run\(\)", "void Go()", "execute-method",
                                      "guidewire/runs/unity_runner.py"),
    "command line of the guide": ("docs/unity.md", r"PlayerBuild\.Linux", "PlayerBuild.Linus", "execute-method"),
}

# Files that are gone, or there where none should be: their bytes, the file that is named, the rule.
FILES = {
    "meta gone": ({f"{VECTOR}.meta": None}, VECTOR, "meta-missing"),
    "folder's meta gone": ({f"{HOME}/Core.meta": None}, f"{HOME}/Core", "meta-missing"),
    "meta left behind": ({VECTOR: None}, f"{VECTOR}.meta", "meta-orphan"),
    "definition gone": ({RUNTIME_ASMDEF: None}, LOOP, "asmdef-outside"),
    "two definitions in a folder": ({f"{RUNTIME}/Other.asmdef": b'{"name": "Other"}'}, RUNTIME_ASMDEF, "asmdef-folder"),
    "source outside": ({"Assets/Loose.cs": b"namespace A\n{\n}\n"}, "Assets/Loose.cs", "asmdef-outside"),
    "options gone": ({f"{RUNTIME}/csc.rsp": None}, f"{RUNTIME}/csc.rsp", "nullable"),
    "manifest gone": ({MANIFEST: None}, MANIFEST, "json"),
    "Latin-1": ({f"{RUNTIME}/Odd.cs": b"// \xe9\n"}, f"{RUNTIME}/Odd.cs", "text-utf8"),
}

# Members of a new behaviour, or (after a folder) of a new class there, and what is said of its file. All at once.
BODIES = {
    "property": ("[SerializeField] private float Speed { get; set; }", "field-stored"),
    "property's field without a setter": ("[field: SerializeField] public float Speed { get; } = 3f;", "field-stored"),
    "readonly": ("[SerializeField] private readonly float _speed = 3f;", "field-stored"),
    "static": ("[SerializeField] private static float _speed = 3f;", "field-stored"),
    "const": ("[SerializeField] private const float Speed = 3f;", "field-stored"),
    "NonSerialized": ("[SerializeField, System.NonSerialized] public float _speed;", "field-stored"),
    "Dictionary": ("[SerializeField] private Dictionary<string, int> _table;", "field-stored"),
    "two dimensions": ("[SerializeField] private int[,] _grid;", "field-stored"),
    "list of arrays": ("[SerializeField] private List<int[]> _grid;", "field-stored"),
    "interface": ("[SerializeField] private IReadOnlyList<int> _list;", "field-stored"),
    "struct without Serializable": ("[SerializeField] private P _p; public struct P { public int A; }", "field-stored"),
    "abstract class": ("[SerializeField] private P _p; [System.Serializable] public abstract class P { }",
                       "field-stored"),
    "Core's vector": ("[SerializeField] private Guidewire.Core.Vector3d _place;", "field-stored"),
    "number that may be missing": ("[SerializeField] private int? _count;", "field-stored"),
    "enum of 64 bits": ("[SerializeField] private E _e; public enum E : long { A }", "field-stored"),
    "tuple": ("[SerializeField] private (int A, int B) _pair;", "field-stored"),
    "Tooltip on what is not stored": ('[Tooltip("x")] private float _speed;', "field-stored"),
    "message of another's parameter": ("private void OnCollisionEnter(Collider other) { }", "script-message"),
    "message that returns": ("private int Awake() { return 1; }", "script-message"),
    "message that nobody sends": ("private void StartIO() { }", "script-message"),
    "nested behaviour": ("public class Inner : MonoBehaviour { }", "script-name"),
    "editor in a player": ("private void A() { UnityEditor.AssetDatabase.Refresh(); }", "editor-in-player"),
    "editor under the wrong condition": ("\n#if !UNITY_EDITOR\nUnityEditor.Editor _a;\n#endif\n", "editor-in-player"),
    "module that is not there": ("private AudioSource _a = null!;", "module-missing"),
    "required member": ("public required int A;", "CS8652"),
    "record": ("private record Pair(int A, int B);", "CS0518"),
    "member of .NET 6": ("private double A => System.Random.Shared.NextDouble();", "CS0117"),
    "behaviour of the editor's": (EDITOR, "", "script-form"),
    "Span in the editor": (EDITOR, 'private static int A() => System.MemoryExtensions.AsSpan("a").Length;',
                           "api-editor"),
    "IsFinite in shared tests": (TESTS, "private static bool A(double a) => double.IsFinite(a);", "api-editor"),
    "range in shared tests": (TESTS, "private static int[] A(int[] a) => a[1..];", "api-editor"),
    "newer NUnit": (TESTS, "private void A() { NUnit.Framework.Assert.Multiple(() => { }); }", "nunit"),
    "engine in shared tests": (TESTS, "private UnityEngine.Vector3 _v;", "CS0246"),
    "engine in Io": (f"{HOME}/Io", "private UnityEngine.Vector3 _v;", "CS0246"),
    "intrinsics": (f"{HOME}/Core", "private System.Runtime.Intrinsics.Vector128<double> _v;", "CS0234"),
    "struct constructor": (f"{HOME}/Core", "private struct P { public P() { } }", "CS8773"),
    "unsafe code": (f"{HOME}/Core", "private unsafe double* _x;", "CS0227"),
}

# Fields of a behaviour, and those of them that a scene may hold.
STORED = {
    "public int A;": ["A"], "int _a;": [], "[SerializeField] float _a = F(1); static float F(int a) => a;": ["_a"],
    "[SerializeField, Range(0, 1)] private float _a, _b = 2f;": ["_a", "_b"], "public static int A;": [],
    "public const int A = 3;": [], "public readonly int A = 3;": [], "[System.NonSerialized] public int A;": [],
    "public int P { get; set; }": [], "[field: SerializeField] public int P { get; set; } = 3;": ["<P>k__BackingField"],
    "public event System.Action E;": [], "[SerializeField] private List<int> _a = new List<int>(), _b;": ["_a", "_b"],
    "public Dictionary<int, int> A;": [], "public LayerMask A; public AnimationCurve B;": ["A", "B"],
    "[SerializeReference] private object _a;": ["_a"], "[SerializeField] private string[] _names;": ["_names"],
    "[SerializeField] private P[] _p; [System.Serializable] private struct P { public int X; }": ["_p"],
    '[UnityEngine.Serialization.FormerlySerializedAs("f")] public float F;': ["f", "F"],
}
# What is right and might be named wrong.
RIGHT = [
    "private System.Collections.IEnumerator Start() { yield return null; }",
    "private async void Start() { await System.Threading.Tasks.Task.Delay(1); }",
    'private void Start() { Invoke("Blink", 1f); } private void Blink() { }',
    "private void OnApplicationPause(bool pause) { } private void OnTriggerExit2D(Collider2D c) { }",
    '[ContextMenu("Blink")] private void Blink() { }',
    "\n#if UNITY_EDITOR\npublic void Save() { UnityEditor.AssetDatabase.Refresh(); }\n#endif\n",
]


def source(name: str, body: str, folder: str = RUNTIME) -> tuple[str, bytes]:
    """A new source and its text: a behaviour where the engine is."""
    base = " : MonoBehaviour" if folder in (RUNTIME, EDITOR) else ""
    using = "using System.Collections.Generic;\n" + ("using UnityEngine;\n" if base else "")
    text = f"public class {name}{base}\n    {{\n        {body}\n    }}\n"
    return f"{folder}/{name}.cs", f"{using}namespace Guidewire.{Path(folder).name}.Odd\n{{\n    {text}}}\n".encode()


@pytest.fixture(scope="module")
def repository() -> Project:
    """This repository, read once, and compiled as it is before anything is changed."""
    building.build(building.CHECKER, print)
    project = Project(ROOT)
    assert sources.answer(project) is not None
    return project


@pytest.fixture(scope="module")
def odd(repository: Project) -> tuple[Project, set[tuple[str, str]]]:
    """The repository with every new source, and what is said of them."""
    bodies = [(f"Odd{k}", body[-2], *body[:-2]) for k, body in enumerate(BODIES.values())]
    fields = [(f"Stored{k}", body) for k, body in enumerate([*STORED, *RIGHT])]
    changes = dict(source(*one) for one in bodies + fields)
    project = repository.with_changes(changes, changes)
    return project, {(violation.path, violation.rule) for violation in checks.run(project)}


def test_repository_keeps_every_rule(repository: Project) -> None:
    assert [str(violation) for violation in checks.run(repository)] == []


def assert_named(project: Project, changes: dict[str, bytes | None], path: str, rule: str) -> None:
    found = checks.run(project.with_changes(changes, {*changes, path}))
    assert (path, rule) in {(violation.path, violation.rule) for violation in found}


@pytest.mark.parametrize("name", EDITS)
def test_edits_are_found_and_named(repository: Project, name: str) -> None:
    path, old, new, rule, *named = EDITS[name]
    changed, count = re.subn(old, new, repository.data(path).decode(), count=1, flags=re.MULTILINE | re.DOTALL)
    assert count == 1, f"{path} does not contain {old}"
    assert_named(repository, {path: changed.encode()}, named[0] if named else path, rule)


@pytest.mark.parametrize("name", FILES)
def test_files_are_found_and_named(repository: Project, name: str) -> None:
    assert_named(repository, *FILES[name])


@pytest.mark.parametrize("number, name", enumerate(BODIES))
def test_sources_are_found_and_named(odd: tuple[Project, set[tuple[str, str]]], number: int, name: str) -> None:
    folder = BODIES[name][0] if len(BODIES[name]) == 3 else RUNTIME
    assert (f"{folder}/Odd{number}.cs", BODIES[name][-1]) in odd[1]


def test_stored_fields(odd: tuple[Project, set[tuple[str, str]]]) -> None:
    known = sources.answer(odd[0])["scripts"]
    assert {body: known[f"{RUNTIME}/Stored{k}.cs"] for k, body in enumerate(STORED)} == STORED


def test_what_is_right_is_not_named(odd: tuple[Project, set[tuple[str, str]]]) -> None:
    new = [f"{RUNTIME}/Stored{k}.cs" for k in range(len(STORED) + len(RIGHT))]
    assert {rule for path, rule in odd[1] if path in new} <= {"meta-missing", "text-wide"}


def test_a_renamed_asset_keeps_its_guid_when_listed(repository: Project) -> None:
    moved = VECTOR.replace("Vector3d", "Vector")
    changes = {VECTOR: None, f"{VECTOR}.meta": None, moved: repository.data(VECTOR),
               f"{moved}.meta": repository.data(f"{VECTOR}.meta")}
    assert_named(repository, changes, f"{moved}.meta", "guid-changed")
    listed = repository.with_changes({**changes, metas.KNOWN_GUIDS: f"{moved} {GUID(VECTOR)}\n".encode()}, ())
    assert checks.run(listed) == []


def test_missing_metas_are_written_as_unity_takes_them(tmp_path: Path, repository: Project) -> None:
    (tmp_path / f"{HOME}/Core").mkdir(parents=True)
    (tmp_path / CORE_ASMDEF).write_bytes(repository.data(CORE_ASMDEF))
    written = [f"{HOME}.meta", f"{HOME}/Core.meta", f"{CORE_ASMDEF}.meta"]
    assert metas.write_missing(Project(tmp_path)) == written and metas.write_missing(Project(tmp_path)) == []
    assert all((tmp_path / path).read_text() == repository.text(path) for path in written)

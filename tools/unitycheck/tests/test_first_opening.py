"""What Unity writes is right: the repository as it is, opened, opened by a newer editor, and things that users add."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Sequence

import pytest

from tools.unitycheck import checks
from tools.unitycheck.project import Project
from tools.unitycheck.tests import firstopening
from tools.unitycheck.tests.breakages import (
    GUIDEWIRE, HUD, LOOP, ODD, RUNTIME, Change, behaviour, both, insert, replace,
)
from tools.unitycheck.tests.breakages import write
from tools.unitycheck.tests.test_mutations import repository  # noqa: F401

TUBE = f"{GUIDEWIRE}/Tests/Unity/TubeMeshTests.cs"


def guid_of(project: Project, path: str) -> str:
    """The guid of an asset, as its .meta has it."""
    return project.text(f"{path}.meta").split("guid: ")[1].split("\n")[0]


def with_meta(path: str, text: str, importer: str) -> Change:
    """A new asset with the .meta that Unity gives it, and its guid among the known ones."""
    guid = hashlib.md5(path.encode()).hexdigest()
    meta = f"fileFormatVersion: 2\nguid: {guid}\n{importer}:\n  externalObjects: {{}}\n  userData: \n"
    return both(both(write(path, text), write(f"{path}.meta", meta)),
                lambda project: {"tools/unitycheck/known_guids.txt": project.data("tools/unitycheck/known_guids.txt")
                                 + f"{path} {guid}\n".encode()})


def script(body: str) -> Change:
    """A behaviour of its own name, so that several can stand beside each other."""
    name = "Odd" + hashlib.md5(body.encode()).hexdigest()[:6]
    return with_meta(f"{RUNTIME}/{name}.cs", behaviour(body, name), "MonoImporter")


def test_what_unity_has_opened_passes(repository: Project) -> None:  # noqa: F811
    opened = repository.with_changes(firstopening.files(repository), ())
    assert [str(violation) for violation in checks.run(opened)] == []


def test_all_class_numbers_are_there() -> None:
    text = b"".join(firstopening.FILES.values()).decode()
    assert all(f"!u!{number} &1" in text for number in (30, 387306366, 1386491679, 937362698, 78))
    ends = firstopening.FILES["ProjectSettings/SceneTemplateSettings.json"]
    assert not ends.endswith(b"\n")


def test_a_newer_editor_passes(repository: Project) -> None:  # noqa: F811
    assert [str(v) for v in checks.run(repository.with_changes(firstopening.newer(repository), ()))] == []


# A prefab's instance at the root, and objects within it that others in the scene name.
PREFAB = """--- !u!1001 &900
PrefabInstance:
  m_ObjectHideFlags: 0
  serializedVersion: 2
  m_Modification:
    serializedVersion: 3
    m_TransformParent: {fileID: 0}
    m_Modifications: []
  m_SourcePrefab: {fileID: 0}
--- !u!4 &901 stripped
Transform:
  m_CorrespondingSourceObject: {fileID: 0}
  m_PrefabInstance: {fileID: 900}
  m_PrefabAsset: {fileID: 0}
--- !u!1 &902 stripped
GameObject:
  m_CorrespondingSourceObject: {fileID: 0}
  m_PrefabInstance: {fileID: 900}
  m_PrefabAsset: {fileID: 0}
--- !u!114 &903 stripped
MonoBehaviour:
  m_CorrespondingSourceObject: {fileID: 0}
  m_PrefabInstance: {fileID: 900}
  m_PrefabAsset: {fileID: 0}
  m_GameObject: {fileID: 902}
  m_Enabled: 1
  m_Script: {fileID: 11500000, guid: HUD, type: 3}
"""

# What is right and once was named wrong, or might be.
RIGHT = {
    "editor under its condition": replace(LOOP, "^using UnityEngine;", "#if UNITY_EDITOR\nusing UnityEditor;\n#endif\n"
                                          "using UnityEngine;"),
    "editor in a branch": insert(LOOP, "private void Save()\n        {\n#if UNITY_EDITOR\n            UnityEditor."
                                 "AssetDatabase.Refresh();\n#endif\n        }\n\n        public void S2() { Save(); }"),
    "coroutine as Start, full name": script("private System.Collections.IEnumerator Start() { yield return null; }"),
    "method called by Invoke": script('private void Start() { Invoke("Blink", 1f); } private void Blink() { }'),
    "method called by nameof": script("private void Start() { Invoke(nameof(Blink), 1f); } private void Blink() { }"),
    "coroutine by name": script('private void Start() { StartCoroutine("Blink"); }'
                                " private IEnumerator Blink() { yield return null; }"),
    "coroutine by call": script("private void Start() { StartCoroutine(Blink()); }"
                                " private IEnumerator Blink() { yield return null; }"),
    "asynchronous Start": script("private async void Start() { await System.Threading.Tasks.Task.Delay(1); }"),
    "messages of two dimensions": script("private void OnCollisionEnter2D(Collision2D c) { }"
                                         " private void OnTriggerExit2D(Collider2D c) { }"),
    "messages of particles and joints": script("private void OnParticleCollision(GameObject o) { }"
                                               " private void OnJointBreak(float f) { }"
                                               " private void OnAnimatorIK(int layer) { }"
                                               " private void OnParticleSystemStopped() { }"),
    "messages of sound and canvas": script("private void OnAudioFilterRead(float[] data, int channels) { }"
                                           " private void OnRectTransformDimensionsChange() { }"),
    "pause with its bool": script("private void OnApplicationPause(bool pause) { }"
                                  " private void OnApplicationFocus(bool focus) { }"),
    "context menu": script('[ContextMenu("Blink")] private void Blink() { }'),
    "event of a delegate": script("private System.Action<string> _said;"
                                  ' private void Start() { _said.Invoke("hello"); }'),
    "value asked later": script("private readonly System.Func<float> _time = () => Time.time;"),
    "fields of every kind": script(
        "[SerializeField] private List<Vector3> _a; [SerializeField] private Pair[] _b; public AnimationCurve C;"
        " [SerializeField] private Guidewire.Runtime.Colouring _d; [SerializeField, Range(0, 1)] private float _e, _f;"
        " [SerializeField] private string? _g; [SerializeReference] private object _h; public LayerMask I;"
        " [System.Serializable] private struct Pair { public int A; } public Dictionary<int, int> NotAsked;"),
    "generic base with a static helper": script("private static int Count<T>(List<T> a) { return a.Count; }"
                                                " public int N => Count(new List<int>());"),
    "behaviour in two files": both(
        replace(HUD, "public sealed class Hud", "public sealed partial class Hud"),
        with_meta(f"{RUNTIME}/Views/HudText.cs", "namespace Guidewire.Runtime\n{\n    public sealed partial class Hud"
                                                 "\n    {\n    }\n}\n", "MonoImporter")),
    "abstract behaviour": both(with_meta(ODD, behaviour("").replace("sealed", "abstract"), "MonoImporter"), replace(
        LOOP, "SimulationLoop : MonoBehaviour", "SimulationLoop : Odd")),
    "picture": with_meta(f"{GUIDEWIRE}/A.png", "", "TextureImporter"),
    "library": with_meta(f"{GUIDEWIRE}/A.dll", "", "PluginImporter"),
    "prefab": with_meta(f"{GUIDEWIRE}/A.prefab", firstopening.HEADER + "--- !u!1 &3\nGameObject:\n  m_Name: A\n",
                        "PrefabImporter"),
    "shader": with_meta(f"{GUIDEWIRE}/A.shader", 'Shader "Own/A"\n{\n}\n', "ShaderImporter"),
    "own shader found": both(
        with_meta(f"{GUIDEWIRE}/A.shader", 'Shader "Own/A"\n{\n}\n', "ShaderImporter"),
        insert(HUD, 'private static Shader Own() { return Shader.Find("Own/A"); } public static Shader O2 => Own();')),
    "assembly reference": with_meta(f"{RUNTIME}/Views/More/More.asmref", '{"reference": "Guidewire.Runtime"}',
                                    "AssemblyDefinitionReferenceImporter"),
    "unknown kind of file": with_meta(f"{GUIDEWIRE}/A.xyz", "", "SomeNewImporter"),
    "definition without a line end": lambda project: {
        f"{RUNTIME}/Guidewire.Runtime.asmdef": project.data(f"{RUNTIME}/Guidewire.Runtime.asmdef").rstrip()},
    "define of a version": replace(f"{GUIDEWIRE}/Editor/Guidewire.Editor.asmdef", r'"versionDefines": \[\]',
                                   '"versionDefines": [{"name": "com.unity.burst", "expression": "1.8", '
                                   '"define": "HAS_BURST"}]'),
    "constraint of this editor": replace(f"{RUNTIME}/Guidewire.Runtime.asmdef", r'"defineConstraints": \[\]',
                                         '"defineConstraints": ["UNITY_6000_0_OR_NEWER", "!UNITY_ANDROID || DEBUG"]'),
    "options that Unity takes": write(f"{RUNTIME}/csc.rsp", "# options\n-nullable:enable\n-nowarn:1701,1702\n"
                                      "-define:GUIDEWIRE_ON\n-langversion:9.0\n-warnaserror+\n"),
    "tag of the project": both(write("ProjectSettings/TagManager.asset", firstopening.FILES[
        "ProjectSettings/TagManager.asset"].decode().replace("tags: []", "tags:\n  - Wire")), replace(
            firstopening.SCENE, "m_TagString: Untagged", "m_TagString: Wire")),
    "collider in a scene": lambda project: {firstopening.SCENE: project.text(firstopening.SCENE).replace(
        "  - component: {fileID: 402}\n", "  - component: {fileID: 402}\n  - component: {fileID: 403}\n").replace(
            "--- !u!1 &500\n", "--- !u!135 &403\nSphereCollider:\n  m_GameObject: {fileID: 400}\n  m_Enabled: 1\n"
            "--- !u!1 &500\n").encode()},
    "cases, sources and values": insert(
        TUBE, "private static readonly int[] Counts = { 1, 2 };"
              "\n[TestCaseSource(nameof(Counts))] public void A(int n) { }"
              "\n[Test] public void B([Values(1, 2)] int n) { }"
              "\n[TestCase(1, ExpectedResult = 1)] public int C(int n) { return n; }"),
    "test that awaits": insert(TUBE, "[Test] public async System.Threading.Tasks.Task A() "
                                     "{ await System.Threading.Tasks.Task.Yield(); }"),
    "what Unity's profile has and .NET Framework lacks": insert(
        TUBE, "[Test] public void A() { System.Array.Fill(new int[1], System.Math.Clamp(1, 0, 2)); }"),
    "field under its former name": both(
        replace(LOOP, "private float _pace = 1f;",
                '[UnityEngine.Serialization.FormerlySerializedAs("_pace")] private float _rate = 1f;\n'
                "        private float _pace { get => _rate; set => _rate = value; }"), lambda project: {}),
    "instance of a prefab with its stripped Transform": lambda project: {firstopening.SCENE: project.text(
        firstopening.SCENE).replace("--- !u!1 &500\n", PREFAB.replace("HUD", guid_of(project, HUD))
                                                     + "--- !u!1 &500\n").replace(
            "  m_Roots:\n", "  m_Roots:\n  - {fileID: 900}\n").encode()},
    "checked menu entry": insert(
        f"{GUIDEWIRE}/Editor/BatchEntry.cs", '[MenuItem("Guidewire/One")] public static void One() { }'
        '\n[MenuItem("Guidewire/One", true)] public static bool MayOne() { return true; }'),
}


# Four at once, one upon the other; each by itself where campaigns run in full.
AT_ONCE = 1 if os.environ.get("GUIDEWIRE_ALL") else 4
GROUPS = [list(RIGHT)[first::-(-len(RIGHT) // AT_ONCE)] for first in range(-(-len(RIGHT) // AT_ONCE))]


@pytest.mark.parametrize("names", GROUPS, ids=" | ".join)
def test_what_is_right_passes(repository: Project, names: Sequence[str]) -> None:  # noqa: F811
    changed, paths = repository, set()
    for name in names:
        changes = RIGHT[name](changed)
        paths |= changes.keys()
        changed = changed.with_changes(changes, paths)
    found = [str(v) for v in checks.run(changed)
             if v.rule != "text-wide" and (v.rule, v.path) != ("meta-missing", f"{RUNTIME}/Views/More")]
    assert found == []

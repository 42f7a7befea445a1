"""The checker against this repository: clean as it is, and each of many seeded breakages found and named."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Callable

import pytest

from unitycheck import checks
from unitycheck.project import Project

ROOT = Path(__file__).resolve().parents[2]
GUIDEWIRE = "Assets/Guidewire"
VECTOR = f"{GUIDEWIRE}/Core/Numbers/Vector3d.cs"
CORE = f"{GUIDEWIRE}/Core/Guidewire.Core.asmdef"
IO = f"{GUIDEWIRE}/Io/Guidewire.Io.asmdef"
RUNTIME = f"{GUIDEWIRE}/Runtime/Guidewire.Runtime.asmdef"
TESTS = f"{GUIDEWIRE}/Tests/Core/Guidewire.Core.Tests.asmdef"
MANIFEST = "Packages/manifest.json"
BUILD = "ProjectSettings/EditorBuildSettings.asset"
SCENE = f"{GUIDEWIRE}/Scenes/Insertion.unity"
MATERIAL = f"{GUIDEWIRE}/Materials/Wire.mat"
LOOP = f"{GUIDEWIRE}/Runtime/Loop/SimulationLoop.cs"
HUD = f"{GUIDEWIRE}/Runtime/Views/Hud.cs"


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """The parts of this repository that Unity reads, in a folder that a test may break."""
    for name in ("Assets", "Packages", "ProjectSettings"):
        shutil.copytree(ROOT / name, tmp_path / name, ignore=shutil.ignore_patterns("bin", "obj"))
    for name in (".gitattributes", "unitycheck/known_guids.txt"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    return tmp_path


def replace(path: str, old: str, new: str) -> Callable[[Path], None]:
    """A breakage: the first `old` (a regular expression, which must match) becomes `new`."""

    def apply(root: Path) -> None:
        data = (root / path).read_bytes().decode("utf-8")
        changed, count = re.subn(old, new, data, count=1, flags=re.MULTILINE)
        assert count == 1, f"{path} does not contain {old}"
        (root / path).write_bytes(changed.encode("utf-8"))

    return apply


def insert(path: str, code: str) -> Callable[[Path], None]:
    """A breakage: code at the start of the file's first type."""
    return replace(path, r"^    \{\n", "    {\n        " + code.replace("\\", r"\\") + "\n")


def remove(path: str) -> Callable[[Path], None]:
    """A breakage: the file is gone."""
    return lambda root: (root / path).unlink()


def move(old: str, new: str) -> Callable[[Path], None]:
    """A breakage: the file and its .meta are renamed."""

    def apply(root: Path) -> None:
        (root / old).rename(root / new)
        (root / f"{old}.meta").rename(root / f"{new}.meta")

    return apply


def write(path: str, text: str) -> Callable[[Path], None]:
    """A breakage: a file that should not be there, or not so."""

    def apply(root: Path) -> None:
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_bytes(text.encode("utf-8"))

    return apply


# name: (breakage, the file that must be named, the rule that must name it)
BREAKAGES = {
    "guid changed": (replace(f"{VECTOR}.meta", "^guid: .", "guid: 0"), f"{VECTOR}.meta", "guid-changed"),
    "guid of wrong form": (replace(f"{VECTOR}.meta", "^guid: .", "guid: X"), f"{VECTOR}.meta", "guid-form"),
    "guid copied": (replace(f"{VECTOR}.meta", "^guid: .*", "guid: 0" + 31 * "1"), f"{VECTOR}.meta", "guid-changed"),
    "meta missing": (remove(f"{VECTOR}.meta"), VECTOR, "meta-missing"),
    "folder's meta missing": (remove(f"{GUIDEWIRE}/Core.meta"), f"{GUIDEWIRE}/Core", "meta-missing"),
    "meta left behind": (remove(VECTOR), f"{VECTOR}.meta", "meta-orphan"),
    "wrong importer": (replace(f"{CORE}.meta", "AssemblyDefinitionImporter", "DefaultImporter"), f"{CORE}.meta",
                       "meta-importer"),
    "file renamed": (move(VECTOR, VECTOR.replace("Vector3d", "Vector")), f"{VECTOR.replace('Vector3d', 'Vector')}.meta",
                     "guid-changed"),
    "asmdef cycle": (replace(CORE, r'"references": \[\]', '"references": ["Guidewire.Io"]'), CORE, "asmdef-cycle"),
    "asmdef reference misspelt": (replace(IO, '"Guidewire.Core"', '"Guidewire.Kore"'), IO, "asmdef-reference"),
    "asmdef trailing comma": (replace(IO, "true\n}", "true,\n}"), IO, "json"),
    "asmdef key misspelt": (replace(IO, "noEngineReferences", "noEngineReference"), IO, "asmdef-form"),
    "player needs the editor": (replace(RUNTIME, '"Guidewire.Io"', '"Guidewire.Io", "Guidewire.Editor"'), RUNTIME,
                                "asmdef-editor"),
    "Core needs Runtime": (replace(CORE, r'"references": \[\]', '"references": ["Guidewire.Runtime"]'), CORE,
                           "asmdef-engine"),
    "wall around Core opened": (replace(CORE, '"noEngineReferences": true', '"noEngineReferences": false'), CORE,
                                "asmdef-engine"),
    "tests in players": (replace(TESTS, '"UNITY_INCLUDE_TESTS"', ""), TESTS, "asmdef-test"),
    "source outside an assembly": (write("Assets/Loose.cs", "namespace A\n{\n}\n"), "Assets/Loose.cs",
                                   "asmdef-outside"),
    "UnityEngine in Core": (replace(VECTOR, "^using System;", "using UnityEngine;\nusing System;"), VECTOR,
                            "engine-in-core"),
    "Unity type by its full name": (insert(VECTOR, "private UnityEngine.Vector3 _v;"), VECTOR, "engine-in-core"),
    "file-scoped namespace": (replace(VECTOR, r"^namespace Guidewire.Core\n\{", "namespace Guidewire.Core;\n{"), VECTOR,
                              "language"),
    "collection expression": (insert(VECTOR, "private static readonly int[] A = [1, 2];"), VECTOR, "language"),
    "record struct": (replace(VECTOR, r"readonly struct", "readonly record struct"), VECTOR, "language"),
    "raw string": (insert(VECTOR, 'private const string A = """b""";'), VECTOR, "language"),
    "global using": (replace(VECTOR, "^using System;", "global using System;"), VECTOR, "language"),
    "init accessor": (insert(VECTOR, "public int A { get; init; }"), VECTOR, "init-accessor"),
    "fused multiply-add": (insert(VECTOR, "private double A => Math.FusedMultiplyAdd(X, Y, Z);"), VECTOR, "api"),
    "intrinsics without a condition": (replace(VECTOR, "^using System;", "using System.Runtime.Intrinsics;"), VECTOR,
                                       "api"),
    "Multiple in a test": (write(f"{GUIDEWIRE}/Tests/Core/A.cs", "class A { void F() { Assert.Multiple(null); } }\n"),
                           f"{GUIDEWIRE}/Tests/Core/A.cs", "nunit"),
    "CRLF": (replace(VECTOR, "^using System;", "using System;\r"), VECTOR, "text-crlf"),
    "tab": (replace(VECTOR, "^    public", "\tpublic"), VECTOR, "text-tab"),
    "a line of 130 columns": (replace(VECTOR, "^    public", 110 * " " + "/* wide */ public"), VECTOR, "text-wide"),
    "version of a package": (replace(MANIFEST, '"3.2.1"', '"3.0.2"'), MANIFEST, "package-version"),
    "package missing": (replace(MANIFEST, r",\s*\"com.unity.test-framework\": \"1.5.1\"", ""), MANIFEST,
                        "package-missing"),
    "editor's version": (write("ProjectSettings/ProjectVersion.txt", "m_EditorVersion: 6000\n"),
                         "ProjectSettings/ProjectVersion.txt", "editor-version"),
    "binary serialization": (replace("ProjectSettings/EditorSettings.asset", "m_SerializationMode: 2",
                                     "m_SerializationMode: 1"), "ProjectSettings/EditorSettings.asset",
                             "editor-settings"),
    "settings header": (replace("ProjectSettings/EditorSettings.asset", "%YAML 1.1", "YAML 1.1"),
                        "ProjectSettings/EditorSettings.asset", "yaml-header"),
    "script guid changed in a scene": (replace(SCENE, "guid: [0-9a-f]{8}(.*type: 3)", r"guid: 00000000\1"), SCENE,
                                       "guid-unknown"),
    "script's own guid changed": (replace(f"{LOOP}.meta", "^guid: .{8}", "guid: 00000000"), SCENE, "guid-unknown"),
    "script renamed": (move(LOOP, LOOP.replace("SimulationLoop", "Loop")), LOOP.replace("SimulationLoop", "Loop"),
                       "script-name"),
    "class renamed": (replace(LOOP, "class SimulationLoop", "class MainLoop"), LOOP, "script-name"),
    "script made abstract": (replace(LOOP, "sealed class", "abstract class"), LOOP, "script-form"),
    "script that is no behaviour": (replace(LOOP, "SimulationLoop : MonoBehaviour", "SimulationLoop"), SCENE,
                                    "scene-script"),
    "field misspelt in a scene": (replace(SCENE, "_parameterFile:", "_parametersFile:"), SCENE, "field-unknown"),
    "field renamed in a script": (replace(LOOP, "string _parameterFile", "string _file"), SCENE, "field-unknown"),
    "field not stored any more": (replace(LOOP, r"\[SerializeField\] private string _parameterFile",
                                          "private string _parameterFile"), SCENE, "field-unknown"),
    "number where a field is text": (replace(SCENE, "  _pace: .*", "  _pace: fast"), SCENE, "field-value"),
    "broken fileID": (replace(SCENE, r"_loop: \{fileID: 302\}", "_loop: {fileID: 392}"), SCENE, "reference-local"),
    "component points elsewhere": (replace(SCENE, r"m_GameObject: \{fileID: 300\}", "m_GameObject: {fileID: 400}"),
                                   SCENE, "scene-component"),
    "component not listed": (replace(SCENE, r"  - component: \{fileID: 302\}\n", ""), SCENE, "scene-component"),
    "two objects of one number": (replace(SCENE, "^--- !u!1 &400", "--- !u!1 &300"), SCENE, "file-id"),
    "root not listed": (replace(SCENE, r"  - \{fileID: 401\}\n", ""), SCENE, "scene-roots"),
    "settings document missing": (replace(SCENE, "^--- !u!157 &3", "--- !u!157 &33"), SCENE, "scene-settings"),
    "class number": (replace(SCENE, "^--- !u!108 &", "--- !u!109 &"), SCENE, "class-id"),
    "missing brace": (replace(SCENE, r"m_Father: \{fileID: 0\}", "m_Father: {fileID: 0"), SCENE, "yaml-form"),
    "material gone": (lambda root: (remove(MATERIAL)(root), remove(f"{MATERIAL}.meta")(root)), SCENE, "guid-unknown"),
    "type of a reference": (replace(SCENE, "type: 3", "type: 2"), SCENE, "reference-type"),
    "scene not in the build": (replace(BUILD, "Transversal", "Transverse"), BUILD, "build-scenes"),
    "scene switched off": (replace(BUILD, "enabled: 1", "enabled: 0"), BUILD, "build-scenes"),
    "message misspelt": (replace(LOOP, r"void Update\(\)", "void Udpate()"), LOOP, "script-message"),
    "message in wrong case": (replace(HUD, r"void OnGUI\(\)", "void OnGui()"), HUD, "script-message"),
    "editor in a player": (replace(LOOP, "^using UnityEngine;", "using UnityEditor;\nusing UnityEngine;"), LOOP,
                           "editor-in-player"),
    "module of IMGUI missing": (replace(MANIFEST, '    "com.unity.modules.imgui": "1.0.0",\n', ""), HUD,
                                "module-missing"),
    "primary constructor": (replace(LOOP, "class SimulationLoop ", "class SimulationLoop(int x) "), LOOP, "language"),
    "attributes": (replace(".gitattributes", r"^\*\.unity.*\n", ""), ".gitattributes", "gitattributes"),
}


def found(root: Path) -> set[tuple[str, str]]:
    return {(violation.path, violation.rule) for violation in checks.run(Project(root))}


def test_repository_keeps_every_rule(copy: Path) -> None:
    assert [str(violation) for violation in checks.run(Project(copy))] == []


@pytest.mark.parametrize("name", sorted(BREAKAGES))
def test_breakage_is_found_and_named(copy: Path, name: str) -> None:
    breakage, path, rule = BREAKAGES[name]
    breakage(copy)
    assert (path, rule) in found(copy)


def test_there_are_at_least_30_breakages() -> None:
    assert len(BREAKAGES) >= 30

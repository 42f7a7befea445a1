"""A small Unity project that keeps every rule, for tests to break in one place."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tools.unitycheck import checks, metas
from tools.unitycheck.project import Project

HEADER = "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n"
FOLDER = "Assets/Guidewire"
SCENE = f"{FOLDER}/Scenes/One.unity"

BEHAVIOUR = """using UnityEngine;

namespace Guidewire.Runtime
{
    public sealed class Spinner : MonoBehaviour
    {
        [SerializeField] private float _speed = 1f;
        [SerializeField, Range(1, 9)] private int _count = 3;
        [SerializeField] private bool _on = true;
        [SerializeField] private string _file = "";
        [SerializeField] private Material _material = null!;

        private void Update()
        {
            Turn();
        }

        private void Turn()
        {
        }
    }
}
"""

SCENE_TEXT = HEADER + """--- !u!29 &1
OcclusionCullingSettings:
  m_ObjectHideFlags: 0
--- !u!104 &2
RenderSettings:
  m_ObjectHideFlags: 0
--- !u!157 &3
LightmapSettings:
  m_ObjectHideFlags: 0
--- !u!196 &4
NavMeshSettings:
  m_ObjectHideFlags: 0
--- !u!1 &100
GameObject:
  m_Component:
  - component: {fileID: 101}
  - component: {fileID: 102}
  m_Name: Spinner
--- !u!4 &101
Transform:
  m_GameObject: {fileID: 100}
  m_Children:
  - {fileID: 201}
  m_Father: {fileID: 0}
--- !u!114 &102
MonoBehaviour:
  m_GameObject: {fileID: 100}
  m_Enabled: 1
  m_Script: {fileID: 11500000, guid: SCRIPT, type: 3}
  m_Name: 
  m_EditorClassIdentifier: 
  _speed: 2.5
  _count: 4
  _on: 1
  _file: params/default.json
  _material: {fileID: 2100000, guid: MATERIAL, type: 2}
--- !u!1 &200
GameObject:
  m_Component:
  - component: {fileID: 201}
  - component: {fileID: 202}
  m_Name: Child
--- !u!4 &201
Transform:
  m_GameObject: {fileID: 200}
  m_Children: []
  m_Father: {fileID: 101}
--- !u!20 &202
Camera:
  m_GameObject: {fileID: 200}
  m_Enabled: 1
--- !u!1660057539 &9223372036854775807
SceneRoots:
  m_ObjectHideFlags: 0
  m_Roots:
  - {fileID: 101}
"""


def asmdef(name: str, **changes: Any) -> str:
    """The text of an assembly definition."""
    data = {"name": name, "references": [], "includePlatforms": [], "excludePlatforms": [], "overrideReferences": False,
            "precompiledReferences": [], "autoReferenced": True, "defineConstraints": [], "noEngineReferences": False}
    return json.dumps({**data, **changes}, indent=2) + "\n"


class Sample:
    """The small project on disk."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.write(".gitattributes", "".join(f"{pattern} text eol=lf\n" for pattern in
                                             ("*.cs", "*.meta", "*.unity", "*.asset", "*.asmdef", "*.mat")))
        self.write("Packages/manifest.json", '{"dependencies": {"com.unity.nuget.newtonsoft-json": "3.2.1", '
                   '"com.unity.test-framework": "1.5.1", "com.unity.modules.imgui": "1.0.0"}}\n')
        self.write("ProjectSettings/ProjectVersion.txt", "m_EditorVersion: 6000.0.58f2\n")
        self.write("ProjectSettings/EditorSettings.asset",
                   HEADER + "--- !u!159 &1\nEditorSettings:\n  m_SerializationMode: 2\n")
        self.write("ProjectSettings/VersionControlSettings.asset",
                   HEADER + "--- !u!890905787 &1\nVersionControlSettings:\n  m_Mode: Visible Meta Files\n")
        tests = {"references": ["Guidewire.Core", "UnityEngine.TestRunner", "UnityEditor.TestRunner"],
                 "includePlatforms": ["Editor"], "overrideReferences": True, "autoReferenced": False,
                 "precompiledReferences": ["nunit.framework.dll"], "defineConstraints": ["UNITY_INCLUDE_TESTS"]}
        for folder, name, changes in (("Core", "Guidewire.Core", {"noEngineReferences": True}),
                                      ("Runtime", "Guidewire.Runtime", {"references": ["Guidewire.Core"]}),
                                      ("Editor", "Guidewire.Editor", {"references": ["Guidewire.Runtime"],
                                                                      "includePlatforms": ["Editor"]}),
                                      ("Tests/Core", "Guidewire.Core.Tests", tests)):
            self.write(f"{FOLDER}/{folder}/{name}.asmdef", asmdef(name, **changes))
            self.write(f"{FOLDER}/{folder}/csc.rsp", "-nullable:enable\n")
        self.write(f"{FOLDER}/Core/Number.cs",
                   "namespace Guidewire.Core\n{\n    public sealed class Number\n    {\n    }\n}\n")
        self.write(f"{FOLDER}/Runtime/Spinner.cs", BEHAVIOUR)
        self.write(f"{FOLDER}/Tests/Core/NumberTests.cs",
                   "using NUnit.Framework;\n\nnamespace Guidewire.Core.Tests\n{\n}\n")
        self.write(f"{FOLDER}/Wire.mat", HEADER + "--- !u!21 &2100000\nMaterial:\n  m_Name: Wire\n"
                   "  m_Shader: {fileID: 46, guid: 0000000000000000f000000000000000, type: 0}\n")
        text = SCENE_TEXT.replace("SCRIPT", metas.stable_guid(f"{FOLDER}/Runtime/Spinner.cs"))
        self.write(SCENE, text.replace("MATERIAL", metas.stable_guid(f"{FOLDER}/Wire.mat")))
        self.write("ProjectSettings/EditorBuildSettings.asset",
                   HEADER + "--- !u!1045 &1\nEditorBuildSettings:\n  m_Scenes:\n  - enabled: 1\n"
                   f"    path: {SCENE}\n    guid: {metas.stable_guid(SCENE)}\n  m_configObjects: {{}}\n")
        metas.write_missing(Project(root))

    def write(self, path: str, text: str) -> None:
        """Write a file, with line ends as given."""
        target = self.root / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(text.encode("utf-8"))

    def add(self, path: str, text: str) -> None:
        """Write a file under Assets and the metas that it calls for."""
        self.write(path, text)
        metas.write_missing(Project(self.root))

    def edit(self, path: str, old: str, new: str) -> None:
        """Replace the first `old`, which must be there, by `new`."""
        text = (self.root / path).read_bytes().decode("utf-8")
        assert old in text, f"{path} does not contain {old!r}"
        self.write(path, text.replace(old, new, 1))

    def broken(self) -> set[tuple[str, str]]:
        """(path, rule) of every violation."""
        return {(violation.path, violation.rule) for violation in checks.run(Project(self.root))}


@pytest.fixture
def sample(tmp_path: Path) -> Sample:
    """A project without violations."""
    project = Sample(tmp_path)
    assert project.broken() == set()
    return project

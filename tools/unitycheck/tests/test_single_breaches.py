"""One breach in a small project is named by its one rule, at its one file, and nothing else is."""

from __future__ import annotations

import pytest

from tools.unitycheck import metas
from tools.unitycheck.tests.conftest import SCENE, asmdef

CORE = "Assets/Guidewire/Core/Guidewire.Core.asmdef"
RUNTIME = "Assets/Guidewire/Runtime/Guidewire.Runtime.asmdef"
EDITOR = "Assets/Guidewire/Editor/Guidewire.Editor.asmdef"
TESTS = "Assets/Guidewire/Tests/Core/Guidewire.Core.Tests.asmdef"
NUMBER = "Assets/Guidewire/Core/Number.cs"
SPINNER = "Assets/Guidewire/Runtime/Spinner.cs"
WIRE = "Assets/Guidewire/Wire.mat"
BUILD = "ProjectSettings/EditorBuildSettings.asset"
VERSION = "ProjectSettings/ProjectVersion.txt"
GUID = metas.stable_guid(NUMBER)
SPINNER_GUID = metas.stable_guid(SPINNER)
COMPONENTS = "  - component: {fileID: 101}\n  - component: {fileID: 102}"

# File, text that stands there, what takes its place, the rule.
BREACHES = {
    "unknown key": (CORE, '"overrideReferences": false', '"overideReferences": false', "asmdef-form"),
    "value of a wrong type": (CORE, '"overrideReferences": false', '"overrideReferences": "false"', "asmdef-form"),
    "both lists of platforms": (EDITOR, '"excludePlatforms": []', '"excludePlatforms": ["Android"]', "asmdef-form"),
    "unknown reference": (RUNTIME, '"Guidewire.Core"', '"Guidewire.Cor"', "asmdef-reference"),
    "reference by an unknown guid": (RUNTIME, '"Guidewire.Core"', f'"GUID:{32 * "0"}"', "asmdef-reference"),
    "name unlike the file": (EDITOR, '"name": "Guidewire.Editor"', '"name": "Guidewire.Editing"', "asmdef-name"),
    "wall around Core opened": (CORE, '"noEngineReferences": true', '"noEngineReferences": false', "asmdef-engine"),
    "tests in players": (TESTS, '"UNITY_INCLUDE_TESTS"', "", "asmdef-test"),
    "engine in Core": (NUMBER, "namespace", "using UnityEngine;\n\nnamespace", "CS0246"),
    "engine in Core by an alias": (NUMBER, "namespace", "using Vector3 = UnityEngine.Vector3;\n\nnamespace", "CS0246"),
    "engine in the shared tests": ("Assets/Guidewire/Tests/Core/NumberTests.cs", "using NUnit",
                                   "using UnityEngine.TestTools;\nusing NUnit", "CS0246"),
    "editor in a player": (SPINNER, "using UnityEngine;", "using UnityEditor;\nusing UnityEngine;",
                           "editor-in-player"),
    "module missing": (SPINNER, "            Turn();", "            int Physics = 0;\n            Turn();",
                       "module-missing"),
    "nullable switched off": ("Assets/Guidewire/Core/csc.rsp", "-nullable:enable", "-nullable:disable", "nullable"),
    "guid of wrong form": (f"{NUMBER}.meta", GUID, GUID[:-1] + "G", "guid-form"),
    "guid changed": (f"{NUMBER}.meta", GUID, GUID[1:] + GUID[0], "guid-changed"),
    "wrong importer": (f"{WIRE}.meta", "NativeFormatImporter", "DefaultImporter", "meta-importer"),
    "folder's meta for a file": ("Assets/Guidewire/Core.meta", "folderAsset: yes\n", "", "meta-importer"),
    "meta of another format": (f"{NUMBER}.meta", "fileFormatVersion: 2", "fileFormatVersion: 3", "meta-form"),
    "key without a colon": (SCENE, "  m_Name: Child", "  m_Name Child", "yaml-form"),
    "document's header": (SCENE, "--- !u!1 &200", "--- !u!1 200", "yaml-form"),
    "class of another number": (SCENE, "GameObject:\n  m_Component:\n  - component: {fileID: 201}",
                                "Gameobject:\n  m_Component:\n  - component: {fileID: 201}", "class-id"),
    "settings document gone": (SCENE, "--- !u!157 &3\nLightmapSettings:\n  m_ObjectHideFlags: 0\n", "",
                               "scene-settings"),
    "Transform second": (SCENE, COMPONENTS, "  - component: {fileID: 102}\n  - component: {fileID: 101}",
                         "scene-transform"),
    "component of another object": (SCENE, "MonoBehaviour:\n  m_GameObject: {fileID: 100}",
                                    "MonoBehaviour:\n  m_GameObject: {fileID: 200}", "scene-component"),
    "component not listed": (SCENE, "  - component: {fileID: 102}\n", "", "scene-component"),
    "child without a father": (SCENE, "  - {fileID: 201}\n  m_Father", "  m_Father", "scene-parent"),
    "root not listed": (SCENE, "  m_Roots:\n  - {fileID: 101}\n", "  m_Roots: []\n", "scene-roots"),
    "reference's type": (SCENE, f"{SPINNER_GUID}, type: 3", f"{SPINNER_GUID}, type: 2", "reference-type"),
    "reference's file ID": (SCENE, "{fileID: 11500000", "{fileID: 1150000", "reference-fileid"),
    "field misspelt": (SCENE, "  _speed: 2.5", "  _sped: 2.5", "field-unknown"),
    "word for a number": (SCENE, "_speed: 2.5", "_speed: fast", "field-value"),
    "fraction for a whole number": (SCENE, "_count: 4", "_count: 4.5", "field-value"),
    "word for a bool": (SCENE, "_on: 1", "_on: true", "field-value"),
    "script that is no behaviour": (SCENE, SPINNER_GUID, GUID, "scene-script"),
    "internal behaviour": (SPINNER, "public sealed class", "internal sealed class", "script-form"),
    "abstract behaviour in a scene": (SPINNER, "public sealed class", "public abstract class", "script-form"),
    "message with a letter lost": (SPINNER, "void Update()", "void Updte()", "script-message"),
    "message in small letters": (SPINNER, "void Update()", "void update()", "script-message"),
    "message that nobody sends": (SPINNER, "void Update()", "void StartIO()", "script-message"),
    "message of another spelling": (SPINNER, "void Update()", "void OnGui()", "script-message"),
    "static message": (SPINNER, "private void Update()\n        {\n            Turn();",
                       "private static void Update()\n        {", "script-message"),
    "version of two numbers": (VERSION, "6000.0.58f2", "6000.0", "editor-version"),
    "version under another key": (VERSION, "m_EditorVersion", "EditorVersion", "editor-version"),
    "binary serialization": ("ProjectSettings/EditorSettings.asset", "m_SerializationMode: 2",
                             "m_SerializationMode: 0", "editor-settings"),
    "metas hidden": ("ProjectSettings/VersionControlSettings.asset", "Visible Meta Files", "Hidden Meta Files",
                     "editor-settings"),
    "scene that is not there": (BUILD, "One.unity", "Two.unity", "build-scenes"),
    "scene of another guid": (BUILD, metas.stable_guid(SCENE), GUID, "build-scenes"),
    "scene switched off": (BUILD, "enabled: 1", "enabled: 0", "build-scenes"),
    "CRLF": (NUMBER, "Core\n", "Core\r\n", "text-crlf"),
    "tab": (NUMBER, "    public", "\tpublic", "text-tab"),
    "wide line": (NUMBER, "    public", "    /* " + 110 * "-" + " */ public", "text-wide"),
    "no line end": (NUMBER, "}\n}\n", "}\n}", "text-end"),
    "byte order mark": (NUMBER, "namespace", "\ufeffnamespace", "text-bom"),
    "YAML header": (WIRE, "%YAML 1.1", "%YAML 1.2", "yaml-header"),
    "attributes": (".gitattributes", "*.meta text eol=lf\n", "*.meta text\n", "gitattributes"),
}
# What is right: nothing is named.
RIGHT = {
    "reference by its guid": (RUNTIME, '"Guidewire.Core"', f'"GUID:{metas.stable_guid(CORE)}"'),
    "engine in a comment": (NUMBER, "namespace", "// UnityEngine.Vector3 is float.\nnamespace"),
    "module that is there": (SPINNER, "            Turn();", "            GUI.Label(default, _file);\n"
                                                             "            Turn();"),
    "private method that is called": (SPINNER, "private void Turn()",
                                      "private void Start()\n        {\n        }\n\n        private void Turn()"),
    "UTF-8": (NUMBER, "    {\n    }", "    {\n        // \u00e9 \u03c4\n    }"),
}


@pytest.mark.parametrize("name", BREACHES)
def test_a_breach_is_named_by_its_rule_alone(sample, name: str) -> None:
    path, old, new, rule = BREACHES[name]
    sample.edit(path, old, new)
    assert sample.broken() == {(path, rule)}


@pytest.mark.parametrize("name", RIGHT)
def test_what_is_right_is_not_named(sample, name: str) -> None:
    sample.edit(*RIGHT[name])
    assert sample.broken() == set()


def test_latin_1_is_named(sample) -> None:
    (sample.root / NUMBER).write_bytes((sample.root / NUMBER).read_bytes() + b"// \xe9\n")
    assert sample.broken() == {(NUMBER, "text-utf8")}


def test_a_cycle_is_named_once(sample) -> None:
    sample.add("Assets/Guidewire/Io/Guidewire.Io.asmdef", asmdef("Guidewire.Io", references=["Guidewire.Core"],
                                                                  noEngineReferences=True))
    sample.add("Assets/Guidewire/Io/csc.rsp", "-nullable:enable\n")
    assert sample.broken() == set()
    sample.edit(CORE, '"references": []', '"references": ["Guidewire.Io"]')
    assert sample.broken() == {(CORE, "asmdef-cycle")}


def test_a_test_assembly_overrides_its_references(sample) -> None:
    sample.edit(TESTS, '"overrideReferences": true', '"overrideReferences": false')
    assert {(TESTS, "asmdef-test"), (TESTS, "asmdef-precompiled")} <= sample.broken()


def test_a_source_outside_all_assemblies_is_named(sample) -> None:
    sample.add("Assets/Loose.cs", "namespace A\n{\n}\n")
    assert sample.broken() == {("Assets/Loose.cs", "asmdef-outside")}


def test_version_and_revision_agree(sample) -> None:
    sample.write(VERSION, "m_EditorVersion: 6000.0.58f2\nm_EditorVersionWithRevision: 6000.0.58f2 (92dee566b325)\n")
    assert sample.broken() == set()
    sample.edit(VERSION, "6000.0.58f2 (", "6000.0.57f2 (")
    assert sample.broken() == {(VERSION, "editor-version")}


def test_a_missing_settings_file_is_named(sample) -> None:
    (sample.root / VERSION).unlink()
    assert sample.broken() == {(VERSION, "settings-missing")}


def test_a_scene_that_is_not_in_the_list_is_named(sample) -> None:
    sample.add("Assets/Guidewire/Scenes/Two.unity", (sample.root / SCENE).read_text())
    assert sample.broken() == {(BUILD, "build-scenes")}


def test_a_lock_may_not_be_older(sample) -> None:
    sample.write("Packages/packages-lock.json", '{"dependencies": {"com.unity.ext.nunit": {"version": "2.0.5"}}}\n')
    assert sample.broken() == set()
    sample.edit("Packages/packages-lock.json", "2.0.5", "1.0.6")
    assert sample.broken() == {("Packages/packages-lock.json", "package-version")}

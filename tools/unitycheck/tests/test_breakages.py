"""The checker against this repository: clean as it is, and each of many seeded breakages found and named.

A breakage is laid over the project in memory: the files on disk are read once and never touched.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tools.unitycheck import checks, metas
from tools.unitycheck.project import Project

ROOT = Path(__file__).resolve().parents[3]
HOME = "Assets/Guidewire"
RUNTIME, EDITOR, TESTS = f"{HOME}/Runtime", f"{HOME}/Editor", f"{HOME}/Tests/Core"
CORE_ASMDEF = f"{HOME}/Core/Guidewire.Core.asmdef"
IO_ASMDEF = f"{HOME}/Io/Guidewire.Io.asmdef"
RUNTIME_ASMDEF = f"{RUNTIME}/Guidewire.Runtime.asmdef"
SAMPLE_ASMDEF = f"{HOME}/Samples~/InputSystem/Guidewire.Samples.InputSystem.asmdef"
EDITOR_ASMDEF = f"{EDITOR}/Guidewire.Editor.asmdef"
TESTS_ASMDEF = f"{TESTS}/Guidewire.Core.Tests.asmdef"
VECTOR = f"{HOME}/Core/Numbers/Vector3d.cs"
LOOP, HUD = f"{RUNTIME}/Loop/SimulationLoop.cs", "Assets/Scenes/Hud.cs"
SCENE = "Assets/Scenes/Insertion.unity"
WIRE = f"{RUNTIME}/Resources/Guidewire/Wire.mat"
MANIFEST, PACKAGE = "Packages/manifest.json", f"{HOME}/package.json"
GUID = metas.stable_guid
REFERENCES = r'"references": \[\]'

# What is changed: file, regular expression over its lines, what takes its place, the rule; the file that is named, if
# it is another.
EDITS = {
    # Assembly definitions
    "define misspelt": (RUNTIME_ASMDEF, '"define": "GUIDEWIRE_INPUT', '"define": "GUIDEWIRE_IMPUT', "asmdef-define"),
    "sample's define misspelt": (SAMPLE_ASMDEF, '"define": "GUIDEWIRE_INPUT', '"define": "GUIDEWIRE_IMPUT',
                                 "asmdef-define"),
    "constraint misspelt": (SAMPLE_ASMDEF, '"GUIDEWIRE_INPUT_SYSTEM"\n', '"GUIDEWIRE_INPUTSYSTEM"\n', "asmdef-define"),
    "define in a source misspelt": (f"{RUNTIME}/Loop/HostInput.cs", "GUIDEWIRE_INPUT_", "GUIDEWIRE_IMPUT_",
                                    "asmdef-define", RUNTIME_ASMDEF),
    "cycle": (CORE_ASMDEF, REFERENCES, '"references": ["Guidewire.Io"]', "asmdef-cycle"),
    "reference misspelt": (IO_ASMDEF, '"Guidewire.Core"', '"Guidewire.Kore"', "asmdef-reference"),
    "reference by an unknown guid": (IO_ASMDEF, '"Guidewire.Core"', f'"GUID:{32 * "3"}"', "asmdef-reference"),
    "reference twice, by name and by guid": (
        IO_ASMDEF, '"Guidewire.Core"', f'"Guidewire.Core", "GUID:{GUID(CORE_ASMDEF)}"', "asmdef-reference"),
    "reference to a package that is not there": (
        RUNTIME_ASMDEF, '"Guidewire.Io"', '"Guidewire.Io", "Unity.Burst"', "asmdef-reference"),
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
    "module that is not there": ({f"{RUNTIME}/Odd.cs": b"private AudioSource _a;\n"}, f"{RUNTIME}/Odd.cs",
                                 "module-missing"),
    "Latin-1": ({f"{RUNTIME}/Odd.cs": b"// \xe9\n"}, f"{RUNTIME}/Odd.cs", "text-utf8"),
}


@pytest.fixture(scope="module")
def repository() -> Project:
    """This repository, read once."""
    return Project(ROOT)


def test_repository_keeps_every_rule(repository: Project) -> None:
    assert [str(violation) for violation in checks.run(repository)] == []


def assert_named(project: Project, changes: dict[str, bytes | None], path: str, rule: str) -> None:
    found = checks.run(project.with_changes(changes))
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


def test_a_renamed_asset_keeps_its_guid_when_listed(repository: Project) -> None:
    moved = VECTOR.replace("Vector3d", "Vector")
    changes = {VECTOR: None, f"{VECTOR}.meta": None, moved: repository.data(VECTOR),
               f"{moved}.meta": repository.data(f"{VECTOR}.meta")}
    assert_named(repository, changes, f"{moved}.meta", "guid-changed")
    listed = repository.with_changes({**changes, metas.KNOWN_GUIDS: repository.data(metas.KNOWN_GUIDS)
                                      + f"{moved} {GUID(VECTOR)}\n".encode()})
    assert checks.run(listed) == []


def test_missing_metas_are_written_as_unity_takes_them(tmp_path: Path, repository: Project) -> None:
    (tmp_path / f"{HOME}/Core").mkdir(parents=True)
    (tmp_path / CORE_ASMDEF).write_bytes(repository.data(CORE_ASMDEF))
    written = [f"{HOME}.meta", f"{HOME}/Core.meta", f"{CORE_ASMDEF}.meta"]
    assert metas.write_missing(Project(tmp_path)) == written and metas.write_missing(Project(tmp_path)) == []
    assert all((tmp_path / path).read_text() == repository.text(path) for path in written)

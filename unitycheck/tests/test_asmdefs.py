"""Assembly definitions: form, references, arrows, the engine-free wall."""

from __future__ import annotations

from unitycheck import metas
from unitycheck.tests.conftest import asmdef

CORE = "Assets/Guidewire/Core/Guidewire.Core.asmdef"
RUNTIME = "Assets/Guidewire/Runtime/Guidewire.Runtime.asmdef"
EDITOR = "Assets/Guidewire/Editor/Guidewire.Editor.asmdef"
TESTS = "Assets/Guidewire/Tests/Core/Guidewire.Core.Tests.asmdef"
NUMBER = "Assets/Guidewire/Core/Number.cs"


def test_not_json(sample) -> None:
    sample.edit(CORE, '"references": [],', '"references": [],,')
    assert (CORE, "json") in sample.broken()


def test_key_twice(sample) -> None:
    sample.edit(CORE, '"references": [],', '"references": [], "references": [],')
    assert (CORE, "json") in sample.broken()


def test_unknown_key_and_wrong_type(breakage, sample) -> None:
    breakage(CORE, '"overrideReferences": false', '"overideReferences": false', "asmdef-form")
    sample.edit(CORE, '"overideReferences": false', '"overrideReferences": "false"')
    assert sample.broken() == {(CORE, "asmdef-form")}


def test_both_platform_lists(breakage) -> None:
    breakage(EDITOR, '"excludePlatforms": []', '"excludePlatforms": ["Android"]', "asmdef-form")


def test_unknown_reference(breakage) -> None:
    breakage(RUNTIME, '"Guidewire.Core"', '"Guidewire.Cor"', "asmdef-reference")


def test_reference_by_guid(sample) -> None:
    sample.edit(RUNTIME, '"Guidewire.Core"', f'"GUID:{metas.stable_guid(CORE)}"')
    assert sample.broken() == set()
    sample.edit(RUNTIME, metas.stable_guid(CORE), "0" * 32)
    assert sample.broken() == {(RUNTIME, "asmdef-reference")}


def test_name_twice(sample) -> None:
    sample.edit(EDITOR, '"name": "Guidewire.Editor"', '"name": "Guidewire.Runtime"')
    assert {path for path, rule in sample.broken() if rule == "asmdef-name"} >= {EDITOR}


def test_file_name(breakage) -> None:
    breakage(EDITOR, '"name": "Guidewire.Editor"', '"name": "Guidewire.Editing"', "asmdef-name")


def test_cycle(sample) -> None:
    sample.add("Assets/Guidewire/Io/Guidewire.Io.asmdef", asmdef("Guidewire.Io", references=["Guidewire.Core"],
                                                                  noEngineReferences=True))
    sample.add("Assets/Guidewire/Io/csc.rsp", "-nullable:enable\n")
    assert sample.broken() == set()
    sample.edit(CORE, '"references": []', '"references": ["Guidewire.Io"]')
    assert sample.broken() == {(CORE, "asmdef-cycle")}


def test_player_assembly_references_editor(sample) -> None:
    sample.edit(RUNTIME, '"Guidewire.Core"', '"Guidewire.Core", "Guidewire.Editor"')
    assert (RUNTIME, "asmdef-editor") in sample.broken()


def test_engine_free_assembly_references_engine(sample) -> None:
    sample.edit(CORE, '"references": []', '"references": ["Guidewire.Runtime"]')
    assert (CORE, "asmdef-engine") in sample.broken()


def test_wall_must_be_enforced_by_the_compiler(breakage) -> None:
    breakage(CORE, '"noEngineReferences": true', '"noEngineReferences": false', "asmdef-engine")


def test_test_assembly_constraint(breakage) -> None:
    breakage(TESTS, '"UNITY_INCLUDE_TESTS"', "", "asmdef-test")


def test_test_assembly_overrides(sample) -> None:
    sample.edit(TESTS, '"overrideReferences": true', '"overrideReferences": false')
    assert {(TESTS, "asmdef-test"), (TESTS, "asmdef-precompiled")} <= sample.broken()


def test_source_outside(sample) -> None:
    sample.add("Assets/Loose.cs", "namespace A\n{\n}\n")
    assert sample.broken() == {("Assets/Loose.cs", "asmdef-outside")}


def test_engine_in_core(breakage, sample) -> None:
    breakage(NUMBER, "namespace", "using UnityEngine;\n\nnamespace", "CS0246")
    sample.edit(NUMBER, "using UnityEngine;", "using Vector3 = UnityEngine.Vector3;")
    assert sample.broken() == {(NUMBER, "CS0246")}


def test_engine_in_shared_tests(breakage) -> None:
    breakage("Assets/Guidewire/Tests/Core/NumberTests.cs", "using NUnit", "using UnityEngine.TestTools;\nusing NUnit",
             "CS0246")


def test_engine_in_a_comment_passes(sample) -> None:
    sample.edit(NUMBER, "namespace", "// UnityEngine.Vector3 is float.\nnamespace")
    assert sample.broken() == set()


def test_editor_api_in_player(breakage) -> None:
    breakage("Assets/Guidewire/Runtime/Spinner.cs", "using UnityEngine;", "using UnityEditor;\nusing UnityEngine;",
             "editor-in-player")


def test_module_missing(breakage) -> None:
    breakage("Assets/Guidewire/Runtime/Spinner.cs", "            Turn();",
             "            int Physics = 0;\n            Turn();", "module-missing")


def test_module_present(sample) -> None:
    sample.edit("Assets/Guidewire/Runtime/Spinner.cs", "            Turn();", "            GUI.Label(default, _file);\n"
                "            Turn();")
    assert sample.broken() == set()


def test_nullable_option(breakage) -> None:
    breakage("Assets/Guidewire/Core/csc.rsp", "-nullable:enable", "-nullable:disable", "nullable")

"""Scenes: form, objects that point at each other, fields that the script stores."""

from __future__ import annotations

import pytest

from unitycheck import metas
from unitycheck.tests.conftest import HEADER, SCENE
from unitycheck.unityyaml import FormError, parse

SPINNER = metas.stable_guid("Assets/Guidewire/Runtime/Spinner.cs")


def test_parse_reads_nested_blocks_lists_and_braces() -> None:
    text = HEADER + ("--- !u!1 &7\nA:\n  a: 1\n  b:\n    c: x y\n  d:\n  - {e: 1, f: {g: 2}}\n  - h: 3\n    i: 4\n"
                     "  j: []\n  k: \n--- !u!4 &8 stripped\nB:\n  m: 1\n")
    first, second = parse(text)
    assert first.data == {"a": "1", "b": {"c": "x y"}, "d": [{"e": "1", "f": {"g": "2"}}, {"h": "3", "i": "4"}],
                          "j": [], "k": ""}
    assert (first.class_id, first.file_id, first.type, first.line) == (1, 7, "A", 3)
    assert second.data == {"m": "1"}


@pytest.mark.parametrize("body", ["  a 1\n", "  a: {b: 1\n", "    a: 1\n", "  a: 1\n  a: 2\n", "  # a: 1\n",
                                  "  a: {b: 1} c\n"])
def test_parse_refuses(body: str) -> None:
    with pytest.raises(FormError):
        parse(HEADER + "--- !u!1 &7\nA:\n" + body)


def test_form(breakage) -> None:
    breakage(SCENE, "  m_Name: Child", "  m_Name Child", "yaml-form")


def test_document_header(breakage) -> None:
    breakage(SCENE, "--- !u!1 &200", "--- !u!1 200", "yaml-form")


def test_class_number(breakage) -> None:
    breakage(SCENE, "GameObject:\n  m_Component:\n  - component: {fileID: 201}",
             "Gameobject:\n  m_Component:\n  - component: {fileID: 201}", "class-id")


def test_file_id_twice(sample) -> None:
    sample.edit(SCENE, "--- !u!1 &200", "--- !u!1 &101")
    assert (SCENE, "file-id") in sample.broken()


def test_dangling_reference(sample) -> None:
    sample.edit(SCENE, "  - {fileID: 201}\n  m_Father", "  - {fileID: 999}\n  m_Father")
    assert (SCENE, "reference-local") in sample.broken()


def test_settings_documents(sample) -> None:
    sample.edit(SCENE, "--- !u!157 &3\nLightmapSettings:\n  m_ObjectHideFlags: 0\n", "")
    assert sample.broken() == {(SCENE, "scene-settings")}


def test_transform_first(breakage) -> None:
    breakage(SCENE, "  - component: {fileID: 101}\n  - component: {fileID: 102}",
             "  - component: {fileID: 102}\n  - component: {fileID: 101}", "scene-transform")


def test_component_back_reference(breakage) -> None:
    breakage(SCENE, "MonoBehaviour:\n  m_GameObject: {fileID: 100}", "MonoBehaviour:\n  m_GameObject: {fileID: 200}",
             "scene-component")


def test_component_not_listed(breakage) -> None:
    breakage(SCENE, "  - component: {fileID: 102}\n", "", "scene-component")


def test_child_without_father(breakage) -> None:
    breakage(SCENE, "  - {fileID: 201}\n  m_Father", "  m_Father", "scene-parent")


def test_roots(breakage) -> None:
    breakage(SCENE, "  m_Roots:\n  - {fileID: 101}\n", "  m_Roots: []\n", "scene-roots")


def test_roots_missing(sample) -> None:
    text = (sample.root / SCENE).read_text()
    sample.write(SCENE, text[:text.index("--- !u!1660057539")])
    assert sample.broken() == {(SCENE, "scene-roots")}


def test_unknown_guid(sample) -> None:
    sample.edit(SCENE, SPINNER, "0123456789abcdef0123456789abcdef")
    assert sample.broken() == {(SCENE, "guid-unknown"), (SCENE, "scene-script")}


def test_reference_type(breakage) -> None:
    breakage(SCENE, f"{SPINNER}, type: 3", f"{SPINNER}, type: 2", "reference-type")


def test_reference_file_id(breakage) -> None:
    breakage(SCENE, "{fileID: 11500000", "{fileID: 1150000", "reference-fileid")


def test_field_misspelt(breakage) -> None:
    breakage(SCENE, "  _speed: 2.5", "  _sped: 2.5", "field-unknown")


@pytest.mark.parametrize("old, new", [("_speed: 2.5", "_speed: fast"), ("_count: 4", "_count: 4.5"), ("_on: 1",
                                                                                                      "_on: true")])
def test_field_of_wrong_type(breakage, old: str, new: str) -> None:
    breakage(SCENE, old, new, "field-value")


def test_script_that_is_no_behaviour(breakage) -> None:
    breakage(SCENE, SPINNER, metas.stable_guid("Assets/Guidewire/Core/Number.cs"), "scene-script")

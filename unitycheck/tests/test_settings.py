"""ProjectSettings and Packages."""

from __future__ import annotations

import pytest

from unitycheck import metas
from unitycheck.tests.conftest import SCENE

BUILD = "ProjectSettings/EditorBuildSettings.asset"
MANIFEST = "Packages/manifest.json"
VERSION = "ProjectSettings/ProjectVersion.txt"


@pytest.mark.parametrize("old, new", [("6000.0.58f2", "6000.0"), ("m_EditorVersion", "EditorVersion")])
def test_version(breakage, old: str, new: str) -> None:
    breakage(VERSION, old, new, "editor-version")


def test_version_and_revision_agree(sample) -> None:
    sample.write(VERSION, "m_EditorVersion: 6000.0.58f2\nm_EditorVersionWithRevision: 6000.0.58f2 (92dee566b325)\n")
    assert sample.broken() == set()
    sample.edit(VERSION, "6000.0.58f2 (", "6000.0.57f2 (")
    assert sample.broken() == {(VERSION, "editor-version")}


def test_missing_file(sample) -> None:
    (sample.root / VERSION).unlink()
    assert sample.broken() == {(VERSION, "settings-missing")}


def test_text_serialization(breakage) -> None:
    breakage("ProjectSettings/EditorSettings.asset", "m_SerializationMode: 2", "m_SerializationMode: 0",
             "editor-settings")


def test_visible_metas(breakage) -> None:
    breakage("ProjectSettings/VersionControlSettings.asset", "Visible Meta Files", "Hidden Meta Files",
             "editor-settings")


def test_scene_that_is_not_there(sample) -> None:
    sample.edit(BUILD, "One.unity", "Two.unity")
    assert sample.broken() == {(BUILD, "build-scenes")}


def test_scene_with_another_guid(breakage) -> None:
    breakage(BUILD, metas.stable_guid(SCENE), metas.stable_guid("Assets/Guidewire/Core/Number.cs"), "build-scenes")


def test_scene_switched_off(breakage) -> None:
    breakage(BUILD, "enabled: 1", "enabled: 0", "build-scenes")


def test_scene_not_listed(sample) -> None:
    sample.add("Assets/Guidewire/Scenes/Two.unity", (sample.root / SCENE).read_text())
    assert sample.broken() == {(BUILD, "build-scenes")}


@pytest.mark.parametrize("old, new, rule", [
    ('"3.2.1"', '"3.2.2"', "package-version"), ('"com.unity.modules.imgui": "1.0.0"',
                                                '"com.unity.modules.imgui": "2.0.0"',
                                               "package-version"),
    ('"com.unity.test-framework": "1.5.1", ', "", "package-missing"), ('"1.0.0"', '"1.0.0",', "json"),
    ('"com.unity.modules.imgui": "1.0.0"', '"com.unity.cinemachine": "3.0.0"', "package-unknown")])
def test_manifest(sample, old: str, new: str, rule: str) -> None:
    sample.edit(MANIFEST, old, new)
    assert (MANIFEST, rule) in sample.broken()


def test_lock(sample) -> None:
    sample.write("Packages/packages-lock.json", '{"dependencies": {"com.unity.ext.nunit": {"version": "2.0.5"}}}\n')
    assert sample.broken() == set()
    sample.edit("Packages/packages-lock.json", "2.0.5", "1.0.6")
    assert sample.broken() == {("Packages/packages-lock.json", "package-version")}

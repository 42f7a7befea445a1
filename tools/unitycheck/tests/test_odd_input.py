"""Whatever stands in a file, the check says so and goes on: no input makes it break off."""

from __future__ import annotations

import json
import os
from typing import Any

import pytest
from hypothesis import HealthCheck, given, seed, settings
from hypothesis import strategies as st

from tools.unitycheck import checks, sceneparameters, sources
from tools.unitycheck.project import Project
from tools.unitycheck.tests.breakages import GUIDEWIRE, HUD, MANIFEST, SCENE
from tools.unitycheck.tests.test_mutations import repository  # noqa: F401

ASMDEF = f"{GUIDEWIRE}/Io/Guidewire.Io.asmdef"
ASMREF = f"{GUIDEWIRE}/Runtime/Views/A.asmref"
LOCK = "Packages/packages-lock.json"
TAGS = "ProjectSettings/TagManager.asset"
MATERIAL = f"{GUIDEWIRE}/Runtime/Resources/Guidewire/Wire.mat"
JSON_FILES = (ASMDEF, ASMREF, MANIFEST, LOCK)
YAML_FILES = (SCENE, MATERIAL, TAGS, "ProjectSettings/EditorBuildSettings.asset",
              "ProjectSettings/ProjectSettings.asset",
              "ProjectSettings/EditorSettings.asset")
EXAMPLES = 60 if os.environ.get("GUIDEWIRE_ALL") == "1" else 10

values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8)
    | st.sampled_from(["Guidewire.Core", "GUID:", "Editor", "file:", "1.0.0", "UNITY_EDITOR", "!", "||", "\x00",
                       "9" * 5000]),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(
        st.text(max_size=6) | st.sampled_from(["dependencies", "name", "version", "scopes", "define"]), inner,
        max_size=4), max_leaves=12)
ASMDEF_KEYS = ["name", "references", "includePlatforms", "excludePlatforms", "precompiledReferences",
               "defineConstraints",
               "versionDefines", "overrideReferences", "noEngineReferences", "autoReferenced", "reference",
               "dependencies",
               "scopedRegistries", "testables"]
objects = st.dictionaries(st.sampled_from(ASMDEF_KEYS), values, max_size=6) | values
words = st.text(max_size=12) | st.sampled_from(["{fileID: 0}", "{", "[]", "{a: {b: ", "1", "-", "nan", "1e999",
                                                "9" * 5000, "- a",
                                                "{fileID: 302, guid: 0, type: 3}", "&1", "--- !u!1 &1", "\t", "#"])


def run(project: Project, changes: dict[str, bytes], monkeypatch: pytest.MonkeyPatch) -> None:
    """Every rule over the project with odd files; the console program is not asked, which takes seconds."""
    monkeypatch.setattr(sceneparameters, "program", lambda root: None)
    for violation in checks.run(project.with_changes(changes, changes)):
        assert str(violation)


@seed(11)
@settings(max_examples=EXAMPLES, deadline=None, suppress_health_check=list(HealthCheck))
@given(path=st.sampled_from(JSON_FILES), value=objects)
def test_odd_json(repository: Project, monkeypatch: pytest.MonkeyPatch, path: str, value: Any) -> None:  # noqa: F811
    run(repository, {path: json.dumps(value).encode("utf-8", "replace")}, monkeypatch)


@seed(12)
@settings(max_examples=EXAMPLES, deadline=None, suppress_health_check=list(HealthCheck))
@given(path=st.sampled_from(YAML_FILES), data=st.data())
def test_odd_yaml(repository: Project, monkeypatch: pytest.MonkeyPatch, path: str, data: Any) -> None:  # noqa: F811
    text = repository.text(path) if repository.is_file(path) else "%YAML 1.1\n--- !u!78 &1\nTagManager:\n  tags: []\n"
    lines = text.split("\n")
    for _ in range(data.draw(st.integers(1, 4))):
        place = data.draw(st.integers(0, len(lines) - 1))
        key, colon, _ = lines[place].partition(": ")
        how = data.draw(st.sampled_from(["value", "line", "gone", "deeper", "twice"]))
        if how == "gone":
            del lines[place]
            lines = lines or [""]
        elif how == "twice":
            lines.insert(place, lines[place])
        else:
            word = data.draw(words)
            lines[place] = key + colon + word if how == "value" else word if how == "line" else "  " + lines[place]
    run(repository, {path: "\n".join(lines).encode("utf-8", "replace")}, monkeypatch)


@seed(13)
@settings(max_examples=EXAMPLES, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_odd_source(repository: Project, data: Any) -> None:  # noqa: F811
    source = repository.text(HUD)
    tokens = st.sampled_from(["{", "}", "(", ")", "[", "]", "<", ">", ";", "=", "=>", '"', "'", "/*", "#if", "#endif",
                              ",",
                              "class", "struct", "enum", "where", "operator", "new", "\n", "$\"{", "@\""])
    for _ in range(data.draw(st.integers(1, 5))):
        place = data.draw(st.integers(0, len(source)))
        source = source[:place] + data.draw(tokens | st.text(max_size=3)) + source[place + data.draw(st.integers(0,
                                                                                                                 30)):]
    assert sources.answer(repository.with_changes({HUD: source.encode("utf-8", "replace")}, [HUD])) is not None


# Two files at once, of different kinds.
@pytest.mark.parametrize("paths", zip(
    (*JSON_FILES, HUD, f"{HUD}.meta", f"{GUIDEWIRE}/Io/csc.rsp", "ProjectSettings/ProjectVersion.txt"),
    (*YAML_FILES, "params/insertion.json", "docs/unity.md"), strict=True), ids=" and ".join)
@pytest.mark.parametrize("data", [b"", b"\n", b"\x00\xff\xfe", b"null", b"[" * 5000, b"{" * 5000, b'{"a":' * 5000,
                                  b"9" * 5000, b'"' * 999, b"- " * 3000, b"--- !u!1 &1\nA:\n" + b"  a: {" * 999],
                         ids=lambda data: f"{data[:16]!r} of {len(data)}")
def test_odd_bytes(repository: Project, monkeypatch: pytest.MonkeyPatch, paths: tuple[str, str],  # noqa: F811
                   data: bytes) -> None:
    run(repository, dict.fromkeys(paths, data), monkeypatch)


@pytest.mark.parametrize("depth", [30, 200, 3000])
def test_deep_blocks(repository: Project, monkeypatch: pytest.MonkeyPatch, depth: int) -> None:  # noqa: F811
    text = "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n--- !u!78 &1\nTagManager:\n"
    text += "".join(f"{'  ' * (k + 1)}a:\n" for k in range(depth))
    run(repository, {TAGS: text.encode()}, monkeypatch)

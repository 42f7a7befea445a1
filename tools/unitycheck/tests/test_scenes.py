"""Scenes: form, objects that point at each other, fields that the script stores."""

from __future__ import annotations

import pytest

from tools.unitycheck import metas
from tools.unitycheck.tests.conftest import HEADER, SCENE
from tools.unitycheck.unityyaml import FormError, parse

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


def test_file_id_twice(sample) -> None:
    sample.edit(SCENE, "--- !u!1 &200", "--- !u!1 &101")
    assert (SCENE, "file-id") in sample.broken()


def test_roots_missing(sample) -> None:
    text = (sample.root / SCENE).read_text()
    sample.write(SCENE, text[:text.index("--- !u!1660057539")])
    assert sample.broken() == {(SCENE, "scene-roots")}


def test_unknown_guid(sample) -> None:
    sample.edit(SCENE, SPINNER, "0123456789abcdef0123456789abcdef")
    assert sample.broken() == {(SCENE, "guid-unknown"), (SCENE, "scene-script")}

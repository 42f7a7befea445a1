"""Text hygiene of what Unity reads: UTF-8 without a mark, LF, no tabs in YAML, exact headers."""

from __future__ import annotations

import functools
import re
from typing import Iterator

from tools.unitycheck.project import TEXT_SUFFIXES, YAML_SUFFIXES, Project
from tools.unitycheck.violation import Violation

HEADER = "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n"
WIDEST = 120  # columns of a line of code
_CONFLICT = re.compile(r"^(<<<<<<< |=======$|>>>>>>> )", re.MULTILINE)


def _files(project: Project) -> Iterator[str]:
    yield from project.assets(*TEXT_SUFFIXES)
    yield from project.settings()
    yield from (path for path in ("Packages/manifest.json",) if project.exists(path))


def check(project: Project) -> Iterator[Violation]:
    """Rules text-utf8, -bom, -crlf, -tab, -wide, -conflict, yaml-header."""
    for path in _files(project):
        yield from _one(path, project.data(path))


@functools.lru_cache(maxsize=8192)
def _one(path: str, data: bytes) -> tuple[Violation, ...]:
    return tuple(_rules(path, data))


def _line(data: bytes, place: int) -> int:
    return data[:place].count(b"\n") + 1


def _rules(path: str, data: bytes) -> Iterator[Violation]:
    if data.startswith(b"\xef\xbb\xbf"):
        yield Violation(path, 1, "text-bom", "starts with a byte order mark")
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        yield Violation(path, _line(data, error.start), "text-utf8", "is not UTF-8")
        text = data.decode("utf-8", "replace")
    if b"\r" in data:
        yield Violation(path, _line(data, data.index(b"\r")), "text-crlf", "line ends must be LF")
    if path.endswith(YAML_SUFFIXES + (".meta", ".cs")) and b"\t" in data:
        yield Violation(path, _line(data, data.index(b"\t")), "text-tab", "tab; indent by blanks")
    conflict = _CONFLICT.search(text)
    if conflict:
        yield Violation(path, text.count("\n", 0, conflict.start()) + 1, "text-conflict", "a merge left its marks")
    if path.endswith(".cs"):
        for number, line in enumerate(text.splitlines(), 1):
            if len(line) > WIDEST:
                yield Violation(path, number, "text-wide", f"{len(line)} columns; at most {WIDEST}")
    # One of Unity's settings files, XRSettings.asset, holds JSON.
    is_json = path.startswith("ProjectSettings/") and text.startswith("{")
    if path.endswith(YAML_SUFFIXES) and not text.startswith(HEADER) and not is_json:
        yield Violation(path, 1, "yaml-header", "must start with '%YAML 1.1' and '%TAG !u! tag:unity3d.com,2011:'")

"""Text hygiene of what Unity reads: UTF-8 without a mark, LF, no tabs in YAML, exact headers."""

from __future__ import annotations

from typing import Iterator

from unitycheck.project import TEXT_SUFFIXES, YAML_SUFFIXES, Project
from unitycheck.violation import Violation

HEADER = "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n"
WIDEST = 120  # columns of a line of code
ATTRIBUTES = ("*.cs", "*.meta", "*.unity", "*.asset", "*.asmdef", "*.mat")


def _files(project: Project) -> Iterator[str]:
    yield from project.assets(*TEXT_SUFFIXES)
    yield from project.settings()
    for path in ("Packages/manifest.json", "Packages/packages-lock.json"):
        if project.exists(path):
            yield path


def check(project: Project) -> Iterator[Violation]:
    """Rules text-utf8, text-bom, text-crlf, text-tab, text-wide, text-end, yaml-header, gitattributes."""
    for path in _files(project):
        data = project.data(path)
        if data.startswith(b"\xef\xbb\xbf"):
            yield Violation(path, 1, "text-bom", "starts with a byte order mark")
        try:
            data.decode("utf-8")
        except UnicodeDecodeError as error:
            yield Violation(path, data[:error.start].count(b"\n") + 1, "text-utf8", "is not UTF-8")
        if b"\r" in data:
            yield Violation(path, data[:data.index(b"\r")].count(b"\n") + 1, "text-crlf", "line ends must be LF")
        if data and not data.endswith(b"\n"):
            yield Violation(path, data.count(b"\n") + 1, "text-end", "the last line has no line end")
        if path.endswith(YAML_SUFFIXES + (".meta", ".cs")) and b"\t" in data:
            yield Violation(path, data[:data.index(b"\t")].count(b"\n") + 1, "text-tab", "tab; indent by blanks")
        if path.endswith(".cs"):
            for number, line in enumerate(project.text(path).splitlines(), 1):
                if len(line) > WIDEST:
                    yield Violation(path, number, "text-wide", f"{len(line)} columns; at most {WIDEST}")
        if path.endswith(YAML_SUFFIXES) and not project.text(path).startswith(HEADER):
            yield Violation(path, 1, "yaml-header", "must start with '%YAML 1.1' and '%TAG !u! tag:unity3d.com,2011:'")
    yield from _attributes(project)


def _attributes(project: Project) -> Iterator[Violation]:
    path = ".gitattributes"
    rules = [line.split() for line in project.text(path).splitlines()] if project.exists(path) else []
    for pattern in ATTRIBUTES:
        if not any(rule[:1] == [pattern] and "eol=lf" in rule[1:] for rule in rules):
            yield Violation(path, 0, "gitattributes", f"needs a line '{pattern} text eol=lf'")

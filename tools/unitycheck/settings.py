"""ProjectSettings: the editor's version, the scenes of the build, text serialization and visible metas."""

from __future__ import annotations

import re
from typing import Any, Iterator

from tools.unitycheck.metas import guid_of
from tools.unitycheck.project import Project
from tools.unitycheck.scenes import documents
from tools.unitycheck.violation import Violation

VERSION = "ProjectSettings/ProjectVersion.txt"
BUILD = "ProjectSettings/EditorBuildSettings.asset"
EDITOR = "ProjectSettings/EditorSettings.asset"
PLAYER = "ProjectSettings/ProjectSettings.asset"
CONTROL = "ProjectSettings/VersionControlSettings.asset"
_FIRST = re.compile(r"^m_EditorVersion: (\d{4}\.\d{1,4}\.\d{1,4}[abfp]\d{1,4})$")
_SECOND = re.compile(r"^m_EditorVersionWithRevision: (\S+) \([0-9a-f]{12}\)$")


def check(project: Project) -> Iterator[Violation]:
    """Rules settings-missing, editor-version, editor-settings, build-scenes."""
    for path in (VERSION, BUILD, EDITOR, CONTROL):
        if not project.exists(path):
            yield Violation(path, 0, "settings-missing", "the file is missing")
    if project.exists(VERSION):
        yield from _version(project)
    for path, key, value in ((EDITOR, "m_SerializationMode", "2"), (CONTROL, "m_Mode", "Visible Meta Files")):
        if project.exists(path) and _data(project, path).get(key) != value:
            yield Violation(path, 0, "editor-settings", f"{key} must be {value}")
    if project.exists(PLAYER):
        yield from _player(project)
    if project.exists(BUILD):
        yield from _scenes(project)


def _data(project: Project, path: str) -> dict[str, Any]:
    found, _ = documents(project, path)
    return found[0].data if found else {}


def _player(project: Project) -> Iterator[Violation]:
    """Settings that Unity leaves to the project: input as the scripts read it, the library that they call."""
    data = _data(project, PLAYER)
    if data.get("activeInputHandler", "0") not in ("0", "2"):
        yield Violation(PLAYER, 0, "player-settings",
                        "activeInputHandler must be 0 (Input Manager) or 2 (both): the keys are read by Input")
    symbols = data.get("scriptingDefineSymbols")
    text = " ".join(map(str, symbols.values())) if isinstance(symbols, dict) else ""
    if re.search(r"\b(NET\d\w*|NETCOREAPP\w*)\b", text):
        yield Violation(PLAYER, 0, "player-settings", "scriptingDefineSymbols claim a .NET that Unity is not")


def _version(project: Project) -> Iterator[Violation]:
    lines = project.text(VERSION).splitlines()
    first = _FIRST.match(lines[0]) if lines else None
    if first is None:
        yield Violation(VERSION, 1, "editor-version", "must read 'm_EditorVersion: 6000.0.58f2' or the like")
        return
    if int(first.group(1).partition(".")[0]) < 6000:
        yield Violation(VERSION, 1, "editor-version", f"{first.group(1)}: the files are written for 6000.0 and newer")
    second = _SECOND.match(lines[1]) if len(lines) > 1 else None
    if len(lines) > 1 and (second is None or second.group(1) != first.group(1)):
        yield Violation(VERSION, 2, "editor-version", f"must name {first.group(1)} with its revision in brackets")


def _scenes(project: Project) -> Iterator[Violation]:
    listed = _data(project, BUILD).get("m_Scenes")
    entries = [entry for entry in listed if isinstance(entry, dict)] if isinstance(listed, list) else []
    paths = [str(entry.get("path", "")) for entry in entries]
    for entry, path in zip(entries, paths):
        if not project.exists(path) or path not in project.asset_files:
            yield Violation(BUILD, 0, "build-scenes", f"scene '{path}' does not exist")
        elif entry.get("guid") != guid_of(project, path):
            yield Violation(BUILD, 0, "build-scenes", f"scene '{path}': its guid is {guid_of(project, path)}")
        if entry.get("enabled") != "1":
            yield Violation(BUILD, 0, "build-scenes", f"scene '{path}' is not enabled")
        if paths.count(path) > 1:
            yield Violation(BUILD, 0, "build-scenes", f"scene '{path}' is listed twice")
    for path in project.assets(".unity"):
        if path not in paths and path.startswith("Assets/"):  # a package's scenes are not the project's
            yield Violation(BUILD, 0, "build-scenes", f"scene '{path}' is not in the list")

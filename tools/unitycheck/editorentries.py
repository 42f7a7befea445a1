"""What a person or a command line calls in the editor: executeMethod targets, paths and names in the guide."""

from __future__ import annotations

import re
from typing import Iterator

from tools.unitycheck.asmdefs import assemblies, owner
from tools.unitycheck.project import Project
from tools.unitycheck.sources import answer, table
from tools.unitycheck.violation import Violation

GUIDES = ("README.md", "docs/unity.md")
CALLERS = GUIDES + ("guidewire/runs/unity_runner.py",)
_TARGET = re.compile(r"-executeMethod\s+([\w.+]+)|\b(Guidewire\.Editor\.[\w.+]*\w)")
_PATH = re.compile(r"(?:Assets|Packages|ProjectSettings|params)/[\w./-]*\w")
_PLAYER = re.compile(r"Build/\w+/[\w.]*\w")
_TEST_ASSEMBLY = re.compile(r"`(Guidewire\.[\w.]*Tests)`")
_PLATFORM = re.compile(r"-testPlatform[\"',\s]+(\w+)")
# What the guide names although only Unity makes it.
_MADE = {"Packages/packages-lock.json", "Packages/org.guidewire.simulation"}


def check(project: Project) -> Iterator[Violation]:
    """Rules execute-method, guide."""
    for path in CALLERS:
        if project.is_file(path):
            for number, line in enumerate(project.text(path).splitlines(), 1):
                for target in {first or second for first, second in _TARGET.findall(line)}:
                    yield from _target(project, path, number, target)
                for platform in _PLATFORM.findall(line):
                    if platform not in ("EditMode", "PlayMode", "editmode", "playmode"):
                        yield Violation(path, number, "guide", f"-testPlatform has no '{platform}'")
    for path in GUIDES:
        if project.is_file(path):
            yield from _guide(project, path)


def _target(project: Project, path: str, number: int, target: str) -> Iterator[Violation]:
    found = table(project, "methods").get(target.replace("+", "."), []) if answer(project) is not None else None
    if found is None:
        return
    if not found:
        yield Violation(path, number, "execute-method", f"there is no method {target}")
    elif len(found) > 1:
        yield Violation(path, number, "execute-method", f"{target} has an overload")
    else:
        assembly = owner(assemblies(project), found[0]["path"])
        if not found[0]["isStatic"] or found[0]["hasParameters"] or found[0]["isGeneric"]:
            yield Violation(path, number, "execute-method", f"{target} must be static, without parameters")
        if assembly is not None and not assembly.is_editor_only:
            yield Violation(path, number, "execute-method", f"{target} stands in no editor-only assembly")


def _words(project: Project, path: str) -> Iterator[Violation]:
    """The word behind which a run's arguments stand, and the menu, are what the guide calls them."""
    text = project.text(path)
    for word in table(project, "markers"):
        if word not in text:
            yield Violation(path, 0, "guide", f"the word before a run's arguments is {word}")
    menus = {menu.partition("/")[0] for menu in table(project, "menus")}
    for name in re.findall(r"the menu \*(\w+)\*", text):
        if menus and name not in menus:
            yield Violation(path, 0, "guide", f"there is no menu {name}")


def _guide(project: Project, path: str) -> Iterator[Violation]:
    players = {player for source in project.assets("PlayerBuild.cs")
               for player in re.findall(rf'"({_PLAYER.pattern})"', project.text(source))}
    names = {asmdef.name for asmdef in assemblies(project)}
    if path == "docs/unity.md":
        yield from _words(project, path)
    scenes = {scene.rpartition("/")[2][:-len(".unity")] for scene in project.assets(".unity")}
    is_of_scenes = False  # within the table of scenes
    for number, line in enumerate(project.text(path).splitlines(), 1):
        is_of_scenes = line.startswith("| scene |") or (is_of_scenes and line.startswith("|"))
        for place in _PATH.findall(line):
            if place not in _MADE and "*" not in line and not project.exists(place.rstrip("/")):
                yield Violation(path, number, "guide", f"there is no {place}")
        for player in _PLAYER.findall(line):
            if players and player not in players:
                yield Violation(path, number, "guide", f"no player is built at {player}")
        for name in _TEST_ASSEMBLY.findall(line):
            if name not in names and not project.exists(f"headless/{name}"):
                yield Violation(path, number, "guide", f"there is no assembly {name}")
        row = re.match(r"^\| `([A-Z]\w+)` \|", line)
        if row and is_of_scenes and row.group(1) not in scenes:
            yield Violation(path, number, "guide", f"there is no scene {row.group(1)}")

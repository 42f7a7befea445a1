"""What a person or a command line calls in the editor: menu entries, executeMethod targets, paths in the guide."""

from __future__ import annotations

import re
from typing import Iterator

from unitycheck.asmdefs import assemblies, owner
from unitycheck.behaviours import types
from unitycheck.csharp import tokens
from unitycheck.declarations import Method
from unitycheck.project import Project
from unitycheck.violation import Violation

GUIDES = ("README.md", "docs/unity.md")
CALLERS = GUIDES + ("experiments/unity_runner.py",)
_TARGET = re.compile(r"-executeMethod\s+([\w.+]+)|\b(Guidewire\.Editor\.[\w.+]*\w)")
_PATH = re.compile(r"(?:Assets|Packages|ProjectSettings|params)/[\w./-]*\w")
_PLAYER = re.compile(r"Build/\w+/[\w.]*\w")
_TEST_ASSEMBLY = re.compile(r"`(Guidewire\.[\w.]*Tests)`")
_PLATFORM = re.compile(r"-testPlatform[\"',\s]+(\w+)")
# What the guide names although only Unity makes it.
_MADE = {"Packages/packages-lock.json"}


def methods(project: Project) -> dict[str, list[tuple[str, Method]]]:
    """Every method of an assembly that the editor loads, by its full name."""

    def make(p: Project) -> dict[str, list[tuple[str, Method]]]:
        found: dict[str, list[tuple[str, Method]]] = {}
        for path, declared in types(p).items():
            for declaration in declared:
                whole = ".".join(part for part in (declaration.namespace, *declaration.outer, declaration.name) if part)
                for method in declaration.methods:
                    found.setdefault(f"{whole}.{method.name}", []).append((path, method))
        return found

    return project.derived("methods", make)


def check(project: Project) -> Iterator[Violation]:
    """Rules menu-item, editor-drawer, execute-method, guide."""
    yield from _menus(project)
    yield from _drawers(project)
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


def _drawers(project: Project) -> Iterator[Violation]:
    for path, declared in types(project).items():
        for declaration in declared:
            for base, needed in (("PropertyDrawer", "CustomPropertyDrawer"), ("DecoratorDrawer",
                                                                              "CustomPropertyDrawer"),
                                 ("Editor", "CustomEditor")):
                is_drawer = base in declaration.bases and "abstract" not in declaration.modifiers
                if is_drawer and not declaration.has(needed):
                    yield Violation(path, declaration.line, "editor-drawer",
                                    f"{declaration.name} draws nothing without [{needed}]")


def _menus(project: Project) -> Iterator[Violation]:
    seen: dict[tuple[str, bool], str] = {}
    asmdefs = assemblies(project)
    for path, declared in types(project).items():
        for declaration in declared:
            for method in declaration.methods:
                marked = method.attribute("MenuItem")
                if marked is None:
                    continue
                name = next((token.value for token in marked.arguments if token.kind == "text"), None)
                checks = any(token.text == "true" for token in marked.arguments)
                where = owner(asmdefs, path)
                reason = "must be static" if "static" not in method.modifiers else \
                    "may have no parameter but a MenuCommand" if method.parameters not in ([], ["MenuCommand"]) else \
                    "checks its entry and must return bool" if checks and method.returns != "bool" else \
                    "must return void" if not checks and method.returns != "void" else \
                    "is generic" if method.is_generic or declaration.is_generic else \
                    f"'{name}' is no path such as Menu/Entry" if name is not None and not re.match(
                        r"^[^/\s][^/]*(/[^/]+)+$", name) else \
                    f"'{name}' is also {seen[name, checks]}" if name is not None and (name, checks) in seen else \
                    "stands in no editor-only assembly" if where is not None and not where.is_editor_only else None
                if reason is not None:
                    yield Violation(path, method.line, "menu-item", f"{method.name} {reason}")
                if name is not None:
                    seen[name, checks] = method.name


def _target(project: Project, path: str, number: int, target: str) -> Iterator[Violation]:
    found = methods(project).get(target.replace("+", "."), [])
    asmdefs = assemblies(project)
    if not found:
        yield Violation(path, number, "execute-method", f"there is no method {target}")
    elif len(found) > 1:
        yield Violation(path, number, "execute-method", f"{target} has an overload")
    else:
        where, method = found[0]
        assembly = owner(asmdefs, where)
        if "static" not in method.modifiers or method.parameters or method.is_generic:
            yield Violation(path, number, "execute-method", f"{target} must be static, without parameters")
        if assembly is not None and not assembly.is_editor_only:
            yield Violation(path, number, "execute-method", f"{target} stands in no editor-only assembly")


def _words(project: Project, path: str) -> Iterator[Violation]:
    """The word behind which a run's arguments stand, and the menu, are what the guide calls them."""
    text = project.text(path)
    for declared in types(project).values():
        for declaration in declared:
            for item in declaration.fields:
                words = [token.value for token in item.value]
                if item.name == "Marker" and "const" in item.modifiers and words and words[0] not in text:
                    yield Violation(path, 0, "guide", f"the word before a run's arguments is {words[0]}")
    menus = {token.value.partition("/")[0] for declared in types(project).values() for declaration in declared
             for method in declaration.methods for attribute in method.attributes if attribute.name == "MenuItem"
             for token in attribute.arguments if token.kind == "text"}
    for name in re.findall(r"the menu \*(\w+)\*", text):
        if name not in menus:
            yield Violation(path, 0, "guide", f"there is no menu {name}")


def _guide(project: Project, path: str) -> Iterator[Violation]:
    players = {token.value for source in project.assets("PlayerBuild.cs") for token in tokens(project.text(source))
               if token.kind == "text" and _PLAYER.fullmatch(token.value)}
    names = {asmdef.name for asmdef in assemblies(project)}
    if path == "docs/unity.md":
        yield from _words(project, path)
    scenes = {scene.rpartition("/")[2][:-len(".unity")] for scene in project.assets(".unity")}
    for number, line in enumerate(project.text(path).splitlines(), 1):
        for place in _PATH.findall(line):
            if place not in _MADE and "*" not in line and not project.exists(place.rstrip("/")):
                yield Violation(path, number, "guide", f"there is no {place}")
        for player in _PLAYER.findall(line):
            if players and player not in players:
                yield Violation(path, number, "guide", f"no player is built at {player}")
        for name in _TEST_ASSEMBLY.findall(line):
            if name not in names and not project.exists(f"experiments/headless/{name}"):
                yield Violation(path, number, "guide", f"there is no assembly {name}")
        row = re.match(r"^\| `([A-Z]\w+)` \| .*(params/|wire)", line)
        if row and path == "docs/unity.md" and row.group(1) not in scenes:
            yield Violation(path, number, "guide", f"there is no scene {row.group(1)}")

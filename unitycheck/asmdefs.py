"""Assembly definitions: which file belongs to which assembly, who may reference whom, and the wall around Core."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Iterator

from unitycheck.csharp import tokens
from unitycheck.metas import guids
from unitycheck.packages import MODULE_OF, dependencies, parsed
from unitycheck.project import Project
from unitycheck.violation import Violation

# Folders whose files compile without the engine: Core and Io for every host, Tests/Core because .NET runs them too.
ENGINE_FREE = ("Assets/Guidewire/Core/", "Assets/Guidewire/Io/", "Assets/Guidewire/Tests/Core/")
NO_ENGINE_ASSEMBLIES = ("Guidewire.Core", "Guidewire.Io")
OUTSIDE = {"UnityEngine.TestRunner", "UnityEditor.TestRunner", "UnityEngine.UI", "Unity.InputSystem",
           "Unity.Mathematics", "Unity.Burst"}
TEST_RUNNERS = {"UnityEngine.TestRunner", "UnityEditor.TestRunner"}
KEYS = {"name": str, "rootNamespace": str, "references": list, "includePlatforms": list, "excludePlatforms": list,
        "allowUnsafeCode": bool, "overrideReferences": bool, "precompiledReferences": list, "autoReferenced": bool,
        "defineConstraints": list, "versionDefines": list, "noEngineReferences": bool, "optionalUnityReferences": list}
_ENGINE_NAMESPACES = {"UnityEngine", "UnityEditor", "Unity"}


@dataclass
class Asmdef:
    """One assembly definition. folder ends in '/'; data: its JSON object."""

    path: str
    data: dict[str, Any] = field(default_factory=dict)

    @property
    def folder(self) -> str:
        return self.path.rpartition("/")[0] + "/"

    @property
    def name(self) -> str:
        return str(self.data.get("name", ""))

    @property
    def is_editor_only(self) -> bool:
        return self.data.get("includePlatforms") == ["Editor"]

    @property
    def is_test(self) -> bool:
        return bool(TEST_RUNNERS & set(self.data.get("references", []))) or \
            "nunit.framework.dll" in self.data.get("precompiledReferences", [])


def load(project: Project) -> tuple[list[Asmdef], list[Violation]]:
    """Every readable assembly definition, and what is wrong with the others."""
    found, problems = [], []
    for path in project.assets(".asmdef"):
        data, problem = parsed(project, path)
        if problem:
            problems.append(problem)
        elif not isinstance(data, dict) or not isinstance(data.get("name"), str):
            problems.append(Violation(path, 0, "asmdef-form", "needs an object with a string 'name'"))
        else:
            found.append(Asmdef(path, data))
    return found, problems


def owner(asmdefs: list[Asmdef], path: str) -> Asmdef | None:
    """The assembly that a source file belongs to: the nearest definition above it."""
    above = [asmdef for asmdef in asmdefs if path.startswith(asmdef.folder)]
    return max(above, key=lambda asmdef: len(asmdef.folder), default=None)


def check(project: Project) -> Iterator[Violation]:
    """Rules asmdef-*, engine-in-core, nullable, module-missing."""
    asmdefs, problems = load(project)
    yield from problems
    by_name = {asmdef.name: asmdef for asmdef in asmdefs}
    by_guid = {guid: by_path for guid, path in guids(project).items()
               for by_path in asmdefs if by_path.path == path}
    seen: dict[str, str] = {}
    for asmdef in asmdefs:
        yield from _form(project, asmdef, seen)
        references = []
        for reference in asmdef.data.get("references", []):
            target = by_guid.get(reference[5:]) if reference.startswith("GUID:") else by_name.get(reference)
            if target:
                references.append(target)
            elif reference not in OUTSIDE:
                yield Violation(asmdef.path, 0, "asmdef-reference", f"reference '{reference}' is no known assembly")
        yield from _arrows(asmdef, references)
    yield from _cycles(asmdefs, by_name)
    yield from _sources(project, asmdefs)


def _form(project: Project, asmdef: Asmdef, seen: dict[str, str]) -> Iterator[Violation]:
    for key, value in asmdef.data.items():
        if key not in KEYS:
            yield Violation(asmdef.path, 0, "asmdef-form", f"unknown key '{key}'")
        elif not isinstance(value, KEYS[key]):
            yield Violation(asmdef.path, 0, "asmdef-form", f"'{key}' must be a {KEYS[key].__name__}")
    if asmdef.name in seen:
        yield Violation(asmdef.path, 0, "asmdef-name", f"name '{asmdef.name}' also in {seen[asmdef.name]}")
    seen[asmdef.name] = asmdef.path
    if asmdef.path != f"{asmdef.folder}{asmdef.name}.asmdef":
        yield Violation(asmdef.path, 0, "asmdef-name", f"the file must be called {asmdef.name}.asmdef")
    if asmdef.data.get("includePlatforms") and asmdef.data.get("excludePlatforms"):
        yield Violation(asmdef.path, 0, "asmdef-form", "includePlatforms and excludePlatforms are both set")
    if asmdef.name in NO_ENGINE_ASSEMBLIES and asmdef.data.get("noEngineReferences") is not True:
        yield Violation(asmdef.path, 0, "asmdef-engine", "noEngineReferences must be true")
    rsp = f"{asmdef.folder}csc.rsp"
    if not project.exists(rsp) or "-nullable:enable" not in project.text(rsp).split():
        yield Violation(rsp, 0, "nullable", "needs -nullable:enable, which the sources rely on")
    if asmdef.is_test:
        yield from _test_form(asmdef)


def _test_form(asmdef: Asmdef) -> Iterator[Violation]:
    data = asmdef.data
    wanted = (("UNITY_INCLUDE_TESTS" in data.get("defineConstraints", []),
               "defineConstraints needs UNITY_INCLUDE_TESTS"),
              (data.get("overrideReferences") is True, "overrideReferences must be true"),
              ("nunit.framework.dll" in data.get("precompiledReferences", []),
               "precompiledReferences needs nunit.framework.dll"),
              (TEST_RUNNERS <= set(data.get("references", [])), "references need both TestRunner assemblies"),
              (data.get("autoReferenced") is False, "autoReferenced must be false"))
    for holds, message in wanted:
        if not holds:
            yield Violation(asmdef.path, 0, "asmdef-test", message)


def _arrows(asmdef: Asmdef, references: list[Asmdef]) -> Iterator[Violation]:
    for target in references:
        if target.is_editor_only and not asmdef.is_editor_only:
            yield Violation(asmdef.path, 0, "asmdef-editor", f"references {target.name}, which only the editor has")
        if asmdef.data.get("noEngineReferences") and not target.data.get("noEngineReferences"):
            yield Violation(asmdef.path, 0, "asmdef-engine", f"is engine-free but references {target.name}")
        if target.is_test and not asmdef.is_test:
            yield Violation(asmdef.path, 0, "asmdef-test", f"references the test assembly {target.name}")


def _cycles(asmdefs: list[Asmdef], by_name: dict[str, Asmdef]) -> Iterator[Violation]:
    reported: set[frozenset[str]] = set()
    for asmdef in asmdefs:
        path = [asmdef.name]
        stack = [iter(asmdef.data.get("references", []))]
        done: set[str] = set()
        while stack:
            name = next(stack[-1], None)
            if name is None:
                stack.pop()
                done.add(path.pop())
            elif name == asmdef.name:
                if frozenset(path) not in reported:
                    reported.add(frozenset(path))
                    yield Violation(asmdef.path, 0, "asmdef-cycle", " -> ".join(path + [name]))
            elif name in by_name and name not in path and name not in done:
                path.append(name)
                stack.append(iter(by_name[name].data.get("references", [])))


def _sources(project: Project, asmdefs: list[Asmdef]) -> Iterator[Violation]:
    modules = {name.rpartition(".")[2] for name in dependencies(project) if name.startswith("com.unity.modules.")}
    for path in project.assets(".cs"):
        asmdef = owner(asmdefs, path)
        if asmdef is None:
            yield Violation(path, 0, "asmdef-outside", "stands in no assembly definition's folder")
        engine_free = path.startswith(ENGINE_FREE) or (asmdef is not None and asmdef.data.get("noEngineReferences"))
        items = tokens(project.text(path))
        for i, token in enumerate(items):
            before = items[i - 1].text if i else ""
            after = items[i + 1].text if i + 1 < len(items) else ""
            if engine_free and token.text in _ENGINE_NAMESPACES and before not in (".", "namespace") \
                    and (after in (".", ";") or before == "using"):
                yield Violation(path, token.line, "engine-in-core", f"{token.text} in an engine-free folder")
            module = MODULE_OF.get(token.text)
            if module is not None and token.kind == "word" and not engine_free and module not in modules:
                yield Violation(path, token.line, "module-missing",
                                f"{token.text} needs com.unity.modules.{module} in the manifest")
            if token.text == "UnityEditor" and before != "." and not engine_free and asmdef is not None \
                    and not asmdef.is_editor_only:
                yield Violation(path, token.line, "editor-in-player",
                                f"UnityEditor in {asmdef.name}, which players contain")

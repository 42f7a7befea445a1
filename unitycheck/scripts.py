"""MonoBehaviours: named like their file, attachable, made by Unity alone."""

from __future__ import annotations

import functools
from typing import Iterator

from unitycheck.asmdefs import assemblies, owner
from unitycheck.behaviours import behaviours, descendants, types
from unitycheck.csharp import tokens
from unitycheck.declarations import Declaration
from unitycheck.project import Project
from unitycheck.violation import Violation


@functools.lru_cache(maxsize=4096)
def _created(source: str) -> tuple[tuple[int, str], ...]:
    items = tokens(source)
    return tuple((items[i].line, items[i + 1].text) for i in range(len(items) - 2)
                 if items[i].text == "new" and items[i + 2].text in ("(", "{"))


def check(project: Project) -> Iterator[Violation]:
    """Rules script-name, script-form, script-constructor, initialize-method."""
    asmdefs = assemblies(project)
    bases = {base for declared in types(project).values() for declaration in declared for base in declaration.bases}
    for path, scripts in behaviours(project).items():
        stem = path.rpartition("/")[2][:-len(".cs")]
        assembly = owner(asmdefs, path)
        for script in scripts:
            if "abstract" not in script.modifiers or script.name not in bases:
                yield from _form(path, script, stem, assembly is not None and assembly.is_editor_only)
            for method in script.methods:
                if method.name == script.name and not method.returns and "static" not in method.modifiers:
                    yield Violation(path, method.line, "script-constructor",
                                    f"{script.name}: Unity makes behaviours by itself; what it has to do stands in "
                                    "Awake")
    made = descendants(project, {"MonoBehaviour", "ScriptableObject"})
    for path in project.assets(".cs"):
        for line, name in _created(project.text(path)):
            if name in made:
                yield Violation(path, line, "script-constructor",
                                f"new {name}: behaviours are made by AddComponent or CreateInstance")
        for declaration in types(project)[path]:
            yield from _initialize(path, declaration)


def _form(path: str, script: Declaration, stem: str, is_editor_only: bool) -> Iterator[Violation]:
    is_test = "/Tests/" in path
    if script.outer and not is_test:
        yield Violation(path, script.line, "script-name",
                        f"{script.name} is nested in {script.outer[-1]}; no scene can hold it")
    elif script.name != stem and not is_test:
        yield Violation(path, script.line, "script-name", f"class {script.name} must be called like its file")
    if script.name == stem:
        if "public" not in script.modifiers or {"abstract", "static"} & script.modifiers or script.is_generic:
            yield Violation(path, script.line, "script-form",
                            f"{script.name} must be public, not abstract, not generic to go on an object")
        if is_editor_only and "MonoBehaviour" in script.bases:
            yield Violation(path, script.line, "script-form", f"{script.name} stands in an editor-only assembly")


def _initialize(path: str, declaration: Declaration) -> Iterator[Violation]:
    names = [method.name for method in declaration.methods]
    for method in declaration.methods:
        marked = next((attribute for attribute in method.attributes
                       if attribute.name in ("RuntimeInitializeOnLoadMethod", "InitializeOnLoadMethod",
                                             "DidReloadScripts")), None)
        if marked is None:
            continue
        reason = "must be static" if "static" not in method.modifiers else \
            "must have no parameters" if method.parameters else \
            "must not be generic, nor its class" if method.is_generic or declaration.is_generic else \
            "has an overload, and Unity records the name only" if names.count(method.name) > 1 else None
        if reason is not None:
            yield Violation(path, method.line, "initialize-method", f"{method.name} with [{marked.name}] {reason}")

"""Findings of the compiler in the C# sources, from the built program Guidewire.UnityCheck, which stays running for
further requests.

Where it has not been built, nothing is known of the sources, and the rules that need it say nothing.
"""

from __future__ import annotations

import atexit
import functools
import json
import re
import shutil
import subprocess
import threading
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterator

from tools.unitycheck.asmdefs import Asmdef, ENGINE_FREE, LIBRARIES, assemblies, owner, targets
from tools.unitycheck.packages import MODULE_OF
from tools.unitycheck.project import Project, at_home
from tools.unitycheck.violation import Violation

PROJECT = "headless/Guidewire.UnityCheck"
PROGRAM = f"{PROJECT}/bin/Release/net10.0/Guidewire.UnityCheck.dll"
_HOME = Path(__file__).resolve().parents[2]
_EVENT = re.compile(r"m_MethodName: (\w+)$", re.MULTILINE)


@dataclass(frozen=True)
class Field:
    """A field that Unity stores.

    Attributes
    ----------
    kind : number, bool, text, struct, enum, object, class or other.
    type : name of its type, or of its elements' type.
    is_list : whether it is an array or a list.
    is_needed : whether the scene has to fill it.
    names : former names, under which a scene may still hold it.
    range : the two limits of [Range], or nothing.
    values : an enum's numbers; None where any will do.
    fields : the names that a class or struct of the project's stores.
    """

    kind: str
    type: str
    is_list: bool
    is_needed: bool
    names: tuple[str, ...]
    range: tuple[float, ...]
    values: frozenset[int] | None
    fields: frozenset[str]


@dataclass(frozen=True)
class Script:
    """A class that is called like its file and that Unity makes itself.

    Attributes
    ----------
    bases : its name and those of all classes above it.
    fields : by the key under which a scene keeps them.
    """

    name: str
    is_attachable: bool
    is_editor_only: bool
    bases: frozenset[str]
    fields: dict[str, Field]


def is_built() -> bool:
    """Whether the program is there."""
    return (_HOME / PROGRAM).is_file() and shutil.which("dotnet") is not None


def answer(project: Project) -> dict[str, Any] | None:
    """The C# checker's reply for a project; None where the checker is not built."""
    return project.derived("sources", _ask) if is_built() else None


def table(project: Project, name: str) -> Any:
    """One of the answer's tables; empty where there is none."""
    found = answer(project)
    return found[name] if found is not None else []


def scripts(project: Project) -> dict[str, Script] | None:
    """The behaviours and assets of the project by source; None where nobody can tell."""
    if answer(project) is None:
        return None
    return project.derived("scripts", lambda p: {path: _script(data) for path, data in answer(p)["scripts"].items()})


def check(project: Project) -> Iterator[Violation]:
    """Rules of the program's: compiler, nunit, api-editor, editor-in-player, script-*, initialize-method, field-stored,
    field-attribute, field-initialiser, menu-item, editor-drawer, test-*, unity-test; and module-missing, internals.
    """
    from tools.unitycheck.packages import dependencies

    for found in table(project, "violations"):
        yield Violation(found["path"], found["line"], found["rule"], found["message"])
    modules = {name.rpartition(".")[2] for name in dependencies(project) if name.startswith("com.unity.modules.")}
    for word in table(project, "words"):
        if MODULE_OF[word["text"]] not in modules:
            yield Violation(word["path"], word["line"], "module-missing",
                            f"{word['text']} needs com.unity.modules.{MODULE_OF[word['text']]} in the manifest")
    names = {asmdef.name for asmdef in assemblies(project)}
    for friend in table(project, "friends"):
        name = friend["text"]
        is_dotnet = project.exists(f"headless/{name}") or not project.exists("headless")
        if name not in names and not is_dotnet:
            yield Violation(friend["path"], friend["line"], "internals",
                            f"there is no assembly '{name}' to see the internals")


def _script(data: dict[str, Any]) -> Script:
    return Script(data["name"], data["isAttachable"], data["isEditorOnly"], frozenset(data["bases"]),
                  {key: _field(item) for key, item in data["fields"].items()})


def _field(data: dict[str, Any]) -> Field:
    values = data["values"]
    return Field(data["kind"], data["type"], data["isList"], data["isNeeded"], tuple(data["names"]),
                 tuple(data["range"]), None if values is None else frozenset(values), frozenset(data["fields"]))


def _ask(project: Project) -> dict[str, Any]:
    asmdefs = assemblies(project)
    files: dict[int, list[str]] = {id(asmdef): [] for asmdef in asmdefs}
    for path in project.assets(".cs"):
        home = owner(asmdefs, path)
        if home is not None:
            files[id(home)].append(path)
    changes = {path: project.text(path) for path in project.changed if path.endswith(".cs") and project.exists(path)}
    only = None if project.only is None else sorted(path for path in project.only if path.endswith(".cs"))
    events = sorted({name for path in project.yaml_files() for name in _EVENT.findall(project.text(path))})
    stamp = hash(tuple(project.stamp(path) for path in project.assets(".cs") if path not in changes))
    return _program(stamp, json.dumps({
        "root": str(project.root.resolve()), "assemblies": [_form(project, item, files[id(item)]) for item in asmdefs],
        "changes": changes, "only": only, "words": sorted(MODULE_OF), "events": events}))


def _form(project: Project, asmdef: Asmdef, files: list[str]) -> dict[str, Any]:
    if asmdef.data.get("overrideReferences"):
        libraries = asmdef.strings("precompiledReferences")
    else:
        libraries = [name for name in LIBRARIES if name != "nunit.framework.dll"]
    return {"name": asmdef.name, "files": files, "libraries": libraries,
            "references": [target.name if target else name for name, target in targets(project, asmdef)],
            "isEditorOnly": asmdef.is_editor_only, "isTest": asmdef.is_test,
            "hasEngine": asmdef.data.get("noEngineReferences") is not True
            and not at_home(asmdef.folder).startswith(ENGINE_FREE),
            "isUnsafeAllowed": asmdef.data.get("allowUnsafeCode") is True}


_lock = threading.Lock()


@functools.lru_cache(maxsize=1)
def _start() -> subprocess.Popen[str]:
    program = subprocess.Popen(["dotnet", str(_HOME / PROGRAM)], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                               text=True, encoding="utf-8")
    atexit.register(_stop, program)
    return program


def _stop(program: subprocess.Popen[str]) -> None:
    assert program.stdin is not None
    program.stdin.close()
    program.wait()


@functools.lru_cache(maxsize=512)
def _program(stamp: int, request: str) -> dict[str, Any]:
    """The answer to a request; the stamp stands for what lies on disk."""
    with _lock:
        program = _start()
        assert program.stdin is not None and program.stdout is not None
        program.stdin.write(request + "\n")
        program.stdin.flush()
        line = program.stdout.readline()
    if not line:
        raise RuntimeError(f"Guidewire.UnityCheck ended with {program.wait()}")
    return json.loads(line)

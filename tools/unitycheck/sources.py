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
from pathlib import Path
from typing import Any, Iterator

from tools.unitycheck.asmdefs import Asmdef, ENGINE_FREE, LIBRARIES, assemblies, owner, targets
from tools.unitycheck.packages import MODULE_OF, dependencies
from tools.unitycheck.project import Project
from tools.unitycheck.violation import Violation

PROJECT = "headless/Guidewire.UnityCheck"
PROGRAM = f"{PROJECT}/bin/Release/net10.0/Guidewire.UnityCheck.dll"
_HOME = Path(__file__).resolve().parents[2]
# What names methods of the editor's that a command line calls.
CALLERS = ("README.md", "docs/unity.md", "guidewire/runs/unity_runner.py")


def is_built() -> bool:
    """Return whether the program is there."""
    return (_HOME / PROGRAM).is_file() and shutil.which("dotnet") is not None


def answer(project: Project) -> dict[str, Any] | None:
    """Return the C# checker's reply for a project; None where the checker is not built."""
    return project.derived("sources", _ask) if is_built() else None


def scripts(project: Project) -> dict[str, frozenset[str]] | None:
    """Give by source the keys that a scene may hold of each behaviour; None where nobody can tell."""
    found = answer(project)
    return None if found is None else {path: frozenset(fields) for path, fields in found["scripts"].items()}


def check(project: Project) -> Iterator[Violation]:
    """Rules of the program's: the compiler's numbers, nunit, api-editor, editor-in-player, script-*, field-stored; and
    module-missing, execute-method."""
    found = answer(project)
    if found is None:
        return
    for item in found["violations"]:
        yield Violation(item["path"], item["line"], item["rule"], item["message"])
    for word in found["words"]:
        module = f"com.unity.modules.{MODULE_OF[word['text']]}"
        if module not in dependencies(project):
            yield Violation(word["path"], word["line"], "module-missing",
                            f"{word['text']} needs {module} in the manifest")
    for path in CALLERS:
        for target in sorted(set(re.findall(r"\bGuidewire\.Editor\.\w[\w.]*\w", project.text(path)))):
            if target not in found["entries"]:
                yield Violation(path, 0, "execute-method", f"no editor-only assembly has a static {target}()")


def _ask(project: Project) -> dict[str, Any]:
    asmdefs = assemblies(project)
    files: dict[int, list[str]] = {id(asmdef): [] for asmdef in asmdefs}
    for path in project.assets(".cs"):
        home = owner(asmdefs, path)
        if home is not None:
            files[id(home)].append(path)
    changes = {path: project.text(path) for path in project.changes if path.endswith(".cs") and project.exists(path)}
    only = None if project.only is None else sorted(path for path in project.only if path.endswith(".cs"))
    return _program(json.dumps({
        "root": str(project.root.resolve()), "assemblies": [_form(project, item, files[id(item)]) for item in asmdefs],
        "changes": changes, "only": only, "words": sorted(MODULE_OF)}))


def _form(project: Project, asmdef: Asmdef, files: list[str]) -> dict[str, Any]:
    if asmdef.data.get("overrideReferences"):
        libraries = asmdef.strings("precompiledReferences")
    else:
        libraries = [name for name in LIBRARIES if name != "nunit.framework.dll"]
    return {"name": asmdef.name, "files": files, "libraries": libraries,
            "references": [target.name if target else name for name, target in targets(project, asmdef)],
            "isEditorOnly": asmdef.is_editor_only, "isTest": asmdef.is_test,
            "hasEngine": asmdef.data.get("noEngineReferences") is not True
            and not asmdef.folder.startswith(ENGINE_FREE),
            "isUnsafeAllowed": asmdef.data.get("allowUnsafeCode") is True}


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


def _program(request: str) -> dict[str, Any]:
    program = _start()
    assert program.stdin is not None and program.stdout is not None
    program.stdin.write(request + "\n")
    program.stdin.flush()
    line = program.stdout.readline()
    if not line:
        raise RuntimeError(f"Guidewire.UnityCheck ended with {program.wait()}")
    return json.loads(line)

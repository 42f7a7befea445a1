"""Edits of this repository that Unity would refuse or silently pass over, each with the file and rule that name it.

Which part finds a breakage follows from its rule:

- a number (CS0117): an error of the compiler, as Guidewire.UnityCheck binds an assembly;
- script-*, initialize-method, field-stored, field-attribute, field-initialiser, menu-item, editor-drawer, nunit,
  editor-in-player, api-editor, test-method, test-fixture, test-assembly, unity-test: rules of that program;
- scene-script, scene-needs, field-value, field-unknown, reference-class, reference-unset, scene-parameters, name-unknown,
  execute-method, module-missing, internals, shader-find, and material-* in code: Python, with tables of that program;
- all others: Python alone, which needs no build.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Callable, Mapping

from tools.unitycheck.project import Project

GUIDEWIRE = "Assets/Guidewire"
RUNTIME = f"{GUIDEWIRE}/Runtime"
VECTOR = f"{GUIDEWIRE}/Core/Numbers/Vector3d.cs"
SCENE = f"{GUIDEWIRE}/Scenes/Insertion.unity"
LOOP = f"{RUNTIME}/Loop/SimulationLoop.cs"
HUD = f"{RUNTIME}/Views/Hud.cs"
WIRE_VIEW = f"{RUNTIME}/Views/WireView.cs"
MANIFEST = "Packages/manifest.json"

Change = Callable[[Project], Mapping[str, "bytes | None"]]


@dataclass(frozen=True)
class Breakage:
    """A change, the file that must be named for it, and the rule that must name it."""

    change: Change
    path: str
    rule: str


def replace(path: str, old: str, new: str) -> Change:
    """The first `old` (a regular expression over lines, which must match) becomes `new`."""

    def apply(project: Project) -> Mapping[str, bytes | None]:
        changed, count = re.subn(old, new, project.data(path).decode("utf-8"), count=1, flags=re.MULTILINE | re.DOTALL)
        assert count == 1, f"{path} does not contain {old}"
        return {path: changed.encode("utf-8")}

    return apply


def insert(path: str, code: str) -> Change:
    """Code at the start of the file's first type."""
    return replace(path, r"^    \{\n", lambda match: "    {\n        " + code + "\n")  # type: ignore[arg-type]


def append(path: str, text: str) -> Change:
    """Text at the file's end."""
    return lambda project: {path: project.data(path) + text.encode("utf-8")}


def remove(*paths: str) -> Change:
    """Files that are gone."""
    return lambda project: {path: None for path in paths}


def move(old: str, new: str) -> Change:
    """A file and its .meta under another name."""
    return lambda project: {old: None, f"{old}.meta": None, new: project.data(old),
                            f"{new}.meta": project.data(f"{old}.meta")}


def write(path: str, text: str) -> Change:
    """A file that should not be there, or not so."""
    return lambda project: {path: text.encode("utf-8")}


def both(first: Change, second: Change) -> Change:
    """Two changes of different files."""
    return lambda project: {**first(project), **second(project)}


def behaviour(body: str, name: str = "Odd", namespace: str = "Guidewire.Runtime") -> str:
    """The source of a MonoBehaviour."""
    return ("using System.Collections;\nusing System.Collections.Generic;\nusing UnityEngine;\n\n"
            f"namespace {namespace}\n{{\n    public sealed class {name} : MonoBehaviour\n    {{\n"
            f"        {body}\n    }}\n}}\n")


ODD = f"{RUNTIME}/Odd.cs"


def odd(body: str, rule: str) -> Breakage:
    """A new MonoBehaviour that Unity does not do justice to."""
    return Breakage(write(ODD, behaviour(body)), ODD, rule)

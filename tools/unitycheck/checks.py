"""All rules together."""

from __future__ import annotations

from tools.unitycheck import (
    asmdefs, compileroptions, components, editorentries, materials, metas, names, packages, references,
    sceneparameters, scenes, settings, sources, textfiles,
)
from tools.unitycheck.project import Project
from tools.unitycheck.violation import Violation

MODULES = (metas, textfiles, packages, settings, asmdefs, compileroptions, sources, references, scenes, components,
           sceneparameters, names, materials, editorentries)


def run(project: Project) -> list[Violation]:
    """Every violation of every rule, ordered by file and line."""
    return sorted({violation for module in MODULES for violation in module.check(project)})

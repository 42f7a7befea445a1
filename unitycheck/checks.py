"""All rules together."""

from __future__ import annotations

from unitycheck import (
    api, asmdefs, assemblyuse, compileroptions, components, editorentries, fields, language, materials, messages, metas,
    names, nunit, packages, references, sceneparameters, scenes, scripts, settings, testshapes, textfiles,
)
from unitycheck.project import Project
from unitycheck.violation import Violation

MODULES = (metas, textfiles, packages, settings, asmdefs, assemblyuse, compileroptions, scripts, messages, fields,
           references, scenes, components, sceneparameters, names, materials, editorentries, language, api, nunit,
           testshapes)


def run(project: Project) -> list[Violation]:
    """Every violation of every rule, ordered by file and line."""
    return sorted({violation for module in MODULES for violation in module.check(project)})

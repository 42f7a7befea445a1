"""All rules together."""

from __future__ import annotations

from unitycheck import api, asmdefs, language, metas, nunit, packages, references, scenes, scripts, settings, textfiles
from unitycheck.project import Project
from unitycheck.violation import Violation

MODULES = (metas, textfiles, packages, settings, asmdefs, scripts, references, scenes, language, api, nunit)


def run(project: Project) -> list[Violation]:
    """Every violation of every rule, ordered by file and line."""
    return sorted({violation for module in MODULES for violation in module.check(project)})

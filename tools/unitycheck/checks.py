"""All rules together."""

from __future__ import annotations

from tools.unitycheck import asmdefs, metas, packages, settings, textfiles
from tools.unitycheck.project import Project
from tools.unitycheck.violation import Violation

MODULES = (metas, textfiles, packages, settings, asmdefs)


def run(project: Project) -> list[Violation]:
    """Return every violation of every rule, ordered by file and line."""
    return sorted({violation for module in MODULES for violation in module.check(project)})

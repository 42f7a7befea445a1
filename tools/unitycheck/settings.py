"""ProjectSettings: the editor's version, text serialization and visible metas."""

from __future__ import annotations

import re
from typing import Iterator

from tools.unitycheck.project import Project
from tools.unitycheck.violation import Violation

# File: what must stand in it, as a regular expression over its lines.
_NEEDED = {
    # The files are written for 6000.0 and newer.
    "ProjectSettings/ProjectVersion.txt":
        r"\Am_EditorVersion: ([6-9]\d{3}\.\d+\.\d+[abfp]\d+)\nm_EditorVersionWithRevision: \1 \([0-9a-f]{12}\)$",
    "ProjectSettings/EditorSettings.asset": r"^  m_SerializationMode: 2$",
    "ProjectSettings/VersionControlSettings.asset": r"^  m_Mode: Visible Meta Files$",
}


def check(project: Project) -> Iterator[Violation]:
    """Rule settings."""
    for path, needed in _NEEDED.items():
        if not project.exists(path) or not re.search(needed, project.text(path), re.MULTILINE):
            yield Violation(path, 0, "settings", f"must hold {needed}")

"""References by GUID: each leads to an asset of this project or to one of Unity's own, with the right type number."""

from __future__ import annotations

import re
from typing import Iterator

from tools.unitycheck.metas import guids
from tools.unitycheck.project import Project
from tools.unitycheck.violation import Violation

BUILTIN = {"0000000000000000e000000000000000", "0000000000000000f000000000000000"}
NONE = "0" * 32
_REFERENCE = re.compile(r"\{fileID: (-?\d{1,20}), guid: ([^,}]*)(?:, type: (\d))?\}")
_TYPE = {".cs": "3", ".mat": "2", ".asset": "2"}
_FILE_ID = {".cs": "11500000", ".mat": "2100000", ".asset": "11400000"}


def check(project: Project) -> Iterator[Violation]:
    """Rules guid-unknown, reference-type, reference-fileid, in every YAML file."""
    known = guids(project)
    for path in project.yaml_files():
        for number, line in enumerate(project.text(path).split("\n"), 1):
            for guid in re.findall(r"guid: ([^,}\s]*)", line):
                # Settings may name what a package brings; the list of scenes has rules of its own.
                if guid not in known and guid not in BUILTIN and guid != NONE and path.startswith("Assets/"):
                    yield Violation(path, number, "guid-unknown", f"guid '{guid}' belongs to no asset")
            for file_id, guid, kind in _REFERENCE.findall(line):
                target = known.get(guid, "")
                suffix = target[target.rfind("."):] if "." in target else ""
                expected = "0" if guid in BUILTIN else _TYPE.get(suffix, kind)
                if kind != expected:
                    yield Violation(path, number, "reference-type",
                                    f"type {kind or 'missing'} for {target or 'a built-in asset'}, expected {expected}")
                if file_id != _FILE_ID.get(suffix, file_id):
                    yield Violation(path, number, "reference-fileid",
                                    f"fileID {file_id} for {target}, expected {_FILE_ID[suffix]}")

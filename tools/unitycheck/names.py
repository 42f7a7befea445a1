"""Names in calls that Unity looks up while it plays: scenes, tags, layers, axes, resources."""

from __future__ import annotations

import re
from typing import Iterator

from tools.unitycheck.project import Project
from tools.unitycheck.scenes import LAYERS, TAGS, own_labels
from tools.unitycheck.sources import table
from tools.unitycheck.violation import Violation

_AXES = {"Horizontal", "Vertical", "Fire1", "Fire2", "Fire3", "Jump", "Mouse X", "Mouse Y", "Mouse ScrollWheel",
         "Submit",
         "Cancel", "Enable Debug Button 1", "Enable Debug Button 2"}
_LAYER_NAMES = {"Default", "TransparentFX", "Ignore Raycast", "Water", "UI"}
_CALLS = {"LoadScene": "scene", "LoadSceneAsync": "scene", "FindWithTag": "tag", "FindGameObjectWithTag": "tag",
          "FindGameObjectsWithTag": "tag", "CompareTag": "tag", "NameToLayer": "layer", "GetMask": "layer",
          "GetAxis": "axis", "GetAxisRaw": "axis", "GetButton": "axis", "GetButtonDown": "axis", "GetButtonUp": "axis"}


def check(project: Project) -> Iterator[Violation]:
    """Rule name-unknown."""
    known = project.derived("names", _known)
    for call in table(project, "calls"):
        kind = _CALLS.get(call["name"])
        if kind is not None and call["text"] not in known[kind]:
            yield Violation(call["path"], call["line"], "name-unknown", f"there is no {kind} '{call['text']}'")
        if call["owner"] == "Resources" and call["name"].startswith("Load") and not any(
                re.search(rf"/Resources/{re.escape(call['text'])}(\.\w+|/.*)?$", asset)
                for asset in project.asset_files):
            yield Violation(call["path"], call["line"], "name-unknown", f"no folder Resources holds '{call['text']}'")


def _known(project: Project) -> dict[str, set[str]]:
    scenes = set(project.assets(".unity"))
    tags, layers = own_labels(project)
    text = "".join(project.text(path) for path in project.settings() if path.endswith("InputManager.asset"))
    names = "".join(project.text(path) for path in project.settings() if path.endswith("TagManager.asset"))
    return {"scene": scenes | {path.rpartition("/")[2][:-len(".unity")] for path in scenes}, "tag": TAGS | tags,
            "layer": _LAYER_NAMES | ({name for name in re.findall(r"^  - (.+)$", names, re.MULTILINE)}
                                     if layers - LAYERS else set()),
            "axis": _AXES | set(re.findall(r"^    m_Name: (.+)$", text, re.MULTILINE))}

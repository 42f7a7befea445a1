"""Names in calls that Unity looks up while it plays: scenes, tags, layers, axes, resources."""

from __future__ import annotations

import functools
import re
from typing import Iterator

from unitycheck.csharp import tokens
from unitycheck.project import Project
from unitycheck.scenes import LAYERS, TAGS, own_labels
from unitycheck.violation import Violation

_AXES = {"Horizontal", "Vertical", "Fire1", "Fire2", "Fire3", "Jump", "Mouse X", "Mouse Y", "Mouse ScrollWheel",
         "Submit",
         "Cancel", "Enable Debug Button 1", "Enable Debug Button 2"}
_LAYER_NAMES = {"Default", "TransparentFX", "Ignore Raycast", "Water", "UI"}
_CALLS = {"LoadScene": "scene", "LoadSceneAsync": "scene", "FindWithTag": "tag", "FindGameObjectWithTag": "tag",
          "FindGameObjectsWithTag": "tag", "CompareTag": "tag", "NameToLayer": "layer", "GetMask": "layer",
          "GetAxis": "axis", "GetAxisRaw": "axis", "GetButton": "axis", "GetButtonDown": "axis", "GetButtonUp": "axis"}
_ASKS = re.compile("|".join((*_CALLS, "Resources")))


@functools.lru_cache(maxsize=4096)
def _asks(source: str) -> bool:
    """Whether a source may hold one of the calls; quick."""
    return _ASKS.search(source) is not None


def check(project: Project) -> Iterator[Violation]:
    """Rule name-unknown."""
    known = project.derived("names", _known)
    for path in project.assets(".cs"):
        if _asks(project.text(path)):
            items = tokens(project.text(path))
            for i in range(1, len(items) - 2):
                kind = _CALLS.get(items[i].text)
                if kind is not None and items[i + 1].text == "(" and items[i + 2].text == '"' \
                        and items[i + 2].value not in known[kind]:
                    yield Violation(path, items[i].line, "name-unknown", f"there is no {kind} '{items[i + 2].value}'")
                if items[i].text == "Resources" and items[i + 1].text == ".":
                    yield from _resource(project, path, [token for token in items[i + 2:i + 12]])


def _resource(project: Project, path: str, items: list) -> Iterator[Violation]:
    name = next((token for token in items if token.kind == "text"), None)
    if items and items[0].text.startswith("Load") and name is not None and name.text == '"' and not any(
            re.search(rf"/Resources/{re.escape(name.value)}(\.\w+|/.*)?$", asset) for asset in project.asset_files):
        yield Violation(path, name.line, "name-unknown", f"no folder Resources holds '{name.value}'")


def _known(project: Project) -> dict[str, set[str]]:
    scenes = set(project.assets(".unity"))
    tags, layers = own_labels(project)
    text = "".join(project.text(path) for path in project.settings() if path.endswith("InputManager.asset"))
    names = "".join(project.text(path) for path in project.settings() if path.endswith("TagManager.asset"))
    return {"scene": scenes | {path.rpartition("/")[2][:-len(".unity")] for path in scenes}, "tag": TAGS | tags,
            "layer": _LAYER_NAMES | ({name for name in re.findall(r"^  - (.+)$", names, re.MULTILINE)}
                                     if layers - LAYERS else set()),
            "axis": _AXES | set(re.findall(r"^    m_Name: (.+)$", text, re.MULTILINE))}

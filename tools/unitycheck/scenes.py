"""Scenes and materials: documents, objects, components and transforms that agree with each other."""

from __future__ import annotations

import math
import re
from typing import Any, Iterator

from tools.unitycheck import classids
from tools.unitycheck.classids import CLASSES
from tools.unitycheck.packages import dependencies
from tools.unitycheck.project import Project
from tools.unitycheck.unityyaml import Document, FormError, parse
from tools.unitycheck.violation import Violation

SETTINGS = {1: 29, 2: 104, 3: 157, 4: 196}
ROOTS = 1660057539
INSTANCE = 1001
TRANSFORMS = (4, 224)
_SINGLE = (20, 23, 33, 81, 108, 120)    # components of which an object has one at most
_INTEGER = re.compile(r"^-?\d{1,20}$")
# Tags and layers that every project has.
TAGS = {"Untagged", "Respawn", "Finish", "EditorOnly", "MainCamera", "Player", "GameController"}
LAYERS = {0, 1, 2, 4, 5}


def local_id(reference: Any) -> int:
    """The local file ID of a reference such as {fileID: 101}; 0 if it is none."""
    text = str(reference.get("fileID", "0")) if isinstance(reference, dict) else "0"
    return int(text) if _INTEGER.match(text) else 0


def documents(project: Project, path: str) -> tuple[list[Document], Violation | None]:
    """The documents of a YAML file, or what is wrong with its form."""
    try:
        return parse(project.text(path)), None
    except FormError as error:
        return [], Violation(path, error.line, "yaml-form", str(error))


def check(project: Project) -> Iterator[Violation]:
    """Rules yaml-form, class-id, file-id, reference-local and, for scenes, scene-*."""
    for path in project.yaml_files():
        found, problem = documents(project, path)
        if problem:
            yield problem
            continue
        seen: dict[int, Document] = {}
        for document in found:
            yield from classids.check(path, document)
            if document.file_id in seen or document.file_id == 0 or not -2**63 <= document.file_id < 2**63:
                yield Violation(path, document.line, "file-id",
                                f"&{document.file_id} is zero, too large or used twice")
            seen[document.file_id] = document
        yield from _local_references(path, found, seen)
        if path.endswith(".unity"):
            yield from _settings(path, found)
            yield from _hierarchy(path, seen)
            yield from _roots(path, seen)
            yield from _labels(project, path, seen)
            for document in found:
                yield from _keys(path, document)
                if document.class_id == 81 and "com.unity.modules.audio" not in dependencies(project):
                    yield Violation(path, document.line, "module-missing",
                                    "AudioListener needs com.unity.modules.audio")


def _local_references(path: str, found: list[Document], seen: dict[int, Document]) -> Iterator[Violation]:
    def walk(value: Any) -> Iterator[Any]:
        if isinstance(value, dict):
            if "fileID" in value and "guid" not in value:
                yield value
            for inner in value.values():
                yield from walk(inner)
        elif isinstance(value, list):
            for inner in value:
                yield from walk(inner)

    for document in found:
        for reference in walk(document.data):
            if not _INTEGER.match(str(reference["fileID"])) or local_id(reference) not in {0, *seen}:
                yield Violation(path, document.line, "reference-local",
                                f"{document.type} &{document.file_id} points to fileID {reference['fileID']}, "
                                "which is not in this file")


def _settings(path: str, found: list[Document]) -> Iterator[Violation]:
    for place, (file_id, class_id) in enumerate(SETTINGS.items()):
        document = found[place] if place < len(found) else None
        if document is None or (document.file_id, document.class_id) != (file_id, class_id):
            yield Violation(path, document.line if document else 0, "scene-settings",
                            f"document {place + 1} must be {CLASSES[class_id]} &{file_id}")


def components(game_object: Document) -> list[int]:
    """The file IDs that a GameObject lists."""
    listed = game_object.data.get("m_Component")
    return [local_id(item.get("component")) for item in listed if isinstance(item, dict)] \
        if isinstance(listed, list) else []


def _hierarchy(path: str, seen: dict[int, Document]) -> Iterator[Violation]:
    listed: dict[int, int] = {}
    for document in seen.values():
        if document.class_id != 1 or document.is_stripped:
            continue
        ids = components(document)
        classes = [seen[number].class_id for number in ids if number in seen]
        if classes[:1] not in ([4], [224]) or sum(classes.count(number) for number in TRANSFORMS) != 1:
            yield Violation(path, document.line, "scene-transform",
                            f"GameObject &{document.file_id}: its first component must be its only Transform")
        for number in _SINGLE:
            if classes.count(number) > 1:
                yield Violation(path, document.line, "scene-component",
                                f"GameObject &{document.file_id} has more than one {CLASSES[number]}")
        for component in ids:
            if component in listed:
                yield Violation(path, document.line, "scene-component", f"&{component} is listed by two GameObjects")
            listed[component] = document.file_id
            target = seen.get(component)
            if target is not None and local_id(target.data.get("m_GameObject")) != document.file_id:
                yield Violation(path, target.line, "scene-component",
                                f"{target.type} &{component}: m_GameObject must be &{document.file_id}, which lists it")
    for document in seen.values():
        if "m_GameObject" in document.data and not document.is_stripped and document.file_id not in listed:
            yield Violation(path, document.line, "scene-component",
                            f"{document.type} &{document.file_id} is in no m_Component list")
        if document.class_id in TRANSFORMS and not document.is_stripped:
            yield from _family(path, document, seen)
            yield from _place(path, document)


def _family(path: str, document: Document, seen: dict[int, Document]) -> Iterator[Violation]:
    children = document.data.get("m_Children")
    ids = [local_id(item) for item in children] if isinstance(children, list) else []
    for child in ids:
        target = seen.get(child)
        if ids.count(child) > 1 or (target is not None and target.class_id not in TRANSFORMS):
            yield Violation(path, document.line, "scene-parent",
                            f"Transform &{document.file_id}: m_Children names &{child} twice, or no Transform")
        if target is not None and not target.is_stripped and local_id(target.data.get("m_Father")) != document.file_id:
            yield Violation(path, target.line, "scene-parent",
                            f"Transform &{child}: m_Father must be &{document.file_id}")
    above, ancestor = {document.file_id}, seen.get(local_id(document.data.get("m_Father")))
    while ancestor is not None and ancestor.file_id not in above:
        above.add(ancestor.file_id)
        ancestor = seen.get(local_id(ancestor.data.get("m_Father")))
    if ancestor is not None:
        yield Violation(path, document.line, "scene-parent",
                        f"Transform &{document.file_id}: its fathers go in a circle")
    father = seen.get(local_id(document.data.get("m_Father")))
    if father is not None and not father.is_stripped:
        listed = father.data.get("m_Children")
        if not isinstance(listed, list) or document.file_id not in [local_id(item) for item in listed]:
            yield Violation(path, father.line, "scene-parent",
                            f"Transform &{father.file_id}: m_Children lacks &{document.file_id}")


def _is_root(instance: Document) -> bool:
    changes = instance.data.get("m_Modification")
    return isinstance(changes, dict) and local_id(changes.get("m_TransformParent")) == 0


def _roots(path: str, seen: dict[int, Document]) -> Iterator[Violation]:
    roots = [document for document in seen.values() if document.class_id == ROOTS]
    fathers = {document.file_id for document in seen.values() if document.class_id in TRANSFORMS
               and not document.is_stripped and local_id(document.data.get("m_Father")) == 0}
    # An instance of a prefab is listed itself; its Transform is the prefab's, and stripped here.
    fathers |= {document.file_id for document in seen.values() if document.class_id == INSTANCE
                and _is_root(document)}
    if len(roots) != 1 or roots[0].file_id != 2**63 - 1:
        yield Violation(path, 0, "scene-roots", "needs one SceneRoots &9223372036854775807")
        return
    listed = roots[0].data.get("m_Roots")
    ids = [local_id(item) for item in listed] if isinstance(listed, list) else []
    if len(ids) != len(set(ids)) or set(ids) != fathers:
        yield Violation(path, roots[0].line, "scene-roots", f"m_Roots must list exactly {sorted(fathers)}, not {ids}")


# Keys that Unity always writes: where one is lost, what stands there is not what was saved.
_KEYS = {1: ("m_Component", "m_Layer", "m_Name", "m_TagString", "m_IsActive"),
         4: ("m_GameObject", "m_LocalRotation", "m_LocalPosition", "m_LocalScale", "m_Children", "m_Father"),
         20: ("m_GameObject", "m_Enabled", "m_ClearFlags", "near clip plane", "far clip plane", "field of view",
              "m_CullingMask"),
         108: ("m_GameObject", "m_Enabled", "m_Type", "m_Color", "m_Intensity", "m_CullingMask"),
         114: ("m_GameObject", "m_Enabled", "m_Script")}


def _keys(path: str, document: Document) -> Iterator[Violation]:
    is_whole = "m_ObjectHideFlags" in document.data and "m_PrefabInstance" in document.data
    for key in _KEYS.get(document.class_id, ()) if is_whole else ():
        if key not in document.data:
            yield Violation(path, document.line, "scene-key", f"{document.type} &{document.file_id} has no '{key}'")


def number(value: Any) -> float:
    """A number as written; not a number where it is none."""
    try:
        return float(value)
    except (TypeError, ValueError):
        return math.nan


def _place(path: str, document: Document) -> Iterator[Violation]:
    """A transform's numbers: all finite, a rotation of length 1, no scale of 0."""
    for key, axes in (("m_LocalPosition", "xyz"), ("m_LocalScale", "xyz"), ("m_LocalRotation", "xyzw")):
        value = document.data.get(key)
        if value is None:
            continue
        parts = [number(value.get(axis)) for axis in axes] if isinstance(value, dict) else [math.nan]
        reason = "must be finite numbers" if not all(map(math.isfinite, parts)) else \
            "may not be 0" if key == "m_LocalScale" and 0.0 in parts else \
            "must have length 1" if key == "m_LocalRotation" and abs(math.hypot(*parts) - 1.0) > 1e-3 else None
        if reason is not None:
            yield Violation(path, document.line, "scene-place", f"Transform &{document.file_id}: {key} {reason}")


def _labels(project: Project, path: str, seen: dict[int, Document]) -> Iterator[Violation]:
    tags, layers = own_labels(project)
    for document in seen.values():
        if document.class_id != 1:
            continue
        tag = document.data.get("m_TagString", "Untagged")
        if tag not in TAGS | tags:
            yield Violation(path, document.line, "scene-tag",
                            f"GameObject &{document.file_id}: there is no tag '{tag}'")
        layer = number(document.data.get("m_Layer", "0"))
        if layer not in LAYERS | layers:
            yield Violation(path, document.line, "scene-layer",
                            f"GameObject &{document.file_id}: there is no layer {document.data.get('m_Layer')}")


def own_labels(project: Project) -> tuple[set[str], set[int]]:
    """The tags and the numbers of the layers that the project has named."""
    path = "ProjectSettings/TagManager.asset"
    data = documents(project, path)[0] if project.is_file(path) else []
    tags, layers = (data[0].data.get(key) for key in ("tags", "layers")) if data else ((), ())
    return ({tag for tag in tags if isinstance(tag, str)} if isinstance(tags, list) else set(),
            {place for place, name in enumerate(layers) if name} if isinstance(layers, list) else set())

"""Scenes and prefabs: documents, objects, components and transforms that agree, and fields that the scripts store."""

from __future__ import annotations

import re
from typing import Any, Iterator

from tools.unitycheck.metas import guids
from tools.unitycheck.project import Project
from tools.unitycheck.sources import scripts
from tools.unitycheck.unityyaml import Document, FormError, parse
from tools.unitycheck.violation import Violation

OBJECT, BEHAVIOUR, INSTANCE, ROOTS = 1, 114, 1001, 1660057539
TRANSFORMS = (4, 224)
SETTINGS = {1: 29, 2: 104, 3: 157, 4: 196}  # the documents that every scene begins with: file ID, class
_INTEGER = re.compile(r"^-?\d{1,20}$")
_OWN_KEYS = {"m_ObjectHideFlags", "m_CorrespondingSourceObject", "m_PrefabInstance", "m_PrefabAsset", "m_GameObject",
             "m_Enabled", "m_EditorHideFlags", "m_Script", "m_Name", "m_EditorClassIdentifier", "serializedVersion",
             "references"}


def local_id(reference: Any) -> int:
    """Return the local file ID of a reference such as {fileID: 101}; 0 if it is none."""
    text = str(reference.get("fileID", "0")) if isinstance(reference, dict) else "0"
    return int(text) if _INTEGER.match(text) else 0


def _ids(listed: Any) -> list[int]:
    return [local_id(item) for item in listed] if isinstance(listed, list) else []


def check(project: Project) -> Iterator[Violation]:
    """Rules yaml-form, file-id, reference-local, scene-* and field-unknown.

    What scripts store is the compiler's to say: where it is not built, their fields are not checked.
    """
    for path in project.yaml_files():
        try:
            found = parse(project.text(path))
        except FormError as error:
            yield Violation(path, error.line, "yaml-form", str(error))
            continue
        seen: dict[int, Document] = {}
        for document in found:
            if document.file_id in seen or document.file_id == 0:
                yield Violation(path, document.line, "file-id", f"&{document.file_id} is zero or used twice")
            seen[document.file_id] = document
        yield from _local_references(path, seen)
        if path.endswith((".unity", ".prefab")):
            yield from _objects(path, seen)
            yield from _families(path, seen)
            yield from _scripts(project, path, found)
        if path.endswith(".unity"):
            if {document.file_id: document.class_id for document in found[:4]} != SETTINGS:
                yield Violation(path, 0, "scene-settings", f"must begin with the documents {SETTINGS} (ID: class)")
            yield from _roots(path, seen)


def _local_references(path: str, seen: dict[int, Document]) -> Iterator[Violation]:
    def walk(value: Any) -> Iterator[Any]:
        if isinstance(value, dict) and "fileID" in value and "guid" not in value:
            yield value
        for inner in value.values() if isinstance(value, dict) else value if isinstance(value, list) else ():
            yield from walk(inner)

    for document in seen.values():
        for reference in walk(document.data):
            if not _INTEGER.match(str(reference["fileID"])) or local_id(reference) not in {0, *seen}:
                yield Violation(path, document.line, "reference-local",
                                f"{document.type} &{document.file_id} points to fileID {reference['fileID']}, "
                                "which is not in this file")


def _objects(path: str, seen: dict[int, Document]) -> Iterator[Violation]:
    listed: set[int] = set()
    for document in seen.values():
        if document.class_id != OBJECT or document.is_stripped:
            continue
        items = document.data.get("m_Component")
        ids = [local_id(item.get("component")) for item in items if isinstance(item, dict)] \
            if isinstance(items, list) else []
        classes = [seen[number].class_id for number in ids if number in seen]
        if sum(map(classes.count, TRANSFORMS)) != 1 or classes[0] not in TRANSFORMS:
            yield Violation(path, document.line, "scene-transform",
                            f"GameObject &{document.file_id}: its first component must be its only Transform")
        for number in ids:
            if number in listed or (number in seen
                                    and local_id(seen[number].data.get("m_GameObject")) != document.file_id):
                yield Violation(path, document.line, "scene-component",
                                f"GameObject &{document.file_id} lists &{number}, which is another's")
            listed.add(number)
    for document in seen.values():
        if "m_GameObject" in document.data and not document.is_stripped and document.file_id not in listed:
            yield Violation(path, document.line, "scene-component",
                            f"{document.type} &{document.file_id} is in no m_Component list")


def _families(path: str, seen: dict[int, Document]) -> Iterator[Violation]:
    """Fathers and children name each other, as often."""
    transforms = [document for document in seen.values()
                  if document.class_id in TRANSFORMS and not document.is_stripped]
    down = [(document.file_id, child) for document in transforms for child in _ids(document.data.get("m_Children"))]
    up = [(local_id(document.data.get("m_Father")), document.file_id) for document in transforms]
    known = {document.file_id for document in transforms}
    for father, child in {*down, *up}:
        if {father, child} <= known and down.count((father, child)) != up.count((father, child)):
            yield Violation(path, seen[child].line, "scene-parent",
                            f"Transform &{child}: m_Father and the m_Children of &{father} do not agree")


def _roots(path: str, seen: dict[int, Document]) -> Iterator[Violation]:
    """An instance of a prefab is listed itself; its Transform is the prefab's, and stripped here."""
    fathers = {document.file_id: document.data.get("m_Father") for document in seen.values()
               if document.class_id in TRANSFORMS and not document.is_stripped}
    fathers |= {document.file_id: document.data["m_Modification"].get("m_TransformParent") for document in seen.values()
                if document.class_id == INSTANCE and isinstance(document.data.get("m_Modification"), dict)}
    tops = {file_id for file_id, father in fathers.items() if local_id(father) == 0}
    roots = seen.get(2**63 - 1)
    ids = _ids(roots.data.get("m_Roots")) if roots is not None and roots.class_id == ROOTS else None
    if ids is None or len(ids) != len(set(ids)) or set(ids) != tops:
        yield Violation(path, roots.line if roots else 0, "scene-roots",
                        f"SceneRoots &{2**63 - 1} must list exactly {sorted(tops)}")


def _scripts(project: Project, path: str, found: list[Document]) -> Iterator[Violation]:
    known = scripts(project)
    for document in found:
        if document.class_id != BEHAVIOUR or document.is_stripped or known is None:
            continue
        reference = document.data.get("m_Script")
        source = guids(project).get(str(reference.get("guid")) if isinstance(reference, dict) else "", "")
        fields = known.get(source)
        if fields is None:
            yield Violation(path, document.line, "scene-script",
                            f"MonoBehaviour &{document.file_id}: '{source}' holds no behaviour of its name for players")
            continue
        for key in document.data.keys() - _OWN_KEYS - fields:
            yield Violation(path, document.line, "field-unknown",
                            f"{source} stores no field '{key}' (it stores {', '.join(sorted(fields)) or 'none'})")

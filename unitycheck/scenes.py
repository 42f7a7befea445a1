"""Scenes and materials: objects, components and references that agree with each other and with the scripts."""

from __future__ import annotations

import re
from typing import Any, Iterator

from unitycheck.asmdefs import load, owner
from unitycheck.metas import guids
from unitycheck.packages import dependencies
from unitycheck.project import Project
from unitycheck.scripts import Field, behaviours
from unitycheck.unityyaml import Document, FormError, parse
from unitycheck.violation import Violation

CLASSES = {1: "GameObject", 4: "Transform", 5: "TimeManager", 20: "Camera", 21: "Material", 23: "MeshRenderer",
           29: "OcclusionCullingSettings", 33: "MeshFilter", 104: "RenderSettings", 108: "Light",
           114: "MonoBehaviour", 120: "LineRenderer",
           129: "PlayerSettings",
           157: "LightmapSettings", 159: "EditorSettings", 196: "NavMeshSettings", 1045: "EditorBuildSettings",
           890905787: "VersionControlSettings", 1660057539: "SceneRoots", 81: "AudioListener"}
SETTINGS = {1: 29, 2: 104, 3: 157, 4: 196}
ROOTS = 1660057539
_OWN_KEYS = {"m_ObjectHideFlags", "m_CorrespondingSourceObject", "m_PrefabInstance", "m_PrefabAsset", "m_GameObject",
             "m_Enabled", "m_EditorHideFlags", "m_Script", "m_Name", "m_EditorClassIdentifier"}
_NUMBER = re.compile(r"^-?\d+(\.\d+)?(e[+-]?\d+)?$")
_INTEGER = re.compile(r"^-?\d+$")


def _id(reference: Any) -> int:
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
    """Rules yaml-form, class-id, file-id, reference-local and, for scenes, scene-* and field-*."""
    scripts = _Scripts(project)
    for path in project.yaml_files():
        found, problem = documents(project, path)
        if problem:
            yield problem
            continue
        seen: dict[int, Document] = {}
        for document in found:
            if CLASSES.get(document.class_id) != document.type:
                expected = CLASSES.get(document.class_id, "not in the table of classes")
                yield Violation(path, document.line, "class-id",
                                f"class {document.class_id} is {expected}, not {document.type}")
            if document.file_id in seen or document.file_id == 0 or not -2**63 <= document.file_id < 2**63:
                yield Violation(path, document.line, "file-id",
                                f"&{document.file_id} is zero, too large or used twice")
            seen[document.file_id] = document
        yield from _local_references(path, found, seen)
        if path.endswith(".unity"):
            yield from _settings(path, found)
            yield from _hierarchy(path, seen)
            yield from _roots(path, seen)
            for document in found:
                if document.class_id == 114:
                    yield from scripts.check(path, document)
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
            if not _INTEGER.match(str(reference["fileID"])) or (_id(reference) != 0 and _id(reference) not in seen):
                yield Violation(path, document.line, "reference-local",
                                f"{document.type} &{document.file_id} points to fileID {reference['fileID']}, "
                                "which is not in this file")


def _settings(path: str, found: list[Document]) -> Iterator[Violation]:
    for place, (file_id, class_id) in enumerate(SETTINGS.items()):
        document = found[place] if place < len(found) else None
        if document is None or (document.file_id, document.class_id) != (file_id, class_id):
            yield Violation(path, document.line if document else 0, "scene-settings",
                            f"document {place + 1} must be {CLASSES[class_id]} &{file_id}")


def _hierarchy(path: str, seen: dict[int, Document]) -> Iterator[Violation]:
    listed: dict[int, int] = {}
    for document in seen.values():
        if document.class_id != 1:
            continue
        components = document.data.get("m_Component")
        ids = [_id(item.get("component")) for item in components if isinstance(item, dict)] \
            if isinstance(components, list) else []
        first = seen.get(ids[0]) if ids else None
        if first is None or first.class_id != 4:
            yield Violation(path, document.line, "scene-transform",
                            f"GameObject &{document.file_id}: its first component must be a Transform")
        for component in ids:
            if component in listed:
                yield Violation(path, document.line, "scene-component", f"&{component} is listed by two GameObjects")
            listed[component] = document.file_id
            target = seen.get(component)
            if target is not None and _id(target.data.get("m_GameObject")) != document.file_id:
                yield Violation(path, target.line, "scene-component",
                                f"{target.type} &{component}: m_GameObject must be &{document.file_id}, which lists it")
    for document in seen.values():
        if "m_GameObject" in document.data and document.file_id not in listed:
            yield Violation(path, document.line, "scene-component",
                            f"{document.type} &{document.file_id} is in no m_Component list")
        if document.class_id == 4:
            yield from _family(path, document, seen)


def _family(path: str, document: Document, seen: dict[int, Document]) -> Iterator[Violation]:
    children = document.data.get("m_Children")
    for child in (_id(item) for item in children) if isinstance(children, list) else ():
        target = seen.get(child)
        if target is not None and _id(target.data.get("m_Father")) != document.file_id:
            yield Violation(path, target.line, "scene-parent",
                            f"Transform &{child}: m_Father must be &{document.file_id}")
    father = seen.get(_id(document.data.get("m_Father")))
    if father is not None:
        listed = father.data.get("m_Children")
        if not isinstance(listed, list) or document.file_id not in [_id(item) for item in listed]:
            yield Violation(path, father.line, "scene-parent",
                            f"Transform &{father.file_id}: m_Children lacks &{document.file_id}")


def _roots(path: str, seen: dict[int, Document]) -> Iterator[Violation]:
    roots = [document for document in seen.values() if document.class_id == ROOTS]
    fathers = {document.file_id for document in seen.values()
               if document.class_id == 4 and _id(document.data.get("m_Father")) == 0}
    if len(roots) != 1 or roots[0].file_id != 2**63 - 1:
        yield Violation(path, 0, "scene-roots", "needs one SceneRoots &9223372036854775807")
        return
    listed = roots[0].data.get("m_Roots")
    ids = [_id(item) for item in listed] if isinstance(listed, list) else []
    if len(ids) != len(set(ids)) or set(ids) != fathers:
        yield Violation(path, roots[0].line, "scene-roots", f"m_Roots must list exactly {sorted(fathers)}, not {ids}")


class _Scripts:
    """What the scene's MonoBehaviours are checked against."""

    def __init__(self, project: Project) -> None:
        self._path_of = guids(project)
        self._behaviours = behaviours(project)
        self._asmdefs, _ = load(project)

    def check(self, path: str, document: Document) -> Iterator[Violation]:
        reference = document.data.get("m_Script")
        guid = reference.get("guid", "") if isinstance(reference, dict) else ""
        source = self._path_of.get(guid, "")
        if not source.endswith(".cs"):
            yield Violation(path, document.line, "scene-script",
                            f"MonoBehaviour &{document.file_id}: m_Script is no script")
            return
        stem = source.rpartition("/")[2][:-len(".cs")]
        script = next((script for script in self._behaviours.get(source, []) if script.name == stem), None)
        if script is None:
            yield Violation(path, document.line, "scene-script", f"{source} holds no MonoBehaviour {stem}")
            return
        assembly = owner(self._asmdefs, source)
        if assembly is not None and assembly.is_editor_only:
            yield Violation(path, document.line, "scene-script", f"{source} exists in the editor only")
        fields = {stored.name: stored for stored in self._fields(script.name)}
        for key, value in document.data.items():
            if key in _OWN_KEYS:
                continue
            if key not in fields:
                yield Violation(path, document.line, "field-unknown", f"{stem} stores no field '{key}' "
                                f"(it stores {', '.join(sorted(fields)) or 'none'})")
            else:
                yield from _field_value(path, document, stem, fields[key], value)

    def _fields(self, name: str) -> Iterator[Field]:
        for scripts in self._behaviours.values():
            for script in scripts:
                if script.name == name:
                    yield from script.fields
                    for base in script.bases:
                        yield from self._fields(base)


def _field_value(path: str, document: Document, stem: str, stored: Field, value: Any) -> Iterator[Violation]:
    kind = stored.type.rstrip("?")
    right = {"bool": value in ("0", "1"), "int": isinstance(value, str) and bool(_INTEGER.match(value)),
             "float": isinstance(value, str) and bool(_NUMBER.match(value)),
             "double": isinstance(value, str) and bool(_NUMBER.match(value)), "string": isinstance(value, str),
             "Vector3": isinstance(value, dict) and set(value) == {"x", "y", "z"},
             "Color": isinstance(value, dict) and set(value) == {"r", "g", "b", "a"},
             "string[]": isinstance(value, list) and all(isinstance(item, str) for item in value)}
    is_reference = isinstance(value, dict) and "fileID" in value
    is_enum = isinstance(value, str) and bool(_INTEGER.match(value))
    if not right.get(kind, is_reference or is_enum or isinstance(value, list)):
        yield Violation(path, document.line, "field-value", f"{stem}.{stored.name} is a {kind}, not '{value}'")

"""Components in scenes: scripts, the values of their fields, what they refer to, and what every scene needs."""

from __future__ import annotations

import re
from typing import Any, Iterator

from tools.unitycheck.classids import CLASSES
from tools.unitycheck.metas import guids
from tools.unitycheck.project import Project
from tools.unitycheck.scenes import components, documents, local_id, number
from tools.unitycheck.scenetable import BESIDE, NEEDED
from tools.unitycheck.sources import Field, Script, scripts
from tools.unitycheck.unityyaml import Document
from tools.unitycheck.violation import Violation

_OWN_KEYS = {"m_ObjectHideFlags", "m_CorrespondingSourceObject", "m_PrefabInstance", "m_PrefabAsset", "m_GameObject",
             "m_Enabled", "m_EditorHideFlags", "m_Script", "m_Name", "m_EditorClassIdentifier", "serializedVersion",
             "references"}
_NUMBER = re.compile(r"^-?\d+(\.\d+)?(e[+-]?\d+)?$", re.IGNORECASE)
_INTEGER = re.compile(r"^-?\d{1,20}$")
_AXES = {"Vector2": "xy", "Vector3": "xyz", "Vector4": "xyzw", "Quaternion": "xyzw", "Color": "rgba"}
_WHOLE = {"byte": (0, 2**8), "sbyte": (-2**7, 2**7), "short": (-2**15, 2**15), "ushort": (0, 2**16),
          "int": (-2**31, 2**31), "uint": (0, 2**32), "long": (-2**63, 2**63), "ulong": (0, 2**64)}
# Files by ending: the classes of the object in them.
_ASSETS = {".mat": {"Material"}, ".shader": {"Shader"}, ".compute": {"ComputeShader"}, ".cs": set(),
           ".txt": {"TextAsset"}, ".json": {"TextAsset"}, ".csv": {"TextAsset"}, ".prefab": {"GameObject"},
           ".png": {"Texture", "Texture2D", "Sprite"}}
# Unity's own assets by number: what they are.
_BUILTIN = ((10200, 10220, {"Mesh"}), (10302, 10306, {"Material"}), (10100, 10110, {"Font", "Material", "Shader"}))
# Choices of Unity's own components: class, key, how many there are (the first is 0).
_CHOICES = ((20, "m_ClearFlags", 5), (20, "orthographic", 2), (20, "m_projectionMatrixMode", 4), (20, "m_GateFitMode",
                                                                                                  5),
            (108, "m_Type", 8), (108, "m_RenderMode", 3), (108, "m_Lightmapping", 7), (104, "m_AmbientMode", 5),
            (104, "m_FogMode", 4), (104, "m_Fog", 2))
_BASES = {"Camera": {"Behaviour", "Component"}, "Light": {"Behaviour", "Component"},
          "Transform": {"Component"}, "MeshRenderer": {"Renderer", "Component"}, "MeshFilter": {"Component"},
          "LineRenderer": {"Renderer", "Component"}, "MeshCollider": {"Collider", "Component"},
          "BoxCollider": {"Collider", "Component"}, "SphereCollider": {"Collider", "Component"},
          "AudioListener": {"Behaviour", "Component"}, "RectTransform": {"Transform", "Component"}}


def check(project: Project) -> Iterator[Violation]:
    """Rules scene-script, scene-needs, scene-camera, scene-light, field-unknown, field-value, reference-*.

    What scripts store is the compiler's to say: where it is not built, their fields are not checked.
    """
    for path in project.assets(".unity"):
        found, problem = documents(project, path)
        if problem is None:
            yield from _Scene(project, path, found).check()


class _Scene:
    def __init__(self, project: Project, path: str, found: list[Document]) -> None:
        self._project = project
        self._path = path
        self._seen = {document.file_id: document for document in found}
        self._known = scripts(project) or {}
        self._scripts: dict[int, Script] = {}

    def check(self) -> Iterator[Violation]:
        for document in self._seen.values():
            if document.class_id == 114 and not document.is_stripped and scripts(self._project) is not None:
                yield from self._script(document)
        for document in self._seen.values():
            if document.file_id in self._scripts:
                yield from self._fields(document, self._scripts[document.file_id])
        for document in self._seen.values():
            for class_id, key, count in _CHOICES:
                value = document.data.get(key, "0")
                if document.class_id == class_id and value not in [str(choice) for choice in range(count)]:
                    yield self._violation(document, "field-value",
                                          f"{document.type}.{key} is none of 0 to {count - 1}: '{value}'")
            if "m_Enabled" in document.data and document.data["m_Enabled"] not in ("0", "1"):
                yield self._violation(document, "field-value", f"{document.type}.m_Enabled is 0 or 1")
        yield from self._needs()
        yield from self._cameras()

    def _script(self, document: Document) -> Iterator[Violation]:
        reference = document.data.get("m_Script")
        guid = str(reference.get("guid", "")) if isinstance(reference, dict) else ""
        source = guids(self._project).get(guid, "")
        if not source.endswith(".cs"):
            yield self._violation(document, "scene-script", f"MonoBehaviour &{document.file_id}: m_Script is no script")
            return
        script = self._known.get(source)
        if script is None or not script.is_attachable:
            stem = source.rpartition("/")[2][:-len(".cs")]
            yield self._violation(document, "scene-script", f"{source} holds no MonoBehaviour {stem}")
            return
        self._scripts[document.file_id] = script
        if script.is_editor_only:
            yield self._violation(document, "scene-script", f"{source} exists in the editor only")

    def _fields(self, document: Document, script: Script) -> Iterator[Violation]:
        names = {name: key for key, item in script.fields.items() for name in (*item.names, key)}
        for key, value in document.data.items():
            if key in _OWN_KEYS:
                continue
            if key not in names:
                yield self._violation(document, "field-unknown", f"{script.name} stores no field '{key}' "
                                      f"(it stores {', '.join(sorted(script.fields)) or 'none'})")
            else:
                yield from self._value(document, f"{script.name}.{key}", script.fields[names[key]], value)
        for key, item in script.fields.items():
            if item.is_needed and not {key, *item.names} & document.data.keys():
                yield self._violation(document, "reference-unset", f"{script.name}.{key} is not set")

    def _value(self, document: Document, name: str, item: Field, value: Any) -> Iterator[Violation]:
        values = [value]
        if item.is_list:
            if not isinstance(value, list) and not (isinstance(value, str) and re.match(r"^([0-9a-f]{2})*$", value)):
                yield self._violation(document, "field-value", f"{name} is a list of {item.type}, not '{value}'")
                return
            values = value if isinstance(value, list) else []
        for one in values:
            reason = self._reason(item, one)
            if reason is not None:
                yield self._violation(document, reason[0], f"{name} {reason[1]}")

    def _reason(self, item: Field, value: Any) -> tuple[str, str] | None:
        said = "field-value", f"is a {item.type}, not '{value}'"
        if item.kind in ("number", "bool"):
            is_whole = item.kind == "bool" or item.type in _WHOLE
            if not isinstance(value, str) or not (_INTEGER if is_whole else _NUMBER).match(value):
                return said
            low, high = (0, 2) if item.kind == "bool" else _WHOLE.get(item.type, (-float("inf"), float("inf")))
            if not low <= float(value) < high:
                return said
            if len(item.range) == 2 and not item.range[0] <= float(value) <= item.range[1]:
                return "field-value", f"= {value} is outside its Range {item.range[0]:g} to {item.range[1]:g}"
        elif item.kind == "text":
            return None if isinstance(value, str) else said
        elif item.type in _AXES:
            is_whole = isinstance(value, dict) and set(value) == set(_AXES[item.type]) \
                and all(isinstance(part, str) and _NUMBER.match(part) for part in value.values())
            return None if is_whole else said
        elif item.kind == "enum":
            if not isinstance(value, str) or not _INTEGER.match(value) or \
                    (item.values is not None and int(value) not in item.values):
                return "field-value", f"is none of {item.type}'s values {sorted(item.values or ())}: '{value}'"
        elif item.kind == "object":
            return self._reference(item, value)
        elif item.kind == "class":
            if not isinstance(value, dict):
                return said
            wrong = sorted(set(value) - item.fields)
            if wrong and "fileID" not in value:
                return "field-unknown", \
                    f"has no field '{wrong[0]}' (a {item.type} stores {', '.join(sorted(item.fields))})"
        return None

    def _reference(self, item: Field, value: Any) -> tuple[str, str] | None:
        if not isinstance(value, dict) or "fileID" not in value:
            return "field-value", f"is a reference, not '{value}'"
        guid = str(value.get("guid", ""))
        if not guid:
            target = self._seen.get(local_id(value))
            if local_id(value) == 0:
                return ("reference-unset", "is not set") if item.is_needed else None
            if target is None:
                return None  # the scenes' rules say so
            kinds = self._kinds(target)
            if kinds is not None and item.type not in kinds | {"Object"}:
                return "reference-class", f"is a {item.type}; &{target.file_id} is a {sorted(kinds)[0]}"
            return None
        target_path = guids(self._project).get(guid)
        if target_path is None:
            low = number(value.get("fileID"))
            kinds = next((kinds for start, end, kinds in _BUILTIN if start <= low <= end), None)
        else:
            suffix = target_path[target_path.rfind("."):] if "." in target_path.rpartition("/")[2] else ""
            kinds = _ASSETS.get(suffix)
        if kinds is not None and item.type not in kinds | {"Object"}:
            return "reference-class", f"is a {item.type}, not what {target_path or 'a built-in asset'} holds"
        return None

    def _kinds(self, target: Document) -> set[str] | None:
        """The names under which a field may hold a document; None where that is not known."""
        if target.class_id == 114:
            script = self._scripts.get(target.file_id)
            if script is None:
                return None
            return set(script.bases)
        name = CLASSES.get(target.class_id)
        return None if name is None else {name} | _BASES.get(name, set())

    def _is_live(self, document: Document) -> bool:
        """Whether a component works once the scene is open: it and every object above it are switched on."""
        if document.data.get("m_Enabled", "1") != "1":
            return False
        seen: set[int] = set()
        game_object = self._seen.get(local_id(document.data.get("m_GameObject")))
        while game_object is not None and game_object.file_id not in seen:
            seen.add(game_object.file_id)
            if game_object.data.get("m_IsActive", "1") != "1" or game_object.data.get("m_TagString") == "EditorOnly":
                return False
            transform = next((self._seen[i] for i in components(game_object)
                              if i in self._seen and self._seen[i].class_id in (4, 224)), None)
            father = self._seen.get(local_id(transform.data.get("m_Father"))) if transform else None
            game_object = self._seen.get(local_id(father.data.get("m_GameObject"))) if father else None
        return True

    def _needs(self) -> Iterator[Violation]:
        if any(script.name in NEEDED for script in self._scripts.values()):
            yield from self._lights()
        existing = {script.name for script in self._known.values()}
        for name in NEEDED:
            if name not in existing:
                continue
            held = [file_id for file_id, script in self._scripts.items() if script.name == name]
            if len(held) != 1:
                yield Violation(self._path, 0, "scene-needs", f"needs one {name}, has {len(held)}")
            elif not self._is_live(self._seen[held[0]]):
                yield self._violation(self._seen[held[0]], "scene-needs", f"{name} is switched off, or its object is")
            elif name in BESIDE and BESIDE[name] not in {CLASSES.get(other.class_id) for other in
                                                         self._beside(self._seen[held[0]])}:
                yield self._violation(self._seen[held[0]], "scene-needs", f"{name} needs a {BESIDE[name]} beside it")

    def _beside(self, document: Document) -> list[Document]:
        """The components of a component's object."""
        game_object = self._seen.get(local_id(document.data.get("m_GameObject")))
        return [self._seen[i] for i in components(game_object) if i in self._seen] if game_object is not None else []

    def _lights(self) -> Iterator[Violation]:
        lights = [document for document in self._seen.values() if document.class_id == 108]
        if not any(self._is_live(light) and number(light.data.get("m_Intensity", 1)) > 0.0 for light in lights):
            yield Violation(self._path, 0, "scene-light", "has no light that is switched on")

    def _cameras(self) -> Iterator[Violation]:
        cameras = [document for document in self._seen.values() if document.class_id == 20]
        if not any(map(self._is_live, cameras)):
            yield Violation(self._path, 0, "scene-camera", "has no camera that is switched on")
        layers = {int(number(document.data.get("m_Layer", "0"))) for document in self._seen.values()
                  if document.class_id == 1 and 0 <= number(document.data.get("m_Layer", "0")) < 32} | {0}
        for camera in cameras:
            yield from self._camera(camera, layers)

    def _camera(self, camera: Document, layers: set[int]) -> Iterator[Violation]:
        data = camera.data
        near, far, angle = (number(data.get(key, usual)) for key, usual in
                            (("near clip plane", 0.3), ("far clip plane", 1000.0), ("field of view", 60.0)))
        mask = data.get("m_CullingMask")
        bits = number(mask.get("m_Bits", 2**32 - 1)) if isinstance(mask, dict) else 2.0**32 - 1
        rect = data.get("m_NormalizedViewPortRect")
        sizes = [number(rect.get(key, 1)) for key in ("width", "height")] if isinstance(rect, dict) else [1.0]
        size = number(data.get("orthographic size", 5)) if data.get("orthographic") == "1" else 5.0
        reason = "its orthographic size must be positive" if not size > 0.0 else \
            "near and far clip plane must be 0 < near < far" if not 0.0 < near < far else \
            "field of view must be between 0 and 180" if not 0.0 < angle < 180.0 else \
            "its culling mask leaves out a layer of the scene" if bits != bits or any(
                not int(bits) >> layer & 1 for layer in layers) else \
            "its part of the screen is empty" if not all(size > 0.0 for size in sizes) else \
            "draws into a texture, not on the screen" if local_id(data.get("m_TargetTexture")) else \
            "draws on another display" if data.get("m_TargetDisplay", "0") != "0" else None
        if reason is not None:
            yield self._violation(camera, "scene-camera", f"Camera &{camera.file_id}: {reason}")

    def _violation(self, document: Document, rule: str, message: str) -> Violation:
        return Violation(self._path, document.line, rule, message)

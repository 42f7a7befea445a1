"""Fields that Unity stores in scenes, and those that it silently leaves out though an attribute asks for them."""

from __future__ import annotations

import re
from typing import Iterator

from unitycheck.behaviours import OBJECTS, ROOTS, behaviours, by_name, chain, descendants, types
from unitycheck.csharp import Token, closing
from unitycheck.declarations import Declaration, Field
from unitycheck.project import Project
from unitycheck.violation import Violation

NUMBERS = {"byte", "sbyte", "short", "ushort", "int", "uint", "long", "ulong", "float", "double"}
_VALUES = NUMBERS | {"bool", "char", "string"} | {
    "Vector2", "Vector3", "Vector4", "Vector2Int", "Vector3Int", "Quaternion", "Color", "Color32", "Rect", "RectInt",
    "Bounds", "BoundsInt", "Matrix4x4", "LayerMask", "AnimationCurve", "Gradient", "RectOffset", "GUIStyle", "Hash128",
    "UnityEvent"}
_NEVER = {
    "Dictionary", "SortedDictionary", "ConcurrentDictionary", "HashSet", "SortedSet", "Queue", "Stack", "LinkedList",
    "SortedList", "IList", "ICollection", "IEnumerable", "IReadOnlyList", "IReadOnlyCollection", "IDictionary",
    "IReadOnlyDictionary", "ISet", "IComparer", "IDisposable", "Action", "Func", "Predicate", "Delegate", "object",
    "dynamic", "decimal", "DateTime", "DateTimeOffset", "TimeSpan", "Guid", "Type", "nint", "nuint", "IntPtr",
    "Nullable", "Tuple", "ValueTuple", "KeyValuePair", "StringBuilder", "Stopwatch", "Thread", "Task", "Regex", "Uri",
    "Lazy", "WeakReference", "Span", "Memory", "ArraySegment", "BigInteger", "Complex", "Half", "CultureInfo",
    "Stream", "StreamReader", "StreamWriter", "FileInfo", "DirectoryInfo", "Exception", "Index", "Range", "JToken",
    "JObject", "JArray", "JValue"}
_INSPECTOR = {"SerializeField", "Range", "Tooltip", "Header", "Min", "TextArea", "Multiline", "ColorUsage", "Delayed",
              "GradientUsage", "ContextMenuItem", "FormerlySerializedAs", "InspectorName", "Space"}
# Attributes that draw a field: the types that they can draw.
_DRAWS = {"Range": NUMBERS, "Min": NUMBERS | {"Vector2", "Vector3", "Vector4", "Vector2Int", "Vector3Int"},
          "TextArea": {"string"}, "Multiline": {"string"}, "ColorUsage": {"Color"}, "GradientUsage": {"Gradient"},
          "Delayed": {"int", "float", "double", "string"}}
# Statics of the engine that a constructor may not ask: they throw there, or give the editor's values.
_STATICS = {"Time", "Application", "Screen", "Input", "Camera", "Resources", "GameObject", "Random", "SystemInfo",
            "Physics", "PlayerPrefs", "QualitySettings", "SceneManager", "Shader", "Graphics", "RenderSettings",
            "Cursor", "GUI", "GUILayout", "GUIUtility", "AssetDatabase", "EditorPrefs", "EditorApplication", "Display",
            "ScriptableObject"}
_ENGINE = {"UnityEngine", "UnityEditor"}
_CALLS = {"FindObjectOfType", "FindObjectsOfType", "FindFirstObjectByType", "FindAnyObjectByType", "FindObjectsByType",
          "Instantiate", "GetComponent", "GetComponentInChildren", "GetComponentInParent", "AddComponent",
          "CreateInstance"}
_NATIVE = {"GameObject", "Material", "Mesh", "Texture2D", "Texture3D", "RenderTexture", "MaterialPropertyBlock",
           "ComputeBuffer", "GraphicsBuffer", "Cubemap"}


def stored_name(stored: Field) -> str:
    """The key under which a scene keeps a field."""
    return f"<{stored.name}>k__BackingField" if stored.is_property else stored.name


def is_stored(item: Field) -> bool:
    """Whether Unity stores a field, its type left aside."""
    if item.is_property:
        return item.has("SerializeField", "field") and item.is_auto and item.is_settable \
            and "static" not in item.modifiers
    asked = item.has("SerializeField") or item.has("SerializeReference")
    return (asked or ("public" in item.modifiers and not item.has("NonSerialized"))) \
        and not {"static", "const", "readonly"} & item.modifiers


def stored_fields(project: Project, script: Declaration) -> dict[str, Field]:
    """The fields that a scene may hold for a script, those of its bases included, by key."""
    return {stored_name(item): item for declaration in chain(project, script) for item in declaration.fields
            if is_stored(item) and _refusal(project, item) is None}


def element(kind: str) -> str:
    """The type that an array or list holds, or the type itself, without namespace."""
    kind = kind.rstrip("?")
    if kind.endswith("[]"):
        kind = kind[:-2].rstrip("?")
    elif re.match(r"^(System\.Collections\.Generic\.)?List<.*>$", kind):
        kind = kind.partition("<")[2][:-1].rstrip("?")
    return kind if "<" in kind else kind.rpartition(".")[2]


def _refusal(project: Project, item: Field) -> str | None:
    """Why Unity does not store a field of this type; None where it does, or where the type is not ours to know."""
    if item.has("SerializeReference"):
        return None
    kind = element(item.type)
    if "[" in kind or kind.startswith(("List<", "System.Collections.Generic.List<")):
        return f"{item.type}: arrays and lists of one dimension only"
    bare = kind.partition("<")[0].rpartition(".")[2]
    if item.type.endswith("?") and (bare in NUMBERS | {"bool", "char", "Vector2", "Vector3", "Color", "Quaternion"}
                                    or any(found.kind in ("enum", "struct") for found in by_name(project).get(bare, []))
                                    ):
        return f"{item.type}: no value that may be missing"
    if bare in _NEVER or kind.startswith("("):
        return f"{item.type} is no type that it stores"
    if bare in _VALUES | OBJECTS or bare in descendants(project, ROOTS):
        return None
    for declaration in by_name(project).get(bare, []):
        if declaration.kind == "enum" and {"long", "ulong"} & set(declaration.bases):
            return f"{item.type} has 64 bits"
        if declaration.kind == "interface":
            return f"{item.type} is an interface (SerializeReference stores one)"
        if declaration.kind in ("class", "struct", "record") and not declaration.has("Serializable"):
            return f"{item.type} is not [Serializable]"
        if declaration.kind == "class" and {"abstract", "static"} & declaration.modifiers:
            return f"{item.type} is abstract (SerializeReference stores one)"
    return None


def check(project: Project) -> Iterator[Violation]:
    """Rules field-stored, field-attribute, field-initialiser."""
    attached = {id(declaration) for declared in behaviours(project).values() for declaration in declared}
    drawn = _INSPECTOR | {name for name in descendants(project, {"PropertyAttribute"})} \
        | {name[:-len("Attribute")] for name in descendants(project,
                                                            {"PropertyAttribute"}) if name.endswith("Attribute")}
    for path, declared in types(project).items():
        for declaration in declared:
            is_attached = id(declaration) in attached
            holds = is_attached or declaration.has("Serializable")
            for item in declaration.fields:
                yield from _stored(project, path, declaration, item, holds, drawn)
            if holds:
                for item in declaration.fields:
                    yield from _initialiser(path, item.name, item.value)
            if is_attached:
                yield from _twins(project, path, declaration)


def _stored(project: Project, path: str, declaration: Declaration, item: Field, holds: bool,
            drawn: set[str]) -> Iterator[Violation]:
    asking = [attribute for attribute in item.attributes if attribute.name in drawn]
    if not asking:
        return
    asked = item.has("SerializeField") or item.has("SerializeField", "field")
    name = f"{declaration.name}.{item.name}"
    reason = None
    if asked and not holds:
        reason = f"{declaration.name} is neither a behaviour nor [Serializable]"
    elif item.is_property and not item.has("SerializeField", "field"):
        reason = "a property is not stored; its field is with [field: SerializeField]"
    elif item.is_property and not (item.is_auto and item.is_settable):
        reason = "a property without 'get;' and 'set;' has no field that could be stored"
    elif {"static", "const", "readonly"} & item.modifiers:
        reason = f"{' '.join(sorted({'static', 'const', 'readonly'} & item.modifiers))} fields are not stored"
    elif item.has("NonSerialized"):
        reason = "it is [NonSerialized] as well"
    elif not is_stored(item):
        reason = f"[{asking[0].name}] on a field that is neither public nor [SerializeField]"
    else:
        reason = _refusal(project, item)
    if reason is not None and (asked or holds):
        yield Violation(path, item.line, "field-stored", f"{name} is left out by Unity without a word: {reason}")
        return
    for attribute in asking:
        kinds = _DRAWS.get(attribute.name)
        if kinds is not None and element(item.type) not in kinds:
            yield Violation(path, item.line, "field-attribute", f"{name}: [{attribute.name}] cannot draw a {item.type}")
        if attribute.name == "Range":
            limits = numbers(attribute.arguments)
            if len(limits) == 2 and limits[0] >= limits[1]:
                yield Violation(path, item.line, "field-attribute", f"{name}: [Range] from {limits[0]} to {limits[1]}")


def numbers(items: list[Token]) -> list[float]:
    """The arguments of an attribute that are plain numbers."""
    found, sign = [], 1.0
    for token in items:
        if token.kind == "number":
            try:
                found.append(sign * float(token.text.rstrip("fFdDmMlL").replace("_", "")))
            except ValueError:
                pass
        sign = -1.0 if token.text == "-" else 1.0
    return found


def _initialiser(path: str, name: str, items: list[Token]) -> Iterator[Violation]:
    position = 0
    while position < len(items):
        token = items[position]
        before = items[position - 1].text if position else ""
        after = items[position + 1].text if position + 1 < len(items) else ""
        if token.text in ("=>", "delegate"):
            return  # what runs later may ask anything
        if token.text in ("nameof", "typeof") and after == "(":
            position = closing(items, position + 1)
        elif before == "new" and token.text in _NATIVE:
            yield Violation(path, token.line, "field-initialiser", f"{name}: new {token.text} belongs into Awake")
        elif (token.text in _STATICS and after == "." and (before != "." or items[position - 2].text in _ENGINE)) or \
                (token.text in _CALLS and after in ("(", "<")):
            yield Violation(path, token.line, "field-initialiser",
                            f"{name}: {token.text} may not be asked before Awake")
        position += 1


def _twins(project: Project, path: str, declaration: Declaration) -> Iterator[Violation]:
    above = [base for base in chain(project, declaration)][1:]
    for item in declaration.fields:
        if is_stored(item) and any(is_stored(other) and other.name == item.name
                                   for base in above for other in base.fields):
            yield Violation(path, item.line, "field-stored",
                            f"{declaration.name}.{item.name} is stored by a base class, too; Unity refuses both")

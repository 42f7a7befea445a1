"""MonoBehaviours: named like their file, attachable, with messages that Unity calls and fields that it can store."""

from __future__ import annotations

import functools
from dataclasses import dataclass, field
from typing import Iterator

from unitycheck.asmdefs import load, owner
from unitycheck.csharp import Token, closing, tokens
from unitycheck.project import Project
from unitycheck.violation import Violation

BASES = {"MonoBehaviour", "ScriptableObject"}
MESSAGES = {
    "Awake", "Start", "Update", "FixedUpdate", "LateUpdate", "OnEnable", "OnDisable", "OnDestroy", "OnGUI",
    "OnValidate", "Reset", "OnDrawGizmos", "OnDrawGizmosSelected", "OnApplicationQuit", "OnApplicationPause",
    "OnApplicationFocus", "OnRenderObject", "OnPreRender", "OnPostRender", "OnPreCull", "OnRenderImage",
    "OnWillRenderObject", "OnBecameVisible", "OnBecameInvisible", "OnMouseDown", "OnMouseUp",
    "OnMouseDrag", "OnMouseEnter", "OnMouseExit", "OnMouseOver", "OnMouseUpAsButton",
    "OnCollisionEnter", "OnCollisionStay", "OnCollisionExit", "OnTriggerEnter", "OnTriggerStay", "OnTriggerExit",
    "OnTransformChildrenChanged", "OnTransformParentChanged",
}
_MODIFIERS = {"public", "private", "protected", "internal", "static", "readonly", "const", "new", "virtual", "override",
              "abstract", "sealed", "async", "extern", "unsafe", "volatile", "partial"}
# A method with one of these may be called from elsewhere.
_REACHABLE = {"public", "internal", "protected", "override", "static"}


@dataclass
class Field:
    """A field that Unity stores. type: its C# type as written, without blanks."""

    name: str
    type: str
    line: int


@dataclass
class Script:
    """A class in a file, as far as Unity looks at it."""

    name: str
    line: int
    bases: list[str]
    modifiers: set[str]
    is_generic: bool
    is_nested: bool
    fields: list[Field] = field(default_factory=list)
    methods: list[tuple[str, int, set[str], str]] = field(default_factory=list)  # name, line, modifiers, return type


def _modifiers(items: list[Token], i: int) -> set[str]:
    found = set()
    while i >= 0 and items[i].text in _MODIFIERS:
        found.add(items[i].text)
        i -= 1
    return found


@functools.lru_cache(maxsize=2048)
def classes(source: str) -> list[Script]:
    """The classes of one file with their serialized fields and their methods."""
    items = tokens(source)
    found = []
    outer_end = -1
    for i, token in enumerate(items):
        is_class = token.text == "class" and i + 1 < len(items) and items[i + 1].kind == "word"
        if not is_class or items[i - 1].text in (":", ","):
            continue
        start = i + 2
        while start < len(items) and items[start].text != "{":
            start += 1
        if start >= len(items):
            continue
        header = [item.text for item in items[i + 2:start]]
        bases = [text for text in (header[header.index(":") + 1:] if ":" in header else []) if text not in (",", ".")]
        script = Script(items[i + 1].text, token.line, bases, _modifiers(items, i - 1), header[:1] == ["<"],
                        i < outer_end)
        end = closing(items, start)
        outer_end = max(outer_end, end)
        _members(items, start + 1, end, script)
        found.append(script)
    return found


def _members(items: list[Token], start: int, end: int, script: Script) -> None:
    attributes: list[str] = []
    member: list[Token] = []
    position = start
    while position < end:
        token = items[position]
        if token.text == "[" and not member:
            stop = closing(items, position)
            attributes += [item.text for item in items[position:stop + 1]]
            position = stop + 1
            continue
        if token.text == "(" and member and member[-1].kind == "word" and not _has_initialiser(member):
            words = [item.text for item in member]
            kept = [word for word in words[:-1] if word not in _MODIFIERS]
            script.methods.append((member[-1].text, member[-1].line, set(words) & _MODIFIERS, "".join(kept)))
            position = closing(items, position) + 1
            while position < end and items[position].text not in ("{", ";", "=>"):
                position += 1
            if position < end and items[position].text == "{":
                position = closing(items, position)
            else:
                while position < end and items[position].text != ";":
                    position = closing(items, position) if items[position].text in ("{", "(") else position
                    position += 1
            attributes, member = [], []
        elif token.text == "{" and not _has_initialiser(member):
            if "field" in attributes and "SerializeField" in attributes and member:
                script.fields.append(Field(f"<{member[-1].text}>k__BackingField", _type(member[:-1]), member[-1].line))
            position = closing(items, position)
            if position + 1 < end and items[position + 1].text == "=":
                while items[position].text != ";":
                    position += 1
            attributes, member = [], []
        elif token.text in ("{", "(", "["):
            stop = closing(items, position)
            if token.text == "[" and not _has_initialiser(member):
                member += items[position:stop + 1]
            position = stop
        elif token.text in (";", ","):
            if token.text == "," and _depth(member) > 0:
                member.append(token)
            else:
                _field(member, attributes, script)
                kept = member if token.text == "," else []
                words = [item.text for item in kept]
                head = words.index("=") - 1 if "=" in words else len(words) - 1
                member = kept[:max(head, 0)]
                attributes = attributes if token.text == "," else []
        else:
            member.append(token)
        position += 1


def _depth(member: list[Token]) -> int:
    return sum((item.text == "<") - (item.text == ">") for item in member)


def _has_initialiser(member: list[Token]) -> bool:
    return any(item.text in ("=", "=>") for item in member)


def _type(member: list[Token]) -> str:
    return "".join(item.text for item in member if item.text not in _MODIFIERS)


def _field(member: list[Token], attributes: list[str], script: Script) -> None:
    words = [item.text for item in member]
    if "=>" in words or len(words) < 2 or {"event", "class", "struct", "enum", "delegate"} & set(words):
        return
    declared = member[:words.index("=")] if "=" in words else member
    modifiers = {item.text for item in declared} & _MODIFIERS
    stored = ("public" in modifiers and "NonSerialized" not in attributes) or "SerializeField" in attributes
    if stored and not {"static", "const", "readonly"} & modifiers and len(declared) >= 2:
        script.fields.append(Field(declared[-1].text, _type(declared[:-1]), declared[-1].line))


def behaviours(project: Project) -> dict[str, list[Script]]:
    """The MonoBehaviours of each file, those included whose base is another MonoBehaviour of the project."""
    files = {path: classes(project.text(path)) for path in project.assets(".cs")}
    known = set(BASES)
    while True:
        more = {script.name for scripts in files.values() for script in scripts if set(script.bases) & known} - known
        if not more:
            break
        known |= more
    return {path: [script for script in scripts if set(script.bases) & known] for path, scripts in files.items()}


def check(project: Project) -> Iterator[Violation]:
    """Rules script-name, script-form, script-message."""
    asmdefs, _ = load(project)
    for path, scripts in behaviours(project).items():
        stem = path.rpartition("/")[2][:-len(".cs")]
        if scripts and stem not in {script.name for script in scripts} and "/Tests/" not in path:
            yield Violation(path, scripts[0].line, "script-name",
                            f"class {scripts[0].name} must be called like its file")
        words = [token.text for token in tokens(project.text(path))]
        assembly = owner(asmdefs, path)
        for script in scripts:
            if script.name == stem and not script.is_nested:
                if "public" not in script.modifiers or {"abstract", "static"} & script.modifiers or script.is_generic:
                    yield Violation(path, script.line, "script-form",
                                    f"{script.name} must be public, not abstract, not generic to go on an object")
                if assembly is not None and assembly.is_editor_only and "MonoBehaviour" in script.bases:
                    yield Violation(path, script.line, "script-form",
                                    f"{script.name} stands in an editor-only assembly")
            for name, line, modifiers, returns in script.methods:
                yield from _message(path, script, name, line, modifiers, returns, words)


def _message(path: str, script: Script, name: str, line: int, modifiers: set[str], returns: str,
             words: list[str]) -> Iterator[Violation]:
    by_case = {message.lower(): message for message in MESSAGES}
    right = by_case.get(name.lower())
    if right and right != name:
        yield Violation(path, line, "script-message", f"{name}: Unity's message is called {right}")
    elif name in MESSAGES and ("static" in modifiers or returns not in ("void", "IEnumerator")):
        yield Violation(path, line, "script-message", f"{name} must be an instance method that returns void")
    elif name not in MESSAGES and returns == "void" and not _REACHABLE & modifiers and words.count(name) == 1:
        yield Violation(path, line, "script-message", f"{name} is no message of Unity's and nobody calls it")

"""C# declarations as a token scan sees them: types with their attributes, fields, properties and methods."""

from __future__ import annotations

import functools
from dataclasses import dataclass, field
from typing import Iterator

from unitycheck.csharp import Token, closing, tokens

MODIFIERS = {"public", "private", "protected", "internal", "static", "readonly", "const", "new", "virtual", "override",
             "abstract", "sealed", "async", "extern", "unsafe", "volatile", "partial", "ref"}
_KINDS = {"class", "struct", "interface", "enum", "record"}


@dataclass
class Attribute:
    """One attribute. name: without namespace and the ending Attribute; target: what stands before its colon."""

    name: str
    target: str
    line: int
    arguments: list[Token] = field(default_factory=list)


@dataclass
class Field:
    """A field or property. type: as written, without blanks; value: the tokens of its initialiser."""

    name: str
    type: str
    line: int
    modifiers: set[str]
    attributes: list[Attribute]
    value: list[Token] = field(default_factory=list)
    is_property: bool = False
    is_auto: bool = False
    is_settable: bool = True

    def has(self, name: str, target: str = "") -> bool:
        """Whether an attribute of this name, for this target, stands on it."""
        return any(attribute.name == name and attribute.target == target for attribute in self.attributes)


@dataclass
class Method:
    """A method or constructor (returns: empty). parameters: their types as written, without blanks."""

    name: str
    line: int
    modifiers: set[str]
    returns: str
    parameters: list[str]
    attributes: list[Attribute]
    body: list[Token]
    is_generic: bool

    def attribute(self, name: str) -> Attribute | None:
        """The first attribute of this name."""
        return next((attribute for attribute in self.attributes if attribute.name == name), None)


@dataclass
class Declaration:
    """A type. kind: class, struct, interface, enum or record; outer: the types around it; values: an enum's numbers."""

    kind: str
    name: str
    namespace: str
    line: int
    bases: list[str]
    modifiers: set[str]
    attributes: list[Attribute]
    is_generic: bool
    outer: tuple[str, ...] = ()
    fields: list[Field] = field(default_factory=list)
    methods: list[Method] = field(default_factory=list)
    values: set[int] = field(default_factory=set)

    def has(self, name: str) -> bool:
        """Whether an attribute of this name stands on it."""
        return any(attribute.name == name for attribute in self.attributes)


@functools.lru_cache(maxsize=4096)
def declarations(source: str) -> list[Declaration]:
    """Every type of one file, nested ones behind their outer one."""
    items = tokens(source)
    found: list[Declaration] = []
    _Reader(items, found).read(0, len(items), "", None)
    return found


@functools.lru_cache(maxsize=4096)
def usings(source: str) -> list[tuple[int, str]]:
    """(line, namespace) of every using directive, those of aliases and static members included."""
    items = tokens(source)
    found = []
    for i, token in enumerate(items):
        if token.text != "using" or (i and items[i - 1].text not in (";", "{", "}", "global", "]")):
            continue
        words, position = [], i + 1
        while position < len(items) and (items[position].kind == "word" or items[position].text in (".", "=", "::")):
            words.append(items[position].text)
            position += 1
        if position < len(items) and items[position].text == ";" and "var" not in words:
            path = "".join(word for word in words if word != "static").rpartition("=")[2]
            found.append((token.line, path))
    return found


def split(items: list[Token], separator: str = ",") -> list[list[Token]]:
    """The parts between separators that stand in no bracket and no type argument list."""
    parts: list[list[Token]] = [[]]
    depth = position = 0
    while position < len(items):
        token = items[position]
        if token.text in ("(", "[", "{"):
            end = closing(items, position)
            parts[-1] += items[position:end + 1]
            position = end + 1
            continue
        depth += (token.text == "<") - (token.text == ">")
        if token.text == separator and depth <= 0:
            parts.append([])
        else:
            parts[-1].append(token)
        position += 1
    return [part for part in parts if part]


def _text(items: list[Token]) -> str:
    return "".join(item.text for item in items)


def _attributes(items: list[Token]) -> list[Attribute]:
    """The attributes between one pair of square brackets, which are not part of items."""
    target = ""
    if len(items) > 1 and items[1].text == ":":
        target, items = items[0].text, items[2:]
    found = []
    for part in split(items):
        end = next((i for i, token in enumerate(part) if token.text == "("), len(part))
        words = [token for token in part[:end] if token.kind == "word"]
        if words:
            name = words[-1].text
            short = name[:-len("Attribute")] if name.endswith("Attribute") and name != "Attribute" else name
            found.append(Attribute(short, target, words[-1].line, part[end + 1:-1]))
    return found


class _Reader:
    def __init__(self, items: list[Token], found: list[Declaration]) -> None:
        self._items = items
        self._found = found

    def read(self, start: int, end: int, namespace: str, owner: Declaration | None) -> None:
        """The members between two places: of a file, a namespace or the type `owner`."""
        items, position = self._items, start
        attributes: list[Attribute] = []
        while position < end:
            if items[position].text == "[":
                stop = closing(items, position)
                attributes += _attributes(items[position + 1:stop])
                position = stop + 1
                continue
            stop = self._head_end(position, end)
            head = items[position:stop]
            if stop >= end:
                return
            words = [token.text for token in head]
            place = next((i for i, word in enumerate(words) if word in _KINDS and i + 1 < len(words)
                          and head[i + 1].kind == "word" and "(" not in words[:i]), -1)
            if "namespace" in words:
                inner = _text(head[words.index("namespace") + 1:])
                if items[stop].text == "{":
                    stop = closing(items, stop)
                    self.read(self._after(position, "{"), stop, f"{namespace}.{inner}".lstrip("."), None)
                else:
                    namespace = inner
                position = stop + 1
            elif words[:1] == ["using"] or not head or "delegate" in words:
                position = self._statement_end(stop, end) + 1
            elif place >= 0:
                position = self._type(head, place, stop, namespace, owner, attributes)
            elif owner is not None:
                position = self._member(head, stop, end, owner, attributes)
            else:
                position = (closing(items, stop) if items[stop].text == "{" else stop) + 1
            attributes = []

    def _after(self, position: int, mark: str) -> int:
        while self._items[position].text != mark:
            position += 1
        return position + 1

    def _head_end(self, position: int, end: int) -> int:
        items = self._items
        while position < end and items[position].text not in (";", "{", "=>", "="):
            if items[position].text in ("(", "["):
                position = closing(items, position)
            position += 1
            if position < end and items[position].text == "=" and items[position - 1].text == "operator":
                position += 1
        return position

    def _statement_end(self, position: int, end: int) -> int:
        items = self._items
        while position < end and items[position].text != ";":
            if items[position].text in ("(", "[", "{"):
                position = closing(items, position)
            position += 1
        return position

    def _type(self, head: list[Token], place: int, stop: int, namespace: str, owner: Declaration | None,
              attributes: list[Attribute]) -> int:
        kind, name = head[place].text, head[place + 1]
        rest = [token.text for token in head[place + 2:]]
        bases: list[str] = []
        if ":" in rest:
            listed = head[place + 2 + rest.index(":") + 1:]
            words = [token.text for token in listed]
            listed = listed[:words.index("where")] if "where" in words else listed
            bases = [_text(part).partition("<")[0].rpartition(".")[2] for part in split(listed)]
        outer = (*owner.outer, owner.name) if owner else ()
        declaration = Declaration(kind, name.text, namespace, name.line, bases,
                                  {token.text for token in head[:place]} & MODIFIERS, attributes, rest[:1] == ["<"],
                                  outer)
        self._found.append(declaration)
        if self._items[stop].text != "{":
            return stop + 1
        end = closing(self._items, stop)
        if kind == "enum":
            declaration.values |= set(_enum_values(self._items[stop + 1:end]))
        else:
            self.read(stop + 1, end, namespace, declaration)
        return end + 1

    def _member(self, head: list[Token], stop: int, end: int, owner: Declaration, attributes: list[Attribute]) -> int:
        items = self._items
        words = [token.text for token in head]
        modifiers = {word for word in words if word in MODIFIERS}
        call = next((i for i, token in enumerate(head) if token.text == "(" and i
                     and (head[i - 1].kind == "word" or head[i - 1].text == ">")
                     and head[i - 1].text not in MODIFIERS), -1)
        if "operator" in words:
            return (closing(items, stop) if items[stop].text == "{" else self._statement_end(stop, end)) + 1
        if call > 0 and items[stop].text != "=":
            return self._method(head, call, stop, end, owner, attributes)
        if items[stop].text in ("{", "=>") and head:
            name = head[-1]
            is_auto = is_settable = False
            body_end = stop
            value: list[Token] = []
            if items[stop].text == "{":
                body_end = closing(items, stop)
                is_auto = any(items[k].text == "get" and items[k + 1].text == ";" for k in range(stop, body_end))
                is_settable = any(items[k].text == "set" for k in range(stop, body_end))
                if body_end + 1 < end and items[body_end + 1].text == "=":
                    last = self._statement_end(body_end, end)
                    value, body_end = items[body_end + 2:last], last
            else:
                body_end = self._statement_end(stop, end)
            kept = [token for token in head[:-1] if token.text not in MODIFIERS]
            owner.fields.append(Field(name.text, _text(kept), name.line, modifiers, attributes, value, True, is_auto,
                                      is_settable))
            return body_end + 1
        last = self._statement_end(stop, end)
        if "event" not in words:
            self._fields(head, items[stop:last], modifiers, owner, attributes)
        return last + 1

    def _fields(self, head: list[Token], rest: list[Token], modifiers: set[str], owner: Declaration,
                attributes: list[Attribute]) -> None:
        declarators = split([token for token in head if token.text not in MODIFIERS] + rest)
        kept = declarators[0] if declarators else []
        type_end = next((i for i, token in enumerate(kept) if token.text == "="), len(kept)) - 1
        if type_end < 1:
            return
        kind = _text(kept[:type_end])
        for declarator in [kept[type_end:], *declarators[1:]]:
            if declarator[0].kind == "word":
                value = declarator[2:] if len(declarator) > 1 and declarator[1].text == "=" else []
                owner.fields.append(Field(declarator[0].text, kind, declarator[0].line, modifiers, attributes, value))

    def _method(self, head: list[Token], call: int, stop: int, end: int, owner: Declaration,
                attributes: list[Attribute]) -> int:
        items = self._items
        opening = call - 1
        is_generic = head[opening].text == ">"
        while is_generic and opening > 0 and head[opening].text != "<":
            opening -= 1
        name = head[opening - 1] if is_generic else head[opening]
        before = head[:opening - 1] if is_generic else head[:opening]
        returns = _text([token for token in before if token.text not in MODIFIERS])
        listed = split(head[call + 1:closing(head, call)])
        parameters = [_parameter_type(part) for part in listed]
        if items[stop].text == "{":
            last = closing(items, stop)
        else:
            last = self._statement_end(stop, end)
        owner.methods.append(Method(name.text, name.line, {token.text for token in before} & MODIFIERS, returns,
                                    parameters, attributes, items[stop:last + 1], is_generic))
        return last + 1


def _parameter_type(part: list[Token]) -> str:
    words = [token.text for token in part]
    part = part[:words.index("=")] if "=" in words else part
    while part and part[0].text == "[":
        part = part[closing(part, 0) + 1:]
    return _text([token for token in part[:-1] if token.text not in ("in", "ref", "out", "params", "this")])


def _enum_values(items: list[Token]) -> Iterator[int]:
    value = -1
    for part in split(items):
        words = [token.text for token in part]
        number = "".join(words[words.index("=") + 1:]) if "=" in words else ""
        try:
            value = int(number, 0) if number else value + 1
        except ValueError:
            value += 1  # an expression: its value is the compiler's
        yield value

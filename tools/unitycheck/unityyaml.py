"""Unity's YAML: documents of one object each, blocks of keys, lists at their key's indent, small maps in braces."""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass
from typing import Any

DOCUMENT = re.compile(r"^--- !u!(\d{1,10}) &(-?\d{1,20})( stripped)?$")
_DEEPEST = 40  # nested blocks or braces


class FormError(ValueError):
    """Text that Unity's reader would not take. line: 1-based."""

    def __init__(self, line: int, message: str) -> None:
        super().__init__(message)
        self.line = line


@dataclass
class Document:
    """One object. class_id: Unity's class number; file_id: its number in the file; line: of its header.

    type: the name above its keys; data: nested dicts, lists and strings; is_stripped: it stands for an object within a
    prefab's instance, and the prefab holds its keys.
    """

    class_id: int
    file_id: int
    line: int
    type: str
    data: dict[str, Any]
    is_stripped: bool = False


def flow(text: str, line: int) -> Any:
    """Return a value after a key: a string, or the map or list that braces or brackets hold."""
    if text[:1] not in ("{", "["):
        return text
    value, end = _flow(text, 0, line, 0)
    if text[end:].strip():
        raise FormError(line, f"'{text[end:].strip()}' stands behind the closing bracket")
    return value


def _flow(text: str, start: int, line: int, depth: int) -> tuple[Any, int]:
    if depth > _DEEPEST:
        raise FormError(line, "nested too deep")
    is_map = text[start] == "{"
    closer = "}" if is_map else "]"
    result: Any = {} if is_map else []
    position = start + 1
    while True:
        while position < len(text) and text[position] in " ,":
            position += 1
        if position >= len(text):
            raise FormError(line, f"'{closer}' is missing")
        if text[position] == closer:
            return result, position + 1
        if is_map:
            colon = text.find(":", position)
            if colon < 0:
                raise FormError(line, "a key without ':' in braces")
            key = text[position:colon].strip()
            position = colon + 1
            while position < len(text) and text[position] == " ":
                position += 1
        if position < len(text) and text[position] in "{[":
            value, position = _flow(text, position, line, depth + 1)
        else:
            stop = position
            while stop < len(text) and text[stop] not in ",}]":
                stop += 1
            value, position = text[position:stop].strip(), stop
        if is_map:
            result[key] = value
        else:
            result.append(value)


@functools.lru_cache(maxsize=512)
def parse(text: str) -> list[Document]:
    """Return all documents of a file; FormError where a line is of no known form."""
    documents = []
    lines = text.split("\n")
    starts = [i for i, line in enumerate(lines) if line.startswith("---")]
    for start, end in zip(starts, starts[1:] + [len(lines)]):
        match = DOCUMENT.match(lines[start])
        if not match:
            raise FormError(start + 1, f"'{lines[start]}' is not of the form '--- !u!CLASS &ID'")
        body = [(i + 1, line) for i, line in enumerate(lines[start + 1:end], start + 1) if line.strip()]
        for number, line in body:
            if line.lstrip().startswith("#"):
                raise FormError(number, "Unity's reader knows no comments")
        if not body or not re.match(r"^\w+:$", body[0][1]):
            raise FormError(start + 2, "the object's type name and ':' must follow its header")
        data, rest = _block(body, 1, 2)
        if rest != len(body):
            raise FormError(body[rest][0], "indented less than its object")
        documents.append(Document(int(match.group(1)), int(match.group(2)), start + 1, body[0][1][:-1], data,
                                  match.group(3) is not None))
    return documents


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip(" "))


def _block(body: list[tuple[int, str]], start: int, indent: int) -> tuple[dict[str, Any], int]:
    result: dict[str, Any] = {}
    position = start
    if indent > 2 * _DEEPEST:
        raise FormError(body[start][0], "nested too deep")
    while position < len(body):
        number, line = body[position]
        depth = _indent(line)
        if depth < indent or line.lstrip().startswith("- "):
            break
        if depth > indent:
            raise FormError(number, f"indented by {depth}, expected {indent}")
        match = re.match(r"^ *([^:{}\[\]]+):(?: (.*))?$", line)
        if not match:
            raise FormError(number, f"'{line.strip()}' is not of the form 'key: value'")
        key, value = match.group(1), (match.group(2) or "").rstrip()
        if key in result:
            raise FormError(number, f"key '{key}' stands twice")
        position += 1
        if value:
            # Unity breaks long texts: what is indented deeper behind a value goes on with it.
            while position < len(body) and _indent(body[position][1]) > indent:
                value += " " + body[position][1].strip()
                position += 1
            result[key] = flow(value, number)
            continue
        following = body[position][1] if position < len(body) else ""
        if following.lstrip().startswith("- ") and _indent(following) in (indent, indent + 2):
            result[key], position = _list(body, position, _indent(following))
        elif following and _indent(following) > indent:
            result[key], position = _block(body, position, indent + 2)
        else:
            result[key] = ""
    return result, position


def _list(body: list[tuple[int, str]], start: int, indent: int) -> tuple[list[Any], int]:
    result: list[Any] = []
    position = start
    while position < len(body):
        number, line = body[position]
        if _indent(line) != indent or not line.lstrip().startswith("- "):
            break
        item = line.lstrip()[2:]
        if item.startswith(("{", "[")) or not re.match(r"^[^:{}\[\]]+:(?: |$)", item):
            result.append(flow(item, number))
            position += 1
            continue
        rest = [(number, " " * (indent + 2) + item)] + body[position + 1:]
        value, used = _block(rest, 0, indent + 2)
        result.append(value)
        position += used
    return result, position

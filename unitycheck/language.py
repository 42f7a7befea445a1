"""Language level: what C# 9 lacks, or what Unity's C# 9 does not support, found token by token.

A token scan sees form, not meaning. Covariant returns or method groups without a target type are left to the compiler,
which builds every file here as C# 9 as well.
"""

from __future__ import annotations

import functools
from typing import Iterator

from unitycheck.csharp import Token, closing, tokens
from unitycheck.project import Project
from unitycheck.violation import Violation

_START = {"{", "}", ";", "]"}
_MODIFIERS = {"public", "private", "protected", "internal", "static", "sealed", "abstract", "virtual", "override",
              "partial", "readonly", "unsafe", "new", "extern", "ref", "const", "async", "required", "file"}
_TYPES = {"class", "struct", "interface", "enum", "record", "delegate"}
_BUILTIN = {"bool", "byte", "char", "decimal", "double", "float", "int", "long", "object", "sbyte", "short", "string",
            "uint", "ulong", "ushort", "void"}
# Words after which a name is no declaration.
_NO_TYPES = {"return", "in", "is", "and", "or", "not", "throw", "await", "new", "else", "get", "set"}
_AFTER_COLLECTION = {")", ",", ".", ";", "}", "?.", "==", "!=", "]", ":"}

# feature: the version of C# that brought it
_VERSION = {
    "file-scoped namespace": "10", "global using": "10", "record struct": "10", "record class": "10",
    "constant interpolated string": "10", "extended property pattern": "10", "struct initialiser": "10",
    "lambda without target type": "10", "lambda return type": "10", "lambda attribute": "10", "with on a value": "10",
    "required member": "11", "raw string": "11", "list pattern": "11", "static abstract member": "11",
    "file-local type": "11", "generic attribute": "11", "UTF-8 literal": "11", "checked operator": "11",
    "ref field": "11", "scoped": "11", "unsigned shift": "11",
    "collection expression": "12", "primary constructor": "12", "alias of any type": "12",
    "ref readonly parameter": "12", "lambda default": "12",
    "params collection": "13", "allows ref struct": "13",
    "field keyword": "14", "extension block": "14", "null-conditional assignment": "14",
}


class _Scan:
    """The tokens of one file with neighbours that never fail."""

    def __init__(self, items: list[Token]) -> None:
        self.items = items
        self.declares_field = any(
            self.text(i) == "field" and self.is_name(i - 1) and self.text(i - 1) not in _NO_TYPES
            and self.text(i + 1) in (";", "=", ",", ")", "in") for i in range(len(items)))

    def text(self, index: int) -> str:
        return self.items[index].text if 0 <= index < len(self.items) else ""

    def kind(self, index: int) -> str:
        return self.items[index].kind if 0 <= index < len(self.items) else ""

    def is_name(self, index: int) -> bool:
        return self.kind(index) == "word"

    def after_generic(self, index: int) -> int:
        """Index behind a type parameter list that starts at index, or index itself."""
        if self.text(index) != "<":
            return index
        depth = 0
        for position in range(index, min(index + 60, len(self.items))):
            depth += (self.text(position) == "<") - (self.text(position) == ">")
            if depth == 0:
                return position + 1
            if self.text(position) in (";", "{", "}"):
                break
        return index


def _types(scan: _Scan, i: int) -> Iterator[str]:
    text, before, after = scan.text(i), scan.text(i - 1), scan.text(i + 1)
    if text == "namespace":
        end = i + 1
        while scan.is_name(end) or scan.text(end) == ".":
            end += 1
        if scan.text(end) == ";":
            yield "file-scoped namespace"
    if text == "global" and after == "using":
        yield "global using"
    if text == "record" and after in ("struct", "class"):
        yield f"record {after}"
    if text in ("class", "struct", "interface") and scan.is_name(i + 1) and before not in (":", ",", "where"):
        if scan.text(scan.after_generic(i + 2)) == "(":
            yield "primary constructor"
    if text == "file" and (after in _TYPES or (after in _MODIFIERS and _TYPES & {scan.text(i + 2), scan.text(i + 3)})):
        yield "file-local type"
    if text == "required" and before in _START | _MODIFIERS and scan.is_name(i + 1):
        yield "required member"
    if text == "using" and scan.is_name(i + 1) and scan.text(i + 2) == "=":
        if scan.text(i + 3) in _BUILTIN | {"(", "unsafe"} or scan.text(i + 5) == "[":
            yield "alias of any type"
    if text == "extension" and before in _START and scan.text(scan.after_generic(i + 1)) == "(":
        yield "extension block"
    if text == "allows" and after == "ref":
        yield "allows ref struct"


def _members(scan: _Scan, i: int) -> Iterator[str]:
    text, before, after = scan.text(i), scan.text(i - 1), scan.text(i + 1)
    if text == "static" and after in ("abstract", "virtual") or text in ("abstract", "virtual") and after == "static":
        yield "static abstract member"
    if text == "operator" and after == "checked":
        yield "checked operator"
    if text == "const" and scan.text(i + 3) == "=" and scan.text(i + 4).startswith(("$", "@$")):
        yield "constant interpolated string"
    if text == "ref" and after == "readonly" and before in ("(", ",", "]"):
        yield "ref readonly parameter"
    if text == "scoped" and (after == "ref" or after in ("in", "out", "Span", "ReadOnlySpan")):
        yield "scoped"
    if text == "params" and scan.is_name(i + 1) and scan.text(i + 2) == "<":
        if scan.text(scan.after_generic(i + 2)) != "[":
            yield "params collection"
    if text == "field" and not scan.declares_field and after != ":" and before not in (".", "?.", "::", "nameof"):
        if before in ("=>", "return", "=", "(", "{", ";", "??", "ref") and \
                after in (";", "=", "??", "??=", ")", ".", "+=", "!"):
            yield "field keyword"
    if text == "[" and before in {"{", "}", ";", "]", "(", ",", ""}:
        end = i + 1
        if scan.text(end + 1) == ":":
            end += 2
        while scan.is_name(end) or scan.text(end) == ".":
            end += 1
        stop = scan.after_generic(end)
        if stop != end and scan.text(stop) in ("]", "(", ",") and \
                scan.text(closing(scan.items, i) + 1) not in _AFTER_COLLECTION:
            yield "generic attribute"
    if text == "class" and scan.text(i + 2) == "<":
        stop = scan.after_generic(i + 2)
        if scan.text(stop) == ":" and scan.text(stop + 1).endswith("Attribute"):
            yield "generic attribute"


def _expressions(scan: _Scan, i: int) -> Iterator[str]:
    text, before, after = scan.text(i), scan.text(i - 1), scan.text(i + 1)
    if scan.kind(i) == "text":
        if text.count('"') >= 3 and "@" not in text:
            yield "raw string"
        if after in ("u8", "U8"):
            yield "UTF-8 literal"
    if text == "with" and after == "{" and before not in (".",):
        yield "with on a value"
    if text == "[":
        if before in ("is", "case", "or", "and", "not") or (before == "{" and scan.text(i - 2) == "switch"):
            yield "list pattern"
        elif before in ("=", "return", "=>", "??", "??=", "+=") or \
                (before == "?" and scan.text(closing(scan.items, i) + 1) == ":") or \
                (before in ("(", ",", ":", "[") and scan.text(closing(scan.items, i) + 1) in _AFTER_COLLECTION
                 and not (before == "," and _in_rank(scan, i))):
            yield "collection expression"
    if text == "." and scan.is_name(i - 1) and scan.text(i - 2) in ("{", ",") and scan.is_name(i + 1) and \
            scan.text(i + 2) == ":":
        yield "extended property pattern"
    if text == ">" and scan.text(i + 1) == ">" and scan.text(i + 2) == ">" and scan.kind(i + 3) in ("number", "word") \
            and (scan.kind(i - 1) == "number" or before == ")" or
                 (scan.is_name(i - 1) and not _opens_generic(scan, i))):
        yield "unsigned shift"
    if text == ">>>=":
        yield "unsigned shift"
    if text == "?." and scan.is_name(i + 1) and scan.text(i + 2) in ("=", "+=", "-=", "*=", "/="):
        yield "null-conditional assignment"


def _opens_generic(scan: _Scan, i: int) -> bool:
    """True if three type argument lists are open at index i."""
    depth, position = 0, i - 1
    while position >= 0 and scan.text(position) not in (";", "{", "}", "=", "(", ")"):
        depth += (scan.text(position) == "<") - (scan.text(position) == ">")
        position -= 1
    return depth >= 3


def _in_rank(scan: _Scan, i: int) -> bool:
    """True if the comma before index i stands in an array rank such as [,]."""
    return scan.text(i - 2) in ("[", ",")


def _lambdas(scan: _Scan, i: int) -> Iterator[str]:
    if scan.text(i) == "var" and scan.is_name(i + 1) and scan.text(i + 2) == "=":
        start = i + 3
        while scan.text(start) in ("static", "async"):
            start += 1
        if scan.text(start) == "delegate" or (scan.is_name(start) and scan.text(start + 1) == "=>"):
            yield "lambda without target type"
        if scan.text(start) == "(" and scan.text(closing(scan.items, start) + 1) == "=>":
            yield "lambda without target type"
    if scan.text(i) != "(":
        return
    end = closing(scan.items, i)
    if scan.text(end + 1) != "=>":
        return
    if scan.text(i - 1) in _BUILTIN and scan.text(i - 2) in ("=", "(", ",", "return", "=>", "static", "async"):
        if not (scan.text(i - 2) in ("static", "async") and scan.text(i - 3) in _START | _MODIFIERS):
            yield "lambda return type"
    if scan.text(i - 1) in ("=", "(", ",", "return", "=>", "async", "static"):
        if any(scan.text(k) == "=" for k in range(i + 1, end)):
            yield "lambda default"
    if scan.text(i - 1) == "]" and _attribute_opens_expression(scan, i - 1):
        yield "lambda attribute"


def _attribute_opens_expression(scan: _Scan, end: int) -> bool:
    depth = 0
    for position in range(end, -1, -1):
        depth += (scan.text(position) == "]") - (scan.text(position) == "[")
        if depth == 0:
            return scan.text(position - 1) in ("=", "(", ",", "return", "=>")
    return False


def _structs(scan: _Scan, i: int) -> Iterator[tuple[str, int]]:
    """Parameterless constructors, initialisers and ref fields, directly in the struct whose name stands at i + 1."""
    if scan.text(i) != "struct" or not scan.is_name(i + 1) or scan.text(i - 1) in (":", ",", "record"):
        return
    name, start = scan.text(i + 1), i + 2
    while start < len(scan.items) and scan.text(start) not in ("{", ";"):
        start += 1
    if scan.text(start) != "{":
        return
    end, member, position = closing(scan.items, start), start + 1, start + 1
    while position < end:
        text = scan.text(position)
        if text == name and scan.text(position + 1) == "(" and scan.text(position + 2) == ")" and \
                not {"static", "new", "=>", "="} & {scan.text(k) for k in range(member, position)}:
            yield "struct initialiser", position
        if text in ("{", "("):
            position = closing(scan.items, position)
            if text == "{" and scan.text(position + 1) == "=":
                yield "struct initialiser", position
            if text == "{":
                member = position + 1
        elif text == ";":
            words = [scan.text(k) for k in range(member, position)]
            if "=" in words and "=>" not in words and not {"static", "const", "(", "{"} & set(words[:words.index("=")]):
                yield "struct initialiser", member
            if "ref" in words and "(" not in words and "=>" not in words:
                yield "ref field", member
            member = position + 1
        position += 1


@functools.lru_cache(maxsize=2048)
def scan(source: str) -> list[tuple[int, str]]:
    """(line, feature) for every feature beyond Unity's C# 9 in one file's source."""
    view = _Scan(tokens(source))
    found = []
    for i, token in enumerate(view.items):
        for family in (_types, _members, _expressions, _lambdas):
            found += [(token.line, feature) for feature in family(view, i)]
        found += [(view.items[place].line, feature) for feature, place in _structs(view, i)]
    return sorted(set(found))


@functools.lru_cache(maxsize=4096)
def _init_rules(source: str) -> tuple[tuple[int, str], ...]:
    return tuple(_inits(tokens(source)))


def _inits(items: list[Token]) -> Iterator[tuple[int, str]]:
    for i, token in enumerate(items):
        after = items[i + 1].text if i + 1 < len(items) else ""
        before = items[i - 1].text if i else ""
        if token.text == "init" and after in (";", "{", "=>") and before in _START | _MODIFIERS:
            yield token.line, "init accessor"
        if token.text == "record" and i + 1 < len(items) and items[i + 1].kind == "word" and \
                after not in ("struct", "class") and before in _START | _MODIFIERS:
            yield token.line, "record"


def check(project: Project) -> Iterator[Violation]:
    """Rules language (a feature after C# 9) and init-accessor (init or record without IsExternalInit)."""
    files = project.assets(".cs")
    has_init = any("class IsExternalInit" in project.text(path) for path in files)
    for path in files:
        for line, feature in scan(project.text(path)):
            yield Violation(path, line, "language", f"{feature} is C# {_VERSION[feature]}; Unity compiles C# 9")
        if not has_init:
            for line, feature in _init_rules(project.text(path)):
                yield Violation(path, line, "init-accessor", f"{feature} needs a class IsExternalInit; Unity has none")

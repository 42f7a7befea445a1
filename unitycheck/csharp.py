"""C# source as tokens: comments and the contents of strings gone, branches that Unity never compiles dropped."""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass
from typing import Iterator

_PUNCTUATION = (">>>=", "<<=", ">>=", "??=", "...", "=>", "==", "!=", "<=", ">=", "&&", "||", "??", "?.", "++", "--",
                "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "->", "::", "..", "<<")
_TOKEN = re.compile(
    r"(?P<space>[ \t\r\f\v]+)|(?P<newline>\n)|(?P<line>//[^\n]*)|(?P<block>/\*.*?\*/)"
    r"|(?P<text>[$@]*\"+)|(?P<char>'(?:\\.[^']*|[^'\\\n])')"
    r"|(?P<number>\.?\d(?:[eEpP][+-](?=\d)|[\w]|\.(?=\d))*)|(?P<word>@?[^\W\d]\w*)"
    r"|(?P<mark>" + "|".join(re.escape(mark) for mark in _PUNCTUATION) + r"|[^\w\s])", re.DOTALL)

# Symbols that Unity never defines: what stands under them is compiled by .NET only.
_NEVER = re.compile(r"^(NET\d\w*|NETCOREAPP\w*|NETFRAMEWORK)$")


@dataclass(frozen=True)
class Token:
    """One token. kind: word, number, char, text or mark.

    A text token's `text` is its opening quote with prefixes, and `value` what stands between the quotes, as written.
    """

    kind: str
    text: str
    line: int
    value: str = ""


def _truth(condition: str, is_player: bool) -> bool | None:
    """The value of an #if condition in Unity; None where it depends on the platform."""
    words = re.findall(r"\w+|&&|\|\||[!()=]=?", condition)
    position = 0

    def factor() -> bool | None:
        nonlocal position
        word = words[position] if position < len(words) else ""
        position += 1
        if word == "!":
            value = factor()
            return None if value is None else not value
        if word == "(":
            value = either()
            position += 1
            return value
        if word == "true":
            return True
        return False if word == "false" or _NEVER.match(word) or (is_player and word == "UNITY_EDITOR") else None

    def both() -> bool | None:
        nonlocal position
        value = factor()
        while position < len(words) and words[position] == "&&":
            position += 1
            other = factor()
            value = False if value is False or other is False else (True if value and other else None)
        return value

    def either() -> bool | None:
        nonlocal position
        value = both()
        while position < len(words) and words[position] == "||":
            position += 1
            other = both()
            value = True if value is True or other is True else (None if value is None or other is None else False)
        return value

    return either()


def unity_source(source: str, is_player: bool = False) -> str:
    """The source with directives, and branches that Unity never compiles, replaced by empty lines."""
    kept = []
    stack: list[tuple[bool, bool]] = []  # (this branch may be compiled, a branch before it always is)
    for line in source.split("\n"):
        directive = re.match(r"\s*#\s*(if|elif|else|endif)\b(.*)", line)
        if directive:
            word, condition = directive.groups()
            condition = condition.split("//")[0]
            if word == "if":
                value = _truth(condition, is_player)
                stack.append((value is not False, value is True))
            elif stack and word == "endif":
                stack.pop()
            elif stack:
                done = stack[-1][1]
                value = True if word == "else" else _truth(condition, is_player)
                stack[-1] = (not done and value is not False, done or value is True)
        is_directive = directive or re.match(r"\s*#\s*\w+", line)
        kept.append("" if is_directive or not all(live for live, _ in stack) else line)
    return "\n".join(kept)


def _string_end(source: str, start: int, opening: str) -> tuple[int, list[tuple[int, int]]]:
    """End of the string whose opening stands at start, and the (start, end) of its interpolation holes."""
    quotes = opening.count('"')
    prefix = opening.rstrip('"')
    position = start + len(prefix)
    if quotes >= 3 and "@" not in prefix:
        end = source.find('"' * quotes, position + quotes)
        return (len(source) if end < 0 else end + quotes), []
    verbatim = "@" in prefix
    if quotes % 2 == 0 and not verbatim:
        return position + 2, []
    position += 1
    holes: list[tuple[int, int]] = []
    while position < len(source):
        letter = source[position]
        if verbatim and source.startswith('""', position):
            position += 2
        elif letter == "\\" and not verbatim:
            position += 2
        elif letter == '"' or (letter == "\n" and not verbatim):
            return position + 1, holes
        elif "$" in prefix and source.startswith("{{", position):
            position += 2
        elif "$" in prefix and letter == "{":
            end = _hole_end(source, position + 1)
            holes.append((position + 1, end))
            position = end + 1
        else:
            position += 1
    return position, holes


def _hole_end(source: str, position: int) -> int:
    depth = 0
    while position < len(source):
        letter = source[position]
        if letter in "$@\"":
            opening = re.match(r"[$@]*\"+", source[position:])
            if opening:
                position, _ = _string_end(source, position, opening.group())
                continue
        if letter in "([{":
            depth += 1
        elif letter in ")]}":
            if depth == 0:
                return position
            depth -= 1
        position += 1
    return position


def _scan(source: str, start: int, end: int, line: int) -> Iterator[Token]:
    position = start
    while position < end:
        match = _TOKEN.match(source, position, end)
        if match is None:
            position += 1
            continue
        kind, text = match.lastgroup or "", match.group()
        if kind == "text":
            stop, holes = _string_end(source, position, text)
            if text.count('"') % 2 == 0 and text.count('"') < 3:
                text = text[:-1]
            opening = match.end() - (len(match.group()) - len(text))
            yield Token("text", text, line, source[opening:max(opening, stop - text.count('"'))])
            for hole_start, hole_end in holes:
                hole_line = line + source.count("\n", position, hole_start)
                # A colon outside brackets starts the format, which is no code.
                yield from _scan(source, hole_start, _format_start(source, hole_start, hole_end), hole_line)
            line += source.count("\n", position, stop)
            position = stop
            continue
        if kind not in ("space", "newline", "line", "block"):
            yield Token(kind, text, line)
        line += text.count("\n")
        position = match.end()


def _format_start(source: str, start: int, end: int) -> int:
    depth = 0
    for position in range(start, end):
        letter = source[position]
        depth += (letter in "([{") - (letter in ")]}")
        if letter == ":" and depth == 0 and source[position - 1] != ":" and source[position + 1] != ":":
            return position
    return end


@functools.lru_cache(maxsize=8192)
def tokens(source: str, is_player: bool = False) -> list[Token]:
    """The tokens that Unity's compiler could see, for players only or for editor and players.

    Every rule reads the same list: none may change it.
    """
    source = unity_source(source, is_player)
    return list(_scan(source, 0, len(source), 1))


def closing(items: list[Token], start: int) -> int:
    """Index of the bracket that closes the one at `start`, or the last index."""
    pairs = {"(": ")", "[": "]", "{": "}"}
    opener, closer = items[start].text, pairs[items[start].text]
    depth = 0
    for index in range(start, len(items)):
        depth += (items[index].text == opener) - (items[index].text == closer)
        if depth == 0:
            return index
    return len(items) - 1

"""Triangles of STL and OBJ files, by the same rules as the runner's readers.

STL: binary where its length agrees with its count, with up to 49 bytes behind the last triangle; else text, in small
letters or capitals. OBJ: "v x y z" and "f i j k ..", corners as "i", "i/", "i//", "i/j", "i//k" or "i/j/k", numbers
from
1 or, negative, from the end; a polygon becomes a fan; a backslash continues a line.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator

import numpy as np

from guidewire.anatomy.mesh import AnatomyError, Mesh

_HEADER, _RECORD = 84, 50
_STL_WORDS = frozenset(b"solid facet outer endloop endfacet endsolid end".split())
_OBJ_WORDS = frozenset(
    b"vt vn vp g o s l p mg mtllib usemtl maplib usemap cstype deg bmat step curv curv2 surf parm trim hole scrv "
    b"sp end "
    b"con bevel c_interp d_interp lod shadow_obj trace_obj ctech stech call csh".split())
_MARK = b"\xef\xbb\xbf"  # of a text in UTF-8


def read_stl(data: bytes) -> Mesh:
    """Return three vertices a triangle, not welded.

    Raises
    ------
    AnatomyError : what is wrong, in one phrase.
    """
    count = struct.unpack_from("<I", data, 80)[0] if len(data) >= _HEADER else -1
    behind = len(data) - (_HEADER + _RECORD * count)
    if count >= 0 and behind == 0:
        return _binary_stl(data, count)
    if b"\0" not in data[:1000] and data.removeprefix(_MARK).lstrip()[:5].lower() == b"solid":
        return _text_stl(data)
    if count > 0 and 0 < behind < _RECORD:
        return _binary_stl(data, count)
    raise AnatomyError("is neither text STL (it does not begin with 'solid') nor long enough for binary STL"
                       if count < 0 else f"is not STL, or truncated: as binary STL of {count} triangles it needs "
                       f"{_HEADER + _RECORD * count} bytes and has {len(data)}")


def _binary_stl(data: bytes, count: int) -> Mesh:
    rows = np.frombuffer(data, dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("end", "<u2")], count=count,
                         offset=_HEADER)
    corners = rows["corners"].astype(float)
    bad = np.flatnonzero(~np.isfinite(corners).all(axis=(1, 2)))
    if len(bad):
        raise AnatomyError(f"triangle {bad[0] + 1} of {count} has a coordinate that is not finite")
    return _made(corners.reshape(-1, 3), np.arange(3 * count))


def _text_stl(data: bytes) -> Mesh:
    vertices: list[list[float]] = []
    corners = 0
    for number, words in _lines(data):
        word = words[0].lower()
        if word == b"vertex":
            vertices.append(_vertex(number, words))
            corners += 1
        elif word == b"endfacet" or [one.lower() for one in words[:2]] == [b"end", b"facet"]:
            if corners != 3:
                raise _wrong(number, words, f"three vertices before it, and has {corners}")
            corners = 0
        elif word not in _STL_WORDS:
            raise _wrong(number, words, "an STL word (facet, vertex, ...)")
    if corners:
        raise AnatomyError("ends inside a facet: the file breaks off")
    return _made(np.array(vertices).reshape(-1, 3), np.arange(len(vertices)))


def read_obj(data: bytes) -> Mesh:
    """Read it as the file has it.

    Raises
    ------
    AnatomyError : what is wrong, in one phrase.
    """
    if b"\0" in data[:1000]:
        raise AnatomyError("is not a text file, as OBJ must be")
    vertices: list[list[float]] = []
    triangles: list[int] = []
    for number, words in _lines(data):
        if words[0] == b"v":
            vertices.append(_vertex(number, words))
        elif words[0] == b"f":
            if len(words) < 4:
                raise _wrong(number, words, "at least three vertices behind f")
            corners = [_index(number, words, word, len(vertices)) for word in words[1:]]
            for one, other in zip(corners[1:], corners[2:]):
                triangles += (corners[0], one, other)
        elif words[0] not in _OBJ_WORDS:
            raise _wrong(number, words, "an OBJ word (v, f, ...)")
    return _made(np.array(vertices, dtype=float).reshape(-1, 3), np.array(triangles, dtype=np.int64))


def _index(number: int, words: list[bytes], word: bytes, count: int) -> int:
    text = word.partition(b"/")[0]
    try:
        index = int(text) if text.lstrip(b"+-").isdigit() else 0
    except ValueError:
        index = 0
    if index == 0 or abs(index) > count:
        raise _wrong(number, words, f"vertices from 1 to {count}" if count else "vertices before it")
    return index - 1 if index > 0 else count + index


def _vertex(number: int, words: list[bytes]) -> list[float]:
    try:
        numbers = [float(word) for word in words[1:4] if b"_" not in word]
    except ValueError:
        numbers = []
    if len(numbers) < 3 or not np.isfinite(numbers).all():
        raise _wrong(number, words, f"three finite numbers behind {words[0].decode('ascii', 'replace')}")
    return numbers


def _lines(data: bytes) -> Iterator[tuple[int, list[bytes]]]:
    """Numbers, from 1, and words of the lines that have some; comments left out, continued lines joined."""
    held: list[bytes] = []
    for number, line in enumerate(data.removeprefix(_MARK).split(b"\n"), 1):
        line = line.partition(b"#")[0].rstrip()
        is_continued = line.endswith(b"\\")
        held += (line[:-1] if is_continued else line).split()
        if held and not is_continued:
            yield number, held
            held = []
    if held:
        yield number, held


def _wrong(number: int, words: list[bytes], needed: str) -> AnatomyError:
    line = re.sub(r"[^ -~]", "?", b" ".join(words).decode("utf-8", "replace"))
    return AnatomyError(f"line {number} '{line if len(line) <= 60 else line[:57] + '...'}' needs {needed}")


def _made(vertices: np.ndarray, triangles: np.ndarray) -> Mesh:
    if not len(triangles):
        raise AnatomyError("has no triangles")
    return Mesh(vertices, triangles.reshape(-1, 3).astype(np.int64))

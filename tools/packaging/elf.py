"""The version of the C library that a Linux program needs, read from the file itself (ELF, 64 bits, little-endian).

The layout is that of the System V ABI, and for the versions that of the Linux Standard Base ("Symbol Versioning"): a section
of type SHT_GNU_verneed has an entry for each library, and each a list of the versions that are needed of it.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator
from pathlib import Path

_VERNEED = 0x6FFFFFFE  # type of the section
_SECTION = struct.Struct("<IIQQQQIIQQ")  # name, type, flags, address, offset, size, link, info, alignment, entry size
_NEED = struct.Struct("<HHIII")  # version, count, file, aux, next
_AUX = struct.Struct("<IHHII")  # hash, flags, other, name, next
_GLIBC = re.compile(r"^GLIBC_(\d+)\.(\d+)")


def needed_glibc(file: Path) -> tuple[int, int]:
    """The newest version of glibc whose symbols a program or library needs.

    Raises
    ------
    ValueError : the file is no ELF file of 64 bits, or names no version of glibc.
    """
    found = [(int(match[1]), int(match[2])) for text in _versions(file.read_bytes(), file)
             if (match := _GLIBC.match(text))]
    if not found:
        raise ValueError(f"{file}: names no version of glibc")
    return max(found)


def _versions(data: bytes, file: Path) -> Iterator[str]:
    if data[:6] != b"\x7fELF\x02\x01":
        raise ValueError(f"{file}: no ELF file of 64 bits, little-endian")
    (table,) = struct.unpack_from("<Q", data, 0x28)
    size, count = struct.unpack_from("<HH", data, 0x3A)
    sections = [_SECTION.unpack_from(data, table + k * size) for k in range(count)]
    for _, kind, _, _, offset, _, link, entries, _, _ in sections:
        if kind != _VERNEED:
            continue
        texts = sections[link][4]
        need = offset
        for _ in range(entries):
            _, versions, _, aux, after = _NEED.unpack_from(data, need)
            place = need + aux
            for _ in range(versions):
                _, _, _, name, step = _AUX.unpack_from(data, place)
                yield data[texts + name:data.index(b"\0", texts + name)].decode("ascii")
                place += step
            need += after

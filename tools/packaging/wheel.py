"""The wheel: sources, data, page and programs below `guidewire`, and what pyproject.toml says of them.

The form is that of the Python packaging specifications (binary distribution format, core metadata 2.4). The same inputs give
the same file, bit for bit: places are in order, times are those of the format's beginning.
"""

from __future__ import annotations

import base64
import hashlib
import tempfile
import zipfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from guidewire.installed import RUNNER, version
from guidewire.prepare import ROOT, PreparationError
from guidewire.runs.whole_files import whole_file
from tools.packaging import contents, programs
from tools.packaging.elf import needed_glibc

try:
    import tomllib
except ImportError:  # before Python 3.11
    tomllib = None

MOST = 40e6  # bytes of the file
_START = (1980, 1, 1, 0, 0, 0)  # a zip file knows no time before
_FILE, _PROGRAM = 0o100644 << 16, 0o100755 << 16


def build(out: Path, tell: Callable[[str], None]) -> Path:
    """Build the wheel into a folder and return its path.

    Raises
    ------
    PreparationError : something is missing or does not build, or the file is larger than it may be.
    """
    project = read_project()
    files = {**contents.files(), **contents.page(tell)}
    content = {place: path.read_bytes() for place, path in files.items()}
    with tempfile.TemporaryDirectory(prefix="guidewire-package-") as folder:
        built = programs.build(Path(folder), tell)
        wheel_tag = tag(list(built.values()))
        content.update({place: path.read_bytes() for place, path in built.items()})
    out.mkdir(parents=True, exist_ok=True)
    wheel = out / f"{project['name']}-{version()}-{wheel_tag}.whl"
    members = {contents.place_of(place): data for place, data in content.items()}
    with whole_file(wheel) as partial:
        write(partial, members, information(project, wheel_tag), f"{project['name']}-{version()}")
        if partial.stat().st_size > MOST:
            raise PreparationError(f"{wheel.name} would have {partial.stat().st_size / 1e6:.0f} MB, more than "
                                   f"{MOST / 1e6:.0f}")
    return wheel


def read_project() -> Mapping[str, Any]:
    """What pyproject.toml says. Raises PreparationError where this Python cannot read it."""
    if tomllib is None:
        raise PreparationError("package needs Python 3.11 or newer, for pyproject.toml")
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def tag(binaries: Sequence[Path]) -> str:
    """Any Python 3, without its binary interface, on Linux with the newest glibc that one of the programs needs."""
    major, minor = max(needed_glibc(binary) for binary in binaries)
    return f"py3-none-manylinux_{major}_{minor}_x86_64"


def information(project: Mapping[str, Any], wheel_tag: str) -> dict[str, str]:
    """The files of the folder .dist-info but RECORD, by name."""
    scripts = "".join(f"{name} = {target}\n" for name, target in project["scripts"].items())
    return {
        "METADATA": metadata(project),
        "WHEEL": f"Wheel-Version: 1.0\nGenerator: guidewire {version()}\nRoot-Is-Purelib: false\nTag: {wheel_tag}\n",
        "entry_points.txt": f"[console_scripts]\n{scripts}",
        "top_level.txt": f"{project['name']}\n",
        **{f"licenses/{name}": (ROOT / name).read_text(encoding="utf-8") for name in project["license-files"]},
    }


def metadata(project: Mapping[str, Any]) -> str:
    """METADATA: one header a line, then the description."""
    lines = [
        ("Metadata-Version", "2.4"), ("Name", project["name"]), ("Version", version()),
        ("Summary", project["description"]), ("Requires-Python", project["requires-python"]),
        ("License-Expression", project["license"]), *(("License-File", name) for name in project["license-files"]),
        *(("Author", author["name"]) for author in project["authors"]), ("Keywords", ",".join(project["keywords"])),
        *(("Classifier", text) for text in project["classifiers"]),
        *(("Requires-Dist", text) for text in project["dependencies"]),
    ]
    for extra, needed in project["optional-dependencies"].items():
        lines.append(("Provides-Extra", extra))
        lines += [("Requires-Dist", f'{text}; extra == "{extra}"') for text in needed]
    lines.append(("Description-Content-Type", "text/markdown"))
    description = (ROOT / project["readme"]).read_text(encoding="utf-8")
    return "".join(f"{name}: {value}\n" for name, value in lines) + "\n" + description


def write(file: Path, members: Mapping[str, bytes], information: Mapping[str, str], name: str) -> None:
    """Write a wheel.

    Parameters
    ----------
    members, information : contents by place, and those of the folder .dist-info.
    name : NAME-VERSION.
    """
    folder = f"{name}.dist-info"
    everything = {**members, **{f"{folder}/{place}": text.encode("utf-8") for place, text in information.items()}}
    record = f"{folder}/RECORD"
    lines = [f"{place},sha256={_digest(data)},{len(data)}\n" for place, data in sorted(everything.items())]
    everything[record] = "".join([*lines, f"{record},,\n"]).encode("utf-8")
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for place in sorted(everything, key=lambda place: (place.startswith(folder), place)):
            member = zipfile.ZipInfo(place, _START)
            member.compress_type = zipfile.ZIP_DEFLATED
            member.external_attr = _PROGRAM if place.endswith(f"/{RUNNER}") else _FILE
            archive.writestr(member, everything[place])


def _digest(data: bytes) -> str:
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode("ascii").rstrip("=")

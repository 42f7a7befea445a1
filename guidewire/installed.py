"""Whether this is the repository or the installed package, and the paths in the latter.

In the package `params`, `instruments` and `docs` lie below `guidewire`, and programs are built already; commands that
build, check or draw what only the repository has are refused.
"""

from __future__ import annotations

import functools
import re
import subprocess
from pathlib import Path

from guidewire.prepare import INSTALLED, ROOT, PreparationError

NATIVE = ROOT / "native"  # folder of the programs, in the package
RUNNER = "guidewire-runner"
LIBRARY = {True: "guidewire-x86-64-v3.so", False: "guidewire-x86-64.so"}  # by whether the processor has AVX2
_NUMBER = re.compile(r'Number = "([^"]+)"')
_FLAGS = {"avx2", "bmi1", "bmi2", "f16c", "fma", "movbe", "abm"}  # x86-64-v3, for which the library is compiled
_LOADER = "/lib64/ld-linux-x86-64.so.2"


def version() -> str:
    """Return the program's version."""
    if INSTALLED:
        import importlib.metadata  # a tenth of the start of a command

        return importlib.metadata.version("guidewire")
    text = (ROOT / "Assets" / "Guidewire" / "Core" / "ProgramVersion.cs").read_text(encoding="utf-8")
    return _NUMBER.search(text)[1]


@functools.lru_cache(maxsize=None)
def has_avx2() -> bool:
    """Return whether this processor is of x86-64-v3; a library that was compiled for it would end the process
    elsewhere.

    The loader of glibc 2.33 and newer asks the processor. Some sandboxes leave flags out of /proc/cpuinfo.
    """
    try:
        told = subprocess.run([_LOADER, "--help"], stdin=subprocess.DEVNULL, capture_output=True, check=False).stdout
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return False
    flags = next((line.partition(":")[2].split() for line in text.splitlines() if line.startswith("flags")), [])
    return b"x86-64-v3 (supported" in told or _FLAGS <= set(flags)


def runner() -> list[str]:
    """Return the command that starts the package's runner, which takes the library for this processor."""
    return [str(NATIVE / RUNNER)]


def library() -> Path:
    """Return the package's library for this processor."""
    return NATIVE / LIBRARY[has_avx2()]


def refuse(what: str) -> None:
    """Raises PreparationError in the package: what can be done in the repository only."""
    if INSTALLED:
        raise PreparationError(f"{what} needs the repository: this is the installed package")

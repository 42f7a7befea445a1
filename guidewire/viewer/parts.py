"""npm packages of the page: named and pinned in page/package.json, installed on first use into .npm here."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from guidewire.prepare import INSTALLED, ROOT, PreparationError

try:
    import fcntl
except ImportError:
    fcntl = None

PAGE = Path(__file__).resolve().parent / "page"
THREE = PAGE / "three"  # in the package
CACHE = ROOT / ".npm"
_MODULES = "node_modules"
_SECONDS = 300
# Name under which the page imports a file, and where it stands in the package.
_OF_THREE = {"three.module.js": "build/three.module.js", "three.core.js": "build/three.core.js",
             "OrbitControls.js": "examples/jsm/controls/OrbitControls.js"}


def three(tell: Callable[[str], None]) -> dict[str, Path]:
    """Files of three by the names that the page has for them, installed if they are not there. (The package has them.)

    Raises PreparationError, one line, where they cannot be had.
    """
    if INSTALLED:
        return {name: THREE / name for name in _OF_THREE}
    folder = require("dependencies", tell) / "three"
    return {name: folder / path for name, path in _OF_THREE.items()}


def require(kind: str, tell: Callable[[str], None]) -> Path:
    """Return the folder node_modules with all packages of one kind, "dependencies", "devDependencies" or
    "lintDependencies" of package.json.

    Parameters
    ----------
    kind : which of them.
    tell : called with a line where something is installed.
    """
    wanted: dict[str, str] = json.loads((PAGE / "package.json").read_text(encoding="utf-8"))[kind]
    modules = CACHE / _MODULES
    missing = _missing(modules, wanted)
    if missing and shutil.which("npm") is None:
        raise PreparationError(f"the page needs {', '.join(missing)} from npm, and there is no npm: install Node.js "
                               "(as root 'apt-get install npm') and try again, or elsewhere "
                               f"'{_by_hand(missing)}' and copy {os.path.relpath(CACHE)} here")
    if missing or os.access(CACHE, os.W_OK):    # else nobody installs there
        with _alone():    # what is there may be half there still
            _install(modules, wanted, tell)
    return modules


def _by_hand(missing: list[str]) -> str:
    return f"npm install --prefix {os.path.relpath(CACHE)} {' '.join(missing)}"


@contextmanager
def _alone() -> Iterator[None]:
    """Hold the right to install: npm takes away what another npm is just writing."""
    CACHE.mkdir(exist_ok=True)
    with (CACHE / "lock").open("w") as file:
        if fcntl is not None:
            fcntl.flock(file, fcntl.LOCK_EX)
        yield


def _missing(modules: Path, wanted: dict[str, str]) -> list[str]:
    return [f"{name}@{version}" for name, version in wanted.items() if _version(modules / name) != version]


def _install(modules: Path, wanted: dict[str, str], tell: Callable[[str], None]) -> None:
    """Install what is missing still."""
    missing = _missing(modules, wanted)
    if not missing:    # installed by whom we waited for
        return
    tell(f"installing {', '.join(missing)} into {os.path.relpath(CACHE)} with npm")
    command = [shutil.which("npm"), "install", "--prefix", str(CACHE), "--no-save", "--no-package-lock",
               "--no-audit", "--no-fund", "--ignore-scripts",
               *(f"{name}@{version}" for name, version in _all(modules, wanted).items())]
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=_SECONDS,
                              check=False)
        why = "" if done.returncode == 0 else (done.stderr.strip().splitlines() or ["npm failed"])[0]
    except (OSError, subprocess.TimeoutExpired) as error:
        why = str(error)
    if why or _missing(modules, wanted):
        raise PreparationError(f"npm could not install {', '.join(missing)} ({why}): with a network try again, or "
                               f"'{_by_hand(missing)}'")


def _all(modules: Path, wanted: dict[str, str]) -> dict[str, str]:
    """Return what is wanted and what is there already: npm takes away what it is not asked for."""
    pinned = json.loads((PAGE / "package.json").read_text(encoding="utf-8"))
    known = {name: version for kind, own in pinned.items() if kind.endswith("ependencies")
             for name, version in own.items()}
    there = {name: version for name, version in known.items() if _version(modules / name) == version}
    return {**there, **wanted}


def _version(package: Path) -> str | None:
    try:
        return json.loads((package / "package.json").read_text(encoding="utf-8"))["version"]
    except (OSError, ValueError, KeyError):
        return None

"""npm packages of the page: named and pinned in page/package.json, installed on first use into .npm here."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

from guidewire.prepare import INSTALLED, ROOT, PreparationError

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
    """Return the folder node_modules with all packages of one kind, "dependencies" or "devDependencies" of
    package.json.

    Parameters
    ----------
    kind : which of them.
    tell : called with a line where something is installed.
    """
    wanted: dict[str, str] = json.loads((PAGE / "package.json").read_text(encoding="utf-8"))[kind]
    modules = CACHE / _MODULES
    missing = [f"{name}@{version}" for name, version in wanted.items() if _version(modules / name) != version]
    if not missing:
        return modules
    npm = shutil.which("npm")
    by_hand = f"npm install --prefix {os.path.relpath(CACHE)} {' '.join(missing)}"
    if npm is None:
        raise PreparationError(f"the page needs {', '.join(missing)} from npm, and there is no npm: install Node.js "
                               f"(as root 'apt-get install npm') and try again, or elsewhere '{by_hand}' and copy "
                               f"{os.path.relpath(CACHE)} here")
    tell(f"installing {', '.join(missing)} into {os.path.relpath(CACHE)} with npm")
    CACHE.mkdir(exist_ok=True)
    command = [npm, "install", "--prefix", str(CACHE), "--no-save", "--no-package-lock", "--no-audit", "--no-fund",
               "--ignore-scripts", *(f"{name}@{version}" for name, version in _all(modules, wanted).items())]
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=_SECONDS,
                              check=False)
        why = "" if done.returncode == 0 else (done.stderr.strip().splitlines() or ["npm failed"])[0]
    except (OSError, subprocess.TimeoutExpired) as error:
        why = str(error)
    if why or any(_version(modules / name) != version for name, version in wanted.items()):
        raise PreparationError(f"npm could not install {', '.join(missing)} ({why}): with a network try again, or "
                               f"'{by_hand}'")
    return modules


def _all(modules: Path, wanted: dict[str, str]) -> dict[str, str]:
    """Return what is wanted and what is there already: npm takes away what it is not asked for."""
    pinned = json.loads((PAGE / "package.json").read_text(encoding="utf-8"))
    known = {**pinned["dependencies"], **pinned["devDependencies"]}
    there = {name: version for name, version in known.items() if _version(modules / name) == version}
    return {**there, **wanted}


def _version(package: Path) -> str | None:
    try:
        return json.loads((package / "package.json").read_text(encoding="utf-8"))["version"]
    except (OSError, ValueError, KeyError):
        return None

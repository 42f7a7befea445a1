"""`package`: the wheel, by pip and setuptools, and the NuGet packages; and what setup.py puts into the wheel."""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from guidewire.installed import LIBRARY, RUNNER, version
from guidewire.prepare import ROOT, PreparationError
from guidewire.runs import building, checking
from guidewire.viewer import parts

PROJECTS = ("Guidewire.Core", "Guidewire.Io")
KINDS = ("wheel", "nuget")
LOG = ROOT / "results" / "package.log"
_ELSEWHERE = ("Windows, macOS: not tried; the same command needs the .NET SDK there with its C++ compiler, a launcher "
              "in place of runner.c, and the tag win_amd64 or macosx_11_0_arm64")


def package(arguments: argparse.Namespace) -> int:
    """`package`: build packages and print where they are."""
    checking.check_out(arguments.out)
    for kind in arguments.kinds or KINDS:
        for file in (_wheel if kind == "wheel" else _nuget)(arguments.out.absolute()):
            print(f"{kind}: {os.path.relpath(file)} ({file.stat().st_size / 1e6:.1f} MB)", flush=True)
    if "nuget" not in arguments.kinds[:1]:
        print(_ELSEWHERE)
    return 0


def _wheel(out: Path) -> list[Path]:
    print("building the wheel", flush=True)
    with tempfile.TemporaryDirectory(prefix="guidewire-package-") as folder:
        _run([sys.executable, "-m", "pip", "wheel", "-v", "--no-deps", "--no-build-isolation", "-w", folder, str(ROOT)])
        (wheel,) = Path(folder).glob("*.whl")
        return [Path(shutil.copy(wheel, _made(out)))]


def _nuget(out: Path) -> list[Path]:
    print("packing", *PROJECTS, flush=True)
    with tempfile.TemporaryDirectory(prefix="guidewire-package-") as folder:  # what the repository has built stays
        for project in PROJECTS:
            _run([building.dotnet()[0], "pack", "-c", "Release", "--nologo", "-v", "q",
                  str(building.HEADLESS / project),
                  "-o", str(_made(out)), "--artifacts-path", folder])
    return [out / f"{project}.{version()}.nupkg" for project in PROJECTS]


def _made(folder: Path) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def add_data(package: Path) -> None:
    """Put scenes, instruments, the table of keys and npm's part of the page into a copy of the package."""
    for folder in ("params", "instruments"):
        shutil.copytree(ROOT / folder, package / folder, ignore=shutil.ignore_patterns("*.md", "*.py"))
    shutil.copy(ROOT / "docs" / "parameters.md", _made(package / "docs"))
    place = _made(package / parts.THREE.relative_to(parts.PAGE.parents[1]))
    for name, path in parts.three(print).items():
        shutil.copy(path, place / name)
    shutil.copy(parts.three(print)["three.module.js"].parents[1] / "LICENSE", place)


def add_programs(folder: Path) -> None:
    """Build the native library, for processors of x86-64-v3 and for older ones, and the runner into a folder."""
    newer = building.build_native(print)
    source = building.HEADLESS / building.NATIVE
    with tempfile.TemporaryDirectory(prefix="guidewire-package-") as older:
        _run([building.dotnet()[0], "publish", "-c", "Release", "--nologo", "-v", "q", str(source), "-p:Baseline=true",
              f"-p:PublishDir={older}{os.sep}"])
        shutil.copy(newer, _made(folder) / LIBRARY[True])
        shutil.copy(Path(older) / f"{building.NATIVE}.so", folder / LIBRARY[False])
    building.link_runner(folder / RUNNER)


def _run(command: Sequence[str]) -> None:
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        _made(LOG.parent)
        LOG.write_text(done.stdout + done.stderr, encoding="utf-8")
        lines = [line.strip() for line in (done.stdout + done.stderr).splitlines() if "rror" in line]
        raise PreparationError(f"{Path(command[0]).name} failed: {(lines or ['no message'])[0]} (log: "
                               f"{os.path.relpath(LOG)})")


def main() -> int:
    """Fill a copy of the package, as `python -m tools.package FOLDER`, which setup.py calls."""
    try:
        add_data(Path(sys.argv[1]))
        add_programs(Path(sys.argv[1]) / "native")
    except PreparationError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())

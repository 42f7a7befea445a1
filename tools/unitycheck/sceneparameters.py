"""The parameter file and the overrides that a scene names, read as the scene will read them.

Where the console program has been built, it reads them: the same reader as the scene's. Where it has not, the file has
to be there and whole JSON, and every key one that the sources know.
"""

from __future__ import annotations

import functools
import re
import shutil
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Iterator

from tools.unitycheck.metas import guids
from tools.unitycheck.packages import parsed
from tools.unitycheck.project import Project, at_home
from tools.unitycheck.scenes import documents
from tools.unitycheck.unityyaml import Document
from tools.unitycheck.violation import Violation

LOOP = "SimulationLoop"
PROGRAM = "headless/Guidewire.Cli/bin/Release/net10.0/Guidewire.Cli.dll"
ENTRIES = "Assets/Guidewire/Io/Parameters/"
_SECONDS = 60.0
_AT_ONCE = 4
_KEY = re.compile(r"\bnew \w*Entry(?:<[\w.]+>)?\(\s*\"(\w+)\"")


def known_keys(project: Project) -> set[str]:
    """The parameter table's keys, as the sources name them; empty where there is no such table."""

    def make(p: Project) -> set[str]:
        return {key for path in p.assets(".cs") if at_home(path).startswith(ENTRIES) for key in _KEY.findall(p.text(path))}

    return project.derived("parameter keys", make)


def check(project: Project) -> Iterator[Violation]:
    """Rule scene-parameters."""
    sources = {path for path in project.assets(f"/{LOOP}.cs")}
    asked = []
    # The scenes of the package need the parameter files beside the repository's Assets: elsewhere nobody opens them.
    for path in (scene for scene in project.assets(".unity") if at_home(scene) == scene):
        for document in documents(project, path)[0]:
            script = document.data.get("m_Script")
            guid = str(script.get("guid", "")) if isinstance(script, dict) else ""
            if document.class_id == 114 and guids(project).get(guid) in sources and "_parameterFile" in document.data:
                problem = _form(project, document)
                if problem is not None:
                    yield Violation(path, document.line, "scene-parameters", problem)
                else:
                    asked.append((path, document))
    yield from _ask(project, asked)


def _values(document: Document) -> tuple[Any, list[Any]]:
    overrides = document.data.get("_overrides")
    return document.data["_parameterFile"], overrides if isinstance(overrides, list) else []


def _form(project: Project, document: Document) -> str | None:
    file, overrides = _values(document)
    if not isinstance(file, str) or not file or file.startswith(("/", "\\")) or ":" in file or "\\" in file:
        return f"_parameterFile '{file}' must be a path from the project's folder, with forward slashes"
    if not project.is_file(file):
        return f"there is no file {file}"
    data, problem = parsed(project, file)
    if problem is not None:
        return f"{file}: {problem.message}"
    if not isinstance(data, dict):
        return f"{file} holds no object"
    keys = known_keys(project)
    for key in data:
        if len(keys) > 20 and key not in keys and key != "formatVersion" and not isinstance(data[key], dict):
            return f"{file}: there is no parameter '{key}'"
    for override in overrides:
        key, sign, value = override.partition("=") if isinstance(override, str) else ("", "", "")
        if not sign or not key.strip() or not value.strip():
            return f"_overrides: '{override}' is not KEY=VALUE"
        if keys and len(keys) > 20 and key.strip() not in keys:
            return f"_overrides: there is no parameter '{key.strip()}'"
    return None


def _ask(project: Project, asked: list[tuple[str, Document]]) -> Iterator[Violation]:
    command = program(str(project.root))
    if command is None:
        return
    questions = []
    for _, document in asked:
        file, overrides = _values(document)
        texts = tuple((name, project.data(name)) for name in [file, *_beside(project, file)])
        questions.append((texts, tuple(overrides)))
    with ThreadPoolExecutor(_AT_ONCE) as workers:
        answers = list(workers.map(lambda question: _read(command, *question), questions))
    for (path, document), answer in zip(asked, answers):
        if answer:
            yield Violation(path, document.line, "scene-parameters", answer)


def _beside(project: Project, file: str) -> list[str]:
    """The mesh or start file that a parameter file names, where it is there."""
    data, _ = parsed(project, file)
    found = []
    for value in data.values() if isinstance(data, dict) else ():
        name = value.get("file") if isinstance(value, dict) else value
        folder = file.rpartition("/")[0]
        if isinstance(name, str) and 0 < len(name) < 200 and project.is_file(f"{folder}/{name}"):
            found.append(f"{folder}/{name}")
    return found


@functools.lru_cache(maxsize=8)
def program(root: str) -> tuple[str, ...] | None:
    """The command that reads parameters; None where it is not built, or older than the sources."""
    # A copy of the repository has the sources alone; what was built from the same ones stands beside this module.
    for base in (Path(root).resolve(), Path(__file__).resolve().parents[2]):
        built = base / PROGRAM
        dotnet = shutil.which("dotnet")
        if dotnet is not None and built.is_file() and (base / ENTRIES).is_dir():
            newest = max(path.stat().st_mtime for path in (base / "Assets/Guidewire/Io").rglob("*.cs"))
            age = built.with_name("Guidewire.Io.dll").stat().st_mtime
            return (dotnet, str(built)) if age >= newest else None
    return None


@functools.lru_cache(maxsize=256)
def _read(reader: tuple[str, ...], texts: tuple[tuple[str, bytes], ...], overrides: tuple[str, ...]) -> str:
    """What the reader says against a file with these overrides, without a step; empty where it takes them."""
    with tempfile.TemporaryDirectory() as folder:
        for name, data in texts:
            (Path(folder) / name).parent.mkdir(parents=True, exist_ok=True)
            (Path(folder) / name).write_bytes(data)
        pairs = [part for override in overrides
                 for part in (f"-{override.partition('=')[0].strip()}", override.partition("=")[2].strip())]
        command = [*reader, "-parameters", texts[0][0], "-out", "out", *pairs, "-maxSimulationSteps", "0"]
        try:
            done = subprocess.run(command, cwd=folder, capture_output=True, timeout=_SECONDS, text=True,
                                  stdin=subprocess.DEVNULL)
        except (OSError, subprocess.TimeoutExpired) as error:
            return f"the console program could not be asked: {error}"
        lines = (done.stderr or done.stdout).strip().splitlines()
        return "" if done.returncode == 0 else (lines[0] if lines else f"exit code {done.returncode}")

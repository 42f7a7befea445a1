"""The first hour of five people who know the pages alone: what they type, in a clone whose path has blanks and
umlauts, with a German and a Russian locale, and in the installed package where that can do it."""

from __future__ import annotations

import csv
import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest

from guidewire.prepare import ROOT
from guidewire.tests.test_docs import blocks
from tools.tests.test_packaging import site  # noqa: F401  a fixture

LOCALES = ("de_DE.UTF-8", "ru_RU.UTF-8")
CONTRIBUTING = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
LONG = pytest.mark.long("minutes: a clone is built; each command has tests of its own")


@dataclass(frozen=True)
class Door:
    """Where somebody types commands, and what starts one."""

    command: Sequence[str]
    folder: Path
    environment: dict[str, str]
    is_clone: bool

    def type(self, *words: str | Path, code: int = 0) -> str:
        """What a command prints, its lines of standard error too; it ends with a code."""
        done = subprocess.run([*self.command, *map(str, words)], cwd=self.folder, env=self.environment, text=True,
                              encoding="utf-8", stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        assert done.returncode == code and "Traceback" not in done.stdout, f"{words}: {done.stdout}"
        return done.stdout

    def write(self, name: str, text: str) -> Path:
        (self.folder / name).write_text(text, encoding="utf-8")
        return self.folder / name

    def rows(self, table: str) -> list[dict[str, str]]:
        return list(csv.DictReader((self.folder / table).read_text(encoding="utf-8").splitlines()))


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What is committed, and what was changed since."""
    folder = tmp_path_factory.mktemp("home") / "Größe und Maß" / "guide wire"
    subprocess.run(["git", "clone", "-q", ROOT, folder], check=True)
    changed = subprocess.run(["git", "ls-files", "-m", "-o", "--exclude-standard"], cwd=ROOT, text=True, check=True,
                             stdout=subprocess.PIPE).stdout.splitlines()
    for name in changed:
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, folder / name)
    if (ROOT / ".npm").is_dir():
        (folder / ".npm").symlink_to(ROOT / ".npm")
    return folder


@pytest.fixture(params=[*(f"clone {one}" for one in LOCALES), "package"])
def door(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Door]:
    kind, _, locale = request.param.partition(" ")
    environment = {**os.environ, "LC_ALL": locale or LOCALES[0], "LANG": locale or LOCALES[0], "MPLBACKEND": "Agg"}
    if kind == "clone":
        folder = request.getfixturevalue("clone")
        yield Door([sys.executable, "guidewire.py"], folder, environment, True)
        shutil.rmtree(folder / "results", ignore_errors=True)
        shutil.rmtree(folder / "mine", ignore_errors=True)
    else:
        environment |= {"PYTHONPATH": str(request.getfixturevalue("site")), "PATH": "/nowhere"}
        door = Door([sys.executable, "-m", "guidewire"], tmp_path, environment, False)
        door.type("scenes", "--copy", ".")
        yield door


@LONG
def test_a_student_has_relaxation_times_of_a_sweep(door: Door) -> None:
    if door.is_clone:
        assert "what to try next" in door.type("demo")
    door.write("steifigkeit.json", json.dumps({
        "study": "steifigkeit", "question": "Wie hängt die Relaxationszeit von Steifigkeit und Zeitschritt ab?",
        "scene": "params/default.json", "axes": {"stretchStiffness": [0.1, 0.4], "timeStep": [0.005, 0.01]}}))
    door.type("sweep", "steifigkeit.json")
    rows = door.rows("results/steifigkeit/runs.csv")
    found = [float(row["relaxationTime"]) for row in rows]
    assert found[1] == pytest.approx(2.0 * found[0], rel=1e-3) and found[2] < 0.4 * found[0]
    said = door.type("plot", "results/steifigkeit", "--x", "stretchStiffness", "--y", "relaxationTime", "--by",
                     "timeStep")
    assert "relaxationTime-over-stretchStiffness.png" in said
    assert "no such column" in door.type("plot", "results/steifigkeit", "--x", "stretchStiffness", "--y",
                                         "relaxation", code=2)
    script = door.write("tau.py", "from guidewire import read_relaxation, read_runs\n"
                                  "for name, run in read_runs('results/steifigkeit').items():\n"
                                  "    print(name, f'{read_relaxation(run).time:.4f}')\n")
    said = (door.type("python", script.name) if door.is_clone else subprocess.run(
        [sys.executable, script], cwd=door.folder, env=door.environment, text=True, check=True,
        stdout=subprocess.PIPE).stdout)
    assert [float(line.split()[-1]) for line in said.splitlines()] == [round(one, 4) for one in found]


@LONG
def test_a_device_engineer_has_a_wire_of_her_own_and_compares_forces(door: Door) -> None:
    said = door.type("instrument", "mine", "--like", "bentson-0.035", "--set", "tipLoad=2", "--set", "tipLength=3 cm")
    assert "7.95e-07 N m2" in said and said.count("passed") >= 4 and "NOT" not in said
    for name, wire in (("weich", "mine"), ("steif", "amplatz-0.035")):
        door.type("run", "params/sheath.json", "--set", f"instrument={wire}", "--set", "maxSimulationSteps=60", "--set",
                  "logHub=true", "--out", f"results/{name}")
    assert "hub-over-insertion.png" in door.type("hub", "results/weich", "results/steif", "--over", "insertion")
    assert "needs a number" in door.type("run", "params/sheath.json", "--set", "wireRadius=0,3", code=2)
    (door.folder / "instruments" / "mine.json").unlink()


@LONG
def test_a_trainer_has_a_vessel_of_her_own_and_a_page(door: Door) -> None:
    pytest.importorskip("vtkmodules")
    door.type("anatomy", "params/meshes/artery.obj", "--inlet", "1", "--target", "2", "--out", "results/Gefäß")
    assert "not watertight" not in (door.folder / "results" / "Gefäß" / "report.md").read_text(encoding="utf-8")
    door.type("steer", "results/Gefäß/scene.json", "--out", "results/gesteuert")
    summary = json.loads((door.folder / "results" / "gesteuert" / "summary.json").read_text(encoding="utf-8"))
    assert summary["centreline"]["reachedAt"] > 0.0 and summary["passages"] == 0
    door.type("view", "results/gesteuert", "--html", "results/Wiedergabe.html")
    assert "data-recording" in (door.folder / "results" / "Wiedergabe.html").read_text(encoding="utf-8")


@LONG
def test_a_trainer_of_policies_has_a_network_that_was_saved(door: Door) -> None:
    policy, learn = blocks((ROOT / "docs" / "first-policy.md").read_text(encoding="utf-8"), "python")[:2]
    door.write("policy.py", policy)
    door.write("learn.py", learn)
    for script in ("policy.py", "learn.py"):
        words = ["guidewire.py", "python", script] if door.is_clone else [script]
        done = subprocess.run([sys.executable, *words], cwd=door.folder, env=door.environment, text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        assert done.returncode == 0, done.stdout
    assert (door.folder / "artery.npz").is_file()
    said = door.type("tasks", "artery", "--policy", "learn:trained", "--episodes", "4")
    assert "episode 4 of 4" in said and "| artery | learn:trained | 4 | " in said
    assert not re.search(r"learn:trained \| 4 \| 0 %", said)
    assert "did you mean 'artery'" in door.type("tasks", "artry", "--policy", "learn:trained", code=2)


def test_a_saved_model_of_stable_baselines_is_scored(tmp_path: Path, runner_command: list[str]) -> None:
    """The page's class, on a stand-in for the package, which answers as its predict does."""
    page = (ROOT / "docs" / "environments.md").read_text(encoding="utf-8")
    script = next(block for block in blocks(page, "python") if "stable_baselines3" in block)
    (tmp_path / "ppo.py").write_text(script, encoding="utf-8")
    for name in ("stable_baselines3", "stable_baselines3/common"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text("class PPO:\n    @staticmethod\n    def load(name):\n"
                                                     "        return PPO()\n"
                                                     "    def predict(self, observation, deterministic):\n"
                                                     "        assert observation.shape == observation.ravel().shape\n"
                                                     "        return [1.0, 0.2], None\n", encoding="utf-8")
    for name, what in (("env_util", "make_vec_env"), ("vec_env", "SubprocVecEnv")):
        (tmp_path / "stable_baselines3" / "common" / f"{name}.py").write_text(f"{what} = None\n", encoding="utf-8")
    done = subprocess.run([sys.executable, ROOT / "guidewire.py", "tasks", "artery", "--policy", "ppo:Saved",
                           "--episodes", "1"], cwd=tmp_path, text=True, capture_output=True, check=False)
    assert done.returncode == 0 and "| artery | ppo:Saved | 1 | " in done.stdout, done.stderr
    assert "episode 1 of 1" in done.stderr


def commands_of_contributing() -> list[str]:
    return [line for block in blocks(CONTRIBUTING, "") for line in block.splitlines()]


@LONG
@pytest.mark.parametrize("locale", LOCALES)
def test_every_line_of_contributing_works_in_a_clone(clone: Path, locale: str) -> None:
    environment = {**os.environ, "LC_ALL": locale, "LANG": locale}
    environment.pop("GUIDEWIRE_ALL", None)
    door = Door([sys.executable, "guidewire.py"], clone, environment, True)
    lines = commands_of_contributing()
    assert [line.split()[2] for line in lines] == ["demo", "test", "test", "lint"]
    for line in lines:
        words = line.split()[2:]
        if words == ["test"]:
            continue    # this test is a part of it
        said = door.type(*words)
        assert words[0] != "test" or ", 0 failed" in said.splitlines()[-1]
    key = '            Key.Number("ownDrag", "1/s", NumberRange.NotNegative, "a drag of my own"),\n'
    drag = "        /// <summary>A drag.</summary>\n        public double OwnDrag { get; set; }\n\n"
    sources = clone / "Assets" / "Guidewire"
    entries = changed(sources / "Io/Parameters/Keys.cs", '            Key.Number("massDamping"', key)
    with entries, changed(sources / "Core/Parameters/MaterialParameters.cs", "        /// <summary>", drag):
        assert "ownDrag: a number >= 0 (1/s)" in door.type("keys", "ownDrag")
        said = door.type("run", "params/cantilever.json", "--set", "ownDrag=1", "--set", "maxSimulationSteps=1",
                         "--out", "results/own", "--force")
        assert said.splitlines()[-1].startswith("finished")


@contextmanager
def changed(file: Path, before: str, added: str) -> Iterator[None]:
    """A file with something added before the first place of a text."""
    text = file.read_text(encoding="utf-8")
    assert before in text
    file.write_text(text.replace(before, added + before, 1), encoding="utf-8")
    try:
        yield
    finally:
        file.write_text(text, encoding="utf-8")


@LONG
def test_the_editable_installation_of_contributing_works_with_and_without_wheel(clone: Path, tmp_path: Path) -> None:
    """`pip install -e . --no-deps`, and without a network with --no-build-isolation: setuptools of this Python."""
    line = re.search(r"`(pip install -e \. --no-deps)`", CONTRIBUTING)[1]
    option = re.search(r"add `(--no-build-isolation)`", CONTRIBUTING)[1]
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "eigene Umgebung"], check=True)
    programs = tmp_path / "eigene Umgebung" / "bin"
    subprocess.run([programs / "python", "-m", *line.split(), "-q", option], cwd=clone, check=True)
    said = subprocess.run([programs / "guidewire", "scenes"], cwd=tmp_path, text=True, check=True,
                          stdout=subprocess.PIPE).stdout
    assert "params/default.json" in said

"""Compares two builds of the runner: 41 scenes of the direct solver, by both.

    python3 guidewire.py python experiments/compare_builds.py BEFORE.dll AFTER.dll [--scenes WORD] [--bench ROUNDS]

A line a scene: the largest difference of a position over L, of a force over the largest force of the scene, and the
counts of both. With --bench the scenes named are run in turns, in warm processes, and the ratio of processor times is
printed: the median over the rounds, the least and the greatest.
"""

from __future__ import annotations

import argparse
import json
import statistics
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from guidewire.runs.runner import Request, Runner

ROOT = Path(__file__).resolve().parent.parent
COUNTS = ("factorisations", "wallIterations", "innerSteps", "halvedSteps")
BENCH = ("sheath", "insertion-accurate", "catheter", "guide-catheter", "microcatheter", "catheter-sheath", "torque",
         "cantilever")
LOGGED = 20  # entries of a log


@dataclass(frozen=True)
class Scene:
    """A parameter file, its first steps, and what is set otherwise."""

    name: str
    steps: int
    overrides: dict[str, Any] = field(default_factory=dict)

    @property
    def title(self) -> str:
        """Say it in one line."""
        texts = (f"{key}={json.dumps(value)}" for key, value in self.overrides.items())
        return " ".join([self.name, *texts])


def scenes() -> list[Scene]:
    """Return all of them."""
    orders = ("implicitEuler", "bdf2", "trbdf2", "esdirk3", "esdirk4")
    moving = {"tipForce": [0.02, 0.01, 0.0], "tipForceReleaseTime": 0.05}
    held = {"gravity": [0, -9.81, 0], "distalEnd": "clamped", "rotationSpeed": 3.0}
    pushed = {"drive": "displace", "insertionSpeed": 0.05}
    found = [Scene("cantilever", 100, {"integrator": order, **moving}) for order in orders]
    found += [Scene("cantilever", 100, {"integrator": order, "timeStepError": 1e-5, "massDamping": 2.0, **moving})
              for order in orders[2:]]
    found += [Scene("cantilever", 100, {"integrator": order, "materialDamping": 1e-4, **held}) for order in orders]
    found += [Scene("cantilever", 50, {"proximalEnd": "free", "integrator": order, "tipForce": [0.01, 0, 0]})
              for order in ("implicitEuler", "esdirk3")]
    found += [Scene("buckling", 200), Scene("buckling", 100, {"integrator": "esdirk3"}), Scene("torque", 300),
              Scene("concentric-tubes", 200), Scene("concentric-tubes", 60,
                                                    {"integrator": "esdirk3", "timeStep": 0.01})]
    found += [Scene("insertion-accurate", 230), Scene("insertion-accurate", 100, {"integrator": "trbdf2"}),
              Scene("insertion-accurate", 60, {"hubForceLimit": 0.001}),
              Scene("insertion-accurate", 40, {"timeStep": 0.1}), Scene("cantilever", 40, pushed)]
    found += [Scene("sheath", 150), Scene("sheath", 90, {"timeStep": 0.1}),
              Scene("sheath", 150, {"hubForceLimit": 0.01})]
    found += [Scene("catheter", 300), Scene("catheter", 150, {"hubForceLimit": 0.02}),
              Scene("catheter", 60, {"timeStep": 0.1}), Scene("catheter", 40, {"timeStep": 0.2}),
              Scene("catheter-branch", 300), Scene("catheter-branch", 60, {"timeStep": 0.1}),
              Scene("catheter-sheath", 150), Scene("catheter-sheath", 40, {"timeStep": 0.2}),
              Scene("microcatheter", 200),
              Scene("microcatheter", 60, {"timeStep": 0.1}), Scene("guide-catheter", 300),
              Scene("guide-catheter", 60, {"timeStep": 0.05}), Scene("guide-catheter", 50, {"timeStep": 0.1})]
    return found


def run(runner: Runner, scene: Scene, out: Path, timed: bool = False) -> tuple[str, float]:
    """What became of a run, in one line, and the processor time of its process, s."""
    overrides = {**scene.overrides, "maxSimulationSteps": scene.steps}
    if not timed:
        overrides |= {"logEvery": max(1, scene.steps // LOGGED), "logHub": True}
    began = processor_time(runner.process)
    answer = runner.run(Request(scene.title, ROOT / "params" / f"{scene.name}.json", out, overrides, log=not timed))
    return f"{answer.outcome}: {answer.message}", processor_time(runner.process) - began


def processor_time(process: int | None) -> float:
    """Return the processor time of a process and its threads so far, s."""
    if process is None:
        return 0.0
    threads = Path(f"/proc/{process}/task").glob("*/schedstat")
    return 1e-9 * sum(int(thread.read_text().split()[0]) for thread in threads)


def numbers(value: Any, path: str = "") -> Iterator[tuple[str, float]]:
    """All numbers of a JSON value with their paths, wall times left out."""
    if isinstance(value, dict | list):
        pairs = value.items() if isinstance(value, dict) else enumerate(value)
        for key, part in pairs:
            if key != "elapsedMilliseconds":
                yield from numbers(part, f"{path}/{key}")
    elif isinstance(value, int | float):
        yield path, float(value)


def compare(before: Path, after: Path) -> str:
    """The largest differences of two runs, in one line."""
    logs = [dict(numbers(json.loads((folder / "positions.json").read_text()))) for folder in (before, after)]
    ends = [json.loads((folder / "summary.json").read_text()) for folder in (before, after)]
    counts = ", ".join(f"{key} {ends[0]['solver'][key]:.0f} {ends[1]['solver'][key]:.0f}" for key in COUNTS
                       if ends[0]["solver"].get(key) is not None and ends[1]["solver"].get(key) is not None)
    if logs[0] == logs[1]:
        return f"same bits; {counts}"
    if logs[0].keys() != logs[1].keys():
        return f"other entries ({len(logs[0])} and {len(logs[1])}); {counts}"
    length = json.loads((before / "parameters.json").read_text())["guidewireLength"]
    forces = [key for key in logs[0] if "orce" in key]
    largest = max((abs(logs[0][key]) for key in forces), default=0.0) or 1.0
    move = max(abs(logs[0][key] - logs[1][key]) for key in logs[0] if key[-2:] in ("/x", "/y", "/z")) / length
    force = max((abs(logs[0][key] - logs[1][key]) for key in forces), default=0.0) / largest
    return f"positions {move:.1e}, forces {force:.1e} of {largest:.2g} N; {counts}"


def bench(runners: list[Runner], scene: Scene, folder: Path, rounds: int) -> str:
    """The ratio of processor times, after by before."""
    for runner in 2 * runners:
        run(runner, scene, folder, timed=True)
    ratios = []
    for k in range(rounds):
        times = {}
        for i in (0, 1) if k % 2 == 0 else (1, 0):
            times[i] = run(runners[i], scene, folder, timed=True)[1]
        ratios.append(times[1] / times[0])
    return f"time {statistics.median(ratios):.3f} of before ({min(ratios):.3f} to {max(ratios):.3f})"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("before", type=Path, help="Guidewire.Cli.dll of the one build")
    parser.add_argument("after", type=Path, help="and of the other")
    parser.add_argument("--scenes", default="", help="only those with this word in their line")
    parser.add_argument("--bench", type=int, default=0, metavar="ROUNDS", help="time the scenes as they are instead")
    given = parser.parse_args()
    runners = [Runner(["dotnet", str(path.resolve())]) for path in (given.before, given.after)]
    chosen = [Scene(name, 200) for name in BENCH] if given.bench else scenes()
    with tempfile.TemporaryDirectory() as temporary:
        for k, scene in enumerate(scene for scene in chosen if given.scenes in scene.title):
            folders = [Path(temporary) / f"{k}-{part}" for part in ("before", "after")]
            if given.bench:
                print(f"{scene.title}: {bench(runners, scene, folders[0], given.bench)}", flush=True)
                continue
            told = [run(runner, scene, folder)[0] for runner, folder in zip(runners, folders, strict=True)]
            ended = "" if told[0] == told[1] else f" ({told[0]} | {told[1]})"
            ended = f" ({told[0]})" if not ended and not told[0].startswith("finished") else ended
            result = compare(*folders) if (folders[1] / "summary.json").exists() else "no runs"
            print(f"{scene.title}: {result}{ended}", flush=True)
    for runner in runners:
        runner.close()


if __name__ == "__main__":
    main()

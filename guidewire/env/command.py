"""`guidewire.py tasks`: lists tasks, scores policies, steers by hand and replays what was steered."""

from __future__ import annotations

import argparse
import importlib
import json
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from guidewire.env import benchmark, demonstrations, score
from guidewire.env.baselines import Chance, baseline_of, parts_of
from guidewire.env.environment import Environment
from guidewire.env.observation import Observation
from guidewire.env.recorded import RecordedDrive, digest_of
from guidewire.env.spaces import Error
from guidewire.env.task import all_tasks, find_task
from guidewire.prepare import DOOR, PreparationError
from guidewire.sessions.session import SessionError

_BY_HAND = {"tip_turn": 0.0, "insertion": 0.0}  # as a page begins


Tell = Callable[[int, int], None]    # shows how many episodes of how many are done


def run(arguments: argparse.Namespace, build_runner: Callable[[], list[str]], tell: Tell) -> int:
    """List, or play, or steer, or replay; returns the exit code: 1 where an episode is not as it must be.

    Raises
    ------
    PreparationError : one line, for a task or a file that cannot be used.
    """
    try:
        if arguments.submitted:
            print(benchmark.table([benchmark.load(file) for file in arguments.submitted]))
            return 0
        policy = arguments.policy or "retry"
        if arguments.benchmark:
            return _score(arguments, policy, tell)
        if arguments.task is None:
            for name, task in all_tasks(None).items():
                print(f"{name}: {task.summary} ({len(task.targets)} targets, {task.time:g} s, {task.tier})")
            return 0
        if arguments.replay is not None:
            return _replay(arguments.task, arguments.replay, arguments.export)
        if arguments.record is None:
            return _score(arguments, policy, tell)
        if arguments.policy is None:
            return _steer(arguments.task, arguments.record, arguments.seed, arguments.open, build_runner)
        return _demonstrate(arguments.task, policy, arguments.record, arguments.episodes, arguments.seed or 1)
    except (Error, SessionError) as error:
        raise PreparationError(str(error)) from error


def _score(arguments: argparse.Namespace, policy: str, tell: Tell) -> int:
    began, first = time.monotonic(), benchmark.FIRST_SEED if arguments.benchmark else arguments.seed or 1
    seeds = range(first, first + arguments.episodes)
    names = [arguments.task] if arguments.task else list(all_tasks(arguments.tier))
    tier = find_task(arguments.task).tier if arguments.task else arguments.tier
    played = {name: _played(name, policy, seeds, arguments.jobs, tell) for name in names}
    results, every = benchmark.results_of(tier, policy, played), [one for own in played.values() for one in own]
    print(benchmark.table([results]))
    faults = [f"seed {one.seed}: {fault}" for one in every for fault in one.faults]
    ended = [f"seed {one.seed}: {one.report['reason']}" for one in every if one.report["end"] == "simulation"]
    print("\n".join([*faults[:20], f"{', '.join(names)}, seeds {seeds[0]} to {seeds[-1]}: {len(faults)} faults, "
                     f"{len(ended)} ended by the simulation, bits {score.digest(every)}, guidewire "
                     f"{results['guidewire']}, {time.monotonic() - began:.0f} s", *ended[:5]]))
    if arguments.benchmark and arguments.results is not None:
        benchmark.save(results, arguments.results)
        print(f"written: {arguments.results}, sha256 {results['sha256'][:16]}")
    return 1 if faults else 0


def _policy_of(policy: str) -> Callable[[Environment, int], Any]:
    """Lead from an environment and a seed to what acts: a baseline by name, or MODULE:NAME, a callable that takes the
    environment; its attribute `options`, a dict or what makes one of a task, are options of the environment."""
    if policy == "random":
        return Chance
    if policy == "retry":
        return lambda environment, _: baseline_of(environment)
    module, _, name = policy.partition(":")
    sys.path.insert(0, "")    # a module of the folder where the command runs
    try:
        make = getattr(importlib.import_module(module), name)
    except (ImportError, AttributeError, ValueError) as error:
        raise Error(f"policy '{policy}' is not allowed: needs retry, random, or MODULE:NAME ({error})") from error

    def made(environment: Environment, _: int) -> Any:
        return make(environment)

    made.options = getattr(make, "options", {})    # type: ignore[attr-defined]
    return made


def _options_of(make: Callable[..., Any], task: str) -> dict[str, Any]:
    given = getattr(make, "options", {})
    found = given(find_task(task)) if callable(given) else given
    return found or {"observation": Observation(parts=parts_of(find_task(task)))}


def _played(task: str, policy: str, seeds: range, jobs: int, tell: Tell) -> list[score.Played]:
    make = _policy_of(policy)
    options = _options_of(make, task)
    played: list[score.Played] = []
    lock = threading.Lock()

    def part(k: int) -> None:
        with Environment(task, **options) as environment:
            for one in seeds[k::jobs]:
                found = score.play(environment, make(environment, one), one)
                with lock:
                    played.append(found)
                    tell(len(played), len(seeds))

    with ThreadPoolExecutor(jobs) as pool:
        list(pool.map(part, range(jobs)))
    return sorted(played, key=lambda one: one.seed)


def _replay(task: str, file: Path, export: Path | None) -> int:
    drives = RecordedDrive.load_all(file)
    with Environment(task, observation=Observation(parts=parts_of(find_task(task)))) as environment:
        made = [demonstrations.trajectory_of(environment, one) for one in drives]
        for one in made:
            print(json.dumps({key: value for key, value in one.report.items() if key != "forces"}, indent=2))
        print("the same bits at the end as where it was recorded")
        if export is not None:
            if export.suffix == ".npz":
                demonstrations.save_npz(made, export)
            else:
                demonstrations.save_minari(environment, made, export, export.name)
            print(f"written: {export}, {len(made)} episodes, {sum(len(one.rewards) for one in made)} steps")
    return 0


def _demonstrate(task: str, policy: str, file: Path, episodes: int, seed: int) -> int:
    make = _policy_of(policy)
    options = _options_of(make, task)
    with Environment(task, **options) as environment:
        drives = demonstrations.demonstrate(environment, make(environment, seed), range(seed, seed + episodes),
                                            f"by the policy {policy}")
    if not drives:
        raise Error(f"{policy} reaches the target safely in none of {episodes} episodes")
    RecordedDrive.save_all(drives, file)
    print(f"recorded: {file}, {len(drives)} episodes of {episodes}, those that reach the target safely")
    return 0


def _steer(name: str, file: Path, seed: int | None, opens: bool, build_runner: Callable[[], list[str]]) -> int:
    from guidewire.viewer.command import serve_scene
    from guidewire.viewer.held import SteeredCalls

    task = find_task(name)
    if file.suffix != ".json" or not file.resolve().parent.is_dir():
        raise PreparationError(f"--record {file}: a file .json in a folder that is there")
    with Environment(task) as environment:
        drawn = {"nominal": True} if seed is None else environment.reset(seed=seed)[1]["draw"]
        options = {**drawn, **_BY_HAND}
        environment.reset(options=options)
        # The page lets it go on without end; the file's own drive, which nobody follows, stays within the wire.
        scene: dict[str, Any] = {**environment.scene, "maxSimulationSteps": 1}
    steered = SteeredCalls()
    with tempfile.TemporaryDirectory(prefix="guidewire-") as folder:
        path = Path(folder) / f"{task.name}.json"
        path.write_text(json.dumps(scene), encoding="utf-8")
        serve_scene(path, build_runner, steered, opens)
    if steered.problem or steered.state is None:
        print("nothing recorded: " + (steered.problem or "no step was made"))
        return 0
    RecordedDrive(task.name, options, steered.made, digest_of(steered.state), "by keys, through the page").save(file)
    print(f"recorded: {file}, {len(steered.made)} calls; "
          f"'{DOOR} tasks {name} --replay {file}' does them again")
    return 0

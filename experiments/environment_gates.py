"""Random episodes of every task, judged from what was seen alone; the same bits everywhere; resets without growth.

    python3 guidewire.py python experiments/environment_gates.py [FRACTION] [TASK ...]

FRACTION of 1,000 episodes of each task, of 3,000 resets, and of 40 episodes compared between threads, processes, runner
and native library (1). Prints a line for each task; exit code 1 where something is not as it must be.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.env import Environment, VectorEnvironment, all_tasks
from guidewire.env.baselines import Chance
from guidewire.env.recorded import digest_of
from guidewire.runs import building

EPISODES, RESETS, COMPARED, STEPS = 1000, 3000, 40, 12
FIRST = 3_000_000  # seed
GROWTH = 30.0  # MB


def judged(environment: Environment, seed: int) -> tuple[str, list[str]]:
    """One episode of even random actions at all hubs: its end, and what is wrong, from the states alone."""
    observation, _ = environment.reset(seed=seed)
    policy = Chance(environment, seed)
    policy.reset(observation)
    faults, largest, ended = [], 0.0, False
    while not ended:
        observation, reward, terminated, truncated, info = environment.step(policy.act(observation))
        ended = terminated or truncated
        state = environment.session.state
        instruments = [state, *state.catheters]
        numbers = [np.ravel(value) for value in observation.values()] + [one.positions.ravel() for one in instruments]
        if not np.isfinite(np.concatenate([*numbers, [reward]])).all():
            faults.append(f"seed {seed}: a number is not finite")
        largest = max([largest, *(float(np.linalg.norm(one.contact_forces, axis=1).max()) for one in instruments)])
        places = [one.place for one in instruments if one.place is not None]
        if not ended and any(not place.is_inside and place.distance > 0.0 for place in places):
            faults.append(f"seed {seed}: out of the vessel, and the episode goes on")
    report = info["report"]
    if largest > report["largest_force"] * (1.0 + 1e-12):
        faults.append(f"seed {seed}: a force of {largest:g} N is not in the report")
    return report["end"], faults + _false_success(environment, seed, report)


def _false_success(environment: Environment, seed: int, report: dict[str, Any]) -> list[str]:
    """A success whose tips are farther from the target, straight, than the centreline's way and the vessel allow."""
    task, state = environment.task, environment.session.state
    within = [task.tolerance]
    if environment.hubs > 1 and task.follow is not None:
        follow = task.follow if isinstance(task.follow, (list, tuple)) else [task.follow] * (environment.hubs - 1)
        within += [max(one, 0.0) for one in follow]
    tips = [one.positions[-1] for one in (state, *state.catheters)]
    far = [np.linalg.norm(tip - environment.target_position) for tip, _ in zip(tips, within)]
    wrong = [f"{one:.1f}" for one, most in zip(far, within) if one > most + environment.widest]
    return [f"seed {seed}: success with tips {wrong} units away"] if report["success"] and wrong else []


def bits(task: str, seeds: list[int], backend: str, native: bool) -> list[str]:
    """Digests of some steps of several environments at once."""
    with VectorEnvironment(task, len(seeds), 2, backend, native=native) as vector:
        vector.reset(seed=seeds)
        random = np.random.default_rng(7)
        for _ in range(STEPS):
            vector.step(random.uniform(-0.5, 1.0, vector.action_space.shape).astype(np.float32))
        return [digest_of(state) for state in (vector.get_attr("session_state"))]


def resident() -> float:
    """Memory of this process, MB."""
    return int(re.search(r"VmRSS:\s+(\d+)", Path("/proc/self/status").read_text()).group(1)) / 1024.0


def main() -> int:
    """Print what was found."""
    fraction = float(sys.argv[1]) if len(sys.argv) > 1 else 1.0
    count, resets, compared = (max(2, round(fraction * one)) for one in (EPISODES, RESETS, COMPARED))
    found = 0
    for task in sys.argv[2:] or all_tasks():
        ends: dict[str, int] = {}
        faults: list[str] = []
        with Environment(task) as environment:
            for seed in range(FIRST, FIRST + count):
                end, wrong = judged(environment, seed)
                ends[end] = ends.get(end, 0) + 1
                faults += wrong
            before = resident()
            for seed in range(resets):
                environment.reset(seed=seed % 8, options={"nominal": True})
            grown = resident() - before
        seeds = list(range(compared))
        hosts = [("threads", False), ("processes", False)] + ([("threads", True)] if building.native_library() else [])
        same = {host: bits(task, seeds, *host) for host in hosts}
        if len({tuple(one) for one in same.values()}) > 1:
            faults.append("bits differ between " + ", ".join(map(str, hosts)))
        if grown > GROWTH:
            faults.append(f"{grown:.0f} MB more after {resets} resets")
        print(f"{task}: {count} episodes, ends {ends}; {resets} resets, {grown:+.1f} MB; {compared} alike in "
              f"{len(hosts)} hosts; {len(faults)} faults", flush=True)
        for line in faults[:10]:
            print("  " + line)
        found += len(faults)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

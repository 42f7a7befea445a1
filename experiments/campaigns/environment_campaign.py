"""Random episodes of tasks with all instruments moved, judged from what was seen; the same bits in other hosts.

``python3 -m experiments.campaigns.environment_campaign --runs 1000 --record FILE [TASK ...]`` plays so many episodes of
each task, and adds a line of JSON to FILE for each. What stands there is not played again, so a campaign that was ended
goes on, and grows with a larger number. ``--result`` writes the rows of `results` from all that stands in FILE. One
episode in ten is also played in threads, in processes, and by the runner. ``--resets 3000`` begins so many episodes
besides, and looks at the memory. The criteria are those of `environment_claims`.
"""

from __future__ import annotations

import hashlib
import re
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from experiments.campaigns import results
from experiments.campaigns.environment_claims import Judge, add_bits
from experiments.campaigns.runs import parser_of
from guidewire.env import Environment, VectorEnvironment, all_tasks
from guidewire.env.baselines import Chance
from guidewire.env.drive import Drive
from guidewire.env.recorded import digest_of
from guidewire.env.task import Task, find_task
from guidewire.installed import version
from guidewire.runs import building

FIRST = 3_000_000  # seed
BLOCK, COMPARED = 40, 4  # episodes of a task at a time; of these, those that other hosts play
ALONE, HOSTS = "alone", ("threads", "processes", "runner")
GROWTH = 30.0  # MB
_NOMINAL, _SETTLED = 8, 600  # seeds of resets, and resets until the heap of the library has its size


def judged(environment: Environment, seed: int) -> dict[str, Any]:
    """Play one episode of even random actions at all hubs, and judge it; returns what is recorded."""
    observation, info = environment.reset(seed=seed)
    judge, policy = Judge(environment, observation, info["draw"]), Chance(environment, seed)
    policy.reset(observation)
    steps, ended = 0, False
    while not ended:
        observation, reward, terminated, truncated, info = environment.step(policy.act(observation))
        steps, ended = steps + 1, terminated or truncated
        judge.see(observation, reward, ended, info)
    report = info["report"]
    digest = judge.verdict(terminated, truncated, report)
    return {"end": report["end"], "reason": report["reason"], "steps": steps, "digest": digest, "faults": judge.faults}


def options_of(task: str) -> dict[str, Any]:
    """Options with which each step of an environment is one time step, as the criteria have it."""
    return {"drive": {"step_time": find_task(task).overrides.get("timeStep", Drive().step_time)}}


def together(task: str | Task, seeds: Sequence[int], backend: str, **options: Any) -> list[str]:
    """Play the episodes of these seeds at once; returns their digests."""
    sums, digests = [hashlib.sha256() for _ in seeds], [""] * len(seeds)
    with VectorEnvironment(task, len(seeds), 2, backend, **options) as vector, Environment(task, **options) as one:
        policies = [Chance(one, seed) for seed in seeds]
        observations, _ = vector.reset(seed=seeds)
        for policy in policies:
            policy.reset(None)
        rewards, ended = np.zeros(len(seeds)), np.zeros(len(seeds), dtype=bool)
        while True:
            for k, total in enumerate(sums):
                if not digests[k]:
                    add_bits(total, [part[k] for part in observations.values()], rewards[k])
            if any(last and not digest for last, digest in zip(ended, digests)):
                for k, state in enumerate(vector.get_attr("session_state")):
                    if ended[k] and not digests[k]:
                        sums[k].update(digest_of(state).encode())
                        digests[k] = sums[k].hexdigest()[:16]
            if all(digests):
                return digests
            actions = np.stack([policy.act(None) for policy in policies])
            observations, rewards, terminated, truncated, _ = vector.step(actions)
            ended = terminated | truncated


def grown(task: str | Task, resets: int) -> float:
    """Begin episodes; returns by how much the memory of this process grew once its heap had its size, MB."""
    with Environment(task) as environment:
        for k in range(resets + _SETTLED):
            if k == _SETTLED:
                before = _resident()
            environment.reset(seed=k % _NOMINAL, options={"nominal": True})
            environment.step(environment.action_space.low)
        return _resident() - before


class Record(results.Record):
    """What was found, by task, seed and host."""

    def __init__(self, file: Path) -> None:
        super().__init__(file, "task", "seed", "host")

    def note(self, task: str, seed: int, host: str, **found: Any) -> None:
        """Take in a line."""
        self.add({"task": task, "seed": seed, "host": host, "version": version(), **found})

    def lacks(self, task: str, seeds: Sequence[int], host: str) -> list[int]:
        """Return those seeds that a host has not played."""
        return [seed for seed in seeds if (task, seed, host) not in self.found]

    def count(self, task: str) -> Counted:
        """Count what is known of a task."""
        own = [one for (name, _, _), one in self.found.items() if name == task]
        alone = {one["seed"]: one for one in own if one["host"] == ALONE}
        faults = {seed: list(one["faults"]) for seed, one in alone.items()}
        counted = Counted(task, list(alone.values()), faults, Counter(one["end"] for one in alone.values()))
        for one in own:
            if one["host"] in HOSTS:
                counted.hosts[one["host"]] += 1
                if one["digest"] != alone[one["seed"]]["digest"]:
                    faults[one["seed"]].append(f"other bits with {one['host']}")
            elif one["host"] == "resets":
                counted.resets[one["seed"]] = one["grown"]
        return counted


@dataclass(frozen=True)
class Counted:
    """What is known of a task.

    Attributes
    ----------
    task : its name.
    episodes : the record's lines of those played alone.
    faults : of each seed.
    ends, hosts : how many episodes ended so, and how many each other host played.
    resets : by how much the memory grew in so many, MB.
    """

    task: str
    episodes: list[dict[str, Any]]
    faults: dict[int, list[str]]
    ends: Counter[str]
    hosts: Counter[str] = field(default_factory=Counter)
    resets: dict[int, float] = field(default_factory=dict)

    def told(self) -> list[str]:
        """Return all faults in words."""
        return [*(f"seed {seed}: {fault}" for seed, faults in self.faults.items() for fault in faults),
                *(f"{grown:.0f} MB more after {count} resets" for count, grown in self.resets.items()
                  if grown > GROWTH)]

    def lines(self) -> list[str]:
        """Say all of it."""
        faults = self.told()
        told = f"{self.task}: {len(self.episodes)} episodes of {self._steps} steps ("
        told += ", ".join(f"{count} {end}" for end, count in self.ends.most_common()) + ")"
        told += "".join(f"; {count} with {host}" for host, count in self.hosts.items())
        told += "".join(f"; {count} resets {grown:+.1f} MB" for count, grown in self.resets.items())
        reasons = [f"seed {one['seed']} ended: {one['reason']}" for one in self.episodes if one["reason"]]
        return [f"{told}; {len(faults)} faults", *(f"  {line}" for line in faults + reasons)]

    def keep(self) -> None:
        """Write the row of the task."""
        results.keep(f"environment {self.task}", f"environment_campaign --record FILE {self.task}", self.episodes,
                     self.ends, [seed for seed, faults in self.faults.items() if faults], task=self.task,
                     steps=self._steps, hosts=self.hosts, resets=self.resets, faults=len(self.told()),
                     reasons=results.kinds_of(one["reason"] for one in self.episodes if one["reason"]))

    @property
    def _steps(self) -> int:
        return sum(one["steps"] for one in self.episodes)


def play(record: Record, task: str, seeds: Sequence[int]) -> None:
    """Play what is not in the record: all of these alone, and the first with other hosts."""
    with Environment(task, **options_of(task)) as environment:
        for seed in record.lacks(task, seeds, ALONE):
            record.note(task, seed, ALONE, **judged(environment, seed))
    for host in HOSTS:
        seeds_of_host = record.lacks(task, seeds[:COMPARED], host)
        if not seeds_of_host:
            continue
        options = {**options_of(task), **({"native": False} if host == "runner" else {})}
        digests = together(task, seeds_of_host, "processes" if host == "processes" else "threads", **options)
        for seed, digest in zip(seeds_of_host, digests):
            record.note(task, seed, host, digest=digest)


def _resident() -> float:
    """Memory of this process, MB."""
    return int(re.search(r"VmRSS:\s+(\d+)", Path("/proc/self/status").read_text()).group(1)) / 1024.0


def main(arguments: Sequence[str]) -> int:
    """Print what is in the record at the end; returns 1 where something is not as it must be."""
    parser = parser_of("environment_campaign", __doc__, 1000)
    parser.set_defaults(first=FIRST)
    parser.add_argument("tasks", nargs="*", metavar="TASK", help="of those that ship (default all)")
    parser.add_argument("--resets", type=int, default=0, help="how many (default 0)")
    given = parser.parse_args(arguments)
    if not given.record:
        parser.error("--record FILE is needed")
    record, tasks = Record(given.record), given.tasks or list(all_tasks())
    building.build(building.RUNNER, print)
    for first in range(given.first, given.first + given.runs, BLOCK):
        for task in tasks:
            play(record, task, range(first, min(first + BLOCK, given.first + given.runs)))
    for task in tasks if given.resets else ():
        if record.lacks(task, [given.resets], "resets"):
            record.note(task, given.resets, "resets", grown=grown(task, given.resets))
    found = 0
    for task in tasks:
        counted = record.count(task)
        print("\n".join(counted.lines()), flush=True)
        found += len(counted.told())
        if given.result and counted.episodes:
            counted.keep()
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

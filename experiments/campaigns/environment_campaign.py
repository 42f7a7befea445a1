"""Random episodes of tasks with all instruments moved, judged from what was seen; the same bits in other hosts.

``python3 -m experiments.campaigns.environment_campaign --runs 1000 --record FILE [TASK ...]`` plays so many episodes of
each task, and adds a line of JSON to FILE for each. What stands there is not played again, so a campaign that was ended
goes on, and grows with a larger number. One episode in ten is also played in threads, in processes, and by the runner.
``--resets 3000`` begins so many episodes besides, and looks at the memory. The criteria are those of
`environment_claims`.
"""

from __future__ import annotations

import hashlib
import json
import re
import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from experiments.campaigns.environment_claims import Judge, add_bits
from experiments.campaigns.push_campaign import parser_of
from guidewire.env import Environment, VectorEnvironment, all_tasks
from guidewire.env.baselines import Chance
from guidewire.env.recorded import digest_of
from guidewire.env.task import Task
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


class Record:
    """A file of one JSON object a line: what was found, by task, seed and host."""

    def __init__(self, file: Path) -> None:
        self._file = file
        lines = file.read_text(encoding="utf-8").splitlines() if file.is_file() else []
        self.found = {(one["task"], one["seed"], one["host"]): one for one in map(json.loads, lines)}

    def add(self, task: str, seed: int, host: str, **found: Any) -> None:
        """Take in a line; it is in the file when this returns."""
        one = self.found[task, seed, host] = {"task": task, "seed": seed, "host": host, "version": version(), **found}
        with self._file.open("a", encoding="utf-8") as file:
            file.write(json.dumps(one) + "\n")

    def lacks(self, task: str, seeds: Sequence[int], host: str) -> list[int]:
        """Return those seeds that a host has not played."""
        return [seed for seed in seeds if (task, seed, host) not in self.found]

    def lines(self, task: str) -> tuple[list[str], int]:
        """Say what is known of a task, and how many faults there are."""
        own = [one for (name, _, _), one in self.found.items() if name == task]
        alone = {one["seed"]: one for one in own if one["host"] == ALONE}
        faults = [f"seed {seed}: {fault}" for seed, one in alone.items() for fault in one["faults"]]
        compared = Counter()
        for one in own:
            if one["host"] in HOSTS:
                compared[one["host"]] += 1
                if one["digest"] != alone[one["seed"]]["digest"]:
                    faults.append(f"seed {one['seed']}: other bits with {one['host']}")
            elif one["host"] == "resets" and one["grown"] > GROWTH:
                faults.append(f"{one['grown']:.0f} MB more after {one['seed']} resets")
        ends = Counter(one["end"] for one in alone.values())
        told = f"{task}: {len(alone)} episodes of {sum(one['steps'] for one in alone.values())} steps ("
        told += ", ".join(f"{count} {end}" for end, count in ends.most_common()) + ")"
        told += "".join(f"; {count} with {host}" for host, count in compared.items())
        told += "".join(f"; {one['seed']} resets {one['grown']:+.1f} MB" for one in own if one["host"] == "resets")
        reasons = [f"seed {seed} ended: {one['reason']}" for seed, one in alone.items() if one["reason"]]
        return [f"{told}; {len(faults)} faults", *(f"  {line}" for line in faults + reasons)], len(faults)


def play(record: Record, task: str, seeds: Sequence[int]) -> None:
    """Play what is not in the record: all of these alone, and the first with other hosts."""
    with Environment(task) as environment:
        for seed in record.lacks(task, seeds, ALONE):
            record.add(task, seed, ALONE, **judged(environment, seed))
    for host in HOSTS:
        seeds_of_host = record.lacks(task, seeds[:COMPARED], host)
        if not seeds_of_host:
            continue
        options = {"native": False} if host == "runner" else {}
        digests = together(task, seeds_of_host, "processes" if host == "processes" else "threads", **options)
        for seed, digest in zip(seeds_of_host, digests):
            record.add(task, seed, host, digest=digest)


def _resident() -> float:
    """Memory of this process, MB."""
    return int(re.search(r"VmRSS:\s+(\d+)", Path("/proc/self/status").read_text()).group(1)) / 1024.0


def main(arguments: Sequence[str]) -> int:
    """Print what is in the record at the end; returns 1 where something is not as it must be."""
    parser = parser_of("environment_campaign", __doc__, 1000)
    parser.set_defaults(first=FIRST)
    parser.add_argument("tasks", nargs="*", metavar="TASK", help="of those that ship (default all)")
    parser.add_argument("--record", type=Path, required=True, metavar="FILE", help="what was found, a line each")
    parser.add_argument("--resets", type=int, default=0, help="how many (default 0)")
    given = parser.parse_args(arguments)
    record, tasks = Record(given.record), given.tasks or list(all_tasks())
    building.build(building.RUNNER, print)
    for first in range(given.first, given.first + given.runs, BLOCK):
        for task in tasks:
            play(record, task, range(first, min(first + BLOCK, given.first + given.runs)))
    for task in tasks if given.resets else ():
        if record.lacks(task, [given.resets], "resets"):
            record.add(task, given.resets, "resets", grown=grown(task, given.resets))
    found = 0
    for task in tasks:
        lines, faults = record.lines(task)
        print("\n".join(lines), flush=True)
        found += faults
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

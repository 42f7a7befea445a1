"""What campaigns share: their arguments, the runs that a record lacks, and what is told and kept of all of them."""

from __future__ import annotations

import argparse
import itertools
import shutil
import tempfile
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import closing, contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any

from experiments.campaigns import results
from experiments.campaigns.results import Record
from guidewire.runs.runner import Runner
from tools.seeds import keep

FINE = ("finished", "converged", "reliable")  # ends of which nothing is told one by one


def parser_of(name: str, description: str, runs: int = 100) -> argparse.ArgumentParser:
    """The arguments that all share: how many runs, the first seed, a record, and whether to write the row."""
    parser = argparse.ArgumentParser(prog=f"python3 -m experiments.campaigns.{name}",
                                     description=description.split("\n", 1)[0])
    parser.add_argument("--runs", type=int, default=runs, help=f"how many (default {runs})")
    parser.add_argument("--first", type=int, default=0, help="the first seed (default 0)")
    parser.add_argument("--record", type=Path, metavar="FILE", help="what each seed came to, a line each; what stands "
                        "there is not run again")
    parser.add_argument("--result", action="store_true", help="write the row of experiments/campaigns/results.json")
    return parser


@contextmanager
def folder_of(given: argparse.Namespace) -> Iterator[Path]:
    """The folder for scenes of runs that break a claim: the one that was asked for, or one that is removed."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = given.keep or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        yield folder


def played(command: Sequence[str], seeds: Iterable[int], make: Callable[[Runner, int, Path], Any], folder: Path,
           name: str) -> Iterator[Any]:
    """Return the runs of these seeds, one after another in one process.

    Parameters
    ----------
    make : one run, with files `NAME-SEED.*` and folders `run-SEED` and `run-SEED-*`; None for a seed that is skipped.
        Files stay where it breaks a claim.
    """
    with closing(Runner(command)) as runner:
        for seed in seeds:
            one = make(runner, seed, folder)
            for out in (folder / f"run-{seed}", *folder.glob(f"run-{seed}-*")):
                shutil.rmtree(out, ignore_errors=True)
            if not one or not one.claims:
                for path in folder.glob(f"{name}-{seed}.*"):
                    path.unlink()
            if one:
                yield one


def fill(record: Record, given: argparse.Namespace, play: Callable[[Iterable[int]], Iterable[Any]],
         again: Sequence[int] = (), skipped: str = "", **group: Any) -> list[dict[str, Any]]:
    """Run what the record lacks, and print what is to be told of each.

    Parameters
    ----------
    given : `runs` from the seed `first` on are wanted.
    play : the runs of seeds, one after another: dataclasses with `seed`, `outcome`, `claims` and `reason`.
    again : seeds that go before all others, and count where they are among those wanted.
    skipped : an outcome that does not count. So many of them are enough, too.
    group : what the lines of the record have in common, where it has others.

    Returns
    -------
    The lines of the record that are wanted, by seed.
    """
    own = {one["seed"]: one for one in record.found.values() if group.items() <= one.items()}
    again = [seed for seed in again if seed not in own]
    following = (seed for seed in itertools.count(given.first) if seed not in own and seed not in again)
    runs = iter(play(itertools.chain(again, following)))
    ends = Counter(one["outcome"] == skipped for seed, one in own.items() if seed >= given.first)
    while max(ends[False], ends[True]) < given.runs:
        one = asdict(next(runs))
        own[one["seed"]] = record.add(one)
        ends[one["outcome"] == skipped] += one["seed"] >= given.first
        if one["claims"] or one["reason"] and one["outcome"] not in (*FINE, skipped):
            print(*group.values(), one["seed"], one.get("kind", ""), f"{one['outcome']}:",
                  "; ".join(one["claims"]) or one["reason"], flush=True)
    return [one for seed, one in sorted(own.items()) if seed >= given.first and one["outcome"] != skipped][:given.runs]


def close(name: str, command: str, lines: Sequence[dict[str, Any]], given: argparse.Namespace, **more: Any) -> int:
    """Tell what the runs came to, note seeds that broke a claim, and write the row where it is asked for; returns 1
    where a run breaks a claim.

    Parameters
    ----------
    name, command, more : of `results.keep`.
    lines : of the record, those that count.
    """
    ends = Counter(str(one["outcome"]) for one in lines)
    broken = [one["seed"] for one in lines if one["claims"]]
    keep(name, broken)
    print(f"{name}: {len(lines)} runs ({', '.join(f'{count} {end}' for end, count in sorted(ends.items()))}), "
          f"{len(broken)} break a claim", *(f"{key} {value}" for key, value in more.items()), sep="; ")
    if given.result and lines:
        results.keep(name, command, lines, ends, broken, **more, failures=results.kinds_of(
            one["reason"] for one in lines if one["outcome"] not in FINE and one["reason"]))
    return 1 if broken else 0

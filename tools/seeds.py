"""Seeds of random tests: where campaigns run in full those of the day, elsewhere a fraction that stays.

Those that broke a claim the last time go first.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from datetime import date

from guidewire.prepare import ROOT
from tools.testing import DAY, FULL_CAMPAIGNS

RED = ROOT / "results" / "red"  # one file for each campaign, a seed a line


def today() -> int:
    """The number of the day, or the one that the environment asks for."""
    return int(os.environ.get(DAY, date.today().toordinal()))


def of_the_day(count: int, most: int | None = None) -> range:
    """So many numbers, each day the next ones; where there are `most` in all, from the first again after the last."""
    first = count * today() if most is None else count * (today() % -(-most // count))
    return range(first, first + count if most is None else min(first + count, most))


def seeds(campaign: str, fraction: Sequence[int], count: int) -> list[int]:
    """The seeds to run: those that broke a claim, and `count` of the day, or the fraction."""
    return list(dict.fromkeys([*red(campaign), *(of_the_day(count) if FULL_CAMPAIGNS in os.environ else fraction)]))


def red(campaign: str) -> list[int]:
    """The seeds that broke a claim the last time."""
    file = RED / campaign
    return [int(line) for line in file.read_text().split()] if file.exists() else []


def keep(campaign: str, broken: Iterable[int]) -> None:
    """Note which broke a claim in this run, and forget those before."""
    lines = "".join(f"{seed}\n" for seed in broken)
    if lines:
        RED.mkdir(parents=True, exist_ok=True)
        (RED / campaign).write_text(lines)
    else:
        (RED / campaign).unlink(missing_ok=True)

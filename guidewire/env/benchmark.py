"""Results of a policy on a tier of tasks: metrics with confidence intervals, in a file that others can check."""

from __future__ import annotations

import hashlib
import json
import platform
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.env.score import Played
from guidewire.env.spaces import Error
from guidewire.installed import version
from guidewire.runs.whole_files import write_whole

FIRST_SEED = 1_000_000  # of the first episode of each task
FORMAT = "guidewire benchmark 1"
_CONFIDENCE = 1.959964  # standard deviations, of 95 %
_RESAMPLED = 2000
_OF_SUCCESSES = ("time", "path ratio")
_FRACTIONS = ("success", "safe success")
METRICS = {"success": "", "safe success": "", "time": "s", "path ratio": "", "largest force": "N", "impulse": "N s",
           "contrast": "ml", "exposures": ""}


def row_of(played: Played) -> dict[str, Any]:
    """Return what a file keeps of an episode."""
    report = played.report
    return {"seed": played.seed, "end": report["end"], "success": report["success"],
            "safe success": report["safe_success"], "return": played.total, "time": report["time"],
            "path ratio": report["path"] / max(report["way"], 1e-9), "largest force": report["largest_force"],
            "impulse": report["impulse"], "contrast": report["contrast"], "exposures": report["exposures"],
            "bits": played.digest[:16]}


def interval(values: Sequence[float], is_fraction: bool) -> list[float] | None:
    """Mean, and the ends of its confidence interval of 95 %: Wilson's of a fraction, of others by the percentiles of
    means of values drawn anew; None without values."""
    if not len(values):
        return None
    numbers = np.asarray(values, dtype=float)
    mean, count = float(numbers.mean()), len(numbers)
    if is_fraction:
        square = _CONFIDENCE**2 / count
        middle = (mean + 0.5 * square) / (1.0 + square)
        half = _CONFIDENCE * (mean * (1.0 - mean) / count + 0.25 * square / count)**0.5 / (1.0 + square)
        return [mean, max(middle - half, 0.0), min(middle + half, 1.0)]
    drawn = np.random.default_rng(count).integers(count, size=(_RESAMPLED, count))
    low, high = np.percentile(numbers[drawn].mean(axis=1), [2.5, 97.5]).tolist()
    return [mean, low, high]


def metrics_of(episodes: Sequence[Mapping[str, Any]]) -> dict[str, list[float] | None]:
    """Return each metric with its interval: time and path ratio of successes, others of all episodes."""
    return {name: interval([float(one[name]) for one in episodes if one["success"] or name not in _OF_SUCCESSES],
                           name in _FRACTIONS) for name in METRICS}


def results_of(tier: str, policy: str, played: Mapping[str, Sequence[Played]]) -> dict[str, Any]:
    """Return what a results file says.

    Parameters
    ----------
    played : episodes of each task.
    """
    tasks = {}
    for name, episodes in played.items():
        rows = [row_of(one) for one in episodes]
        tasks[name] = {"metrics": metrics_of(rows), "episodes": rows}
    found = {"format": FORMAT, "guidewire": version(), "python": platform.python_version(), "numpy": np.__version__,
             "machine": platform.machine(), "tier": tier, "policy": policy, "tasks": tasks}
    return {**found, "sha256": _sum_of(found)}


def save(results: Mapping[str, Any], file: Path) -> None:
    """Write a results file."""
    write_whole(file, json.dumps(results, indent=1) + "\n")


def load(file: Path) -> dict[str, Any]:
    """Read a results file, and check that it is whole.

    Raises
    ------
    Error : it is none, its sum is another, its seeds are not those of a benchmark, or its metrics do not follow from
        its episodes; one line.
    """
    try:
        read = json.loads(file.read_text(encoding="utf-8"))
        rest = {key: value for key, value in read.items() if key != "sha256"}
        if read["format"] != FORMAT:
            raise Error(f"{file}: no results file: format is {read['format']!r}")
        if read["sha256"] != _sum_of(rest):
            raise Error(f"{file}: its sha256 is not that of what stands there: it was changed")
        for name, task in read["tasks"].items():
            seeds = [one["seed"] for one in task["episodes"]]
            if seeds != list(range(FIRST_SEED, FIRST_SEED + len(seeds))):
                raise Error(f"{file}: the seeds of {name} are not those of the benchmark, from {FIRST_SEED} on")
            if task["metrics"] != metrics_of(task["episodes"]):
                raise Error(f"{file}: the metrics of {name} do not follow from its episodes")
    except OSError as error:
        raise Error(f"{file}: {error.strerror}") from error
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise Error(f"{file}: no results file ({error})") from error
    return read


def table(files: Sequence[Mapping[str, Any]]) -> str:
    """Return a row for each task and policy, with the intervals in brackets."""
    head = ("task", "policy", "episodes", *(f"{name} {unit}".strip() for name, unit in METRICS.items()))
    lines = [head, ("---",) * len(head)]
    for results in files:
        for name, task in results["tasks"].items():
            cells = [_cell(value, key in _FRACTIONS) for key, value in task["metrics"].items()]
            lines.append((name, results["policy"], str(len(task["episodes"])), *cells))
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def _cell(value: Sequence[float] | None, is_fraction: bool) -> str:
    if value is None:
        return "-"
    if is_fraction:
        mean, low, high = (100.0 * one for one in value)
        return f"{mean:.0f} % [{low:.0f}, {high:.0f}]"
    mean, low, high = value
    return f"{mean:.3g}" if low == high else f"{mean:.3g} [{low:.3g}, {high:.3g}]"


def _sum_of(results: Mapping[str, Any]) -> str:
    return hashlib.sha256(json.dumps(results, sort_keys=True).encode()).hexdigest()

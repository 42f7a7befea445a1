"""Run folders (parameters.json, summary.json, the log) and study folders (study.json above runs)."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.logs.logs import LogError, find_log
from guidewire.studies.keys import TABLE, Value

PARAMETERS_NAME = "parameters.json"
SUMMARY_NAME = "summary.json"
LOAD_NAME = "load.json"
FORMAT = 2  # of a run's files, the newest that is read here; what states none is of version 1
FORMAT_KEY = "formatVersion"
_NAMED = 5  # runs of a study, in an error line


@dataclass(frozen=True)
class Run:
    """It is one run's folder.

    Attributes
    ----------
    folder : where the run stands.
    parameters : all effective values, by key.
    summary : summary.json; None where the run was killed before it could be written.
    key, repeat : from the study's table where the run belongs to one: the run's name, and the number of the timed
        repeat (None for a run that is not timed).
    variant, values : from the same: name of the variant, empty where there is none, and the values of the axes by key.
    repeat_folders : where its timed repeats stand, in their order, where they were asked for.
    """

    folder: Path
    parameters: Mapping[str, Any]
    summary: Mapping[str, Any] | None
    key: str = ""
    repeat: int | None = None
    variant: str = ""
    values: Mapping[str, Value] = field(default_factory=dict)
    repeat_folders: tuple[Path, ...] = ()

    def value(self, key: str) -> Any:
        """Return the effective value of a parameter."""
        if key not in self.parameters:
            raise LogError(f"{self.folder / PARAMETERS_NAME}: has no {key}")
        return self.parameters[key]

    def number(self, key: str) -> float:
        """Return the effective value of a parameter that is a number."""
        value = self.value(key)
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise LogError(f"{self.folder / PARAMETERS_NAME}: {key} is {json.dumps(value)}, not a number")
        return value

    def measured(self, name: str) -> float:
        """Return a number of the summary."""
        if self.summary is None:
            raise LogError(f"{self.folder}: has no {SUMMARY_NAME}, the run did not end by itself")
        if name not in self.summary:
            raise LogError(f"{self.folder / SUMMARY_NAME}: has no {name}")
        return self.summary[name]

    @property
    def others_busy(self) -> float | None:
        """Processors that other programs kept busy beside a timed run, on average; None where nobody looked."""
        file = self.folder / LOAD_NAME
        return float(_read_object(file)["othersBusy"]) if file.is_file() else None

    @property
    def outcome(self) -> str:
        """How the run ended; "killed" where it could not say so."""
        return "killed" if self.summary is None else str(self.summary.get("outcome"))

    @property
    def is_reliable(self) -> bool:
        """Whether the run came to its end and nothing that it measured of itself speaks against its result."""
        return self.summary is not None and self.summary.get("reliable") is True

    @property
    def direction(self) -> np.ndarray:
        """Unit vector of the first sphere's displacement, shape (3,)."""
        direction = np.asarray(self.value("displacementDirection"), dtype=float)
        return direction / np.linalg.norm(direction)

    @property
    def displacement(self) -> np.ndarray:
        """Displacement of the first sphere at the start, shape (3,), in units."""
        return self.number("displacement") * self.direction

    @property
    def rest_positions(self) -> np.ndarray:
        """x_i before the displacement, shape (n+1, 3), in units: sphere i at z = guidewireOffset + i L/n."""
        count = int(self.number("numberRodElements"))
        rest = np.zeros((count + 1, 3))
        rest[:, 2] = self.number("guidewireOffset") + self.number("guidewireLength") * np.arange(count + 1) / count
        return rest


def busiest(repeats: Iterable[Run]) -> float | None:
    """Return what others kept busy beside the repeat that they disturbed most; None where nobody looked."""
    return max((busy for repeat in repeats if (busy := repeat.others_busy) is not None), default=None)


@dataclass(frozen=True)
class StudyRuns:
    """The runs of one study, in the order of its table, without those that left no log."""

    name: str
    folder: Path
    runs: tuple[Run, ...]
    missing: tuple[str, ...]  # keys of the runs that left nothing to read

    def required(self) -> tuple[Run, ...]:
        """Runs made for their positions, or LogError where none left a log."""
        if not self.untimed:
            raise LogError(f"{self.folder}: no run of this study has a log")
        return self.untimed

    @property
    def untimed(self) -> tuple[Run, ...]:
        """Runs made for their positions."""
        return tuple(run for run in self.runs if run.repeat is None)

    @property
    def axes(self) -> tuple[str, ...]:
        """Keys of the parameters that the study varies, without those of its variants."""
        return tuple(dict.fromkeys(key for run in self.runs for key in run.values))

    def along(self, key: str) -> tuple[Run, ...]:
        """Runs made for their positions, one for each value of ``key``.

        Raises
        ------
        LogError : the study varies something else too, or instead.
        """
        varied = [*self.axes, *(["variants"] if len({run.variant for run in self.untimed}) > 1 else [])]
        if self.runs and varied != [key]:
            raise LogError(f"{self.folder / TABLE}: varies {', '.join(varied) or 'nothing'}, not {key} alone")
        return self.untimed

    def timed(self, key: str) -> tuple[Run, ...]:
        """Timed repeats of the run named ``key`` that ended by themselves: a killed one has no step time."""
        return tuple(
            run for run in self.runs if run.repeat is not None and run.key == key and run.summary is not None
        )


def read_run(
    folder: str | Path, key: str = "", repeat: int | None = None, variant: str = "",
    values: Mapping[str, Value] | None = None,
) -> Run:
    """Reads a run folder's small files; the log is read by whoever needs it.

    Raises
    ------
    LogError : parameters.json is missing, one of the two files is not a JSON object, or they are of a format newer than
        FORMAT.
    """
    folder = Path(folder)
    summary_file = folder / SUMMARY_NAME
    summary = _read_object(summary_file) if summary_file.is_file() else None
    if (folder / TABLE).is_file() and not (folder / PARAMETERS_NAME).is_file():
        runs = {row.key: row.place for row in _rows(folder) if row.repeat is None}
        named = "; ".join(f"{place} ({key})" for key, place in list(runs.items())[:_NAMED])
        more = f"; and {len(runs) - _NAMED} more" if len(runs) > _NAMED else ""
        raise LogError(f"{folder}: the folder of a study, not of a run; its runs are {named}{more}")
    parameters = _read_object(folder / PARAMETERS_NAME)
    stated = parameters.get(FORMAT_KEY, FORMAT)
    if isinstance(stated, bool) or not isinstance(stated, int) or not 1 <= stated <= FORMAT:
        raise LogError(f"{folder / PARAMETERS_NAME}: {FORMAT_KEY} = {json.dumps(stated)} is not allowed: versions 1 to "
                       f"{FORMAT} are read here")
    return Run(folder, parameters, summary, key, repeat, variant, values or {})


def read_repeats(run: Run, repeats: int) -> list[Run]:
    """Return the timed repeats of a run that has so many."""
    if len(run.repeat_folders) < repeats:
        raise LogError(f"{run.key}: has {len(run.repeat_folders)} timed repeats, not {repeats}")
    return [read_run(place, run.key, k, run.variant, run.values)
            for k, place in enumerate(run.repeat_folders[:repeats], 1)]


def read_runs(folder: str | Path) -> dict[str, Run]:
    """Runs in a study's table that are not timed, by key, each with the folders of its timed repeats.

    Raises
    ------
    LogError : the table, or a small file of a run, cannot be read.
    """
    runs: dict[str, Run] = {}
    repeats: dict[str, dict[int, Path]] = {}
    for row in _rows(Path(folder)):
        if row.repeat is None:
            runs[row.key] = read_run(row.place, row.key, None, row.variant, row.values)
        else:
            repeats.setdefault(row.key, {})[row.repeat] = row.place
    return {key: replace(run, repeat_folders=tuple(place for _, place in sorted(repeats.get(key, {}).items())))
            for key, run in runs.items()}


def read_study(folder: Path) -> StudyRuns:
    """Reads study.json and every run of it that left a log."""
    runs, missing = [], []
    for row in _rows(folder):
        try:
            find_log(row.place)
        except LogError:
            missing.append(row.key)
        else:
            runs.append(read_run(row.place, row.key, row.repeat, row.variant, row.values))
    name = _read_object(folder / TABLE).get("study", folder.name)
    return StudyRuns(str(name), folder, tuple(runs), tuple(missing))


@dataclass(frozen=True)
class _Row:
    """A line of a study's table, and where its run stands."""

    key: str
    variant: str
    values: Mapping[str, Value]
    repeat: int | None
    place: Path


def _rows(folder: Path) -> list[_Row]:
    """Return the lines of a study's table."""
    try:
        return [_Row(row["key"], row["variant"], row["values"], row["repeat"], (folder / row["folder"]).resolve())
                for row in _read_object(folder / TABLE).get("runs", [])]
    except (KeyError, TypeError) as error:
        raise LogError(f"{folder / TABLE}: a run lacks {error}") from error


def _read_object(path: Path) -> Mapping[str, Any]:
    try:
        content = json.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise LogError(f"{path}: {error.strerror}") from error
    except ValueError as error:
        raise LogError(f"{path}: not JSON ({error})") from error
    if not isinstance(content, dict):
        raise LogError(f"{path}: not a JSON object")
    return content

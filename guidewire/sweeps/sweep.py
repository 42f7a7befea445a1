"""Makes the runs of studies and checks, round by round, and writes tables of their results.

Runs stand in one store, each under the address that the runner gives its parameters (guidewire/sweeps/store.py), so
that what is done is not run again, whoever asked for it. In `<out>/<source>/` stand study.json, what was asked for and
in which folder it is, and runs.csv, what came of it, one line for each run.
"""

from __future__ import annotations

import csv
import io
import json
import os
import time
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional, Protocol

from guidewire.json_text import without_notes
from guidewire.prepare import ROOT, PreparationError
from guidewire.runs import building
from guidewire.runs.runner import BAD_INPUT, FAILED, INTERRUPTED, Answer, Request
from guidewire.runs.whole_files import write_whole
from guidewire.studies.keys import RESULTS, TABLE, told_values
from guidewire.studies.table import Case, Findings, Rounds, Source, Study
from guidewire.sweeps.store import folder_of, read_whole

if TYPE_CHECKING:
    from guidewire.sweeps.cluster import Cluster
    from guidewire.sweeps.worker import Job

_STARTS = "starts"
_TIMED = {"logSpheres": "last", "logOrientations": False}  # a timed run's log is read for its times only
WALL_TIMES = (  # what differs from one time to the next; all other columns are independent of the machine
    "computationTime", "setUpTime", "wallTime", "averageStepTime", "medianStepTime", "othersBusy", "timesMeasured",
    "elementIterationsPerMillisecond", "wallTimePerSecond", "elementIterationTime", "versions.machine",
)


class Bar(Protocol):
    """What shows how far a round is; tqdm has it."""

    def update(self, n: int) -> Any:
        """So many runs more have ended."""

    def close(self) -> None:
        """The round has ended."""


class _NoBar:
    def update(self, n: int) -> None:
        pass

    def close(self) -> None:
        pass


def no_bar(number: int, total: int, found: int) -> Bar:
    """Shows nothing."""
    return _NoBar()


def build_stopwatch() -> list[str]:
    """Return the program that measures a motion's cost in turns with sweeps, built without a word."""
    return building.build(building.BENCHMARKS, lambda _: None)


@dataclass(frozen=True)
class Means:
    """What makes runs.

    Attributes
    ----------
    command : the runner.
    jobs : untimed runs at once; timed ones are made one at a time.
    address : of a running scheduler whose workers make them; None: workers within this process.
    folder : from where files that a study names count; None: from where we stand.
    stopwatch : gives the program that measures a motion's cost in turns with sweeps; called where that is asked for.
    bar : shows a round: its number from 1, its runs, and how many of them are there already.
    """

    command: Sequence[str]
    jobs: int = 1
    address: str | None = None
    folder: Path | None = None
    stopwatch: Callable[[], Sequence[str]] = build_stopwatch
    bar: Callable[[int, int, int], Bar] = no_bar


@dataclass(frozen=True)
class SweepResult:
    """What became of all runs.

    Attributes
    ----------
    made : runs that were made now.
    found : runs that were there, or that two rows share.
    failures : runs that have no result, by the name of their source and their own.
    cluster_seconds : what starting the cluster took.
    """

    made: int
    found: int
    failures: list[Answer]
    cluster_seconds: float


def sweep(asked: Iterable[tuple[Source, Path]], runs: Path, means: Means) -> SweepResult:
    """Make what is missing of all sources' runs, a round of all of them at a time: untimed runs several at once, then
    the timed ones one by one.

    Parameters
    ----------
    asked : who asks for runs, and the folder above its own; one that has lost a run is not asked for more.
    runs : folder of all runs.
    means : what makes them.

    Raises
    ------
    PreparationError : a run of the first round cannot be made; nothing was run or written.
    KeyboardInterrupt : after Ctrl-C, when the runs under way have ended; the tables then say what was done.
    """
    started = time.monotonic()
    from guidewire.sweeps.cluster import Cluster  # which takes a second, and packages that other commands do without

    runs = runs.resolve()
    with Cluster(means.command, runs, means.folder, means.address, means.jobs) as cluster:
        return _Sweep(asked, runs, means, cluster).make(time.monotonic() - started)


@dataclass
class _Row:
    """One run of a source.

    Attributes
    ----------
    case, job : what is asked for; the job's folder is not known before its parameters are checked.
    refused : why it cannot be made; empty where it can.
    """

    case: Case
    job: Job
    refused: str = ""

    @property
    def folder(self) -> Path:
        return self.job.request.out

    @property
    def repeat(self) -> int | None:
        return self.job.request.repeat

    def read(self) -> dict[str, Any] | None:
        """Return its summary, where it is done."""
        return None if self.refused else read_whole(self.folder, self.job.request.log, self.job.timed)


class _Sweep:
    """One call of `sweep`."""

    def __init__(self, asked: Iterable[tuple[Source, Path]], runs: Path, means: Means, cluster: Cluster) -> None:
        self._means = means
        self._runs = runs
        self._cluster = cluster
        self._asked = [_Asked(source, out.resolve() / source.name) for source, out in asked]
        self._answers: dict[Path, Answer] = {}
        self._made = self._found = 0

    def make(self, cluster_seconds: float) -> SweepResult:
        number = 0
        while waiting := [one for one in self._asked if one.next_round()]:
            number += 1
            self._place([row for one in waiting for row in one.latest])
            if number == 1:
                self._refuse(waiting)
            try:
                for one in waiting:
                    one.write_study()
                self._make_round(number, [row for one in waiting for row in one.latest if not row.refused])
            finally:
                for one in waiting:
                    one.write_results(self._answers)
        lost = [answer for one in self._asked for answer in one.lost]
        return SweepResult(self._made, self._found, lost, cluster_seconds)

    def _place(self, rows: Sequence[_Row]) -> None:
        """Give every row the folder of its run, or the reason why it cannot be made."""
        for row, found in zip(rows, self._cluster.check([row.job for row in rows])):
            if isinstance(found, str):
                place = folder_of(self._runs, found, row.repeat, row.case.in_turns)
                row.job = replace(row.job, request=replace(row.job.request, out=place))
            elif found.exit_code == BAD_INPUT:
                row.refused = found.message.removeprefix("set: ")
            else:
                raise PreparationError(found.message)

    def _refuse(self, waiting: Sequence[_Asked]) -> None:
        for one in waiting:
            refused = [row for row in one.latest if row.refused]
            if refused:
                others = f" (and {len(refused) - 1} more of {len(one.latest)} runs)" if len(refused) > 1 else ""
                raise PreparationError(f"{one.source.origin}: run {refused[0].case.key}: {refused[0].refused}{others}")

    def _make_round(self, number: int, rows: Sequence[_Row]) -> None:
        missing: dict[Path, _Row] = {}  # two rows may share a run
        for row in rows:
            if not row.job.is_done and (row.folder not in missing or row.job.request.log):
                missing[row.folder] = row
        self._found += len(rows) - len(missing)
        if not missing:
            return
        bar = self._means.bar(number, len(rows), len(rows) - len(missing))

        def note(job: Job, answer: Answer) -> None:
            self._answers[job.request.out] = answer
            self._made += 1
            bar.update(1)

        timed = sorted((row for row in missing.values() if row.job.timed), key=lambda row: row.repeat)
        in_turns = [row for row in missing.values() if row.case.in_turns]
        untimed = [row for row in missing.values() if not row.job.timed and not row.case.in_turns]
        try:
            for kind, command in ((untimed, None), (timed, None), (in_turns, self._means.stopwatch)):
                if kind:
                    self._cluster.make([row.job for row in kind], note, kind is not untimed, command and command())
        finally:
            bar.close()


class _Asked:
    """A source, and what it has asked for so far."""

    def __init__(self, source: Source, folder: Path) -> None:
        self.source = source
        self.latest: list[_Row] = []  # of the latest round
        self.lost: list[Answer] = []  # what became of runs that have no result
        self._folder = folder
        self._earlier: list[_Row] = []
        self._places: dict[str, str] = {}  # folders above those of runs, from that of the tables
        self._lines: list[dict[str, Any]] = []  # of the table, for the rounds before the latest
        self._rounds: Rounds = source.rounds(folder)
        self._keys: set[str] = set()  # without regard to case: names of files are made of them

    def next_round(self) -> bool:
        """Ask for more; False where there is nothing more, or a run is lost."""
        if self.lost:
            return False
        try:
            cases = self._rounds.send(_Ended(self.latest)) if self._keys else next(self._rounds)
        except StopIteration as end:
            if isinstance(end.value, Findings):
                _write(self._folder / end.value.name, _csv(end.value.rows))
            return False
        for case in cases:
            if case.key.lower() in self._keys:
                raise ValueError(f"{self.source.name} asks for two runs of one name, {case.key}")
            self._keys.add(case.key.lower())
        self._earlier += self.latest
        rows = [row for case in cases for row in self._rows(case)]
        self.latest = sorted(rows, key=lambda row: row.repeat or 0)  # all first repeats, then the second
        return True

    def write_study(self) -> None:
        """Write study.json: what was asked for, and in which folder it is."""
        rows = (json.dumps({
            "key": row.case.key,
            "variant": row.case.variant,
            "values": told_values(row.case.values),
            "parameters": self.source.scene,
            "overrides": row.job.request.overrides,
            "folder": self._place_of(row),
            "repeat": row.repeat,
        }) for row in (*self._earlier, *self.latest) if not row.refused)
        head = f'{{"study": {json.dumps(self.source.name)}, "question": {json.dumps(self.source.title)}, "runs": [\n'
        _write(self._folder / TABLE, head + ",\n".join(rows) + "\n]}\n")

    def write_results(self, answers: Mapping[Path, Answer]) -> None:
        """Write runs.csv: what came of every run, one line each."""
        for row in self.latest:
            summary = row.read()
            if summary is not None:
                line = self._line(row, summary)
            else:
                answer = self._answer(row, answers)
                word = answer.outcome if answer.outcome in ("", "interrupted") else "failed"
                line = {"outcome": word, "reason": answer.message}
            self._lines.append({"key": row.case.key, "variant": row.case.variant, **told_values(row.case.values),
                                "repeat": row.repeat, **line})
            if summary is None or line["outcome"] not in self.source.results:
                name = f"{self.source.name}: {row.case.key}" + (f", repeat {row.repeat}" if row.repeat else "")
                code = answers[row.folder].exit_code if row.folder in answers else FAILED
                self.lost.append(Answer(name, BAD_INPUT if row.refused else code, line["outcome"], line["reason"]))
        _write(self._folder / RESULTS, _csv(self._lines))

    def _line(self, row: _Row, summary: Mapping[str, Any]) -> dict[str, Any]:
        """Return what came of a run, and last what depends on the machine."""
        flat = dict(_flat("", {name: value for name, value in summary.items() if name not in _SAID}))
        if isinstance(self.source, Study) and row.repeat is None and summary.get("log"):
            flat |= _relaxation(row.folder)
        last = {name: flat.pop(name) for name in WALL_TIMES if name in flat}
        return {**flat, "folder": self._place_of(row), **last}

    def _place_of(self, row: _Row) -> str:
        """Folder of a run, from that of the tables."""
        above, part, name = str(row.folder).rsplit(os.sep, 2)
        if above not in self._places:
            self._places[above] = os.path.relpath(above, self._folder).replace(os.sep, "/")
        return f"{self._places[above]}/{part}/{name}"

    def _answer(self, row: _Row, answers: Mapping[Path, Answer]) -> Answer:
        """Return what became of a run that is not done."""
        if row.refused:
            return Answer(row.case.key, BAD_INPUT, None, row.refused)
        return answers.get(row.folder, Answer(row.case.key, INTERRUPTED, "", "not run yet"))

    def _rows(self, case: Case) -> list[_Row]:
        overrides = dict(case.overrides)
        if case.start is not None:
            start = self._folder / _STARTS / f"{case.key}.json"
            start.parent.mkdir(parents=True, exist_ok=True)
            write_whole(start, json.dumps(case.start))
            overrides["startFile"] = str(start)
        repeats = range(1, case.repeats + 1)
        return [self._row(case, None, overrides), *(self._row(case, k, {**overrides, **_TIMED}) for k in repeats)]

    @cached_property
    def _scene(self) -> dict[str, Any]:
        """Keys of the scene's file; none where it cannot be read, which the runner then says."""
        try:
            return dict(without_notes(json.loads((ROOT / self.source.scene).read_text(encoding="utf-8-sig"))))
        except (OSError, ValueError, TypeError):
            return {}

    def _row(self, case: Case, repeat: int | None, overrides: dict[str, Any]) -> _Row:
        from guidewire.sweeps.worker import Job

        logs = self.source.logs and not case.in_turns
        if not logs and repeat is None and isinstance(self.source, Study) and self.source.file is not None:
            from guidewire.logs.relaxation import is_released

            logs = is_released({**self._scene, **overrides})
            overrides = {"logSpheres": "last", **overrides} if logs else overrides  # what its relaxation takes
        request = Request(case.key, ROOT / self.source.scene, None, overrides, repeat, logs)
        return _Row(case, Job(request, repeat is not None, self.source.seconds))


class _Ended(Mapping[str, Optional[dict[str, Any]]]):
    """Summaries of untimed runs by key, read when they are asked for."""

    def __init__(self, rows: Iterable[_Row]) -> None:
        self._rows = {row.case.key: row for row in rows if row.repeat is None}

    def __getitem__(self, key: str) -> dict[str, Any] | None:
        return self._rows[key].read()

    def __iter__(self) -> Iterator[str]:
        return iter(self._rows)

    def __len__(self) -> int:
        return len(self._rows)


_SAID = ("repeat", "timed", "complete")  # of a summary, what the table says elsewhere


def _relaxation(folder: Path) -> dict[str, Any]:
    """Relaxation of a run's tip, where its wire is let go. `relaxationNote` says why there is none, or what it leaves.
    """
    from guidewire.logs.logs import LogError
    from guidewire.logs.relaxation import RelaxationError, is_released, read_relaxation
    from guidewire.logs.runs import read_run

    found, note = None, ""
    try:
        run = read_run(folder)
        if not is_released(run.parameters):
            return {}
        with warnings.catch_warnings(record=True) as warned:
            warnings.simplefilter("always")
            found = read_relaxation(run)
        note = "; ".join(str(one.message) for one in warned)
    except (LogError, RelaxationError) as error:
        note = str(error)
    return {"relaxationTime": found and found.time, "relaxationTimeError": found and found.time_error,
            "relaxationPeriod": found and found.period, "relaxationNote": note}


def _flat(prefix: str, values: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Values of an object and of those in it, a list as JSON."""
    for name, value in values.items():
        if isinstance(value, dict):
            yield from _flat(f"{prefix}{name}.", value)
        else:
            yield prefix + name, json.dumps(value) if isinstance(value, list) else value


def _csv(lines: Sequence[Mapping[str, Any]]) -> str:
    """Lines as CSV; numbers so that they read back to the same bits, true and false as in JSON."""
    columns = list(dict.fromkeys(name for line in lines for name in line))
    columns.sort(key=lambda name: name in WALL_TIMES)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    for line in lines:
        cells = (line.get(name) for name in columns)
        writer.writerow([json.dumps(cell) if isinstance(cell, bool) else cell for cell in cells])
    return text.getvalue()


def _write(path: Path, text: str) -> None:
    """Write at once: a reader finds the old file or the new one, never a part."""
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, text)

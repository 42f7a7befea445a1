"""Makes the runs that studies and checks ask for, round by round, and says in study.json what became of them.

Runs stand in `<out>/<source>/<run key>/`, timed repeats in `repeat-K` below, study.json beside the run keys. What is
done already is not run again.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from experiments import building
from experiments.prepare import ROOT
from experiments.runner import Answer, Request, run_all
from studies.keys import TABLE
from studies.table import Case, Rounds, Source

START = "start.json"
_TIMED = {"logSpheres": "last", "logOrientations": False}  # a timed run's log is read for its times only


@dataclass(frozen=True)
class SweepResult:
    """What became of all runs, by folder of the run relative to `folder`, and which of them have no result."""

    folder: Path
    answers: dict[str, Answer]
    failures: list[Answer]


def build_stopwatch() -> list[str]:
    """The program that measures a motion's cost in turns with sweeps, built without a word."""
    return building.build(building.BENCHMARKS, lambda _: None)


def sweep(
    sources: Sequence[Source],
    command: Sequence[str],
    out: Path,
    jobs: int,
    progress: Callable[[int, int, Answer], None],
    stopwatch: Callable[[], Sequence[str]] = build_stopwatch,
) -> SweepResult:
    """Make what is missing of all sources' runs, a round of all of them at a time: untimed runs several at once, then
    the timed ones one by one.

    Parameters
    ----------
    sources : who asks for runs; one that has lost a run is not asked for more.
    command : the runner.
    out : folder above those of the sources.
    jobs : number of untimed runs at once.
    progress : called after each run with the number of runs that ended, of those asked for so far, and the answer.
    stopwatch : gives the program that measures a motion's cost in turns with sweeps; called where a case is to be measured in turns.

    Raises
    ------
    KeyboardInterrupt : after Ctrl-C, when the runs under way have ended; study.json then says what was done.
    """
    folder = out.resolve()
    answers: dict[str, Answer] = {}
    asked: list[_Asked] = [_Asked.of(source, folder) for source in sources]

    def note(_: Request, answer: Answer) -> None:
        answers[answer.name] = answer
        progress(len(answers), sum(len(one.requests) for one in asked), answer)

    waiting = asked
    while waiting := [one for one in waiting if one.next_round(answers)]:
        untimed, timed, measured = ([request for one in waiting for request in one.latest(kind)] for kind in _KINDS)
        timed.sort(key=lambda request: request.repeat)  # what slows a machine for a while slows all cases alike
        try:
            run_all(command, untimed, jobs, note)
            run_all(command, timed, 1, note)
            if measured:
                run_all(stopwatch(), measured, 1, note)
        finally:
            for one in waiting:
                one.write_table(answers)
    return SweepResult(folder, answers, [answer for one in asked for answer in one.lost(answers)])


_KINDS = ("untimed", "timed", "measured")


@dataclass(frozen=True)
class _Row:
    """A request, the case that it is of, and when it is made."""

    case: Case
    request: Request
    kind: str


@dataclass
class _Asked:
    """A source, and what it has asked for so far."""

    source: Source
    folder: Path
    rounds: Rounds
    rows: list[_Row] = field(default_factory=list)
    first: int = 0  # row of the latest round
    keys: set[str] = field(default_factory=set)  # without regard to case, as some file systems have it

    @classmethod
    def of(cls, source: Source, out: Path) -> _Asked:
        folder = out / source.name
        return cls(source, folder, source.rounds(folder))

    @property
    def requests(self) -> list[Request]:
        return [row.request for row in self.rows]

    def latest(self, kind: str) -> list[Request]:
        """What the latest round asked for."""
        return [row.request for row in self.rows[self.first:] if row.kind == kind]

    def lost(self, answers: dict[str, Answer]) -> list[Answer]:
        """Answers that are no result."""
        ended = (answers.get(request.name) for request in self.requests)
        return [answer for answer in ended if answer is not None and answer.outcome not in self.source.results]

    def next_round(self, answers: dict[str, Answer]) -> bool:
        """Ask for more; False where there is nothing more, or a run is lost."""
        if self.lost(answers):
            return False
        try:
            cases = next(self.rounds)
        except StopIteration:
            return False
        self.first = len(self.rows)
        for case in cases:
            if case.key.lower() in self.keys:
                raise ValueError(f"{self.source.name} asks for two runs in one folder, {case.key}")
            self.keys.add(case.key.lower())
        rows = [row for case in cases for row in self._rows(case)]
        self.rows += sorted(rows, key=lambda row: row.request.repeat or 0)  # all values' first repeats, then the second
        return True

    def _rows(self, case: Case) -> list[_Row]:
        overrides = dict(case.overrides)
        if case.start is not None:
            start = self.folder / case.folder() / START
            start.parent.mkdir(parents=True, exist_ok=True)
            start.write_text(json.dumps(case.start), encoding="utf-8")
            overrides["startFile"] = str(start)
        rows = [_Row(case, self._request(case, None, overrides), "measured" if case.in_turns else "untimed")]
        for repeat in range(1, case.repeats + 1):
            rows.append(_Row(case, self._request(case, repeat, {**overrides, **_TIMED}), "timed"))
        return rows

    def _request(self, case: Case, repeat: int | None, overrides: dict[str, Any]) -> Request:
        place = case.folder(repeat)
        return Request(f"{self.source.name}/{place}", ROOT / self.source.scene, self.folder / place, overrides, repeat)

    def write_table(self, answers: dict[str, Answer]) -> None:
        """Write study.json at once: a reader finds the old table or the new one, never a part."""
        rows: list[dict[str, Any]] = []
        for row in self.rows:
            answer = answers.get(row.request.name)
            rows.append({
                "key": row.case.key,
                "variant": row.case.variant,
                "values": dict(row.case.values),
                "parameters": self.source.scene,
                "overrides": row.request.overrides,
                "folder": row.case.folder(row.request.repeat),
                "repeat": row.request.repeat,
                "outcome": answer.outcome if answer else None,
                "exitCode": answer.exit_code if answer else None,
                "message": answer.message if answer else "not run yet",
            })
        table = {"study": self.source.name, "title": self.source.title, "runs": rows}
        path = self.folder / TABLE
        path.parent.mkdir(parents=True, exist_ok=True)
        partial = path.with_name(path.name + ".partial")
        partial.write_text(json.dumps(table, indent=2) + "\n", encoding="utf-8")
        os.replace(partial, path)

"""Reads position logs of any size in one pass.

A log of format json is one JSON object, ``{"0": {"totalTime", "elapsedMilliseconds", "delta", "sphere": {"0": {"x",
...}}}, ...}``. It may stand on one line or on many. Only one entry is decoded at a time and only what was asked for is
kept, so that memory is set by the request and not by the file. Logs of format npz (logFormat) have an array for each
quantity, which guidewire.logs.array_logs reads; what stands here gives the same of both.
"""

from __future__ import annotations

import json
from array import array
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from guidewire.logs.array_logs import ArrayLog
from guidewire.logs.entries import arrays_of

LOG_NAMES = ("positions.json", "positions.npz", "positions.json.partial", "positions.npz.partial")

_CHUNK = 1 << 20  # characters read at a time
_LONGEST_TOKEN = 64  # characters; the decoder reports a cut token at most this far before the cut
_WHITESPACE = " \t\r\n"


class LogError(Exception):
    """A log that cannot be understood. The message is one line that names the file."""


@dataclass(frozen=True)
class PositionLog:
    """What was asked of one log, ``k`` entries and ``s`` spheres.

    Attributes
    ----------
    source : the file read.
    steps : (k,) of int, step numbers; entry 0 is the start, after the first sphere's displacement (with direct between
        walls before it).
    time, elapsed : (k,), in-game time and real time since the start of the run, both in seconds.
    prediction_error : (k,), Delta_p of the last sphere, in units.
    spheres : (s,) of int, indices of the spheres kept, ascending.
    positions : (k, s, 3), in units.
    velocities : (k, s, 3), in units/s; None unless asked for.
    final_step : the last whole step in the file, also where thinning skips it.
    final_spheres : (f,) of int, indices of all spheres that the last whole step states, whatever ``spheres`` asked for.
    final_positions : (f, 3), their positions, in units.
    catheters : (k, m+1, 3) each, positions of the nodes of each catheter over the wire, outermost first, in units; none
        unless all spheres were asked for.
    warning : one line where the log ends before the run did; what was read then goes up to the last whole step.
    """

    source: Path
    steps: np.ndarray
    time: np.ndarray
    elapsed: np.ndarray
    prediction_error: np.ndarray
    spheres: np.ndarray
    positions: np.ndarray
    velocities: np.ndarray | None
    final_step: int
    final_spheres: np.ndarray
    final_positions: np.ndarray
    warning: str | None
    catheters: tuple[np.ndarray, ...] = ()

    @property
    def complete(self) -> bool:
        """Whether the log was closed by the run that wrote it."""
        return self.warning is None

    def sphere(self, index: int) -> np.ndarray:
        """Positions of one sphere, shape (k, 3), in units."""
        column = np.flatnonzero(self.spheres == index)
        if column.size == 0:
            raise LogError(f"{self.source}: sphere {index} was not read")
        return self.positions[:, column[0]]


def find_log(path: str | Path) -> Path:
    """Return the log that ``path`` means: a file itself, or a run folder's log, complete or else partial."""
    path = Path(path)
    if path.is_dir():
        for name in LOG_NAMES:
            if (path / name).is_file():
                return path / name
        raise LogError(f"{path}: holds neither {LOG_NAMES[0]} nor {LOG_NAMES[1]}")
    if not path.is_file():
        raise LogError(f"{path}: no such log")
    return path


def read_log(
    path: str | Path,
    spheres: str | Sequence[int] = "last",
    every: int = 1,
    velocities: bool = False,
) -> PositionLog:
    """Reads a log, or a run folder's log, in one pass.

    Parameters
    ----------
    path : the log or the run folder.
    spheres : "last", "all" or a sequence of int: which spheres' positions to keep.
    every : keep the entries whose step number is a multiple of this.
    velocities : keep the velocities of these spheres too.

    Raises
    ------
    LogError : the file is missing, is not a log, holds no whole step, or lacks a sphere that was asked for.
    """
    if every < 1:
        raise ValueError(f"every = {every}: must be at least 1")
    source = find_log(path)
    if _is_of_arrays(source):
        with _named(source):
            return _read_arrays(source, spheres, every, velocities)
    entries = _Entries(source)
    columns = _Columns(source, spheres, velocities)
    step, entry = -1, None
    for step, entry in entries:
        if step % every == 0:
            columns.append(step, entry)
    if entry is None:
        raise LogError(f"{source}: holds no whole step")
    return columns.finish(step, entry, entries.warning)


def read_entries(path: str | Path) -> Iterator[tuple[int, dict]]:
    """Every whole entry of a log, or of a run folder's log, as (step, entry), for what `read_log` does not keep.

    Raises
    ------
    LogError : the file is missing, is not a log or holds no whole step.
    """
    source = find_log(path)
    if _is_of_arrays(source):
        with _named(source):
            yield from ArrayLog(source).entries()
        return
    step = -1
    for step, entry in _Entries(source):
        yield step, entry
    if step < 0:
        raise LogError(f"{source}: holds no whole step")


def read_columns(path: str | Path, names: Iterable[str], steps: np.ndarray | None = None) -> dict[str, np.ndarray]:
    """Quantities of a log, or of a run folder's log, by their names in the table of quantities.

    Parameters
    ----------
    path : the log or the run folder.
    names : of the quantities; those that some entry does not have are left out.
    steps : (k,) of int, ascending, the entries to read; None: all.

    Returns
    -------
    dict of ndarray
        The first index counts entries, as in a log of format npz.

    Raises
    ------
    LogError : the file is missing, is not a log or holds no whole step.
    """
    source = find_log(path)
    if _is_of_arrays(source):
        with _named(source):
            log = ArrayLog(source)
            kept = slice(None) if steps is None else np.flatnonzero(np.isin(log["step"], steps))
            return {name: column[kept] for name, column in log.columns(names).items()}
    wanted = None if steps is None else set(steps.tolist())
    rows: dict[str, list[np.ndarray]] = {name: [] for name in names}
    count = 0
    for step, entry in read_entries(source):
        if wanted is None or step in wanted:
            try:
                arrays = arrays_of(step, entry)
            except (KeyError, TypeError, ValueError) as error:
                raise LogError(f"{source}: step {step} lacks {error}") from error
            count += 1
            for name in rows:
                if name in arrays:
                    rows[name].append(arrays[name])
    return {name: np.array(values) for name, values in rows.items() if values and len(values) == count}


def extent(log: PositionLog) -> tuple[np.ndarray, float]:
    """Middle (3,) and diagonal, in units, of the box around all places that the wire passes.

    Raises LogError where a log does not have every sphere, or no place that is finite.
    """
    if len(log.spheres) < 2:
        raise LogError(f"{log.source}: holds one sphere only; a picture needs a run with logSpheres = \"all\"")
    every = log.positions.reshape(-1, 3)
    every = every[np.isfinite(every).all(axis=1)]
    if len(every) == 0:
        raise LogError(f"{log.source}: holds no finite position")
    low, high = every.min(axis=0), every.max(axis=0)
    return 0.5 * (low + high), float(np.linalg.norm(high - low))


def _is_of_arrays(source: Path) -> bool:
    return ".npz" in source.suffixes


@contextmanager
def _named(source: Path) -> Iterator[None]:
    """Provide what goes wrong with a log of arrays, as a line with its name."""
    try:
        yield
    except (OSError, ValueError) as error:
        raise LogError(f"{source}: {getattr(error, 'strerror', None) or error}") from error


def _read_arrays(source: Path, spheres: str | Sequence[int], every: int, velocities: bool) -> PositionLog:
    log = ArrayLog(source)
    steps = log["step"]
    kept = np.flatnonzero(steps % every == 0)
    if kept.size == 0:
        raise LogError(f"{source}: no step left after thinning")
    whole = slice(None) if kept.size == steps.size else kept
    logged, positions = log.spheres, log["positions"]
    chosen = {"all": logged, "last": logged[-1:]}
    asked = chosen[spheres] if isinstance(spheres, str) else np.sort(np.asarray(spheres, dtype=int))
    missing = np.setdiff1d(asked, logged)
    if missing.size:
        raise LogError(f"{source}: step {steps[0]} lacks sphere {missing[0]}")
    columns = slice(None) if asked.size == logged.size else asked - logged[0]
    return PositionLog(
        source=source, steps=steps[whole], time=log["totalTime"][whole],
        elapsed=log["elapsedMilliseconds"][whole] / 1000.0, prediction_error=log["delta"][whole], spheres=asked,
        positions=np.asarray(positions[whole][:, columns], dtype=float),
        velocities=np.asarray(log["velocities"][whole][:, columns], dtype=float) if velocities else None,
        final_step=int(steps[-1]), final_spheres=logged, final_positions=np.asarray(positions[-1], dtype=float),
        warning=log.warning,
        catheters=tuple(np.asarray(log[name][whole], dtype=float) for name in log.catheters) if spheres == "all"
        else (),
    )


class _Entries:
    """Yields (step, entry) of a log; afterwards ``warning`` says whether its end was missing."""

    def __init__(self, source: Path) -> None:
        self.warning: str | None = None
        self._source = source
        self._decoder = json.JSONDecoder()
        self._buffer = ""
        self._at = 0
        self._dropped = 0  # characters before the buffer
        self._ended = False

    def __iter__(self) -> Iterator[tuple[int, dict]]:
        step = -1
        try:
            with open(self._source, encoding="utf-8-sig") as stream:
                self._stream = stream
                try:
                    self._expect("{")
                    if self._peek() == "}":
                        return
                    while True:
                        following = self._key()
                        if following <= step:
                            raise LogError(f"{self._source}: step {following} stands after step {step}")
                        self._expect(":")
                        entry = self._value()
                        step = following
                        yield step, entry
                        if self._expect(",}") == "}":
                            break
                    if self._peek(at_end=True):
                        raise self._unreadable()
                except EOFError:
                    self.warning = f"{self._source}: cut short, read up to step {step}, its last whole step"
        except UnicodeDecodeError as error:
            raise LogError(f"{self._source}: not a text file ({error.reason})") from error
        except OSError as error:
            raise LogError(f"{self._source}: {error.strerror}") from error

    def _more(self) -> None:
        """Reads on. An entry may be longer than a chunk, so what is read grows with what is waiting."""
        if self._ended:
            raise EOFError
        waiting = self._buffer[self._at:]
        text = self._stream.read(max(_CHUNK, len(waiting)))
        self._ended = not text
        self._dropped += self._at
        self._buffer = waiting + text
        self._at = 0

    def _peek(self, at_end: bool = False) -> str:
        """Return the next character that is not white space; at the end of the file "" if ``at_end``."""
        while True:
            while self._at < len(self._buffer):
                if self._buffer[self._at] not in _WHITESPACE:
                    return self._buffer[self._at]
                self._at += 1
            if self._ended and at_end:
                return ""
            self._more()

    def _expect(self, characters: str) -> str:
        found = self._peek()
        if found not in characters:
            raise self._unreadable()
        self._at += 1
        return found

    def _key(self) -> int:
        self._peek()
        key = self._decode()
        if not (isinstance(key, str) and key.isdecimal()):
            raise self._unreadable()
        return int(key)

    def _value(self) -> dict:
        self._peek()
        entry = self._decode()
        if not isinstance(entry, dict):
            raise self._unreadable()
        return entry

    def _decode(self) -> object:
        """Return one JSON value. An error near the end of what has been read is a value still to be read on."""
        while True:
            try:
                value, self._at = self._decoder.raw_decode(self._buffer, self._at)
                return value
            except json.JSONDecodeError as error:
                if len(self._buffer) - error.pos > _LONGEST_TOKEN:
                    self._at = error.pos
                    raise self._unreadable() from error
                self._more()

    def _unreadable(self) -> LogError:
        return LogError(f"{self._source}: not a position log at character {self._dropped + self._at}")


class _Columns:
    """Collects what was asked for, one entry at a time, in flat arrays of numbers."""

    def __init__(self, source: Path, spheres: str | Sequence[int], velocities: bool) -> None:
        self._source = source
        self._asked = spheres
        self._spheres: list[str] | None = None
        self._steps = array("q")
        self._scalars = {name: array("d") for name in ("totalTime", "elapsedMilliseconds", "delta")}
        self._positions = array("d")
        self._velocities = array("d") if velocities else None
        self._catheters: list[array[float]] = []

    def append(self, step: int, entry: dict) -> None:
        try:
            if self._spheres is None:
                self._spheres = self._choose(entry["sphere"])
            self._steps.append(step)
            for name, column in self._scalars.items():
                column.append(float(entry[name]))
            for index in self._spheres:
                sphere = entry["sphere"][index]
                self._positions.extend((float(sphere["x"]), float(sphere["y"]), float(sphere["z"])))
                if self._velocities is not None:
                    self._velocities.extend((float(sphere["vx"]), float(sphere["vy"]), float(sphere["vz"])))
            catheters = entry.get("catheters", []) if self._asked == "all" else []
            if len(self._steps) == 1:
                self._catheters = [array("d") for _ in catheters]
            for column, catheter in zip(self._catheters, catheters, strict=True):
                column.extend(float(part) for node in catheter["sphere"] for part in node)
        except (KeyError, TypeError, ValueError) as error:
            raise LogError(f"{self._source}: step {step} lacks {error}") from error

    def _choose(self, logged: dict) -> list[str]:
        if self._asked == "all":
            return sorted(logged, key=int)
        if self._asked == "last":
            return [max(logged, key=int)]
        return [str(index) for index in sorted(self._asked)]

    def finish(self, step: int, entry: dict, warning: str | None) -> PositionLog:
        if self._spheres is None:
            raise LogError(f"{self._source}: no step left after thinning")
        count = len(self._spheres)
        final = sorted(entry["sphere"], key=int)
        return PositionLog(
            source=self._source,
            steps=np.frombuffer(self._steps, dtype=np.int64),
            time=np.frombuffer(self._scalars["totalTime"]),
            elapsed=np.frombuffer(self._scalars["elapsedMilliseconds"]) / 1000.0,
            prediction_error=np.frombuffer(self._scalars["delta"]),
            spheres=np.array([int(index) for index in self._spheres]),
            positions=np.frombuffer(self._positions).reshape(-1, count, 3),
            velocities=None if self._velocities is None else np.frombuffer(self._velocities).reshape(-1, count, 3),
            final_step=step,
            final_spheres=np.array([int(index) for index in final]),
            final_positions=np.array([[float(entry["sphere"][i][axis]) for axis in "xyz"] for i in final]),
            warning=warning,
            catheters=tuple(np.frombuffer(column).reshape(len(self._steps), -1, 3) for column in self._catheters),
        )

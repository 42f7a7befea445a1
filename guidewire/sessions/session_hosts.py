"""The host that simulates for a session: the runner in a process of its own, or the native library in this one.

Both answer the requests of docs/runs.md; the library also makes steps whose state comes back without text.
"""

from __future__ import annotations

import ctypes
import json
import math
import os
import subprocess
import sys
import threading
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.installed import has_avx2
from guidewire.prepare import DOOR, INSTALLED, ROOT, PreparationError
from guidewire.runs import building
from guidewire.runs.process import end_of
from guidewire.sessions.session_state import PARTS, SessionError, part_of

SECONDS_TO_END = 10.0
STEPS_AT_ONCE = 64  # of a library; between them Ctrl-C is heard
_loaded_by: int | None = None  # the process that loaded the library
_STATE = '{"session": "state"}'


class Ended(Exception):
    """Nobody answers any more. The message is one line."""


class Process:
    """A runner that takes requests by lines."""

    def __init__(self, command: Sequence[str]) -> None:
        # A session of its own: Ctrl-C reaches the script, which then closes this.
        self.process = subprocess.Popen([*command, "-lines"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                        encoding="utf-8", errors="replace", start_new_session=True)

    def ask(self, line: str) -> dict[str, Any]:
        """Return the answer to a request. Raises Ended; what interrupts it, such as Ctrl-C, ends the runner."""
        try:
            try:
                self.process.stdin.write(line + "\n")
                self.process.stdin.flush()
            except OSError:
                pass    # it has died: the end of its output will say so
            reply = self.process.stdout.readline()
        except BaseException:    # its answer would be taken for the next one's
            self.process.kill()
            raise
        if not reply.endswith("\n"):    # it is gone, and perhaps half of its answer is there
            raise Ended(f"the runner of this session ended ({end_of(self.process, SECONDS_TO_END)})")
        try:
            answer = json.loads(reply)
        except ValueError:
            answer = None
        if not isinstance(answer, dict):
            self.process.kill()
            raise Ended(f"the runner of this session wrote {reply.strip()[:200]!r} instead of an answer")
        return answer

    def kill(self) -> None:
        """End it at once; from any thread."""
        self.process.kill()

    def close(self) -> None:
        """End it."""
        try:
            self.process.stdin.close()
            self.process.wait(timeout=SECONDS_TO_END)
        except (OSError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        self.process.stdout.close()


class Library:
    """A session of the native library.

    Parameters
    ----------
    path : the library.

    Raises
    ------
    PreparationError : this processor cannot run it, or it cannot be loaded.
    """

    def __init__(self, path: Path) -> None:
        self._functions = _load(str(path))
        self._number = self._functions.guidewire_new()
        self._layout: Mapping[str, tuple[int, ...]] | None = None    # that of the parts
        # By part of a state, its arrays within the numbers of that part, and how many these are.
        self._parts: list[tuple[list[tuple[str, slice, tuple[int, ...]]], int]] = []
        self._head = (ctypes.c_double * 4)()    # after steps: steps done, time, whether the run has ended, error
        self._grey_levels = 256 * 256    # of the last picture
        self._is_killed = threading.Event()

    def ask(self, line: str) -> dict[str, Any]:
        """Return the answer to a request."""
        if self._is_killed.is_set():
            raise Ended("this session was ended while it made steps")
        return self._answer(line.encode("utf-8"))

    def last(self) -> dict[str, Any]:
        """Return the answer to a request for the state, also of a session that was ended."""
        return self._answer(_STATE.encode("ascii"))

    def step(self, motion: Sequence[float], steps: int) -> tuple[int, float, float] | dict[str, Any]:
        """Make steps.

        Parameters
        ----------
        motion : push, units, and turn, rad, of each hub in all of them together, the wire's first; others rest.

        Returns
        -------
        Steps done since the start, the time (s) and the prediction error (units); or the answer of a session that
        refused, or whose run has ended, with its state.
        """
        step, head, count = self._functions.guidewire_step, self._head, len(motion)
        of_each = (ctypes.c_double * count)(*(one / steps for one in motion))
        for done in range(0, steps, STEPS_AT_ONCE):
            if self._is_killed.is_set():
                raise Ended("this session was ended while it made steps")
            if not step(self._number, of_each, count // 2, min(STEPS_AT_ONCE, steps - done), head):
                return self._answer(b"")
            if head[2]:
                return self.ask(_STATE)
        return int(head[0]), head[1], head[3]

    def read(self, part: int, layout: Mapping[str, tuple[int, ...]]) -> dict[str, np.ndarray] | None:
        """Read a part of the state off.

        Parameters
        ----------
        layout : the arrays of a state and their shapes.

        Returns
        -------
        The arrays of that part, by name; None where the session has others than the layout says.
        """
        if layout is not self._layout:
            self._lay_out(layout)
        arrays, count = self._parts[part]
        numbers = np.empty(count)    # new ones for each state: its arrays are parts of them
        if self._functions.guidewire_state(self._number, part, numbers.ctypes.data, count) != count:
            return None
        return {name: numbers[where].reshape(shape) for name, where, shape in arrays}

    def picture(self, view: str, positions: np.ndarray | None) -> np.ndarray | dict[str, Any]:
        """Take a fluoroscopic picture.

        Parameters
        ----------
        view : which, as JSON.
        positions : x, y, z of the wire's nodes and then of each catheter's, doubles; None: as they are now.

        Returns
        -------
        Grey levels, (pixels, pixels) of uint8; or the answer of a session that refused.
        """
        if self._is_killed.is_set():
            raise Ended("this session was ended")
        text = view.encode("utf-8")
        nodes, count = (None, 0) if positions is None else (positions.ctypes.data, positions.size)

        def take(grey: np.ndarray) -> int:
            return self._functions.guidewire_picture(self._number, text, len(text), nodes, count,
                                                     grey.ctypes.data, grey.size)

        grey = np.empty(self._grey_levels, dtype=np.uint8)
        written = take(grey)
        if written == 0:
            return self._answer(b"")
        if written != grey.size:    # pictures of another size than before
            self._grey_levels = written
            grey = np.empty(written, dtype=np.uint8)
            if take(grey) == 0:
                return self._answer(b"")
        side = math.isqrt(written)
        return grey.reshape(side, side)

    def kill(self) -> None:
        """End it, at once or after some steps; from any thread."""
        self._is_killed.set()

    def close(self) -> None:
        """Forget the session."""
        self._functions.guidewire_close(self._number)

    def _lay_out(self, layout: Mapping[str, tuple[int, ...]]) -> None:
        self._layout, self._parts = layout, []
        for part in PARTS:
            arrays, count = [], 0
            for name, shape in layout.items():
                if part_of(name) == part:
                    end = count + math.prod(shape)
                    arrays.append((name, slice(count, end), shape))
                    count = end
            self._parts.append((arrays, count))

    def _answer(self, request: bytes) -> dict[str, Any]:
        length = ctypes.c_int()
        answer = self._functions.guidewire_ask(self._number, request, len(request), ctypes.byref(length))
        try:
            return json.loads(ctypes.string_at(answer, length.value))
        finally:
            self._functions.guidewire_free(answer)


@cache
def _load(path: str) -> ctypes.CDLL:
    global _loaded_by
    if reason := obstacle():
        raise PreparationError(f"{path}: {reason}")
    try:
        functions = ctypes.CDLL(path)
    except OSError as error:
        raise PreparationError(f"{path}: {error}") from error
    _loaded_by = os.getpid()
    number, count, data = ctypes.c_longlong, ctypes.c_int, ctypes.c_void_p
    for name, result, arguments in (
        ("new", number, []), ("ask", data, [number, ctypes.c_char_p, count, data]), ("free", None, [data]),
        ("step", count, [number, data, count, count, data]), ("state", count, [number, count, data, count]),
        ("close", None, [number]), ("lanes", count, []),
        ("picture", count, [number, ctypes.c_char_p, count, data, count, data, count]),
        ("folder", None, [ctypes.c_char_p]),
    ):
        function = getattr(functions, f"guidewire_{name}")
        function.restype, function.argtypes = result, arguments
    functions.guidewire_folder(os.fsencode(ROOT))
    return functions


def obstacle() -> str:
    """Why this process may not load the library, in one line; empty where it may."""
    if _loaded_by not in (None, os.getpid()):    # the threads that collect its memory are not there
        return "a process forked from one with native sessions cannot have its own: start it by 'spawn'"
    # The package has a library for older processors.
    return "" if INSTALLED or has_avx2() else "the native library needs a processor of x86-64-v3 (AVX2)"


def lanes(path: Path) -> int:
    """Return how many numbers the library computes with at once, 4 where its vector paths are on."""
    return _load(str(path)).guidewire_lanes()


@cache
def _found(find: Callable[[], Path | None]) -> Path | None:
    """Return what it finds, asked once in a process: to compare 700 sources takes as long as to open a session."""
    return find()


def host_of(native: bool | None) -> Library | Process:
    """Return what simulates: the native library where it has been built and is not refused, else a process."""
    reason = "" if native is False else obstacle()
    if native and reason:
        raise SessionError(reason)
    library = None if native is False or reason else _found(building.native_library)
    if library is None and native:
        raise SessionError(f"the native library is not built from these sources: '{DOOR} native' builds it")
    if library is not None:
        return Library(library)
    return Process(building.build(building.RUNNER, lambda line: print(line, file=sys.stderr, flush=True)))

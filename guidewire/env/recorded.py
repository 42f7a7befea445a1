"""The motion of the hub in an episode, saved to a file and replayed with the same bits."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.env.spaces import Error
from guidewire.runs.whole_files import write_whole
from guidewire.sessions.session import State

_FORMATS = ("guidewire drive 1", "guidewire drive 2")  # the second of several hubs


@dataclass(frozen=True)
class RecordedDrive:
    """Calls of a session, from the start of an episode.

    Attributes
    ----------
    task : name.
    options : of the reset that began it.
    calls : push (units), turn (rad) and steps of each; of several hubs lists of push and turn, the wire's first.
    digest : of the instruments at the end.
    source : how it was steered.
    """

    task: str
    options: Mapping[str, Any]
    calls: Sequence[tuple[Any, Any, int]]
    digest: str
    source: str = ""

    def save(self, file: str | Path) -> None:
        """Write it as JSON; numbers read back to the same bits."""
        self.save_all([self], file)

    @staticmethod
    def save_all(drives: Sequence[RecordedDrive], file: str | Path) -> None:
        """Write several, one in a line."""
        write_whole(Path(file), "".join(json.dumps({
            "format": one._format, "task": one.task, "options": one.options, "source": one.source,
            "digest": one.digest, "calls": one.calls}) + "\n" for one in drives))

    @property
    def _format(self) -> str:
        return _FORMATS[any(isinstance(call[0], (list, tuple)) for call in self.calls)]

    @staticmethod
    def load(file: str | Path) -> RecordedDrive:
        """Read one, the first of several.

        Raises
        ------
        Error : the file is missing or is no recorded drive.
        """
        return RecordedDrive.load_all(file)[0]

    @staticmethod
    def load_all(file: str | Path) -> list[RecordedDrive]:
        """Read all; errors as of `load`."""
        try:
            drives = []
            for line in Path(file).read_text(encoding="utf-8").splitlines():
                read = json.loads(line)
                if read["format"] not in _FORMATS:
                    raise ValueError(f"format is {read['format']!r}")
                drives.append(RecordedDrive(read["task"], read["options"], [tuple(call) for call in read["calls"]],
                                            read["digest"], read["source"]))
            if not drives:
                raise ValueError("it is empty")
            return drives
        except OSError as error:
            raise Error(f"{file}: {error.strerror}") from error
        except (ValueError, KeyError, TypeError) as error:
            raise Error(f"{file}: no recorded drive ({error})") from error


def digest_of(state: State) -> str:
    """Return a sum over the bits of positions, velocities, orientations and spins, and of places and frames of
    catheters."""
    parts = [state.positions, state.velocities, state.orientations, state.angular_velocities]
    for catheter in state.catheters:
        parts += [catheter.positions, catheter.orientations]
    return hashlib.sha256(b"".join(np.ascontiguousarray(part, dtype="<f8").tobytes() for part in parts)).hexdigest()

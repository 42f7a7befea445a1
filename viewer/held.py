"""The instruments of a run under the hand of a page: which of them the hand holds, and what was steered of each."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from analysis.instruments.library import FOLDER, find_files
from experiments.prepare import ROOT
from experiments.session import Session
from viewer.steered import Steered, exact_push, exact_turn


class HeldInstruments:
    """The wire and the catheters of a run; one of their hubs is held at a time.

    Parameters
    ----------
    session : the run, at its start.
    described : as of `Session.describe`.
    scene : its parameter file.

    Attributes
    ----------
    names : of the instruments, the wire first.
    held : number of the one whose hub is held.
    choices : for each of them the names that can stand for it: those of the folder beside the scene's file, then the
        program's; for a catheter only catheters. Empty where the run's method takes no instrument.
    """

    def __init__(self, session: Session, described: Mapping[str, Any], scene: Path) -> None:
        self.names: list[str] = [one["name"] for one in described["instruments"]]
        self.held = 0
        self._has_hand = session.hand
        self._parameters = session.parameters
        self.choices: list[list[str]] = []
        if "instrument" in session.parameters:
            files = find_files([scene.resolve().parent / FOLDER, ROOT / FOLDER])
            catheters = [name for name, file in files.items() if _is_catheter(file)]
            self.choices = [list(files), *(catheters for _ in self.names[1:])]
        self.begin()

    def begin(self) -> None:
        """The run is at its start; the same hub stays held."""
        self._steered = [Steered(self._parameters) for _ in self.names]

    def hold(self, number: int) -> None:
        """Take another one; raises ValueError where there is none of this number."""
        if isinstance(number, bool) or not isinstance(number, int) or not 0 <= number < len(self.names):
            raise ValueError("no such instrument")
        self.held = number

    def in_a_step(self, push: float, turn: float) -> tuple[float, float]:
        """What is asked of the held hub in a step, units and rad, such that a table can say it."""
        if not self._has_hand:
            return 0.0, 0.0
        metres = self._parameters.get("metresPerUnit")
        return (push, turn) if metres is None else (exact_push(push, metres), exact_turn(turn))

    def add(self, number: int, push: float, turn: float, steps: int) -> None:
        """Note steps that were made with so much push (units) and turn (rad) of one hub in each."""
        for k, steered in enumerate(self._steered):
            steered.add(push if k == number else 0.0, turn if k == number else 0.0, steps)

    def invalidate(self, why: str) -> None:
        """From here on no table says what was steered."""
        for steered in self._steered:
            steered.invalidate(why)

    def status(self) -> dict[str, Any]:
        """What a page is told."""
        catheters = self._parameters.get("catheters") or []
        chosen = [self._parameters.get("instrument") or "", *(one.get("instrument", "") for one in catheters)]
        return {"instruments": self.names, "held": self.held, "named": self.choices, "chosen": chosen}

    @property
    def problem(self) -> str:
        """Why no table says what was steered; empty where one does."""
        return self._steered[0].problem

    def to_csv(self, number: int) -> str:
        """What was steered of one hub since the start, as a drive table. Raises IndexError where there is none."""
        return self._steered[number].to_csv()


def key_of(number: int) -> str:
    """The key that names an instrument of a scene: 0 the wire, k catheter k."""
    return f"catheters[{number - 1}].instrument" if number else "instrument"


def _is_catheter(file: Path) -> bool:
    try:
        return json.loads(file.read_text(encoding="utf-8-sig")).get("kind") == "catheter"
    except (OSError, ValueError, AttributeError):
        return False    # the runner says what is wrong with it, once it is chosen

"""The value of a parameter at which a wire at rest loses its stability, as on a bench: turned or loaded until it snaps.

Each state at rest is found from the one before, so the search follows one branch of equilibria. Where the branch ends,
or loses its stability, the next state lies elsewhere: the shape jumps.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from guidewire.identification.trials import Trials
from guidewire.logs.logs import read_columns
from guidewire.prepare import PreparationError

_BEYOND = 3.0    # times the measured value, up to which is searched
_PARTS = 30    # of the measured value, in each of which the next state is found
_JUMP = 0.02    # of the length: a displacement beyond the expected one that is a snap
_NEAR = 1e-5    # of the measured value: far below the step of a difference quotient
_REST = {"initialState": "equilibrium", "maxSimulationSteps": 0, "logOrientations": True}


def find_critical(trials: Trials, values: Mapping[str, Any], scene: Mapping[str, Any], key: str, guess: float) -> float:
    """Return the value of `key` at which the wire snaps, in the key's unit.

    Parameters
    ----------
    trials : makes the runs.
    values : overrides of all of them.
    scene : every effective value, from whose value of `key` the search begins.
    key : a number of the scene, such as distalRotation.
    guess : about where; the search goes on to three times this value.

    Raises
    ------
    PreparationError : it does not snap up to there, or the scene's own state has no rest.
    """
    start = float(scene[key])
    length = float(scene["guidewireLength"])
    state = _rest(trials, values, key, start, scene.get("start") or {})
    if state is None:
        raise PreparationError(f"critical {key}: the wire has no rest at the scene's own value {start:g}")
    at, step, before = start, (guess - start) / _PARTS, None
    while abs(at - start) < abs(_BEYOND * (guess - start)):
        after = _rest(trials, values, key, at + step, state)
        moved = None if after is None else np.array(after["positions"]) - np.array(state["positions"])
        expected = np.zeros_like(moved) if before is None or moved is None else before * step
        if moved is not None and np.max(np.linalg.norm(moved - expected, axis=1)) < _JUMP * length:
            at, state, before = at + step, after, moved / step
            continue
        if abs(step) < _NEAR * abs(guess - start):
            return at + 0.5 * step
        step *= 0.5
    raise PreparationError(f"critical {key}: the wire does not snap up to {at:g}")


def _rest(trials: Trials, values: Mapping[str, Any], key: str, value: float, state: Mapping[str, Any]
          ) -> dict[str, Any] | None:
    """Return the state at rest that the search of the minimum finds from another; None where there is none."""
    asked: dict[str, Any] = {key: value}
    start = dict(state)
    if key == "distalRotation" and "distalFrame" in start:    # counted from the start, and each state is a new one
        turned = Rotation.from_quat(start["distalFrame"]) * Rotation.from_rotvec([0.0, 0.0, value])
        start["distalFrame"], asked = turned.as_quat().tolist(), {key: 0.0}
    (folder,) = trials.run([{**values, **_REST, **({"start": start} if start else {}), **asked}])
    if not isinstance(folder, Path):
        return None
    rest = read_columns(folder, ("positions", "orientations"))
    trials.forget(folder)
    frames = {name: state[name] for name in ("proximalFrame", "distalFrame") if name in state}
    return {**{name: values[0].tolist() for name, values in rest.items()}, **frames}

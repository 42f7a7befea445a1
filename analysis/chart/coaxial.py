"""Problems of two coaxial instruments: tubes that are turned until they snap, and the position of their tip before
that."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from analysis.chart import settings
from analysis.chart.points import Asked, Problem, Setting, case
from analysis.validation import scenes
from analysis.validation.coaxial import BEGIN, SNAPS, Pair, even, tip_of, turning
from analysis.validation.concentric import coupling, snap_angle, turned_tip
from guidewire.logs.hub import read_hub, snap_turns
from guidewire.logs.runs import Run
from guidewire.studies.table import Case

_ALONE = "takes one instrument"
ABSENT = {"pbd": _ALONE, "xpbd": _ALONE, "explicit": _ALONE}
_SPEED = 10.0  # degrees/s of the inner hub; all motions of the tubes are fast against it
_TURNED = ((5, 5.0), (5, 2.5), (10, 2.5), (10, 1.0), (10, 0.5), (20, 0.5), (20, 0.2), (20, 0.05), (40, 0.05))
_PAST = 1.03  # of the angle of the snap, where a run ends


def _snap(name: str) -> scenes.Asking[Asked]:
    """Error of a hub angle known to one step: of the farther end of that in which it snaps."""
    yield []
    ratio, nu, curvature, straight = SNAPS[name]
    exact = snap_angle(coupling(ratio, nu, curvature), straight)

    def error(run: Run) -> float:
        log = read_hub(run.folder)
        ends = [math.radians(BEGIN) + turns for turns in snap_turns(log.turn, log.torque)]
        return max(abs(float(end[0]) / exact - 1.0) for end in ends) if len(ends[0]) == 1 else math.nan

    made = []
    for n, degrees in _TURNED:
        pair = even(n, ratio, nu, curvature, math.radians(BEGIN), straight * (1.0 + ratio))
        steps = math.ceil((_PAST * math.degrees(exact) - BEGIN) / degrees)
        made.append(_turning(pair, degrees, steps))
    return Asked(made, lambda _: (error, "theta'' = c sin theta, solved as a differential equation"))


def _setting(words: tuple[str, str], made: Case) -> Setting:
    return Setting("direct", *words, case(made.key, "direct", made.overrides))


def _turning(pair: Pair, degrees: float, steps: int) -> Setting:
    """Turn at _SPEED."""
    step = degrees / _SPEED
    return _setting(settings.direct("implicitEuler", pair.elements, step),
                    turning(pair, degrees, steps, f"turned-{pair.elements}-{steps}", step))


_RATIO, _NU, _CURVATURE = 1.0, 0.3, 2.0  # B_2/B_1, EI/GJ - 1, k L
_ANGLE = 120.0  # degrees


def _tip() -> scenes.Asking[Asked]:
    """Rest shapes at once, and hubs that turn up to that angle."""
    yield []
    turn = math.radians(_ANGLE)
    exact = turned_tip(_RATIO, _NU, _CURVATURE, turn)

    def error(run: Run) -> float:
        return float(np.linalg.norm(tip_of(run) - exact))

    made = [_setting((f"rest shape at once, n = {n}", f"at once n{n}"),
                     even(n, _RATIO, _NU, _CURVATURE, turn, timeStep=_ANGLE / _SPEED).case(f"at-once-{n}"))
            for n in (5, 10, 20, 40)]
    made += [_turning(even(n, _RATIO, _NU, _CURVATURE, 0.0), _ANGLE / steps, steps)
             for n, steps in ((5, 5), (10, 5), (10, 20), (20, 20), (20, 100), (40, 100))]
    return Asked(made, lambda _: (error, "the differential equations of concentric tubes"))


def _snaps() -> Iterator[Problem]:
    for name in SNAPS:
        yield Problem(f"snap-{list(SNAPS).index(name) + 1}", f"snap of two tubes, {name}", "angle of the hub, relative",
                      lambda name=name: _snap(name), ABSENT)


PROBLEMS = (
    *_snaps(),
    Problem("turned-tip", "two tubes turned by 120°", "tip's distance, of L", _tip, ABSENT),
)

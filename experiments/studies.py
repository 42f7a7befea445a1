"""What is run: each study is a scene, one parameter and its values. Running them is experiments/sweep.py.

The longitudinal studies of the thesis (Figures 4.5 to 4.9) start from its Table 4.1 and change one parameter each.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Study:
    """A scene and one parameter of it that takes several values.

    Attributes
    ----------
    name : folder of the study in the results, and its name on the command line.
    title : what is varied, for people.
    scene : parameter file, relative to the repository.
    parameter : key that takes the values, or None where the scene is run as it is.
    values : its values, ascending, in the unit of the key.
    common : overrides of every run.
    repeats : number of timed repeats of each run, made with no other run beside them.
    """

    name: str
    title: str
    scene: str
    parameter: str | None = None
    values: tuple[float, ...] = ()
    common: Mapping[str, Any] = field(default_factory=dict)
    repeats: int = 5

    def runs(self) -> list[StudyRun]:
        """Every run: first one per value whose log is analysed, then the timed repeats.

        The repeats go through all values before the next repeat, so that a machine that slows down for a while
        slows every value's repeats alike.
        """
        points = [("default", None)] if self.parameter is None else [
            (f"{self.parameter}={value:g}", value) for value in self.values
        ]
        return [
            StudyRun(key, value, self._overrides(value, repeat), repeat)
            for repeat in (None, *range(1, self.repeats + 1))
            for key, value in points
        ]

    def _overrides(self, value: float | None, repeat: int | None) -> dict[str, Any]:
        varied = {} if self.parameter is None else {self.parameter: value}
        return {**self.common, **varied, **({} if repeat is None else _TIMED)}


@dataclass(frozen=True)
class StudyRun:
    """One run of a study.

    Attributes
    ----------
    key : names the value, such as `timeStep=0.01`; folder of the run within the study.
    value : value of the study's parameter, or None where it has none.
    overrides : parameter key to value, laid over the scene.
    repeat : number of the timed repeat, or None for the run whose log is analysed.
    """

    key: str
    value: float | None
    overrides: Mapping[str, Any]
    repeat: int | None

    @property
    def folder(self) -> str:
        """Folder of the run, relative to the study's."""
        return self.key if self.repeat is None else f"{self.key}/repeat-{self.repeat}"


_TABLE_4_1 = "params/default.json"
_TIMED = {"logSpheres": "last"}  # a timed run's log is read for its times only

STUDIES: dict[str, Study] = {
    study.name: study
    for study in (
        Study("default", "the default run", _TABLE_4_1),
        Study(
            "constraint-solver-steps", "constraint solver steps m", _TABLE_4_1, "constraintSolverSteps",
            tuple(range(100, 1001, 100)),
        ),
        Study("rod-elements", "rod elements n", _TABLE_4_1, "numberRodElements", tuple(range(5, 61, 5))),
        Study(
            "displacement", "displacement of the first sphere", _TABLE_4_1, "displacement",
            (1, *range(10, 101, 10)),
        ),
        Study(
            "time-step", "time step size dt", _TABLE_4_1, "timeStep",
            (1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2, 1e-1),
        ),
        Study(
            "total-mass", "total mass M", _TABLE_4_1, "totalMass",
            (1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2, 1e-1, 2e-1, 5e-1, 1.0),
        ),
    )
}

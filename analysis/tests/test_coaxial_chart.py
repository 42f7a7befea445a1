"""The chart's problems of two coaxial instruments, at their coarser settings: errors as the closed forms have them."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import pytest

from analysis.chart import coaxial
from analysis.chart.points import Charted, Problem, check_of
from guidewire.sweeps.check import replay
from guidewire.sweeps.sweep import Means, sweep
from tools.testing import FULL_CAMPAIGNS


def charted(problem: Problem, count: int, folder: Path, command: list[str]) -> Charted:
    """The first settings of a problem, once."""
    def ask():
        asked = yield from problem.ask()
        kept = [replace(one, case=replace(one.case, repeats=1)) for one in asked.settings[:count]]
        return replace(asked, settings=kept)

    check = check_of(replace(problem, ask=ask))
    assert sweep([(check, folder)], folder / "runs", Means(command)).failures == []
    return replay(check, folder)


# Of the three tubes that snap one problem; the angles of the others are tests of Core (CoaxialStaticsTests).
SNAPS = coaxial.PROBLEMS[:3] if FULL_CAMPAIGNS in os.environ else coaxial.PROBLEMS[:1]


@pytest.mark.parametrize("problem", SNAPS, ids=lambda problem: problem.name)
def test_a_snap_is_found_within_its_step(problem: Problem, tmp_path: Path, runner_command: list[str]) -> None:
    for point in charted(problem, 4, tmp_path, runner_command).points:
        n, step = (point.setting.case.overrides[key] for key in ("numberRodElements", "timeStep"))
        # Errors of 10 elements are 0.15 % in the angle, of 5 four times that; the step is known at its ends.
        assert 0.0 < point.error < 0.0015 * (10 / n) ** 2 + 10.0 * step / 180.0


def test_the_tip_of_turned_tubes_converges_in_second_order(tmp_path: Path, runner_command: list[str]) -> None:
    found = charted(coaxial.PROBLEMS[3], 10, tmp_path, runner_command)
    by_elements: dict[int, list[float]] = {}
    for point in found.points:
        by_elements.setdefault(point.setting.case.overrides["numberRodElements"], []).append(point.error)
    for n, errors in by_elements.items():  # at once, and turned in steps of any length
        assert errors == pytest.approx([errors[0]] * len(errors), rel=0.1)
        assert 2 * n not in by_elements or 3.5 < errors[0] / by_elements[2 * n][0] < 4.5
    assert sorted(by_elements) == [5, 10, 20, 40] and by_elements[40][0] < 2e-4

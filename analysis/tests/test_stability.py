"""Limits of gains and steps: the chain's against the closed forms, and against a sweep done by hand."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from analysis.figures import FIGURES
from analysis.stability import (
    _sweep_across, _sweep_along, closed_form_along, limit_across, limit_along, limit_explicit, lost_turns,
    read_frontiers,
)
from analysis.tests.turning_spring import ESDIRK4, TRBDF2, largest_energy
from analysis.validation.wire import Wire
from guidewire.logs.logs import LogError
from guidewire.studies.frontiers import LENGTH, MASS


def test_long_wires_of_many_sweeps_come_to_the_closed_forms() -> None:
    assert limit_along(60, 2000) == pytest.approx(closed_form_along(60), rel=2e-3)
    assert limit_across(60, 2000, "stretchStiffness") == pytest.approx(2.0, rel=2e-3)
    assert limit_across(60, 2000, "bendStiffness") == pytest.approx(LENGTH / 60, rel=2e-3)


def test_one_element_is_taken_back_by_the_part_that_its_sphere_moves() -> None:
    """Of a lone element only sphere 1 moves: 1 - g w/(w + 4 l^2) of a stretch is left, with l = 300 and w = 2/M."""
    w = 2.0 / MASS
    assert _sweep_along(1, 0.3)[0, 0] == pytest.approx(1.0 - 0.3 * w / (w + 4.0 * LENGTH**2))


def test_a_sweep_of_gain_one_leaves_no_error_in_the_last_constraint() -> None:
    random = np.random.default_rng(1)
    state = random.normal(size=12)
    after = _sweep_across(6, 1.0, 0.5 * LENGTH / 6) @ state  # 2 gain/l = 1
    assert after[11] == pytest.approx(after[10])  # the last two elements' angles
    along = _sweep_along(2, (2.0 / MASS * 1.5 * 2 + 4.0 * 150.0**2) / (2 * 3.0 / MASS)) @ np.array([0.3, -0.4])
    assert along[0] == pytest.approx(along[1])  # no stretch between spheres 1 and 2


def test_an_explicit_step_of_a_short_wire_is_that_of_its_shear() -> None:
    """n = 1: turning against shear, omega^2 = 4 kGA/(m L) + kGA/(rho I), where m = rho A L."""
    wire = Wire()
    mass, turning = wire.line_density * wire.length, wire.density * wire.second_moment
    omega = np.sqrt(4.0 * wire.shearing / (mass * wire.length) + wire.shearing / turning)
    assert limit_explicit(wire, 1) == pytest.approx(2.0 / omega, rel=1e-9)


def test_caption_says_how_far_frontiers_are_from_their_limits_and_what_is_lost(
    drawn: dict[str, tuple[Figure, str]]
) -> None:
    figure, caption = drawn["stability"]
    assert len([axes for axes in figure.axes if axes.axison]) == 5
    assert "from m = 100 on the limit lies at 2.010 to 2.010" in caption
    assert "within 0.50 % of the closed form" in caption and "within 0.10 % of 2/ω_max" in caption
    assert "crosses are lost: esdirk4 (sags, 100 ms): diverged. All others hold." in caption
    crosses = [line for line in figure.axes[4].lines if line.get_marker() == "x"]
    assert len(crosses) == 1 and crosses[0].get_xdata()[0] == 100.0


def test_a_frontier_that_was_not_found_is_reported(studies: dict[str, Path], tmp_path: Path) -> None:
    (tmp_path / "frontier.csv").write_text(
        "variant,constraintSolverSteps,numberRodElements,key,low,high,fails,note\nverlet,20,30,gain,,,,holds at "
        "both ends\n")
    assert np.isnan(read_frontiers(tmp_path)[0].middle)
    with pytest.raises(LogError, match="lies outside the range"):
        FIGURES["stability"].draw({**studies, "limit-bend": tmp_path})
    (tmp_path / "frontier.csv").write_text("a,b\n1,2\n")
    with pytest.raises(LogError, match="not a table of frontiers"):
        read_frontiers(tmp_path)


def test_esdirk4_gains_energy_from_a_stiff_spring_that_turns_and_from_nothing_else() -> None:
    """Why long steps lose a pendulum: a mass on one stiff spring is lost as the wire is, at 100 ms; on a soft one, on a
    rod, or by trbdf2 it is not."""
    step, steps = 0.1, 150
    assert largest_energy(ESDIRK4, step, steps, 1e8) > 1.0
    assert largest_energy(ESDIRK4, step, steps, 1e3) < 0.01
    assert largest_energy(ESDIRK4, step, steps, None) < 0.01
    assert largest_energy(TRBDF2, step, steps, 1e8) < 0.01


def test_gates_name_frontiers_that_are_elsewhere(studies: dict[str, Path], tmp_path: Path) -> None:
    gates = FIGURES["stability"].gates
    assert gates(studies) == []
    (tmp_path / "frontier.csv").write_text(
        "variant,constraintSolverSteps,numberRodElements,key,low,high,fails,note\n"
        "verlet,100,30,gain,2.09,2.1,diverged,holds below\n"
        "verlet,20,30,gain,1.5,1.6,diverged,holds below\n")
    (line,) = gates({**studies, "limit-stretch-across": tmp_path})
    assert "stretch stiffness, across" in line and "numberRodElements = 30" in line and "above its limit 1.5 %" in line


@pytest.mark.parametrize("damping", [0.0, 0.5, 1.0])
def test_the_limit_of_a_damped_wire_is_where_its_own_steps_begin_to_grow(damping: float) -> None:
    """Steps of a chain, done one by one with one sweep each: p = (2 - d) x_k - (1 - d) x_(k-1)."""
    n, limit = 10, limit_along(10, 1, damping)
    l, w = LENGTH / n, np.array([0.0, *np.full(n, (n + 1) / MASS)])

    def growth(gain: float) -> float:
        before = x = np.concatenate([[0.0], np.random.default_rng(1).normal(size=n)])
        sizes = []
        for _ in range(2000):
            before, x = x, (2.0 - damping) * x - (1.0 - damping) * before
            for j in range(n):
                stretch = gain * (x[j + 1] - x[j]) / (w[j] + w[j + 1] + 4.0 * l * l)
                x[j], x[j + 1] = x[j] + w[j] * stretch, x[j + 1] - w[j + 1] * stretch
            sizes.append(float(np.max(np.abs(x))))
        return max(sizes[1000:]) / max(sizes[:1000])

    assert growth(0.99 * limit) < 1.0 < growth(1.01 * limit)


def test_a_turn_is_lost_where_a_joint_is_turned_by_more_than_it_gives_back() -> None:
    """Two elements, the first held and turned by so much a step: it is followed where that is little."""
    assert lost_turns(2, 1, 0.02, np.array([0.001, 0.1, 3.0]), 200).tolist() == [False, False, True]

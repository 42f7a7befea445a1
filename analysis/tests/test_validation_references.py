"""The references against numbers published elsewhere, other closed forms, and conservation laws."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigh, expm
from scipy.spatial.transform import Rotation

from analysis.validation import (
    bar, beam, drum, elastica, planar_stability, planes, release, suite, tube_buckling, tubes,
    twisted, twisted_tube, whip,
)
from analysis.validation.wire import BASE, Wire

HALF = np.linspace(0.0, 1.0, 11)


def test_base_wire_has_the_stiffness_of_its_material() -> None:
    assert BASE.bending == pytest.approx(2.945243e-3, rel=1e-6)
    assert BASE.torsion == pytest.approx(2.258020e-3, rel=1e-6)
    assert BASE.stretching == pytest.approx(47123.89, rel=1e-7)
    assert BASE.line_density == pytest.approx(5.065818e-3, rel=1e-6)


# Deflection and shortening of the tip over L: Mattiasson (1981), Table 1, and Bisshopp and Drucker (1945).
@pytest.mark.parametrize(
    "load, across, shortening",
    [(1.0, 0.301720774, 0.0564332363), (2.0, 0.493457480, 0.160641721), (10.0, 0.810609025, 0.554995598)],
)
def test_tip_load_agrees_with_published_tables(load: float, across: float, shortening: float) -> None:
    tip = elastica.tip_loaded(load, HALF).tip
    assert tip == pytest.approx((1.0 - shortening, across), abs=2e-9)


@pytest.mark.parametrize(
    "radius, along, across", [(0.5e-3, 0.299446369, 0.0170399963), (0.2e-3, 0.281225454, 0.0975643958)]
)
def test_own_weight_agrees_with_an_independent_solution(radius: float, along: float, across: float) -> None:
    wire = Wire(radius=radius)
    load = wire.line_density * 9.81 * wire.length**3 / wire.bending
    tip = wire.length * np.array(elastica.heavy(load, HALF).tip)
    np.testing.assert_allclose(tip, [along, across], atol=1e-9)


def test_small_own_weight_gives_the_beams_compliance() -> None:
    assert elastica.heavy(1e-4, HALF).tip[1] / 1e-4 == pytest.approx(1.0 / 8.0, rel=1e-6)
    assert elastica.tip_loaded(1e-4, HALF).tip[1] / 1e-4 == pytest.approx(1.0 / 3.0, rel=1e-6)


def test_shape_keeps_its_length() -> None:
    fine = np.linspace(0.0, 1.0, 4001)
    shape = elastica.tip_loaded(10.0, fine)
    assert np.sum(np.hypot(np.diff(shape.along), np.diff(shape.across))) == pytest.approx(1.0, abs=1e-6)


def test_tip_on_a_plane_agrees_with_an_independent_solution() -> None:
    wire = Wire(radius=0.3e-3)
    load = wire.line_density * 9.81 * wire.length**3 / wire.bending
    shape, force = elastica.heavy_on_plane(load, 20e-3 / wire.length, HALF)
    assert force * wire.bending / wire.length**2 == pytest.approx(1.16164e-3, rel=1e-5)
    assert shape.tip[1] == pytest.approx(20e-3 / wire.length) and np.max(shape.across) <= shape.tip[1] + 1e-12


def test_lightly_loaded_tip_on_a_plane_is_a_propped_cantilever() -> None:
    """N = 3 EI/L^3 (w L^4/(8 EI) - d)."""
    load, drop = 1e-3, 0.5e-4
    _, force = elastica.heavy_on_plane(load, drop, HALF)
    assert force == pytest.approx(3.0 * (load / 8.0 - drop), rel=1e-5)


def test_cantilever_has_its_tabulated_frequencies() -> None:
    np.testing.assert_allclose(beam.mode_numbers(3), [1.875104069, 4.694091133, 7.854757438], rtol=1e-9)
    np.testing.assert_allclose(beam.frequencies(BASE, 3), [4.7409366, 29.710943, 83.1915], rtol=1e-7)


@pytest.mark.parametrize("derivative", [1, 2, 3])
def test_mode_shapes_have_their_derivatives(derivative: int) -> None:
    for number in beam.mode_numbers(6):
        step = 1e-5 / number
        points = np.linspace(0.1, 0.9, 9)
        central = (
            beam.mode_shape(number, points + step, derivative - 1)
            - beam.mode_shape(number, points - step, derivative - 1)
        ) / (2.0 * step)
        scale = number**derivative
        np.testing.assert_allclose(beam.mode_shape(number, points, derivative) / scale, central / scale, atol=1e-8)


def test_mode_shapes_are_clamped_and_free() -> None:
    for number in beam.mode_numbers(12):
        held = [beam.mode_shape(number, np.array(0.0), k) / number**k for k in (0, 1)]
        free = [beam.mode_shape(number, np.array(1.0), k) / number**k for k in (2, 3)]
        np.testing.assert_allclose(held + free, 0.0, atol=1e-9)
        assert beam.mode_shape(number, np.array(1.0)) == pytest.approx(2.0)


# Greenhill (1883): tan(x) = x, and with tension from the beam equation, an independent solution.
@pytest.mark.parametrize("tension, moment", [(0.0, 8.987), (1.0, 9.134), (10.0, 10.429)])
def test_clamped_rod_has_its_critical_couple(tension: float, moment: float) -> None:
    assert twisted.clamped_moment(tension) == pytest.approx(moment, abs=1e-3)


def test_critical_couple_has_no_jump_at_zero_tension() -> None:
    assert twisted.clamped_moment(1e-6) == pytest.approx(twisted.clamped_moment(0.0), rel=1e-6)


def test_bar_chain_moves_as_its_matrix_exponential_says() -> None:
    chain = bar.BarChain(5, 0.2, 3.0, 1e-3)
    links = 2.0 * np.eye(5) - np.eye(5, k=1) - np.eye(5, k=-1)
    links[-1, -1] = 1.0
    matrix = np.block([[np.zeros((5, 5)), np.eye(5)], [-15.0 * links, np.zeros((5, 5))]])
    start = np.concatenate([np.full(5, -1e-3), np.zeros(5)])
    for time in (0.0, 0.3, 2.0):
        moved = 1e-3 + (expm(time * matrix) @ start)[:5]
        np.testing.assert_allclose([chain.motion(np.array(time), node) for node in range(1, 6)], moved, atol=1e-15)


def test_release_keeps_its_energy() -> None:
    """Kinetic and bending energy of a large swing, both by quadrature: the equations are those of this energy."""
    system = release.cantilever(6, 1e-4)
    start = np.concatenate([system.rest(1.0), np.zeros(6)])
    state, step = start.copy(), 2e-4
    energy = system.energy(start)
    for _ in range(100):  # Runge-Kutta, order 4
        k1 = system.slope(0.0, state)
        k2 = system.slope(0.0, state + 0.5 * step * k1)
        k3 = system.slope(0.0, state + 0.5 * step * k2)
        k4 = system.slope(0.0, state + step * k3)
        state = state + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    assert np.max(np.abs(state - start)) > 0.05
    assert system.energy(state) == pytest.approx(energy, rel=1e-8)


def test_small_release_is_the_series_of_linear_modes() -> None:
    """y(t) = sum over modes of k (phi(1)/b^2)^2 cos(2 pi f t), phi(1) = 2."""
    load, modes, thin = 1e-3, 6, Wire(radius=1e-6)
    motion = release.tip_motion(thin, load, 0.2 * thin.time_unit, 201, modes)
    numbers, time = beam.mode_numbers(modes), motion.time / thin.time_unit
    series = load * np.cos(np.multiply.outer(time, numbers**2)) @ (4.0 / numbers**4)
    np.testing.assert_allclose(motion.across / thin.length, series, atol=1e-5 * load)


def test_release_starts_at_the_elastica() -> None:
    motion = release.tip_motion(BASE, 0.1, 1e-3, 2, modes=8)
    tip = BASE.length * np.array(elastica.tip_loaded(0.1, HALF).tip)
    np.testing.assert_allclose([motion.along[0], motion.across[0]], tip, atol=1e-4 * tip[1])


def test_release_converges_with_the_number_of_modes() -> None:
    motions = [release.tip_motion(BASE, 0.1, 0.02, 201, modes) for modes in (4, 6, 8)]
    differences = [np.max(np.abs(a.across - b.across)) for a, b in zip(motions, motions[1:])]
    assert differences[1] < 0.5 * differences[0] < 1e-4 * BASE.length


@pytest.mark.parametrize("tip", [0.3, 1.5, 2.9])
def test_turned_wire_in_a_bend_is_a_pendulum(tip: float) -> None:
    """From the tip back to the hub, as an initial value problem."""
    stretch = 2.0
    back = solve_ivp(lambda _, y: [y[1], stretch**2 * math.sin(y[0])], (0.0, 1.0), [tip, 0.0], rtol=1e-10, atol=1e-12)
    assert whip.hub_angle(tip, stretch) == pytest.approx(back.y[0, -1], abs=1e-7)


def test_snap_is_where_the_hub_cannot_go_on() -> None:
    hub, tip = whip.snap(2.0)
    assert [math.degrees(hub), math.degrees(tip)] == pytest.approx([197.8, 116.7], abs=0.05)
    assert all(whip.hub_angle(other, 2.0) < hub for other in (tip - 0.1, tip + 0.1))


def test_snaking_between_clamps_is_the_lowest_eigenvalue_of_the_column() -> None:
    """Cubic beam elements on an elastic foundation."""
    length, n = 22.6, 100
    h = length / n
    bend = np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h], [-12, -6 * h, 12, -6 * h],
                     [6 * h, 2 * h * h, -6 * h, 4 * h * h]]) / h**3
    lean = np.array([[36, 3 * h, -36, 3 * h], [3 * h, 4 * h * h, -3 * h, -h * h], [-36, -3 * h, 36, -3 * h],
                     [3 * h, -h * h, -3 * h, 4 * h * h]]) / (30 * h)
    lie = np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h], [54, 13 * h, 156, -22 * h],
                    [-13 * h, -3 * h * h, -22 * h, 4 * h * h]]) * h / 420
    held, thrust = np.zeros((2 * n + 2, 2 * n + 2)), np.zeros((2 * n + 2, 2 * n + 2))
    for j in range(n):
        part = slice(2 * j, 2 * j + 4)
        held[part, part] += bend + lie
        thrust[part, part] += lean
    loads = eigh(thrust[2:-2, 2:-2], held[2:-2, 2:-2], eigvals_only=True)
    assert tube_buckling.clamped_onset(length) == pytest.approx(1.0 / loads[-1], rel=1e-4)


def test_helix_holds_below_the_load_at_which_an_even_one_has_the_straight_wires_energy() -> None:
    """An even one of pitch 2 pi/p has p^4/2 - f p^2/2 at best, - f^2/8: the straight wire's - 1 at 2 sqrt(2)."""
    assert 0.95 * tube_buckling.EVEN_HELIX < tube_buckling.helix_lifts_off() < tube_buckling.EVEN_HELIX


def test_frames_along_a_curve_have_its_directions() -> None:
    turns = np.linspace(0.0, 4.0, 30)
    nodes = np.stack([np.sin(turns), 1.0 - np.cos(turns), turns], axis=1)
    directors = Rotation.from_quat(tubes.untwisted_frames(nodes)).apply([0.0, 0.0, 1.0])
    chords = np.diff(nodes, axis=0)
    np.testing.assert_allclose(directors, chords / np.linalg.norm(chords, axis=1)[:, None], atol=1e-12)


def test_linear_stability_is_that_of_the_column_and_of_thin_strips() -> None:
    """A column under its own weight buckles at 7.837 EI/L^3 (Greenhill 1881), a thin strip under its at 12.85 sqrt(B2
    C)/L^3 (Prandtl 1899, Michell)."""
    column = planar_stability.PlaneRest(0.0, math.pi, 1.0, 1.0)
    # Both directions across are alike: the shape in the plane is left at the same load.
    assert column.limits(np.linspace(0.5, 9.0, 8)) == pytest.approx([7.83735], rel=1e-5)
    thin = planar_stability.PlaneRest(0.0, 0.5 * math.pi, 1e-8, 1e-8)
    assert thin.limits(np.linspace(1e-9, 2e-7, 9)) == pytest.approx([12.853e-8], rel=1e-3)


@pytest.mark.long("3 s; runs of the validation agree with snap loads of deeper arches")
def test_snap_load_of_a_shallow_arch_grows_with_the_root_of_its_slack() -> None:
    assert planar_stability.snap(0.004) / planar_stability.snap(0.001) == pytest.approx(2.0, rel=1e-2)


def test_column_between_planes_touches_first_under_eulers_load() -> None:
    assert planes.push(4.0 * math.pi**2 * (1.0 + 1e-9)) == pytest.approx(0.0, abs=1e-5)
    below, above = planes.push(16.0 * math.pi**2 * (1.0 - 1e-9)), planes.push(16.0 * math.pi**2 * (1.0 + 1e-9))
    assert below == pytest.approx(above, rel=1e-6) and above == pytest.approx(64.0 * math.pi**2, rel=1e-6)


def test_rod_twisted_in_a_tube_first_touches_at_greenhills_couple_and_then_splits_its_contact() -> None:
    """The couples of Li (2010)."""
    assert twisted_tube.middle(twisted.clamped_moment() + 1e-7)[2] == pytest.approx(0.0, abs=1e-4)
    assert twisted_tube.splits() == pytest.approx(11.472, abs=1e-3)


def test_two_contacts_of_the_twisted_rod_become_three_points_and_then_a_line_between_points() -> None:
    # J. Li, thesis, 2010: 13.022 and 13.098. Where the one contact has just split both have its force.
    assert twisted_tube.touches_again() == pytest.approx(13.022, abs=1e-3)
    assert twisted_tube.lies_on() == pytest.approx(13.098, abs=1e-3)
    just = twisted_tube.pair(twisted_tube.splits() + 0.03, (0.006, 0.04))
    assert just.force == pytest.approx(twisted_tube.middle(twisted_tube.splits() + 0.03)[2], rel=5e-3)


def test_stiff_cable_and_its_swing_are_the_limp_ones_as_its_bending_vanishes() -> None:
    limp = Wire(1.0, 1e-3, 1e7, 1e7 / 3.0, 1000.0)
    assert suite.stiff_cable_sag(limp, 0.8) == pytest.approx(suite.catenary_sag(limp, 0.8), rel=2e-4)
    frequency, _ = suite.first_mode(limp)
    chain = 0.5 * 2.404825557695773 * math.sqrt(9.81 / (1.0 + 0.5 * limp.line_density * 9.81 / limp.stretching))
    assert frequency == pytest.approx(chain, rel=2e-3)


def test_critical_level_is_where_the_growth_begins() -> None:
    rates = {level: (-2.0 + math.sqrt(4.0 + 4.0 * 9.0 * (level - 0.99))) / 2.0 for level in (1.0, 1.02, 1.04, 1.06)}
    assert suite.critical_level({0.96: -0.1, **rates}) == pytest.approx(0.99, rel=1e-9)


def test_stiff_ropes_capstan_is_the_textbooks_for_a_limp_rope() -> None:
    """But for the 0.12 mm by which its held end lies beside the drum's tangent, over 85 mm and more."""
    around = 1e-3 * 50.0 + 0.3e-3
    grows = math.exp(0.3 * math.pi * 0.05 / around)
    assert drum.force(0.3, 1e3, True) == pytest.approx(0.02 * grows, rel=1e-3)
    assert drum.force(0.3, 1e3, False) == pytest.approx(0.02 / grows, rel=1e-3)

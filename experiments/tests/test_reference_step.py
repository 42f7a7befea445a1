"""The reference step keeps what the equations promise, before the C# code is compared with it."""

import numpy as np
import pytest

from experiments.tests import reference_step as reference


def straight(n, inverse_masses=None, **changes):
    length = 1.0
    rod = reference.Rod(
        element_length=length, inverse_masses=np.full(n + 1, n + 1.0) if inverse_masses is None else inverse_masses,
        stretch_gain=1.0, bend_gain=0.3, iterations=5, bilateral=False, verlet=True, time_step=0.01, damping=0.0,
        gravity=np.zeros(3),
    )
    rod = reference.Rod(**{**rod.__dict__, **changes})
    x = np.zeros((n + 1, 3))
    x[:, 2] = np.arange(n + 1) * length
    q = np.tile([0.0, 0.0, 0.0, 1.0], (n, 1))
    return rod, reference.State(x, np.zeros_like(x), q, np.zeros((n, 3)))


def random_state(rod, state, seed=3):
    random = np.random.default_rng(seed)
    q = state.orientations + 0.2 * random.normal(size=state.orientations.shape)
    return reference.State(
        state.positions + 0.1 * random.normal(size=state.positions.shape), state.velocities,
        q / np.linalg.norm(q, axis=1, keepdims=True), state.angular_velocities,
    )


def test_a_straight_wire_at_rest_stays():
    rod, state = straight(6)
    after = reference.step(rod, state)
    np.testing.assert_array_equal(after.positions, state.positions)
    np.testing.assert_array_equal(after.orientations, state.orientations)


def test_free_fall_is_the_sum_of_its_steps():
    rod, state = straight(4, gravity=np.array([0.0, -9.81, 0.0]))
    for _ in range(10):
        state = reference.step(rod, state)
    # x_k = g dt^2 k (k + 1)/2 for a start at rest with the new velocity in the position's step.
    np.testing.assert_allclose(state.positions[:, 1], -9.81 * 0.01**2 * 55.0, rtol=1e-12)


@pytest.mark.parametrize("bilateral", [False, True])
def test_a_sweep_keeps_the_centre_of_mass_when_no_sphere_is_held(bilateral):
    rod, state = straight(7, bilateral=bilateral)
    state = random_state(rod, state)
    after = reference.step(rod, state)
    np.testing.assert_allclose(after.positions.mean(axis=0), state.positions.mean(axis=0), atol=1e-14)
    assert not np.allclose(after.positions, state.positions)


def test_one_stretch_correction_with_gain_1_removes_the_error_of_a_straight_element():
    # Along its director an element cannot turn, so the correction only has w0 + w1 of D to work with.
    rod, state = straight(1)
    x, q = state.positions.copy(), state.orientations.copy()
    x[1, 2] = 1.5
    reference.stretch(rod, x, q, 0)
    w = rod.inverse_masses.sum()
    assert x[1, 2] - x[0, 2] - 1.0 == pytest.approx(0.5 * (1.0 - w / (w + 4.0)), abs=1e-15)


def test_bend_twist_lowers_bending_and_twist_alike():
    rod, _ = straight(2)
    for axis in np.eye(3):
        q = np.array([[0.0, 0.0, 0.0, 1.0], [*np.sin(0.2) * axis, np.cos(0.2)]])
        before = np.linalg.norm(reference.product(reference.conjugate(q[0]), q[1])[:3])
        reference.bend_twist(rod, q, 0)
        after = np.linalg.norm(reference.product(reference.conjugate(q[0]), q[1])[:3])
        assert after < 0.8 * before


def test_the_orders_visit_every_index_once():
    assert reference.sweep_order(5, False) == [0, 1, 2, 3, 4]
    assert reference.sweep_order(5, True) == [0, 4, 1, 3, 2]
    assert reference.sweep_order(4, True) == [0, 3, 1, 2]
    assert reference.sweep_order(0, True) == []


@pytest.mark.long("the run of Core, which follows this reference, passes it there (LongitudinalStudyTests)")
def test_the_thesis_default_run_passes_its_error_at_2_19_seconds():
    # Table 4.1 with the orientations left out: a longitudinal run never turns an element. Thesis, Figure 4.4: 0.0049.
    n, m, dt, l = 30, 500, 0.01, 10.0
    x = [l * i + (10.0 if i == 0 else 0.0) for i in range(n + 1)]
    w = [0.0] + [(n + 1) / 0.01] * n
    v = [0.0] * (n + 1)
    errors = []
    for _ in range(230):
        old = list(x)
        x = [position + dt * velocity for position, velocity in zip(x, v)]
        for _ in range(m):
            for j in range(n):
                pull = 0.1 * ((x[j + 1] - x[j]) / l - 1.0) * l / (w[j] + w[j + 1] + 4.0 * l**2)
                x[j] += w[j] * pull
                x[j + 1] -= w[j + 1] * pull
        v = [(new - before) / dt for new, before in zip(x, old)]
        errors.append(sum(abs(position - (l * i + 10.0)) for i, position in enumerate(x)) / (n + 1))
    peaks = {k + 1: errors[k] for k in range(1, 229) if errors[k - 1] < errors[k] > errors[k + 1]}
    assert peaks[219] == pytest.approx(0.0049, abs=0.00005)

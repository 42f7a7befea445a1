"""The C# step against the independent numpy step, bending and twisting in all three directions."""

import json
import os

import numpy as np
import pytest

from experiments.tests import reference_step as reference
from guidewire.runs.runner import Request
from tools.testing import FULL_CAMPAIGNS

STEPS = 100 if FULL_CAMPAIGNS in os.environ else 8
ELEMENT_LENGTH = 0.5
MASS = 0.5
DISPLACEMENT = np.array([0.1, 0.2, 0.2])  # length 0.3
# The two round differently; each step's rounding (1e-16 of a coordinate of at most 10) is carried on, not amplified.
TOLERANCE = 1e-12


def random_start(n, seed):
    """A wire far from straight: spheres and velocities of every direction, orientations turned by up to a radian."""
    random = np.random.default_rng(seed)
    positions = np.zeros((n + 1, 3))
    positions[:, 2] = np.arange(n + 1) * ELEMENT_LENGTH
    positions += 0.1 * random.normal(size=positions.shape)
    velocities = 0.5 * random.normal(size=positions.shape)
    velocities[0] = 0.0  # the first sphere is held
    orientations = np.array([0.0, 0.0, 0.0, 1.0]) + 0.3 * random.normal(size=(n, 4))
    return reference.State(
        positions, velocities, orientations / np.linalg.norm(orientations, axis=1, keepdims=True),
        2.0 * random.normal(size=(n, 3)),
    )


def run_core(live, folder, start, parameters):
    """The log's entries of a run from the start, as (delta, x, v, q) arrays."""
    start_file = folder / "start.json"
    start_file.write_text(json.dumps({
        "positions": start.positions.tolist(), "orientations": start.orientations.tolist(),
        "velocities": start.velocities.tolist(), "angularVelocities": start.angular_velocities.tolist(),
    }))
    scene = folder / "scene.json"
    scene.write_text(json.dumps({**parameters, "startFile": str(start_file), "logOrientations": True}))
    answer = live.run(Request("core", scene, folder / "run"))
    assert answer.exit_code == 0, answer.message
    log = json.loads((folder / "run" / "positions.json").read_text())
    n = len(start.orientations)
    entries = []
    for k in range(STEPS + 1):
        spheres = [log[str(k)]["sphere"][str(i)] for i in range(n + 1)]
        turned = [log[str(k)]["orientation"][str(j)] for j in range(n)]
        entries.append((
            log[str(k)]["delta"],
            np.array([[s["x"], s["y"], s["z"]] for s in spheres]),
            np.array([[s["vx"], s["vy"], s["vz"]] for s in spheres]),
            np.array([[q["x"], q["y"], q["z"], q["w"]] for q in turned]),
        ))
    return entries


def compare(live, folder, n, iterations, order="naive", integrator="verlet", loaded=True):
    """Run both for the same steps and compare every one; returns the last state and the largest motion on the way."""
    gravity, damping = ((0.3, -2.0, 0.7), 0.02) if loaded else ((0.0, 0.0, 0.0), 0.0)
    start = random_start(n, seed=20 + n + loaded)
    entries = run_core(live, folder, start, {
        "stretchStiffness": 0.7, "bendStiffness": 0.05, "constraintSolverSteps": iterations, "timeStep": 0.01,
        "numberRodElements": n, "guidewireLength": n * ELEMENT_LENGTH, "totalMass": MASS, "gravity": gravity,
        "damping": damping, "integrator": integrator, "sweepOrder": order, "displacement": 0.3,
        "displacementDirection": DISPLACEMENT.tolist(), "maxSimulationSteps": STEPS, "deltaThreshold": 0,
    })
    inverse_masses = np.full(n + 1, (n + 1) / MASS)
    inverse_masses[0] = 0.0
    rod = reference.Rod(
        element_length=ELEMENT_LENGTH, inverse_masses=inverse_masses, stretch_gain=0.7, bend_gain=0.05,
        iterations=iterations, bilateral=order == "bilateral", verlet=integrator == "verlet", time_step=0.01,
        damping=damping, gravity=np.array(gravity),
    )
    start.positions[0] += DISPLACEMENT
    expected = start
    moved = 0.0
    for k, (delta, x, v, q) in enumerate(entries):
        if k > 0:
            expected = reference.step(rod, expected)
        np.testing.assert_allclose(x, expected.positions, rtol=0.0, atol=TOLERANCE, err_msg=f"x, step {k}")
        np.testing.assert_allclose(q, expected.orientations, rtol=0.0, atol=TOLERANCE, err_msg=f"q, step {k}")
        # A velocity is a difference of positions over dt, and so is its rounding.
        np.testing.assert_allclose(v * 0.01, expected.velocities * 0.01, rtol=0.0, atol=TOLERANCE)
        assert delta == pytest.approx(expected.prediction_error, abs=TOLERANCE)
        moved = max(moved, np.abs(x - entries[0][1]).max())
    assert moved > 0.1, "nothing moved, so nothing was compared"
    return expected


@pytest.mark.parametrize("loaded", [False, True], ids=["free", "gravity and damping"])
@pytest.mark.parametrize("integrator", ["euler", "verlet"])
@pytest.mark.parametrize("order", ["naive", "bilateral"])
@pytest.mark.few(3)
def test_core_follows_the_equations_step_by_step(live, tmp_path, order, integrator, loaded):
    last = compare(live, tmp_path, 12, 7, order, integrator, loaded)
    assert np.abs(last.positions[:, :2]).max() > 0.05, "the wire ended straight, so bending was not compared"


@pytest.mark.parametrize("n", [1, 2, 3, 5])
@pytest.mark.parametrize("iterations", [1, 4, 6])
@pytest.mark.few(4)
def test_core_follows_the_equations_on_short_wires(live, tmp_path, n, iterations):
    compare(live, tmp_path, n, iterations)

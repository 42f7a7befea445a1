"""Random wires with a material over the widest ranges: each run ends in time, and what it claims is true of its own
numbers.

By default a seeded fraction; where campaigns run in full those of the day.
"""

import math
import re

import numpy as np
import pytest

from experiments.tests.run_claims import Campaign, read_strictly
from guidewire.runs.tests.parameter_strategies import FULL
from tools.seeds import of_the_day

SEEDS = of_the_day(100) if FULL else range(5)
SEED = 20260
LIMIT = 60.0  # s of wall time a run
# Reasons name what would help by its key.
KEY = re.compile(r"\b(timeStep|substeps|numberRodElements|restCurvature|maxNewtonIterations|solverTolerance|tipForce|"
                 r"tipMoment|tipFollowerForce|distalRotation|twistPerStep|distalDisplacement|gravity|startShape|"
                 r"integrator|wireRadius|youngsModulus|constraintSolverSteps)\b")

# What does work on a wire that its own energies do not tell.
DRIVEN = {"drive", "twistPerStep", "distalRotation", "tipFollowerForce", "tipMoment"}


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    return float(10.0 ** rng.uniform(math.log10(low), math.log10(high)))


def vector(rng: np.random.Generator, size: float) -> list[float]:
    return (size * rng.uniform(-1.0, 1.0, 3)).tolist()


def scene_of(seed: int) -> dict:
    """A wire of E 1e3 to 1e12 Pa, r 1e-6 to 1e-2 m, L 1e-3 to 10 m, n 1 to 2,000, dt 1e-7 to 1 s, sections that differ
    by up to 1:1e4, rest curvature of up to 20 loops, up to 50 turns, with any drive, solver and scheme."""
    rng = np.random.default_rng([SEED, seed])
    length = log_uniform(rng, 1e-3, 10.0)
    radius = log_uniform(rng, 1e-6, min(1e-2, 0.1 * length))
    young = log_uniform(rng, 1e3, 1e12)
    stiffness = young * 0.25 * math.pi * radius**4 / length**2  # EI/L^2, N
    n = int(log_uniform(rng, 1, 2000.99))
    solver = str(rng.choice(["direct", "direct", "direct", "xpbd", "explicit"]))
    step = log_uniform(rng, 1e-7, 1.0)
    scene = {
        "solver": solver, "metresPerUnit": 1.0, "guidewireOffset": 0.0, "guidewireLength": length, "wireRadius": radius,
        "youngsModulus": young, "shearModulus": young * rng.uniform(0.3, 0.5), "density": log_uniform(rng, 1e2, 3e4),
        "numberRodElements": n, "timeStep": step, "deltaThreshold": log_uniform(rng, 1e-9, 1e-3) * length,
        "proximalEnd": str(rng.choice(["clamped", "clamped", "held", "free"])),
        "distalEnd": str(rng.choice(["free", "free", "clamped", "sliding" if solver == "direct" else "clamped"])),
        "gravity": vector(rng, 9.81), "tipForce": vector(rng, stiffness * log_uniform(rng, 1e-3, 1e2)),
        "maxSimulationSteps": int(rng.integers(1, 21)), "logOrientations": True, "logStrains": True,
    }
    if solver == "direct":
        scene["integrator"] = str(rng.choice(["implicitEuler", "bdf2", "trbdf2", "esdirk3", "esdirk4"]))
        if scene["integrator"] in ("trbdf2", "esdirk3", "esdirk4") and rng.random() < 0.2:
            scene["timeStepError"] = log_uniform(rng, 1e-5, 1e-1)
            scene["maxSimulationSteps"] = 3
        if rng.random() < 0.2:
            scene["materialDamping"] = log_uniform(rng, 1e-7, 1.0)
    else:
        scene["substeps"] = int(rng.integers(1, 50))
    if rng.random() < 0.2:
        scene["massDamping"] = log_uniform(rng, 1e-3, 1e4)
    if rng.random() < 0.3:
        scene["restCurvature"] = [2.0 * math.pi * rng.uniform(0.0, 20.0) / length, 0.0,
                                  rng.uniform(-10.0, 10.0) / length]
    if rng.random() < 0.3:
        border = rng.uniform(0.1, 0.9) * length
        scene["wireSections"] = [{"from": border, "to": length, "youngsModulus": young * log_uniform(rng, 1e-4, 1.0)}]
    if scene["distalEnd"] == "clamped" or scene["distalEnd"] == "sliding":
        scene["distalRotation"] = 2.0 * math.pi * rng.uniform(-50.0, 50.0)
        scene["distalRampTime"] = step * rng.uniform(0.5, 20.0) if solver != "direct" or rng.random() < 0.5 else 0.0
        scene["distalDisplacement"] = 0.0 if scene["distalEnd"] == "sliding" else length * rng.uniform(-0.3, 0.02)
    elif rng.random() < 0.2:
        scene["tipFollowerForce"] = vector(rng, stiffness * log_uniform(rng, 1e-2, 30.0))
    elif rng.random() < 0.2 and solver != "xpbd":
        scene["tipMoment"] = vector(rng, stiffness * length * log_uniform(rng, 1e-2, 10.0))
    drive = str(rng.choice(["hold", "displace", "push", "force", "twist"]))
    if drive == "twist" and scene["proximalEnd"] == "clamped":
        scene["twistPerStep"] = 2.0 * math.pi * rng.uniform(-50.0, 50.0) / scene["maxSimulationSteps"]
    elif drive in ("displace", "push") and scene["proximalEnd"] != "free":
        scene.update(drive=drive, displacementPerStep=length * log_uniform(rng, 1e-6, 0.05),
                     displacementDirection=vector(rng, 1.0))
    elif drive == "force":
        scene.update(drive="force", externalForce=vector(rng, stiffness), proximalEnd="free")
    holds = scene["proximalEnd"] == "clamped" or scene["distalEnd"] != "free"
    if holds and rng.random() < 0.3:
        scene.update(initialState="equilibrium", maxSimulationSteps=int(rng.choice([0, scene["maxSimulationSteps"]])))
    return scene


@pytest.fixture(scope="module")
def wide(runner_command, tmp_path_factory):
    campaign = Campaign(runner_command, tmp_path_factory.mktemp("wide"), LIMIT)
    yield campaign
    campaign.close()


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.few(2)
def test_a_wire_of_any_size_ends_in_time_and_in_truth(wide, seed):
    scene = scene_of(seed)
    answer, out = wide.run(scene)
    assert answer.exit_code in (0, 4, 5), answer
    summary, log = read_strictly(out / "summary.json"), read_strictly(out / "positions.json")
    if answer.exit_code != 0:
        assert KEY.search(answer.message), answer.message
        return
    solver = summary["solver"]
    if summary["outcome"] == "converged" and scene.get("initialState") == "equilibrium" and summary["steps"] == 0:
        assert solver["equilibriumResidual"] <= 1e-5 + rounding_of(scene)
        assert solver["smallestEigenvalue"] is not None
    first, last = log["0"], log[str(summary["steps"])]
    state = np.array([list(sphere.values()) for sphere in last["sphere"].values()])
    assert np.isfinite(state).all()
    turns = np.array([list(q.values()) for q in last["orientation"].values()])
    assert np.allclose(np.linalg.norm(turns, axis=1), 1.0, rtol=0.0, atol=1e-9)
    if solver["energy"] is not None:
        assert math.isfinite(solver["energy"])
    if "but" not in summary["reason"]:
        assert_no_joint_lost_a_turn(scene, turns)
        if not DRIVEN & scene.keys():
            assert_energy_did_not_grow(first["stress"], last["stress"])


def rounding_of(scene: dict) -> float:
    """What the last digit of a place makes of EA, over the loads and EI/L^2: EA/l times 2e-16 L."""
    area = math.pi * scene["wireRadius"]**2
    length = scene["guidewireLength"]
    axial = scene["youngsModulus"] * area
    loads = (0.25 * axial * (scene["wireRadius"] / length)**2 + np.linalg.norm(scene["tipForce"])
             + scene["density"] * area * length * np.linalg.norm(scene["gravity"]))
    return np.finfo(float).eps * axial * scene["numberRodElements"] / float(loads)


def assert_no_joint_lost_a_turn(scene: dict, turns: np.ndarray) -> None:
    """Wound up between two clamps that face one another: where all elements point forward, the turn about the wire's
    axis from the first element to the last is that of the clamps, but for what the last half elements hold."""
    x, y, z, w = turns.T
    forward = (w**2 + z**2 > x**2 + y**2).all()
    if scene["proximalEnd"] != "clamped" or "distalRotation" not in scene or len(turns) < 20 or not forward:
        return
    if scene.get("drive") == "force" or "restCurvature" in scene or "wireSections" in scene:
        return
    turned = np.diff(2.0 * np.arctan2(z, w))
    turned -= 2.0 * np.pi * np.round(turned / (2.0 * np.pi))
    asked = asked_turn(scene)
    n = len(turns)
    assert abs(turned.sum() * n / (n - 1) - asked) <= np.pi + 0.3 * abs(asked) * (scene["maxSimulationSteps"] > 0)


def asked_turn(scene: dict) -> float:
    """Turn of the distal clamp against the proximal one at the end, radians."""
    time = scene["timeStep"] * scene["maxSimulationSteps"]
    ramp = scene["distalRampTime"]
    return scene["distalRotation"] * (1.0 if time >= ramp else time / ramp) - (
        scene.get("twistPerStep", 0.0) * scene["maxSimulationSteps"])


def assert_energy_did_not_grow(first: dict, last: dict) -> None:
    """Of strains, motion and dead loads together, which nothing but a drive may add to."""
    parts = ("kineticEnergy", "elasticEnergy", "potentialEnergy")
    scale = last["kineticEnergy"] + last["elasticEnergy"] + first["elasticEnergy"] + abs(
        last["potentialEnergy"] - first["potentialEnergy"])
    assert sum(last[part] - first[part] for part in parts) <= 0.01 * scale

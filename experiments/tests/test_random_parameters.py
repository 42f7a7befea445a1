"""Random parameter files: each ends in one clear line, or as a run whose outcome is true.

By default a seeded fraction of the campaign; GUIDEWIRE_ALL=1 makes it long and unseeded.
"""

import json
import math
import os
import shutil
import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st

from analysis.logs import read_log
from experiments.runner import Request, Runner

FULL = os.environ.get("GUIDEWIRE_ALL") == "1"
campaign = settings(
    max_examples=5000 if FULL else 300, derandomize=not FULL, deadline=None, database=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture, HealthCheck.data_too_large],
)


def log_uniform(low, high):
    return st.floats(math.log10(low), math.log10(high)).map(lambda exponent: 10.0**exponent)


def vectors(component):
    return st.one_of(
        st.lists(component, min_size=3, max_size=3),
        st.tuples(component, component, component).map(lambda v: dict(zip("xyz", v))),
    )


not_zero = st.lists(st.floats(-1.0, 1.0), min_size=3, max_size=3).filter(lambda v: np.linalg.norm(v) > 1e-3)
whole = st.integers

# Values that a key allows, of sizes that scenes have. Cost is bounded: steps, elements and iterations stay small.
SCENE = {
    "constraintSolverSteps": whole(0, 60),
    "timeStep": log_uniform(1e-5, 1.0),
    "guidewireLength": log_uniform(1.0, 1e4),
    "numberRodElements": st.one_of(whole(1, 40), whole(1, 40).map(float)),
    "totalMass": log_uniform(1e-4, 100.0),
    "guidewireOffset": st.floats(-1e3, 1e3),
    "stretchStiffness": st.floats(0.0, 3.0),
    "bendStiffness": log_uniform(1e-3, 100.0),
    "sphereRadius": log_uniform(0.01, 100.0),
    "collisionMargin": st.floats(0.0, 10.0),
    "collisionStiffness": st.floats(0.0, 1.0),
    "displacement": st.floats(-100.0, 100.0),
    "displacementDirection": not_zero,
    "displacementPerStep": st.floats(-1.0, 1.0),
    "externalForce": vectors(st.floats(-1.0, 1.0)),
    "gravity": vectors(st.floats(-10.0, 10.0)),
    "damping": st.floats(0.0, 1.0),
    "drive": st.sampled_from(["hold", "displace", "push", "force"]),
    "integrator": st.sampled_from(["verlet", "euler"]),
    "sweepOrder": st.sampled_from(["naive", "bilateral"]),
    "deltaThreshold": st.one_of(st.just(0), log_uniform(1e-6, 1.0)),
    "steadyStateHold": whole(1, 200),
    "maxSimulationSteps": whole(0, 400),
    "position": vectors(st.floats(-100.0, 100.0)),
    "rotation": vectors(st.floats(-360.0, 360.0)),
    "logEvery": whole(1, 20),
    "logSpheres": st.sampled_from(["all", "last"]),
    "logOrientations": st.booleans(),
    "rodElementLength": log_uniform(0.1, 1e3),
}

POSITIVE = ("timeStep", "guidewireLength", "totalMass", "sphereRadius", "rodElementLength")
NOT_NEGATIVE = ("stretchStiffness", "bendStiffness", "collisionMargin", "deltaThreshold")
FRACTIONS = ("damping", "collisionStiffness")
WHOLE = ("constraintSolverSteps", "numberRodElements", "steadyStateHold", "maxSimulationSteps", "logEvery")
FROM_ONE = ("numberRodElements", "steadyStateHold", "logEvery")
VECTORS = ("displacementDirection", "externalForce", "gravity", "position", "rotation")
WORDS = ("drive", "integrator", "sweepOrder", "logSpheres")
no_number = st.one_of(st.text(max_size=5), st.booleans(), st.none(), st.lists(st.floats(-1, 1), max_size=4),
                      st.dictionaries(st.text(max_size=2), st.integers(), max_size=3))


def wrong(key):
    """Values that a key does not allow."""
    if key in VECTORS:
        wrong_vectors = st.lists(st.floats(-1, 1), max_size=5).filter(lambda v: len(v) != 3)
        zero = st.just([0, 0.0, -0.0]) if key == "displacementDirection" else st.nothing()
        return st.one_of(wrong_vectors, zero, st.floats(-1, 1), st.text(max_size=5), st.none(),
                         st.just([1, 2, "3"]), st.just({"x": 1, "y": 2}), st.just({"x": 1, "y": 2, "z": 3, "w": 4}))
    if key in WORDS:
        return st.one_of(st.text(max_size=8), st.integers(-2, 5), st.none(), st.booleans())
    if key == "logOrientations":
        return st.one_of(st.integers(0, 1), st.text(max_size=5), st.none(), st.just("true"))
    if key in WHOLE:
        low = 0 if key in FROM_ONE else -1
        halves = st.integers(-3, 1000).map(lambda k: k + 0.5)
        return st.one_of(no_number, st.integers(-(10**25), low), st.integers(2 * 10**9, 10**25), halves)
    if key in POSITIVE:
        return st.one_of(no_number, st.floats(-1e300, 0.0))
    if key in NOT_NEGATIVE:
        return st.one_of(no_number, st.floats(-1e300, -1e-300))
    if key in FRACTIONS:
        return st.one_of(no_number, st.floats(1.0000001, 1e300), st.floats(-1e300, -1e-300))
    return no_number


@st.composite
def scenes(draw, values=None):
    chosen = draw(st.sets(st.sampled_from(sorted(SCENE)), max_size=12))
    scene = {key: draw((values or {}).get(key, SCENE[key])) for key in chosen}
    # Without these most runs would be over before they can come to rest.
    scene.setdefault("constraintSolverSteps", 40)
    scene.setdefault("maxSimulationSteps", 400)
    scene.setdefault("steadyStateHold", 20)
    scene.setdefault("deltaThreshold", draw(log_uniform(1e-4, 0.1)))
    return scene


def refuse_constant(word):
    raise ValueError(f"{word} is no JSON")


@pytest.fixture(scope="module")
def make(runner_command):
    """A function that runs a scene and returns (answer, folder); the folder lasts until the next. The runner stays up
    from one to the next."""
    runner = Runner(runner_command)
    with tempfile.TemporaryDirectory() as folder:

        def run(text):
            scene, out = Path(folder) / "scene.json", Path(folder) / "run"
            shutil.rmtree(out, ignore_errors=True)
            scene.write_text(text, encoding="utf-8")
            return runner.run(Request("random", scene, out)), out

        yield run
        runner.close()


def judge(answer, out):
    event(str(answer.outcome))
    """Raise AssertionError unless the run's outcome is true by its own log."""
    assert "\n" not in answer.message and answer.message
    assert (answer.exit_code, answer.outcome) in ((0, "converged"), (0, "finished"), (4, "diverged"))
    summary = json.loads((out / "summary.json").read_text())
    parameters = json.loads((out / "parameters.json").read_text())
    assert summary["outcome"] == answer.outcome and summary["complete"] is True
    log_text = (out / "positions.json").read_text()
    if answer.outcome == "diverged":
        assert "null" in log_text or is_lost(read_log(out, spheres=parameters["logSpheres"]), parameters)
        return
    assert "null" not in log_text, "a value of the log is not finite"
    log = read_log(out, spheres=parameters["logSpheres"], velocities=True)
    assert log.complete and log.final_step == summary["steps"]
    assert np.all(np.isfinite(log.positions)) and np.all(np.isfinite(log.velocities))
    if answer.outcome == "finished":
        assert summary["steps"] == parameters["maxSimulationSteps"]
    elif parameters["logSpheres"] == "all":
        strains = strains_of(log.final_positions, parameters)
        assert strains.max() <= 0.2, "at rest with elements of the wrong length"


def strains_of(positions, parameters):
    """|element length/l - 1| of every element; positions have shape (..., n + 1, 3)."""
    with np.errstate(over="ignore"):  # of a wire that was lost
        lengths = np.linalg.norm(np.diff(positions, axis=-2), axis=-1)
    return np.abs(lengths * parameters["numberRodElements"] / parameters["guidewireLength"] - 1.0)


def is_lost(log, parameters):
    """Whether a log shows what the word diverged means; what it does not hold is given the benefit of the doubt."""
    far = np.linalg.norm(log.positions - log.positions[0, 0], axis=-1).max() > 10.0 * parameters["guidewireLength"]
    if far or parameters["logSpheres"] == "last" or parameters["logEvery"] > 1:
        return True
    return len(log.steps) > 200 and strains_of(log.positions[-200:], parameters).max() > 0.2


def assert_refused(answer, out, *words):
    assert (answer.exit_code, answer.outcome) == (2, None)
    assert "\n" not in answer.message and "\r" not in answer.message
    for word in words:
        assert word in answer.message
    assert not out.exists()


@campaign
@given(scene=scenes())
def test_an_allowed_scene_runs_to_a_true_outcome(make, scene):
    answer, out = make(json.dumps(scene))
    judge(answer, out)


@campaign
@given(scene=scenes(), key=st.sampled_from(sorted(SCENE)), data=st.data())
def test_one_wrong_value_is_refused_by_name(make, scene, key, data):
    value = data.draw(wrong(key))
    if key in WORDS and value in ("hold", "displace", "push", "force", "verlet", "euler", "naive", "bilateral", "all",
                                  "last"):
        return
    answer, out = make(json.dumps({**scene, key: value}))
    assert_refused(answer, out, "scene.json", key)


@campaign
@given(scene=scenes(), key=st.text(max_size=30).filter(lambda key: key not in SCENE))
def test_an_unknown_key_is_refused(make, scene, key):
    others = ("displacementPerStep", "VerletIntegration", "SteadyState", "scale", "startFile", "logFilePath")
    if key not in others:
        assert_refused(*make(json.dumps({**scene, key: 1})), "scene.json")


@campaign
@given(scene=scenes(), data=st.data())
def test_a_damaged_file_is_refused_or_means_what_it_says(make, scene, data):
    text = json.dumps(scene)
    at = data.draw(st.integers(0, len(text)))
    damage = data.draw(st.sampled_from(["cut", "drop", "insert", "double"]))
    character = data.draw(st.sampled_from('{}[]",:.-+eE019 \t\n\\/tfnNI\x00\x7fäß'))
    text = {
        "cut": text[:at], "drop": text[:at] + text[at + 1:], "insert": text[:at] + character + text[at:],
        "double": text[:at] + text[max(0, at - 8):],
    }[damage]
    try:
        pairs = json.loads(text, object_pairs_hook=list, parse_constant=refuse_constant)
        whole_file = isinstance(pairs, list) and len({key for key, _ in pairs}) == len(pairs)
    except (ValueError, TypeError):
        whole_file = False
    # An inserted digit may make a run of a thousand times the cost; those say nothing about damage.
    if whole_file and any(isinstance(value, (int, float)) and abs(value) > 1e4 for _, value in pairs):
        return
    answer, out = make(text)
    if whole_file and answer.exit_code != 2:
        judge(answer, out)
    else:
        assert_refused(answer, out, "scene.json")


EXTREME = {
    key: st.one_of(st.floats(5e-324, 1.7e308), log_uniform(1e-300, 1e300)) for key in POSITIVE
} | {
    key: st.floats(0.0, 1.7e308) for key in NOT_NEGATIVE
} | {
    key: st.floats(-1.7e308, 1.7e308) for key in ("guidewireOffset", "displacement", "displacementPerStep")
} | {
    key: vectors(st.floats(-1.7e308, 1.7e308)) for key in ("gravity", "externalForce", "position", "rotation")
}


@campaign
@given(scene=scenes(EXTREME))
def test_extreme_numbers_end_in_a_line_or_in_a_true_outcome(make, scene):
    answer, out = make(json.dumps(scene))
    if answer.exit_code == 2:
        assert_refused(answer, out)
    else:
        judge(answer, out)

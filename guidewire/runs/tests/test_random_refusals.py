"""Random parameter files that hold something wrong: each ends in one line that names it, and nothing is written.

By default a seeded fraction of the campaign; GUIDEWIRE_ALL=1 makes it long, by the seed that pytest is given.
"""

import json
import subprocess

import pytest
from hypothesis import given
from hypothesis import strategies as st

from experiments.tests.run_claims import assert_refused, assert_true_outcome, read_strictly, refuse_constant
from guidewire.runs.key_table import foreign_keys, own_keys
from guidewire.runs.tests.parameter_strategies import (
    FITTED, REFUSED_IN_FILES, SOLVERS, allowed, coaxial_scenes, examples, scenes,
)
from guidewire.runs.tests.wrong_values import wrong

EXAMPLE_OF_FITTED = {
    "material": "steel", "fibres": 4,
    "wireSections": [{"from": 0, "to": 10, "wireRadius": 1e-4}], "startFile": "", "innerRadius": 1e-4,
    "loadTables": {"tipForce": "load_table.csv"}, "driveFile": "", "sheath": {},
    "instrument": "workhorse-0.014",
    "vessel": {"shape": "plane", "point": [50, 0, 0], "normal": [-1, 0, 0]},
    "obstacles": [{"shape": "sphere", "centre": [50, 0, 0], "radius": 1}],
    "pointLoads": [{"at": 10, "force": [0, 1, 0]}], "start": {},
    "proximalMotionFile": "motion.csv", "distalMotionFile": "motion.csv",
}
every_method = pytest.mark.parametrize("solver", SOLVERS)


@every_method
def test_keys_of_other_methods_are_refused_on_the_command_line(campaign, table, solver):
    @examples(1)
    @given(data=st.data())
    def check(data):
        for name in foreign_keys(table, solver):
            value = EXAMPLE_OF_FITTED.get(name) if name in FITTED else data.draw(allowed(table[name]))
            answer = campaign.run({"solver": solver, "maxSimulationSteps": 1}, {name: value})
            assert_refused(*answer, "set", name, f"solver {solver}")

    check()


def test_the_program_refuses_such_a_key_among_its_arguments_too(runner_command, tmp_path):
    out = tmp_path / "run"
    arguments = ["-solver", "direct", "-substeps", "2", "-out", str(out)]
    done = subprocess.run([*runner_command, *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 2 and done.stdout == "" and not out.exists()
    line, = done.stderr.splitlines()
    assert "substeps" in line and "solver direct" in line


@every_method
def test_a_wall_a_load_or_a_damping_that_a_method_does_not_take_is_refused_in_a_file(campaign, table, solver):
    for name in set(REFUSED_IN_FILES) & set(foreign_keys(table, solver)):
        other = 1e-3 if table[name].kind == "number" else [1e-3, 0, 0]
        scene = {"solver": solver, "maxSimulationSteps": 1, name: EXAMPLE_OF_FITTED.get(name, other)}
        assert_refused(*campaign.run(scene), "scene.json", name, f"solver {solver}")


@examples(150)
@given(data=st.data())
def test_one_wrong_value_is_refused_by_name(campaign, table, integrators, data):
    solver = data.draw(st.sampled_from(SOLVERS))
    scene = data.draw(scenes(table, solver, integrators[solver]))
    name = data.draw(st.sampled_from(sorted(table)))
    scene[name] = data.draw(wrong(table[name]))
    assert_refused(*campaign.run(scene), "scene.json", name)


WRONG_OF_CATHETERS = {
    "lumenRadius": lambda scene: st.floats(1e-6, scene["wireRadius"]), "start": lambda scene: st.floats(-1e3, -1e-3),
    "wireRadius": lambda scene: st.floats(1e-6, scene["wireRadius"]), "elements": lambda scene: st.integers(-5, 0),
    "length": lambda scene: st.floats(-1e3, 0.0), "lumenFriction": lambda scene: st.floats(-1.0, -1e-6),
    "hubForceLimit": lambda scene: st.just("slips"), "frictionCoefficient": lambda scene: st.floats(-1.0, -1e-6),
    "radius": lambda scene: st.just(1e-3), "sheath": lambda scene: st.just({}),
}


@examples(10)
@given(data=st.data())
def test_one_wrong_value_of_a_catheter_is_refused_by_name(campaign, integrators, data):
    scene = data.draw(coaxial_scenes(integrators["direct"]))
    name = data.draw(st.sampled_from(sorted(WRONG_OF_CATHETERS)))
    scene["catheters"][0][name] = data.draw(WRONG_OF_CATHETERS[name](scene))
    assert_refused(*campaign.run(scene), "scene.json", "catheters", name)


CONFLICTS = {
    "an integrator of another method": ("integrator", {"solver": "direct", "integrator": "verlet"}),
    "gains with an integrator of the direct solver": ("integrator", {"integrator": "bdf2"}),
    "gains with a free proximal end": ("proximalEnd", {"proximalEnd": "free"}),
    "gains with a sliding end": ("distalEnd", {"distalEnd": "sliding"}),
    "sweeps with a sliding end": ("distalEnd", {"solver": "xpbd", "distalEnd": "sliding"}),
    "explicit steps with a sliding end": ("distalEnd", {"solver": "explicit", "distalEnd": "sliding"}),
    "a turn at once": ("distalRotation", {"solver": "explicit", "distalEnd": "clamped", "distalRotation": 1.01}),
    "a twist without a clamp": ("twistPerStep", {"solver": "direct", "twistPerStep": 0.1}),
    "two speeds of one hub": ("displacementPerStep", {"solver": "direct", "drive": "push", "insertionSpeed": 0.1,
                                                      "displacementPerStep": 1.0}),
    "a speed without a way": ("insertionSpeed", {"solver": "xpbd", "insertionSpeed": 0.1}),
    "a hub that gives way without walls": ("hubForceLimit", {"solver": "direct", "hubForceLimit": 0.1}),
    "a free end that is driven": ("proximalEnd", {"solver": "direct", "proximalEnd": "free", "drive": "push"}),
    "a free end that is displaced": ("proximalEnd", {"solver": "xpbd", "proximalEnd": "free", "SteadyState": False}),
    "a helix longer than the wire": ("startTurns", {"solver": "direct", "startShape": "helix", "startTurns": -9}),
    "a rest shape without a clamp": ("initialState", {"solver": "direct", "initialState": "equilibrium"}),
    "sweeps with another bend law": ("bendLaw", {"solver": "xpbd", "bendLaw": "darboux"}),
    "two words for one thing": ("integrator", {"integrator": "euler", "VerletIntegration": True}),
    "two drives": ("drive", {"drive": "hold", "SteadyState": False}),
}


@pytest.mark.parametrize("key, scene", CONFLICTS.values(), ids=CONFLICTS)
def test_what_does_not_go_together_is_refused_by_name(campaign, key, scene):
    assert_refused(*campaign.run({"maxSimulationSteps": 1, **scene}), "scene.json", key)


@examples(60)
@given(name=st.text(max_size=30))
def test_an_unknown_key_is_refused(campaign, table, name):
    if name not in table:
        assert_refused(*campaign.run({name: 1}), "scene.json")


@examples(80)
@given(data=st.data())
def test_a_damaged_file_is_refused_or_means_what_it_says(campaign, table, integrators, data):
    solver = data.draw(st.sampled_from(SOLVERS))
    scene = data.draw(scenes(table, solver, integrators[solver]).filter(lambda scene: "startFile" not in scene))
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
    costly = ("constraintSolverSteps", "substeps", "numberRodElements", "maxSimulationSteps", "maxNewtonIterations")
    if whole_file and any(key in costly and not abs(value) <= 100 for key, value in pairs
                          if isinstance(value, (int, float))):
        return  # an inserted digit may make a run of a thousand times the cost; it says nothing about damage
    answer, out = campaign.run(text)
    if whole_file and answer.exit_code != 2:
        assert_true_outcome(answer, out, own_keys(table, read_strictly(out / "parameters.json")["solver"]))
    else:
        assert_refused(answer, out, "scene.json")

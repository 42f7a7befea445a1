"""Random parameter files of every method: each ends in one clear line, or as a run whose outcome is true.

By default a seeded fraction of the campaign; GUIDEWIRE_ALL=1 makes it long, by the seed that pytest is given.
"""

import json
import resource
import subprocess

import pytest
from hypothesis import given
from hypothesis import strategies as st

from experiments.tests.run_claims import assert_refused, assert_true_outcome, read_strictly, without_wall_times
from guidewire.runs.key_table import foreign_keys, own_keys
from guidewire.runs.tests.parameter_strategies import (
    FITTED, REFUSED_IN_FILES, SOLVERS, VALUES, allowed, coaxial_scenes, examples, extreme, scenes,
)
from guidewire.runs.tests.wrong_values import borders

# The direct solver does not end where its own scales leave what a double holds: see the last tests.
LARGEST = {"pbd": 1.7e308, "xpbd": 1.7e308, "direct": 1e20, "explicit": 1.7e308}
every_method = pytest.mark.parametrize("solver", SOLVERS)


@pytest.fixture(scope="module")
def hold(campaign, table):
    """A function that runs a scene and holds it to the claims; returns (summary, folder), or None for a wire that
    starts within a wall."""

    def hold(scene):
        answer, out = campaign.run(scene)
        if answer.exit_code == 2 and (scene.get("vessel") or scene.get("obstacles")):
            assert_refused(answer, out, "scene.json")
            return None
        return assert_true_outcome(answer, out, own_keys(table, scene["solver"])), out

    return hold


def test_every_key_of_the_table_is_drawn(table, integrators):
    assert [name for name, key in table.items() if allowed(key) is None and name not in FITTED] == []
    assert VALUES.keys() | FITTED.keys() <= table.keys()
    assert table["solver"].words == SOLVERS
    assert {word for words in integrators.values() for word in words} == set(table["integrator"].words)
    assert all(integrators[solver] for solver in table["integrator"].solvers)


@every_method
def test_an_allowed_scene_runs_to_a_true_outcome(hold, table, integrators, solver):
    @examples(60)
    @given(scene=scenes(table, solver, integrators[solver]))
    def check(scene):
        hold(scene)

    check()


@every_method
@pytest.mark.few(2)
def test_extreme_numbers_end_in_a_line_or_in_a_true_outcome(campaign, table, integrators, solver):
    @examples(30)
    @given(scene=scenes(table, solver, integrators[solver], lambda key: extreme(key, LARGEST[solver])))
    def check(scene):
        answer, out = campaign.run(scene)
        if answer.exit_code == 2:
            assert_refused(answer, out, "scene.json")
        else:
            assert_true_outcome(answer, out, own_keys(table, solver))

    check()


@pytest.mark.parametrize("solver", SOLVERS[1:])
def test_a_rest_shape_is_stable_and_balanced_or_none(hold, table, integrators, solver):
    @examples(30)
    @given(scene=scenes(table, solver, integrators[solver], initialState="equilibrium", maxSimulationSteps=0))
    def check(scene):
        summary, _ = hold(scene)
        assert summary["outcome"] in ("converged", "failed") and summary["steps"] == 0

    check()


@every_method
def test_the_parameters_that_a_run_wrote_repeat_it_to_the_bit(campaign, hold, table, integrators, solver):
    @examples(8)
    @given(scene=scenes(table, solver, integrators[solver]))
    def check(scene):
        if (held := hold(scene)) is not None:
            assert_repeats(campaign, *held)

    check()


def assert_repeats(campaign, summary, out):
    """The parameters that a run wrote make the same run."""
    answer, again = campaign.repeat(out)
    assert (answer.outcome, answer.message) == (summary["outcome"], summary["reason"])
    second = read_strictly(again / "summary.json")
    for name in ("warnings", "ignored"):  # of the file, not of the run
        second[name] = summary[name]
    assert without_wall_times(second) == without_wall_times(summary)
    assert read_strictly(again / "parameters.json") == read_strictly(out / "parameters.json")
    assert (without_wall_times(read_strictly(again / "positions.json"))
            == without_wall_times(read_strictly(out / "positions.json")))


def test_a_wire_in_a_catheter_runs_to_a_true_outcome_that_repeats_to_the_bit(campaign, hold, integrators):
    @examples(12)
    @given(scene=coaxial_scenes(integrators["direct"]))
    def check(scene):
        if (held := hold(scene)) is not None:
            summary, _ = held
            for hub in summary["hubs"]:
                assert abs(hub["asked"] - hub["gone"]) <= abs(hub["shortfall"]) + 1e-9
            assert_repeats(campaign, *held)

    check()


@every_method
def test_keys_of_other_methods_are_passed_over_in_a_file(hold, table, solver):
    foreign = [name for name in foreign_keys(table, solver) if name not in REFUSED_IN_FILES]

    @examples(8)
    @given(data=st.data())
    def check(data):
        chosen = data.draw(st.sets(st.sampled_from(foreign), min_size=1))
        scene = {"solver": solver, "maxSimulationSteps": 2, "numberRodElements": 3}
        for name in sorted(chosen):
            scene[name] = data.draw(FITTED[name](scene) if name in FITTED else allowed(table[name]))
        scene.update({name: None for name in ("vessel", "obstacles") if name in foreign_keys(table, solver)})
        passed_over = [name for name in table if name in scene and solver not in table[name].solvers]
        summary, _ = hold(scene)
        assert summary["ignored"] == passed_over
        warnings = [line for line in summary["warnings"] if "does not take" in line]
        assert warnings == [f"solver {solver} does not take {', '.join(passed_over)}: ignored"]

    check()


@every_method
def test_the_borders_of_what_is_allowed_are_as_stated(campaign, hold, table, solver):
    for name, key in table.items():
        if key.kind not in ("number", "whole") or solver not in key.solvers or name == "duration":
            continue  # a duration's largest number of steps depends on timeStep
        inside, outside = borders(key)
        scene = {"solver": solver, "numberRodElements": 3, "maxSimulationSteps": 2}
        for value in inside:
            hold({**scene, name: value})
        for value in outside:
            assert_refused(*campaign.run({**scene, name: value}), "scene.json", name)


def end_in_time(command, folder, scene):
    """Exit code of a run by itself; it is killed where it takes more than 3 s of a processor's time."""
    path = folder / "scene.json"
    path.write_text(json.dumps(scene))
    done = subprocess.run([*command, "-parameters", str(path), "-out", str(folder / "run")], capture_output=True,
                          check=False, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (3, 3)))
    return done.returncode


# A bend stiffness that is 0, infinite or next to either as a double.
@pytest.mark.parametrize("radius", [1e-100, 1e-83, 1e-78, 1e75, 1e100])
@pytest.mark.few(1)
def test_a_wire_too_thin_or_thick_for_a_double_ends(runner_command, tmp_path, radius):
    assert end_in_time(runner_command, tmp_path, {"solver": "direct", "wireRadius": radius}) in (0, 2, 5)


def test_a_rest_shape_of_any_turn_is_found_or_failed(campaign, table):
    scene = {"solver": "direct", "initialState": "equilibrium", "maxSimulationSteps": 0, "distalEnd": "clamped",
             "distalRotation": 1e10}
    answer, out = campaign.run(scene)
    assert_true_outcome(answer, out, own_keys(table, "direct"))


@pytest.mark.parametrize("scene", [
    {"distalEnd": "clamped", "distalRotation": 1e10}, {"twistPerStep": -1e10},
    {"distalEnd": "clamped", "distalRotation": -1e10, "distalRampTime": 0.02},
    {"distalEnd": "clamped", "distalRotation": 1e300, "initialState": "equilibrium", "maxSimulationSteps": 0},
], ids=["at once", "a step", "in a ramp", "rest shape"])
def test_a_turn_that_no_wire_can_be_wound_up_by_fails(campaign, table, scene):
    answer, out = campaign.run({"solver": "direct", "proximalEnd": "clamped", "maxSimulationSteps": 3, **scene})
    assert_true_outcome(answer, out, own_keys(table, "direct"))
    assert answer.outcome == "failed" and "turns by more than 10000 rad at once" in answer.message

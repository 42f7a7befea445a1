"""What a table of runs holds: exact names, every combination of values, variants, repeats, and what it refuses."""

import json
import math
from urllib.parse import unquote

import pytest
from hypothesis import given
from hypothesis import strategies as st

from guidewire.studies.builtin import STUDIES
from guidewire.studies.frontiers import FRONTIERS
from guidewire.studies.keys import checked_key, run_key, value_text
from guidewire.studies.maps import MAPS
from guidewire.studies.table import Axis, Case, Grid
from guidewire.studies.wire_maps import WIRE_MAPS

GRIDS = {name: study for name, study in STUDIES.items() if study not in (*FRONTIERS, *MAPS, *WIRE_MAPS)}
VALUES = st.one_of(
    st.integers(-10**30, 10**30), st.floats(allow_nan=False, allow_infinity=False), st.booleans(),
    st.text(max_size=6), st.sampled_from(["1", "1.0", "true", "a,b=1", "'1'", "%31", "..", "", "\ud800"]),
)


def exact(value):
    """What two values share that are the same in every respect: 1, 1.0 and true are three, and 0.0 and -0.0 two."""
    return type(value), math.copysign(1.0, value) if isinstance(value, float) else None, value


@given(VALUES, VALUES)
def test_two_values_never_share_a_name(one, other):
    keys = {Grid((Axis("key", (value,)),)).cases()[0].key for value in (one, other)}
    assert len(keys) == (1 if exact(one) == exact(other) else 2)


@given(st.lists(VALUES, min_size=1, max_size=12, unique_by=exact),
       st.lists(VALUES, min_size=1, max_size=3, unique_by=exact))
def test_no_two_runs_of_two_axes_share_a_name(first, second):
    keys = [case.key for case in Grid((Axis("a", tuple(first)), Axis("b", tuple(second)))).cases()]
    assert len(set(keys)) == len(keys) == len(first) * len(second)


@given(VALUES)
def test_a_value_can_be_read_back_from_its_text(value):
    text = value_text(value)
    if isinstance(value, str):
        assert (unquote(text[1:-1], errors="surrogatepass") if text.startswith("'") else text) == value
    else:
        assert exact(json.loads(text)) == exact(value)


def test_values_that_six_digits_do_not_tell_apart_have_names_of_their_own():
    keys = [case.key for case in Grid((Axis("timeStep", (1 / 30, 0.033333334, 0.1, 1, 1.0)),)).cases()]
    assert keys == [
        "timeStep=0.03333333333333333", "timeStep=0.033333334", "timeStep=0.1", "timeStep=1", "timeStep=1.0"]


@pytest.mark.parametrize("value", [math.nan, math.inf, None, [1], {"a": 1}])
def test_what_has_no_exact_text_is_no_value_of_an_axis(value):
    with pytest.raises(ValueError, match="as a variant, which has a name"):
        Axis("key", (value,))


@pytest.mark.parametrize("key", ["", ".", "..", "a/b", "a\\b", "a:b", "a.", "a ", "\n", "ü", "x" * 201])
def test_a_name_that_cannot_be_a_files_is_refused(key):
    with pytest.raises(ValueError, match="to name a run|cannot name a run"):
        Case(key, {})
    assert checked_key("barycentric,s=0.1") == "barycentric,s=0.1"


def test_two_axes_are_every_combination_with_every_variant():
    grid = Grid((Axis("totalMass", (1.0, 2.0)), Axis("integrator", ("euler", "verlet"))), {"displacement": 1},
                {"hard": {"bendStiffness": 2}, "soft": {"bendStiffness": 0.5, "displacement": 3}}, repeats=2)
    assert [(case.key, dict(case.overrides)) for case in grid.cases()] == [
        (f"{variant},totalMass={mass},integrator={word}",
         {"displacement": size, "bendStiffness": gain, "totalMass": mass, "integrator": word})
        for variant, gain, size in (("hard", 2, 1), ("soft", 0.5, 3)) for mass in (1.0, 2.0)
        for word in ("euler", "verlet")
    ]
    last = grid.cases()[-1]
    assert (last.variant, last.values, last.repeats) == ("soft", {"totalMass": 2.0, "integrator": "verlet"}, 2)


def test_each_variant_takes_every_value_and_a_duration_sets_the_steps():
    grid = Grid((Axis("timeStep", (0.1, 0.3)),), {"displacement": 1}, {"many": {"displacement": 2}, "few": {}},
                duration=0.9, least_steps=5)
    assert [(case.key, case.overrides) for case in grid.cases()] == [
        ("many,timeStep=0.1", {"displacement": 2, "timeStep": 0.1, "maxSimulationSteps": 9}),
        ("many,timeStep=0.3", {"displacement": 2, "timeStep": 0.3, "maxSimulationSteps": 5}),
        ("few,timeStep=0.1", {"displacement": 1, "timeStep": 0.1, "maxSimulationSteps": 9}),
        ("few,timeStep=0.3", {"displacement": 1, "timeStep": 0.3, "maxSimulationSteps": 5}),
    ]
    # 0.07/0.01 is above 7 by rounding.
    assert Grid(common={"timeStep": 0.01}, duration=0.07).cases()[0].overrides["maxSimulationSteps"] == 7


def test_variants_without_an_axis_are_runs_of_their_own_name_and_neither_is_one_run():
    named = Grid(variants={"a": {}, "b": {"displacement": 3}}).cases()
    assert [(case.key, case.variant, case.values) for case in named] == [("a", "a", {}), ("b", "b", {})]
    assert [case.key for case in Grid().cases()] == ["default"] == [run_key("", {})]


@pytest.mark.parametrize("make, said", [
    (lambda: Axis("m", (1, 2, 1)), "m takes 1 twice"),
    (lambda: Axis("m", ()), "m takes no value"),
    (lambda: Grid((Axis("m", (1,)), Axis("m", (2,)))), "m is an axis twice"),
    (lambda: Grid((Axis("m", (1,)),), variants={"few": {"m": 3}}), "m is an axis, and variant few sets it too"),
])
def test_a_table_that_contradicts_itself_is_refused(make, said):
    with pytest.raises(ValueError, match=said):
        make()


def test_the_thesis_sweeps_are_the_thesis_ranges():
    thesis = {
        "constraintSolverSteps": (100, 1000), "numberRodElements": (5, 60), "displacement": (1, 100),
        "timeStep": (1e-4, 1e-1), "totalMass": (1e-3, 1.0),
    }
    swept = [study for study in GRIDS.values() if study.grid.axes and not study.grid.variants]
    assert len(swept) == 14
    for study in swept:
        (axis,) = study.grid.axes
        assert (min(axis.values), max(axis.values)) == thesis[axis.key], study.name


def test_every_thesis_sweep_holds_the_default_value():
    table_4_1 = {
        "constraintSolverSteps": 500, "numberRodElements": 30, "displacement": 10, "timeStep": 0.01,
        "totalMass": 0.01,
    }
    for study in GRIDS.values():
        assert all(table_4_1[axis.key] in axis.values for axis in study.grid.axes)


@pytest.mark.parametrize("study", (*GRIDS.values(), *MAPS, *(study for study in WIRE_MAPS
                                                             if isinstance(study.grid, Grid))),
                         ids=lambda study: study.name)
def test_no_two_runs_share_a_name(study):
    keys = [case.key for case in study.grid.cases()]
    assert len({key.lower() for key in keys}) == len(keys)
    assert len(keys) * (1 + study.grid.repeats) == study.grid.count

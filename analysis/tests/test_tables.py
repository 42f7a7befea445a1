"""Run and study folders, and the table of a study."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from analysis.tables import Spread, read_table, steady_state_step
from analysis.tests.chain import Chain, small, write_study
from guidewire.logs.logs import LogError, read_log
from guidewire.logs.runs import read_run, read_study


@pytest.fixture(scope="module")
def chain() -> Chain:
    return small()


def test_run_knows_its_rest_and_displacement(tmp_path: Path, chain: Chain) -> None:
    run = read_run(chain.write(tmp_path / "run"))
    np.testing.assert_array_equal(run.rest_positions[:, 2], chain.rest)
    np.testing.assert_array_equal(run.rest_positions[:, :2], 0.0)
    np.testing.assert_array_equal(run.displacement, [0.0, 0.0, 10.0])
    assert run.outcome == "converged"
    with pytest.raises(LogError, match="parameters.json: has no gravity"):
        run.value("gravity")
    with pytest.raises(LogError, match="not a number"):
        run.number("displacementDirection")


def test_direction_need_not_be_of_length_one(tmp_path: Path, chain: Chain) -> None:
    folder = chain.write(tmp_path / "run")
    (folder / "parameters.json").write_text(json.dumps({**chain.parameters, "displacementDirection": [0, 3, 4]}))
    np.testing.assert_allclose(read_run(folder).displacement, [0.0, 6.0, 8.0])


def test_table_rows_are_measured_from_their_own_runs(studies: dict[str, Path]) -> None:
    table = read_table(studies["constraint-solver-steps"], "constraintSolverSteps")
    np.testing.assert_array_equal(table.column("value"), [80, 120, 160, 200])
    for row in table.rows:
        chain = small(constraint_solver_steps=int(row.value))
        rest = chain.rest + chain.displacement
        assert row.total_error == pytest.approx(np.abs(chain.z[-1] - rest).sum(), rel=1e-12)
        assert row.steady_state_step == chain.steady_state_step > 0
        assert row.steady_state_time == pytest.approx(row.steady_state_step * 0.01)
        # Repeats 1, 2, 3 take 2, 3, 4 ms a step.
        assert row.step_time == Spread(3.0, 2.0, 4.0, 3)
        assert row.computation_time is not None
        assert row.computation_time.median == pytest.approx(0.003 * row.steady_state_step)
        assert row.computation_time.highest == pytest.approx(0.004 * row.steady_state_step)
    assert np.all(np.diff(table.column("relaxation.time")) < 0.0)


def test_rows_are_in_the_order_of_the_value(tmp_path: Path) -> None:
    chains = [small(displacement=size) for size in (10.0, 1.0, 5.0)]
    table = read_table(write_study(tmp_path, "displacement", "displacement", chains, repeats=0), "displacement")
    np.testing.assert_array_equal(table.column("value"), [1.0, 5.0, 10.0])
    assert all(row.step_time is None and row.computation_time is None for row in table.rows)
    assert np.isnan(table.column("step_time.median")).all()


def test_run_without_steady_state_or_relaxation_has_a_row_that_says_so(tmp_path: Path) -> None:
    short = small(most_steps=30)
    row = read_table(write_study(tmp_path, "time-step", "timeStep", [short]), "timeStep").rows[0]
    assert row.steady_state_step is None and row.steady_state_time is None and row.computation_time is None
    assert row.relaxation is None and "too few" in (row.no_relaxation or "")
    assert row.step_time is not None


def test_killed_run_is_read_up_to_its_last_whole_step(tmp_path: Path, chain: Chain) -> None:
    folder = write_study(tmp_path, "time-step", "timeStep", [chain], repeats=2)
    run = folder / "timeStep=0.01"
    log = run / "positions.json"
    (run / "positions.json.partial").write_text(log.read_text()[:-5000])
    log.unlink()
    (run / "summary.json").unlink()
    (folder / "timeStep=0.01-repeat-2" / "summary.json").unlink()
    row = read_table(folder, "timeStep").rows[0]
    assert row.run.outcome == "killed" and "cut short" in (row.warning or "") and 0 < row.steps < chain.steps
    assert row.steady_state_step is None  # killed within the 100 steps that it must hold still
    assert row.step_time is not None and row.step_time.count == 1  # the killed repeat has no step time


def test_without_a_summary_the_steady_state_is_found_in_a_log_of_every_step(tmp_path: Path, chain: Chain) -> None:
    folder = chain.write(tmp_path / "run")
    (folder / "summary.json").unlink()
    run = read_run(folder)
    assert steady_state_step(run, read_log(folder)) == chain.steady_state_step
    assert steady_state_step(run, read_log(folder, every=2)) is None


def test_log_of_the_last_sphere_alone_has_no_total_error(tmp_path: Path, chain: Chain) -> None:
    folder = write_study(tmp_path, "time-step", "timeStep", [chain], repeats=0)
    entries = {str(k): chain.entry(k, spheres=[chain.elements]) for k in range(chain.steps + 1)}
    (folder / "timeStep=0.01" / "positions.json").write_text(json.dumps(entries))
    row = read_table(folder, "timeStep").rows[0]
    assert row.total_error is None and row.relaxation is not None


def test_curve_over_one_parameter_is_not_drawn_from_a_study_of_two(tmp_path: Path, chain: Chain) -> None:
    folder = write_study(tmp_path, "map", "timeStep", [chain], repeats=0)
    table = json.loads((folder / "study.json").read_text())
    table["runs"][0]["values"]["totalMass"] = 0.01
    (folder / "study.json").write_text(json.dumps(table))
    assert read_study(folder).axes == ("timeStep", "totalMass")
    with pytest.raises(LogError, match="study.json: varies timeStep, totalMass, not timeStep alone"):
        read_table(folder, "timeStep")


def test_curve_over_one_parameter_is_not_drawn_from_several_variants(tmp_path: Path, chain: Chain) -> None:
    folder = write_study(tmp_path, "two", "timeStep", [chain, chain], repeats=0, variants=["a", "b"])
    assert [(run.variant, dict(run.values)) for run in read_study(folder).untimed] == [
        ("a", {"timeStep": chain.time_step}), ("b", {"timeStep": chain.time_step})]
    with pytest.raises(LogError, match="varies timeStep, variants, not timeStep alone"):
        read_table(folder, "timeStep")


def test_runs_that_left_nothing_are_named(tmp_path: Path, chain: Chain) -> None:
    folder = write_study(tmp_path, "time-step", "timeStep", [chain], repeats=0)
    table = json.loads((folder / "study.json").read_text())
    table["runs"].append({**table["runs"][0], "key": "timeStep=9", "folder": "timeStep=9"})
    (folder / "study.json").write_text(json.dumps(table))
    assert read_table(folder, "timeStep").missing == ("timeStep=9",)
    (folder / "timeStep=0.01" / "positions.json").unlink()
    with pytest.raises(LogError, match="no run of this study has a log"):
        read_table(folder, "timeStep")


@pytest.mark.parametrize(("text", "said"), [("", "not JSON"), ("[]", "not a JSON object"), ('{"runs": [{}]}', "lacks")])
def test_study_that_is_none_is_refused_in_one_line(tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "study.json").write_text(text)
    with pytest.raises(LogError, match=said) as error:
        read_study(tmp_path)
    assert "\n" not in str(error.value) and "study.json" in str(error.value)


def test_spread_is_the_median_and_the_range() -> None:
    assert Spread.of([3.0, 1.0, 2.0, 10.0]) == Spread(2.5, 1.0, 10.0, 4)
    assert Spread.of([]) is None

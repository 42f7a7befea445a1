"""Advice for what one asks: what an error is of, and that nothing is advised where a finer run has not converged."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from analysis.tests.chain import write_log
from guidewire.advice import chart, plan, quantity, report
from guidewire.advice.plan import Advice, Tried, AdviceRequest
from guidewire.advice.quantity import Quantity
from guidewire.advice.trials import Trial
from guidewire.commands.arguments import error_part
from guidewire.commands.commands import parse
from guidewire.logs.hub import read_hub, snap_turns
from guidewire.logs.logs import LogError, read_log
from guidewire.logs.runs import Run, read_runs
from guidewire.sweeps.check import replay
from guidewire.sweeps.sweep import Means, sweep

# A short wire that is pushed against a plane at an angle, and slides along it.
PUSHED = {
    "solver": "direct", "guidewireLength": 100.0, "numberRodElements": 8, "wireRadius": 0.0004, "massDamping": 20,
    "proximalEnd": "clamped", "drive": "displace", "insertionSpeed": 0.1, "timeStep": 0.02, "deltaThreshold": 0,
    "guidewireOffset": -101.0, "maxSimulationSteps": 16,
    "vessel": {"shape": "plane", "point": [0, -0.5, 0], "normal": [0, 0.94, -0.34]},
}


@pytest.fixture(scope="module")
def advise(tmp_path_factory, runner_command):
    """Advice for a wish, all into one folder of runs."""
    folder = tmp_path_factory.mktemp("advice")
    file = folder / "pushed.json"
    file.write_text(json.dumps(PUSHED), encoding="utf-8")

    def made(wish: AdviceRequest, **overrides: object) -> tuple[Advice, Path]:
        check = plan.check_of(file, wish, plan.by_work, repeats=0, overrides=overrides)
        assert sweep([(check, folder)], folder / "runs", Means(runner_command)).failures == []
        return replay(check, folder), folder / "pushed"

    return made


def test_the_hubs_force_has_an_error_of_its_own(advise) -> None:
    """Errors are those of the logs, measured anew."""
    advice, folder = advise(AdviceRequest(0.5, quantity=Quantity("hubForce")))
    runs = read_runs(folder)
    exact, file = read_hub(runs["reference"].folder), read_hub(runs["file"].folder)
    times = np.linspace(0.0, 0.32, 81)
    force = np.interp(times, exact.time, exact.force)
    error = np.sqrt(np.mean((np.interp(times, file.time, file.force) - force) ** 2) / np.mean(force**2))
    assert advice.scene.error == pytest.approx(error, rel=1e-9)
    places, _ = advise(AdviceRequest(0.5))
    assert abs(places.scene.error / error - 1.0) > 0.5


def test_errors_of_places_are_parts_of_a_displacement_and_a_run_that_ended_stays(tmp_path) -> None:
    write_log(tmp_path, [[(100.0, 0.0, 10.0 * i + 2.0 * k) for i in range(3)] for k in range(3)], 0.5)
    tip = Quantity("tip")
    values = tip.read(Run(tmp_path, {}, {}), np.array([0.0, 0.5, 1.0, 2.0]))
    assert values == pytest.approx(np.array([[100.0, 0.0, 20.0 + z] for z in (0.0, 2.0, 4.0, 4.0)]))
    assert tip.scale(values) == pytest.approx(math.sqrt((0.0 + 4.0 + 16.0 + 16.0) / 12.0))
    assert Quantity("hubForce").scale(values[:, 2:]) == pytest.approx(
        math.sqrt(np.mean(values[:, 2] ** 2)))


def test_at_the_end_the_last_moment_counts(advise) -> None:
    advice, folder = advise(AdviceRequest(0.5, quantity=Quantity("tip", "end")))
    runs = read_runs(folder)
    exact, file = (tips(runs[key].folder) for key in ("reference", "file"))
    error = np.linalg.norm(file[-1] - exact[-1]) / np.linalg.norm(exact[-1] - exact[0])
    assert advice.scene.error == pytest.approx(error, rel=1e-6)


def test_overrides_hold_in_every_run_but_where_a_part_is_left_out(advise) -> None:
    advice, folder = advise(AdviceRequest(0.5), **{"vessel.frictionCoefficient": 0.2, "massDamping": 30})
    runs = read_runs(folder)
    friction = {key: run.parameters["vessel"].get("frictionCoefficient", 0.0) for key, run in runs.items()}
    smooth = {f"part-{k}" for k, one in enumerate(advice.parts) if one.trial.name == "friction, left out"}
    assert {key for key, value in friction.items() if value == 0.0} == smooth and len(smooth) == 1
    assert {run.parameters["massDamping"] for key, run in runs.items()} == {0.0, 30.0}
    scene = {**PUSHED, "vessel.frictionCoefficient": 0.2, "massDamping": 30}
    assert json.loads(report.parameters(advice, scene, folder))["vessel"]["frictionCoefficient"] == 0.2


def tips(folder: Path) -> np.ndarray:
    return read_log(folder, spheres="all").positions[:, -1]


def test_a_number_of_the_summary_is_compared_with_two_coarser_runs(advise) -> None:
    advice, folder = advise(AdviceRequest(0.5, quantity=Quantity("extremes.axialForce")))
    runs = read_runs(folder)
    values = {key: runs[key].summary["extremes"]["axialForce"] for key in runs}
    assert {"coarser-0", "coarser-1"} <= set(values)
    apart = max(abs(values[key] / values["reference"] - 1.0) for key in ("coarser-0", "coarser-1"))
    assert advice.reference_error == pytest.approx(apart, rel=1e-9)


def test_nothing_is_advised_beyond_what_the_reference_is_known_to(advise) -> None:
    known = advise(AdviceRequest(0.5, quantity=Quantity("hubForce")))[0].reference_error
    wish = AdviceRequest(0.9 * known, quantity=Quantity("hubForce"))
    advice, _ = advise(wish)
    assert advice.taken is None
    said = report.verdict(wish, advice)
    assert said.startswith("Not advised: the hub's force from start to end has not converged")
    assert report.percent(known) in said and report.percent(wish.error) in said
    assert "No run was timed." in report.as_markdown("pushed.json", wish, advice)
    assert advise(AdviceRequest(1.1 * known, quantity=Quantity("hubForce")))[0].taken is not None


def test_the_walls_force_is_read_from_the_contacts_of_the_log(advise) -> None:
    advice, _ = advise(AdviceRequest(0.5, quantity=Quantity("contactForce")))
    assert 0.0 < advice.scene.error < 1.0


@pytest.mark.parametrize("of, scene, said", [
    ("hubForce", {"solver": "pbd"}, "--of hubForce needs solver direct, this is pbd"),
    ("contactForce", {"solver": "direct", "vessel": None}, "needs walls"),
    ("snapAngle", {"solver": "direct"}, "needs catheters"),
    ("snapAngle", {"solver": "xpbd"}, "needs solver direct"),
])
def test_what_a_scene_does_not_have_is_reported(of: str, scene: dict, said: str) -> None:
    with pytest.raises(LogError, match=said):
        Quantity(of).refuse(scene, {})


@pytest.mark.parametrize("steps", [7, 97, 5000])
def test_a_snap_lies_between_the_entries_where_the_torque_comes_back(steps: int) -> None:
    """The torque falls back over a fifth of a degree at 1.2 and at 2.4 rad, the hub then turns back; slow changes are
    no snaps."""
    turn = np.concatenate((np.linspace(0.0, 3.0, steps + 1), np.linspace(3.0, 2.0, steps)))
    torque = 0.2 * np.sin(40.0 * turn[: steps + 1]) / 40.0
    for at in (1.2, 2.4):
        torque -= 0.5 + 0.5 * np.tanh((turn[: steps + 1] - at) / math.radians(0.04))
    torque += turn[: steps + 1] / 1.2
    torque = np.concatenate((torque, np.full(steps, torque[-1])))
    before, after = snap_turns(turn, torque)
    assert len(before) == len(after) == 2
    for at, start, end in zip((1.2, 2.4), before, after):
        slack = math.radians(0.05)
        assert start - slack <= at <= end + slack and end - start == pytest.approx(3.0 / steps, rel=1e-9)
    assert len(snap_turns(turn, np.zeros(len(turn)))[0]) == 0


def test_an_unknown_name_gets_the_nearest() -> None:
    summary = {"steps": 3, "extremes": {"axialForce": 0.5, "strain": None}, "outcome": "finished"}
    assert quantity.number_of(summary, "extremes.axialForce") == 0.5
    with pytest.raises(LogError, match="did you mean extremes.axialForce?"):
        quantity.number_of(summary, "extremes.axialforce")
    with pytest.raises(LogError, match="did you mean hubForce?"):
        quantity.number_of(summary, "hubforce")


@pytest.mark.parametrize("text, error", [("5%", 0.05), ("0.05", 0.05), ("1", 1.0), ("250%", 2.5)])
def test_an_error_is_a_part_or_a_percentage(text: str, error: float) -> None:
    assert error_part(text) == pytest.approx(error, rel=1e-15)


@pytest.mark.parametrize("text, said", [("5", "'5' is 500 %: write 5% for 0.05"), ("%", "is not a number"),
                                        ("0%", "is not a number above 0"), ("1.01", "write 1.01% for 0.0101")])
def test_a_plain_number_above_one_is_questioned(text: str, said: str, capsys) -> None:
    with pytest.raises(SystemExit) as ended:
        parse(["advise", "scene.json", "--error", text])
    line = capsys.readouterr().err
    assert ended.value.code == 2 and said in line and line.count("\n") == 1


def test_the_chart_has_a_point_for_each_setting_that_was_not_lost() -> None:
    def tried(n: int, error: float, work: float) -> Tried:
        return Tried(Trial(f"n = {n}", {}), error, 0.0, "finished", work, None, None, None, {"numberRodElements": n})

    searched = [tried(8, 0.1, 1.0), tried(8, 0.02, 4.0), tried(16, 0.01, 8.0), tried(16, math.nan, 2.0)]
    advice = Advice(searched[0], tried(32, 0.0, 64.0), 0.005, [], searched, searched[1])
    axes = chart.draw_advice("scene.json", AdviceRequest(0.03, quantity=Quantity("hubForce")), advice).axes[0]
    drawn = {line.get_label(): line.get_xydata() for line in axes.lines}
    assert drawn["n = 8"].tolist() == [[1.0, 0.1], [4.0, 0.02]] and drawn["n = 16"].tolist() == [[8.0, 0.01]]
    assert axes.get_ylim() == pytest.approx((0.0025, 0.2))
    assert drawn["taken"].tolist() == [[4.0, 0.02]] and "the hub's force" in axes.get_ylabel()

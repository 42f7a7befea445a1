"""`reliable` of random runs, judged from their logs; and the judge, of runs that are not what they say."""

import json

import numpy as np
import pytest

from experiments.campaigns import reliable_claims, reliable_runs
from experiments.campaigns.reliable_campaign import campaign
from guidewire.prepare import ROOT
from guidewire.runs.runner import Request
from tools.seeds import keep, seeds

WARNINGS = reliable_claims.listed((ROOT / "docs" / "runs.md").read_text(encoding="utf-8"))


def test_reliable_is_what_the_logs_of_random_runs_say(runner_command, tmp_path):
    judged = list(campaign(runner_command, seeds("reliable", range(2000, 2033), 132), tmp_path))
    keep("reliable", [one.seed for one in judged if one.claims])
    assert {one.seed: one.claims for one in judged if one.claims} == {}
    assert {one.kind for one in judged} == set(reliable_runs.KINDS)
    words = [one.outcome for one in judged]
    assert words.count("reliable") > 0.3 * len(words) and words.count("not reliable") > 0.1 * len(words)
    assert "refused" not in words and "lost" not in words


@pytest.fixture(name="run", scope="module")
def _run(live, tmp_path_factory):
    folder = tmp_path_factory.mktemp("judged")
    scene = {**reliable_runs.LOGS, "solver": "direct", "integrator": "implicitEuler", "guidewireLength": 100.0,
             "numberRodElements": 10, "guidewireOffset": 0.0, "proximalEnd": "clamped", "massDamping": 50.0,
             "timeStep": 0.01, "maxSimulationSteps": 20, "logContacts": True, "logHub": True, "logStrains": True,
             "drive": "displace", "displacementPerStep": 0.5, "gravity": [0.0, -9.81, 0.0], "hubForceLimit": 5.0,
             "vessel": {"shape": "tube", "radius": 3.0, "openEnd": True, "knots": [[0, 0, -50], [0, 0, 200]]}}
    (folder / "scene.json").write_text(json.dumps(scene))
    assert live.run(Request("a", folder / "scene.json", folder / "out")).outcome == "finished"
    with np.load(folder / "out" / "positions.npz") as log:
        return (json.loads((folder / "out" / "parameters.json").read_text()),
                json.loads((folder / "out" / "summary.json").read_text()), dict(log))


def test_the_judge_has_nothing_against_a_run_that_is_right(run):
    assert run[1]["reliable"] and reliable_claims.violations(*run, WARNINGS) == []
    assert len(WARNINGS) > 10


def _moved(log, by, entry=-1):
    positions = log["positions"].copy()
    positions[entry] += by
    return {**log, "positions": positions}


@pytest.mark.parametrize("name, changed", [
    ("not finite", lambda log: {**log, "velocities": np.where(log["velocities"] == log["velocities"].max(), np.nan,
                                                               log["velocities"])}),
    ("passed a wall", lambda log: _moved(log, [0.0, 3.5, 0.0], 10)),
    ("penetration", lambda log: _moved(log, [0.0, -2.6, 0.0], 12)),
    ("length", lambda log: {**log, "positions": 1.02 * log["positions"]}),
    ("strain", lambda log: {**log, "curvature": log["curvature"] + 500.0}),
    ("shortfall", lambda log: _moved(log, [0.0, 0.0, -0.1])),
    ("hub's force", lambda log: {**log, "hubForce": log["hubForce"] + 6.0}),
    ("balance", lambda log: {**log, "reaction": log["reaction"] + [0.2 * np.abs(log["reaction"]).max(), 0.0, 0.0]}),
])
def test_the_judge_finds_what_a_run_that_calls_itself_reliable_hides(run, name, changed):
    scene, summary, log = run
    claims = reliable_claims.violations(scene, summary, changed(log), WARNINGS)
    assert any(claim.startswith(f"{name}: ") and "calls itself reliable" in claim for claim in claims), claims


def test_the_judge_finds_a_run_that_warns_without_reason(run):
    scene, summary, log = run
    for line in ("3 points of the wire passed a wall",
                 "the outermost fibre was strained by up to 30 % at t = 0.1 s: a real instrument would have kinked",
                 "the wire is 2.0 % longer than at rest"):
        said = {**summary, "warnings": [line], "reliable": False}
        assert "says otherwise" in reliable_claims.violations(scene, said, log, WARNINGS)[0]
        assert reliable_claims.violations(scene, {**said, "reliable": True}, log,
                                          WARNINGS)[0].startswith("reliable = True")
    assert reliable_claims.violations(scene, {**summary, "reliable": False}, log,
                                      WARNINGS)[0].startswith("reliable = False")


IN_ONE_ANOTHER = {
    **reliable_runs.LOGS, "solver": "direct", "guidewireLength": 120.0, "numberRodElements": 30,
    "guidewireOffset": -20.0,
    "wireRadius": 0.0004, "proximalEnd": "clamped", "drive": "displace", "massDamping": 20.0, "timeStep": 0.02,
    "maxSimulationSteps": 100, "logHub": True, "insertionSpeed": 0.008,
    "vessel": {"shape": "tube", "smooth": True, "openStart": True, "openEnd": True, "radius": 3.0,
               "knots": [[0, 0, -60], [0, 0, 200]], "frictionCoefficient": 0},
    "catheters": [{"start": 20.0, "length": 80.0, "elements": 20, "wireRadius": 0.0008, "lumenRadius": 0.0006}],
}


@pytest.mark.parametrize("bent, is_reliable", [(0.0, True), (2.0, True), (20.0, False), (40.0, True), (200.0, False)])
@pytest.mark.few(3)
def test_a_hub_that_rests_does_not_fall_short_and_large_play_is_not_reliable(live, tmp_path, bent, is_reliable):
    """A wire is pushed through a catheter at rest, whose spring gives way by 1e-10 of its length. The wire's play d =
    0.2 mm and a difference k of the rest curvatures: sqrt(3 d k), and a = sqrt(12 d/k), of the overlap of 80 mm."""
    catheter = {**IN_ONE_ANOTHER["catheters"][0], "restCurvature": [bent, 0.0, 0.0]}
    (tmp_path / "scene.json").write_text(json.dumps({**IN_ONE_ANOTHER, "catheters": [catheter]}))
    assert live.run(Request("a", tmp_path / "scene.json", tmp_path / "out")).outcome == "finished"
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    hubs = summary["hubs"]
    assert hubs[0]["asked"] == pytest.approx(0.016) and hubs[1]["asked"] == 0.0
    assert abs(hubs[0]["shortfall"]) < 1e-9 and abs(summary["driveShortfall"]) < 1e-4
    angle = float(np.degrees(np.sqrt(3.0 * 2e-4 * bent)))
    length = float(np.sqrt(12.0 * 2e-4 / bent)) if bent else 0.0
    assert summary["catheters"][0]["playAngle"] == pytest.approx(angle, rel=1e-6)
    is_small = angle <= 15.0 and (angle <= 5.0 or length <= 0.1 * summary["catheters"][0]["overlap"])
    assert is_small == is_reliable, (angle, length, summary["warnings"])
    assert any("of play in the" in line for line in summary["warnings"]) == (not is_small)
    # Elements of 4 mm are long for a bend of 40/m beyond the tip, for which the run says so.
    assert summary["reliable"] == (is_small and "is uncertain by" not in summary["reason"])

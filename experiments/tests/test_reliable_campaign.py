"""`reliable` of random runs, judged from their logs; and the judge, of runs that are not what they say."""

import json
import os

import numpy as np
import pytest

from experiments.campaigns import reliable_claims, reliable_runs
from experiments.campaigns.reliable_campaign import campaign
from guidewire.prepare import ROOT
from guidewire.runs.runner import Request
from tools.testing import FULL_CAMPAIGNS

WARNINGS = reliable_claims.listed((ROOT / "docs" / "runs.md").read_text(encoding="utf-8"))


def test_reliable_is_what_the_logs_of_random_runs_say(runner_command, tmp_path):
    seeds = range(2000, 2500) if FULL_CAMPAIGNS in os.environ else range(2000, 2044)
    judged = list(campaign(runner_command, seeds, tmp_path))
    assert {one.seed: one.claims for one in judged if one.claims} == {}
    assert {one.kind for one in judged} == set(reliable_runs.KINDS)
    words = [one.word for one in judged]
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
    for line in ("3 points of the wire passed a wall", "the outermost fibre was strained by up to 30 %: a real instrument "
                 "would have kinked", "the wire is 2.0 % longer than at rest"):
        said = {**summary, "warnings": [line], "reliable": False}
        assert "says otherwise" in reliable_claims.violations(scene, said, log, WARNINGS)[0]
        assert reliable_claims.violations(scene, {**said, "reliable": True}, log, WARNINGS)[0].startswith("reliable = True")
    assert reliable_claims.violations(scene, {**summary, "reliable": False}, log, WARNINGS)[0].startswith("reliable = False")

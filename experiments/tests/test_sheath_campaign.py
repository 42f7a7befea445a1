"""The wire of the clinical scene, fed in with its tip bent in any direction and at many speeds: no passage, and every
figure of log and summary true."""

import os

import numpy as np
import pytest

from analysis.passages import Wall
from experiments.campaigns import sheath_campaign
from experiments.campaigns.vessel import artery_lumens



@pytest.mark.skipif(os.environ.get("GUIDEWIRE_ALL") != "1", reason="test_random_pushes.py has wires in sheaths, too")
def test_wires_fed_in_pass_no_wall_and_say_what_is_true(runner_command, tmp_path):
    runs = list(sheath_campaign.campaign(runner_command, range(100), tmp_path))
    broken = [f"{run.seed} ({run.angle:.2f} rad, {run.speed:.0f} mm/s): {run.claims}" for run in runs if run.claims]
    assert not broken, "\n".join(broken)
    assert {run.branch for run in runs} == {0, 1}


def test_a_tip_is_in_the_branch_whose_line_it_is_on():
    whole, second = artery_lumens()
    assert sheath_campaign.branch_of(whole.centres[-1] - 1e-3) == 0
    assert sheath_campaign.branch_of(second.centres[-1] - 1e-3) == 1
    assert sheath_campaign.branch_of(second.centres[0]) is None
    assert sheath_campaign.branch_of(np.array([500.0, 0.0, 0.0])) is None


def test_what_is_not_so_is_claimed():
    # A square channel of 4 mm along z, open at both ends.
    ring = np.array([[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]])
    ends = [np.column_stack([ring, np.full(4, z)]) for z in (-20.0, 120.0)]
    sides = [face for k in range(4) for face in ((k, (k + 1) % 4, 4 + k), ((k + 1) % 4, 4 + (k + 1) % 4, 4 + k))]
    wall = Wall.of(np.concatenate(ends), np.array(sides))
    angle, speed = sheath_campaign.draw(1)
    scene = sheath_campaign.scene_of(angle, speed)
    gone = 1e3 * scene["insertionSpeed"] * scene["timeStep"] * scene["maxSimulationSteps"]
    line = np.linspace(30.0, 0.0, 5)[:, None] * [0.0, 0.0, -1.0]
    start = line + [0.0, 0.0, 15.0]
    positions = np.array([start, start + [0.0, 0.0, 5.0], start + [0.0, 0.0, 5.0]])
    summary = {
        "outcome": "finished", "steps": scene["maxSimulationSteps"], "reason": "", "passages": 0, "driveAsked": gone,
        "driveShortfall": gone - 5.0, "hub": {"insertion": 0.005, "lengthInBody": 0.035, "spheresInBody": 4},
    }
    honest = sheath_campaign.judge(scene, summary, positions, wall)
    assert [claim.split(":")[0] for claim in honest] == ["the tip is in neither branch"]

    def claims(places=positions, **changed):
        hub = summary["hub"] | {key: changed.pop(key) for key in tuple(changed) if key in summary["hub"]}
        return sheath_campaign.judge(scene, summary | {"hub": hub} | changed, places, wall)[:-1]

    outside = positions.copy()
    outside[2, 3:, 0] = 5.0
    assert [len(claims(passages=1)), len(claims(outside)), len(claims(driveShortfall=0.0)), len(claims(steps=3))] == [
        1, 1, 1, 3]
    assert len(claims(lengthInBody=0.5)) == len(claims(spheresInBody=5)) == 1
    assert len(claims(insertion=0.006)) == 3

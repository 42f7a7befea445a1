"""Random tubes in one another against an own solution: composite beams, and bars that slide."""

import json
import os

import numpy as np
import pytest

from experiments.tests.coaxial_beams import hub_forces, parameters, random_case
from guidewire.logs.logs import read_log
from guidewire.runs.runner import Request

CASES = int(os.environ.get("GUIDEWIRE_COAXIAL_BEAMS", "20"))
OF_LENGTH = 1e-3
OF_FORCE = 5e-3
LEAST_FORCE = 1e-4                 # N


@pytest.mark.parametrize("seed", range(CASES))
@pytest.mark.few(5)
def test_rest_shapes_and_hub_forces_are_those_of_beams_and_bars(live, tmp_path, seed):
    tubes, gravity, expected = random_case(seed)
    path = tmp_path / "tubes.json"
    path.write_text(json.dumps(parameters(tubes, gravity)))
    answer = live.run(Request("tubes", path, tmp_path / "out", {}))
    assert answer.exit_code == 0, answer.message
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    log = read_log(tmp_path / "out", "all")
    tips = np.array([*(one["tipPosition"] for one in summary["catheters"]), log.positions[-1, -1]])[:, 1:] * 1e-3
    forces = np.array([*(one["force"] for one in summary["catheters"]), summary["hub"]["force"]])
    length = max(tube.end for tube in tubes)
    assert np.abs(tips - expected.tips).max() < OF_LENGTH * length
    hubs = hub_forces(tubes, gravity)
    assert np.abs(forces - hubs).max() < OF_FORCE * max(np.abs(hubs).max(), LEAST_FORCE)

"""A wire that coils up under a steady push: its run ends after bounded work, counted in Newton iterations."""

import json
import re

import pytest

from guidewire.prepare import ROOT
from guidewire.runs.runner import Request

SOLUTION = 50                     # maxNewtonIterations
AT_ONCE, A_STEP = 200, 4          # of it, for steps that are not solved as asked
AS_ASKED = 2                      # solutions of a step before its first halving
PUSH = "time,insertion,rotation\n0,0,0\n44.2,1.768,0\n60,1.768,0\n"    # at 40 mm/s, all of the wire in its sheath


@pytest.mark.long("half a minute; WorkLimitTests counts, SnapTests has a step that ends so")
def test_a_wire_that_coils_up_under_a_steady_push_ends_and_says_why(live, tmp_path):
    table = tmp_path / "push.csv"
    table.write_text(PUSH)
    changes = {"insertionSpeed": 0, "driveFile": str(table), "maxSimulationSteps": 1200}
    answer = live.run(Request("jam", ROOT / "params" / "sheath.json", tmp_path / "run", changes), 3000.0)
    assert answer.exit_code == 5 and answer.outcome == "failed", answer.message
    said = re.search(r"steps that were halved took more Newton iterations than a run may .*; the hub pushes with "
                     r"(\S+) N; "
                     r"the largest of \d+ contact forces is", answer.message)
    assert said, answer.message
    assert float(said[1]) < 10.0
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    steps = summary["steps"]
    assert 120 < steps < 300      # at the fork it buckles after some 130 of them
    assert summary["solver"]["wallIterations"] < SOLUTION * (AT_ONCE + (A_STEP + AS_ASKED) * (steps + 1))
    assert not summary["reliable"]

"""States beyond frontiers and in the maps of outcomes (guidewire/studies/frontiers.py, guidewire/studies/maps.py): a
method that fails says so, by its outcome, its reason or a number of the summary, and does not look fine."""

import json
from contextlib import closing
from pathlib import Path

import pytest

from guidewire.prepare import ROOT
from guidewire.runs.runner import Request, Runner

STATES = json.loads(Path(__file__).with_name("failing_states.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def runner(runner_command):
    with closing(Runner(runner_command)) as runner:
        yield runner


@pytest.mark.parametrize("state", STATES, ids=[state["name"] for state in STATES])
def test_a_state_beyond_a_frontier_is_reported(runner, tmp_path, state):
    request = Request(state["name"], ROOT / "params" / state["scene"], tmp_path / "run", state["set"], log=False)
    answer = runner.run(request, 60.0)
    assert (answer.outcome, state["says"] in answer.message) == (state["outcome"], True), answer
    summary = json.loads((tmp_path / "run" / "summary.json").read_text(encoding="utf-8"))
    assert all(summary[name] >= least for name, least in state.get("atLeast", {}).items())

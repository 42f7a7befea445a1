"""The campaign of environments: claims that are wrong are found, hosts are compared by bits, and it goes on."""

import json
from dataclasses import replace

import numpy as np
import pytest

from experiments.campaigns import results
from experiments.campaigns.environment_campaign import ALONE, Record, judged, together
from experiments.campaigns.environment_claims import Judge, Lumen, Way
from guidewire.env import Environment
from guidewire.env.task import find_task


@pytest.fixture(scope="module")
def task():
    """Three steps of two hubs."""
    whole = find_task("microcatheter")
    return replace(whole, anatomies=whole.anatomies[:1], time=0.42)


def test_claims_are_judged_from_the_states_and_hosts_by_their_bits(task):
    with Environment(task) as own:
        found = judged(own, 3)
        assert (found["end"], found["steps"], found["faults"]) == ("time", 3, [])
        assert together(task, [3, 4], "threads", native=False)[0] == found["digest"]
        observation, info = own.reset(seed=3)
        judge = Judge(own, observation, info["draw"])
        observation, reward, terminated, truncated, info = own.step([1.0, 0.0, 0.5, 0.0])
        judge.see(observation, reward, False, {"force": info["force"] + 1e-6})
        report = own.report.as_info() | {"end": "target", "success": True, "impulse": 1.0}
        judge.verdict(True, True, report)
        for wrong in ("of a step, seen", "terminated True, truncated True", "impulse 1 in the report",
                      "success, and the tips are not"):
            assert sum(wrong in fault for fault in judge.faults) == 1, judge.faults
        assert len(judge.faults) == 4

        way = Way(own, own.recorded().options)
        assert way.is_within(own.target_position, task.tolerance, is_sure=True)
        lumen, state = Lumen(own, way), own.session_state
        lengths = np.linalg.norm(np.diff(state.positions, axis=0), axis=1)
        assert lumen.faults(state.positions, [one.positions for one in state.catheters], lengths) == []
        aside = np.zeros_like(state.positions)
        aside[-1] = 40.0, 0.0, 0.0
        for moved, wrong in ((aside, "an element crosses the wall"),
                             (aside[-1], "nodes are outside and went through no rim")):
            assert lumen.faults(state.positions + moved, [], lengths) == [wrong]

        behind = lumen.exit - np.linspace(1.0, 20.0, 20)[:, None] * lumen.along    # units, along the sheath
        for nodes, has_come_out in ((behind, False), (np.r_[state.positions, behind], True)):    # by its own inlet
            assert [lumen.is_out([nodes]), lumen.is_out([nodes], is_of_tips=True)] == 2 * [has_come_out]


def test_a_record_goes_on_where_it_was_ended_and_counts_other_bits_as_faults(tmp_path, monkeypatch):
    record = Record(tmp_path / "record.jsonl")
    for seed in (1, 2):
        record.note("a", seed, ALONE, end="time", reason="", steps=5, digest=str(seed), faults=[])
    record.note("a", 1, "threads", digest="1")
    again = Record(tmp_path / "record.jsonl")
    assert again.lacks("a", [1, 2, 3], ALONE) == [3] and again.lacks("a", [1, 2], "threads") == [2]
    assert again.count("a").lines() == ["a: 2 episodes of 10 steps (2 time); 1 with threads; 0 faults"]
    again.note("a", 2, "threads", digest="1")
    again.note("a", 3000, "resets", grown=99.0)
    monkeypatch.setattr(results, "FILE", tmp_path / "results.json")
    again.count("a").keep()
    row = json.loads(results.FILE.read_text())["environment a"]
    assert (row["runs"], row["steps"], row["ends"], row["broken"], row["faults"]) == (2, 10, {"time": 2}, [2], 2)
    line = results.tables()[results.ENVIRONMENTS].splitlines()[-1]
    assert line.startswith("| `a` | ") and line.endswith(
        "| 1 to 2 | 2, 10 | 2 time | 2 threads | 3,000: +99.0 MB | 2 |")

"""What short runs cost beside their steps is what the wall and the processors say less the steps' own times."""

import pytest

from experiments.overhead import Overhead, measure


def test_what_the_places_did_other_than_steps_is_shared_among_the_runs():
    cost = Overhead(runs=100, jobs=2, wall=0.5, steps=0.3, processor=0.6)
    assert cost.beside_steps == pytest.approx(7.0)    # 2 x 5 ms of wall time a run, less 3 ms of steps
    assert cost.beside_steps_on_processors == pytest.approx(3.0)


def test_runs_are_made_and_their_own_step_times_added_up(fake):
    cost = measure(fake.command, 6, 2)
    assert (cost.runs, cost.jobs) == (6, 2)
    assert cost.steps == pytest.approx(6 * 0.001)    # what each summary of the fake runner says
    assert 0 < cost.processor and cost.steps < 2 * cost.wall
    requests = [request for *_, request in fake.calls()]
    assert len({request["out"] for request in requests}) == len(requests) == 6
    assert all(request["set"]["maxSimulationSteps"] == 100 for request in requests)

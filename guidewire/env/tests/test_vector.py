"""Several environments at once: what they refuse, how they begin anew, what ends, what their infos are."""

import importlib.util
import os
import signal
from dataclasses import replace

import numpy as np
import pytest

from guidewire.env import Environment, Observation, VectorEnvironment
from guidewire.env.spaces import AutoresetMode, Box, ClosedEnvironmentError, Error, InvalidAction, ResetNeeded
from guidewire.env.tests.environment_cases import same, tube  # noqa: F401

FORWARDS = np.array([[1.0, 0.0], [1.0, 0.0]], np.float32)


def test_one_action_that_is_not_allowed_changes_nothing_in_any_environment(tube):
    with VectorEnvironment(tube, 2) as vector, VectorEnvironment(tube, 2) as other:
        vector.reset(seed=3), other.reset(seed=3)
        for wrong in (np.nan, 1.5):
            with pytest.raises(InvalidAction):
                vector.step(np.array([[1.0, 0.0], [wrong, 0.0]]))
        assert [report.time for report in vector.get_attr("report")] == [0.0, 0.0]
        same(vector.step(FORWARDS)[0], other.step(FORWARDS)[0])


def test_at_the_same_step_an_episode_follows_and_the_info_has_the_last_one(tube):
    tube = replace(tube, time=0.42)    # three steps
    with VectorEnvironment(tube, 2, autoreset_mode="SameStep") as vector, \
            VectorEnvironment(tube, 2, autoreset_mode=AutoresetMode.NEXT_STEP) as plain:
        assert vector.metadata["autoreset_mode"] == AutoresetMode.SAME_STEP
        vector.reset(seed=5), plain.reset(seed=5)
        for _ in range(3):
            seen, _, _, truncated, info = vector.step(FORWARDS)
            last, _, _, _, last_info = plain.step(FORWARDS)
        begun, _, _, _, _ = plain.step(FORWARDS)
        assert truncated.all() and info["_final_obs"].all()
        same(seen, begun)
        for k in range(2):
            same(info["final_obs"][k], {name: values[k] for name, values in last.items()})
        assert info["final_info"]["report"]["end"].tolist() == ["time", "time"]
        assert info["final_info"]["force"].tolist() == last_info["force"].tolist()
        assert not vector.step(FORWARDS)[3].any(), "the next step goes on with the new episode"


def test_infos_are_dicts_of_arrays_with_masks(tube):
    with VectorEnvironment(tube, 2) as vector:
        _, info = vector.reset(seed=1)
        assert info["draw"]["friction"].dtype == float and info["draw"]["_friction"].tolist() == [True, True]
        vector.set_attr("task", [replace(tube, time=0.14), tube])
        info = vector.step(FORWARDS)[4]
        assert info["_report"].tolist() == [True, False] and info["report"]["_end"].tolist() == [True, False]
        assert info["report"]["end"].tolist() == ["time", None]
        assert info["report"]["time"] == pytest.approx([0.14, 0.0])
        assert isinstance(info["report"]["forces"][0], list) and info["force"].shape == (2,)


def test_methods_are_called_and_attributes_are_read_and_set_in_each(tube):
    with VectorEnvironment(tube, 2) as vector:
        vector.reset(seed=1)
        assert vector.get_attr("safe_force") == (1.5, 1.5)
        vector.set_attr("safe_force", (1.0, 2.0))
        assert vector.call("safe_force") == (1.0, 2.0)
        assert [type(one) for one in vector.call("save")] == [bytes, bytes]
        with pytest.raises(ValueError):
            vector.set_attr("safe_force", [1.0])


def test_a_session_that_ended_is_one_line_and_a_reset_starts_it_anew(tube):
    with VectorEnvironment(tube, 2, native=False) as vector:
        before, _ = vector.reset(seed=4)
        vector.get_attr("session")[1].kill()
        with pytest.raises(ClosedEnvironmentError, match=r"reset\(\) starts it anew") as refused:
            vector.step(FORWARDS)
        assert "\n" not in str(refused.value)
        with pytest.raises(ResetNeeded):
            vector.step(FORWARDS)
        vector.get_attr("session")[0].kill()    # nobody has asked it since
        same(vector.reset(seed=4)[0], before)


@pytest.mark.long("3 s: processes of their own")
def test_a_process_that_was_killed_is_one_line_and_a_reset_starts_it_anew(tube):
    with VectorEnvironment(tube, 2, workers=2, backend="processes", native=False) as vector:
        before, _ = vector.reset(seed=4)
        after = vector.step(FORWARDS)[0]
        os.kill(vector._group._workers[1][1].pid, signal.SIGKILL)
        with pytest.raises(ClosedEnvironmentError, match=r"process 1 .* \(killed by signal 9\): reset\(\)"):
            vector.step(FORWARDS)
        with pytest.raises(ResetNeeded):
            vector.step(FORWARDS)
        same(vector.reset(seed=4)[0], before)
        same(vector.step(FORWARDS)[0], after)


def test_options_that_cannot_be_sent_are_refused_in_one_line_or_sent_by_cloudpickle(tube):
    own = Observation(parts=("image",), image=lambda state: np.zeros((2, 2), np.uint8),
                      image_space=Box(0, 255, (2, 2), np.uint8))
    if importlib.util.find_spec("cloudpickle"):
        VectorEnvironment(tube, 1, backend="processes", observation=own).close()
    else:
        with pytest.raises(Error, match="cloudpickle") as refused:
            VectorEnvironment(tube, 1, backend="processes", observation=own)
        assert "\n" not in str(refused.value)


def test_what_several_cannot_be_made_of_is_refused(tube):
    for options, said in (({"num_envs": 0}, "num_envs"), ({"workers": 1.5}, "workers"),
                          ({"backend": "fork"}, "threads"), ({"autoreset_mode": "Disabled"}, "NextStep"),
                          ({"nonsense": 1}, "nonsense")):
        with pytest.raises((Error, TypeError), match=said):
            VectorEnvironment(tube, **options)


def test_a_report_goes_through_gymnasiums_own_vectors(tube):
    pytest.importorskip("gymnasium", reason="gymnasium is not installed; its shapes are tested above")
    from gymnasium.vector import SyncVectorEnv

    tube = replace(tube, time=0.28)
    with VectorEnvironment(tube, 2) as mine:
        theirs = SyncVectorEnv([lambda: Environment(tube)] * 2)
        mine.reset(seed=2), theirs.reset(seed=2)
        for _ in range(4):
            (seen, rewards, _, _, info), (seen_too, rewards_too, _, _, info_too) = (
                one.step(FORWARDS) for one in (mine, theirs))
            same(seen, seen_too)
            np.testing.assert_array_equal(rewards, rewards_too)
            assert info.keys() == info_too.keys()
        theirs.close()

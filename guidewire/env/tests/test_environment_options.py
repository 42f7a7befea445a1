"""What an environment cannot be made with is one line of what is allowed."""

import math
from functools import partial

import pytest

from guidewire.env.drive import Drive
from guidewire.env.environment import Environment, Reward
from guidewire.env.observation import Observation
from guidewire.env.spaces import Error

NO_NUMBER = (math.nan, math.inf, -math.inf, "1", True, None)
NOT_ABOVE_0 = (0.0, -1.0)
NO_COUNT = (1.5, math.nan, -1, "1", True, None)


@pytest.mark.parametrize("make, key, refused", [
    (Drive, "step_time", NO_NUMBER + NOT_ABOVE_0), (Drive, "noise", (*NO_NUMBER, -0.1)), (Drive, "delay", NO_COUNT),
    (Drive, "speed", NO_NUMBER[:-1] + NOT_ABOVE_0), (Drive, "rotation", NO_NUMBER[:-1] + NOT_ABOVE_0),
    (Drive, "actions", ("jerky", None)), (Observation, "points", (*NO_COUNT, 0)),
    (Observation, "spacing", (*NO_COUNT, 0)), (Observation, "lookahead", NO_NUMBER + NOT_ABOVE_0),
    (Observation, "screen", ([[1.0, 0.0, math.nan], [0.0, 0.0, 1.0]], [1.0, 0.0, 0.0])),
    (Reward, "progress", NO_NUMBER), (Reward, "target", NO_NUMBER), (Reward, "time", NO_NUMBER),
    (Reward, "force", NO_NUMBER), (partial(Environment, "artery"), "safe_force", NO_NUMBER + NOT_ABOVE_0),
])
def test_an_option_that_is_not_allowed_is_refused_in_one_line(make, key, refused):
    for value in refused:
        with pytest.raises(Error) as error:
            make(**{key: value})
        said = str(error.value)
        assert key in said and "\n" not in said and "needs" in said, value

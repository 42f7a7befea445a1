"""Walls of a run, by its parameters."""

import pytest

from guidewire.logs.walls import soft_walls


@pytest.mark.parametrize("own, soft", (({}, []), ({"wallStiffness": 1e5}, [0]), ({"modulus": 1e6}, [0])))
def test_walls_that_give_way_state_a_stiffness_or_a_modulus(own, soft):
    assert soft_walls({"vessel": {"shape": "tube", **own}}) == soft
    assert soft_walls({"vessel": {"shape": "tube"}, "obstacles": [own]}) == [one + 1 for one in soft]
    assert soft_walls({"obstacles": [{"shape": "plane"}, own]}) == [one + 1 for one in soft]

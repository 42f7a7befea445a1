"""The gates of environments judge by what was seen: a seeded fraction of them, and a success that is none."""

from dataclasses import replace

import numpy as np

from experiments import environment_gates
from guidewire.env import Environment
from guidewire.env.tests.environment_cases import tube  # noqa: F401

CATHETER = {"start": 4.0, "length": 50.0, "elements": 10, "wireRadius": 8e-4, "lumenRadius": 6e-4,
            "youngsModulus": 1e9, "shearModulus": 4e8}


def test_episodes_are_judged_by_what_was_seen_and_hosts_by_their_bits(tube):
    pair = replace(tube, overrides={"catheters": [CATHETER]}, follow=8.0)
    for task in (pair, tube):
        with Environment(task) as own:
            end, faults = environment_gates.judged(own, 0)
            assert end in ("target", "time", "left the vessel") and faults == []
            report = {**own.report.as_info(), "success": True}
            own.reset(options={"nominal": True})
            assert np.linalg.norm(own.session_state.positions[-1] - own.target_position) > 10.0
            assert len(environment_gates._false_success(own, 1, report)) == 1
    one, other = (environment_gates.bits(pair, [1, 2], "threads", native) for native in (False, None))
    assert one == other and one[0] != one[1]

"""The mandrel that leaves a bend, against the closed form of a round steel wire."""

import json
import math
import subprocess

import pytest
from scipy.optimize import brentq

_YOUNG, _YIELD, _RADIUS = 190e9, 1.5e9, 0.178e-3


def _kept(curvature):
    """What is left of a curvature: 1 - 4 eta g(eta)/pi, eta = yield stress/(E a kappa)."""
    eta = min(1.0, _YIELD / (_YOUNG * _RADIUS * curvature))
    root = math.sqrt(1.0 - eta * eta)
    g = (math.asin(eta) - eta * root * (1.0 - 2.0 * eta * eta)) / (2.0 * eta) + 4.0 / 3.0 * root**3
    return curvature * (1.0 - 4.0 * eta * g / math.pi)


@pytest.mark.parametrize("degrees", [10.0, 45.0, 90.0])
def test_mandrel_leaves_the_angle(runner_command, tmp_path, degrees):
    file = tmp_path / "steel.json"
    file.write_text(json.dumps({"solver": "direct", "wireRadius": _RADIUS, "material": "steel", "fibres": 8,
                                "guidewireLength": 300.0}))
    done = subprocess.run([*runner_command, "--mandrel", str(file), repr(math.radians(degrees)), "290", "295"],
                          capture_output=True, text=True, check=True)
    found = json.loads(done.stdout)
    bent = brentq(lambda curvature: 5e-3 * _kept(curvature) - math.radians(degrees), 50.0, 2e3)
    assert found["radius"] == pytest.approx(1e3 * (1.0 / bent - _RADIUS), rel=0.01)
    assert found["bent"] == pytest.approx(5e-3 * bent, rel=0.01)


def test_a_wire_that_does_not_yield_has_none(runner_command, tmp_path):
    file = tmp_path / "nitinol.json"
    file.write_text(json.dumps({"solver": "direct", "material": "nitinol"}))
    done = subprocess.run([*runner_command, "--mandrel", str(file), "0.5"], capture_output=True, text=True)
    assert done.returncode == 2
    assert "no mandrel leaves that bend" in done.stderr and done.stderr.count("\n") == 1

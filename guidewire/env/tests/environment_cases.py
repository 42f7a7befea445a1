"""A task in a bent tube that costs little, for tests of environments."""

import json

import numpy as np
import pytest

from guidewire.env import Environment
from guidewire.env.task import Task

# A bent tube, whose centreline is known, with a wire that costs little.
TUBE = {"solver": "direct", "guidewireLength": 60.0, "numberRodElements": 12, "guidewireOffset": -62.0,
        "wireRadius": 0.0003, "youngsModulus": 5e9, "shearModulus": 2e9, "density": 6450.0, "massDamping": 20.0,
        "wireSections": [{"from": 40.0, "to": 60.0, "numberRodElements": 6, "restCurvature": [-20.0, 0.0, 0.0]}],
        "proximalEnd": "clamped", "drive": "displace", "insertionSpeed": 0.02, "timeStep": 0.07,
        "maxSimulationSteps": 100, "target": 2,
        "vessel": {"shape": "tube", "knots": [[0, 0, -70], [0, 0, 20], [0, 20, 60]], "radius": 3.0,
                   "openStart": True, "anatomy": "anatomy.json"}}


def anatomy_of(points, radius, branches, parents, ends):
    return {"metresPerUnit": 0.001, "ends": [{"number": k + 1, "name": f"end {k + 1}", "point": point}
                                             for k, point in enumerate(ends)],
            "centreline": {"points": [[*map(float, p), radius] for p in points], "parents": parents,
                           "branches": branches, "names": [f"branch {k}" for k in range(1, max(branches) + 1)]}}


@pytest.fixture(scope="session")
def tube(tmp_path_factory):
    """A task in a tube: its centreline has a point every 2 units."""
    folder = tmp_path_factory.mktemp("tube")
    straight = [[0.0, 0.0, z] for z in np.arange(-70.0, 20.0, 2.0)]
    along = np.array([0.0, 20.0, 40.0]) / np.hypot(20.0, 40.0)
    bent = [list(np.array([0.0, 0.0, 20.0]) + s * along) for s in np.arange(0.0, 44.0, 2.0)]
    points = straight + bent
    count = len(points)
    (folder / "anatomy.json").write_text(json.dumps(
        anatomy_of(points, 3.0, [1] * count, [-1, *range(count - 1)], [0, count - 1])))
    vessel = {key: value for key, value in TUBE["vessel"].items() if key != "anatomy"}
    scene = {**TUBE, "vessel": vessel}
    scene.pop("target")
    (folder / "scene.json").write_text(json.dumps(scene))
    return Task("tube", scene=str(folder / "scene.json"), anatomies=(str(folder / "anatomy.json"),),
                targets=(("branch 1", 92.0), ("branch 1", 100.0)), frictions=(0.0, 0.1), tip_turns=4, time=2.8,
                tolerance=2.0)


@pytest.fixture
def environment(tube):
    with Environment(tube) as made:
        yield made


def same(a, b):
    assert a.keys() == b.keys()
    for name in a:
        np.testing.assert_array_equal(a[name], b[name], err_msg=name)

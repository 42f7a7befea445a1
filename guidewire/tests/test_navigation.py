"""What `steer` says where it fails, and the inlets that it tries."""

from __future__ import annotations

import numpy as np
import pytest

from guidewire.navigation import Route, other_inlets


def anatomy(radii: list[float]) -> dict:
    """A straight vessel along z with a point every 5 mm, and a branch of four points at its middle."""
    points = [[0.0, 0.0, 5.0 * k, radius] for k, radius in enumerate(radii)]
    middle = len(radii) // 2
    parents = [k - 1 for k in range(len(radii))]
    for k in range(1, 5):
        points.append([5.0 * k, 0.0, 5.0 * middle, 2.0])
        parents.append(middle if k == 1 else len(points) - 2)
    ends = [{"number": number, "name": f"rim {number}", "radius": points[point][3], "point": point}
            for number, point in ((1, 0), (2, len(radii) - 1), (3, len(points) - 1))]
    return {"metresPerUnit": 1e-3, "ends": ends, "centreline": {"points": points, "parents": parents}}


@pytest.mark.parametrize("at, radius, farthest, expected", [
    (20, 0.3, 90.0, "too narrow: 100 mm from the inlet its radius is 0.3 mm, the wire's 0.45 mm"),
    (40, 0.6, 150.0, "target lies in a sliver of radius 0.6 mm of a branch of 4 mm"),
    (20, 4.0, 8.0, "did not come away from its inlet"),
    (20, 4.0, 196.0, "within two radii of the target"),
    (20, 4.0, 120.0, "more --attempts")])
def test_a_failure_names_what_is_at_fault(at: int, radius: float, farthest: float, expected: str) -> None:
    radii = [4.0] * 41
    radii[at] = radius
    path = list(range(41))
    route = Route({"distances": [200.0], "indices": path}, anatomy(radii), 1.0)
    assert expected in route.reason(farthest, 0.45)


def test_other_inlets_have_the_wire_that_reaches_the_target() -> None:
    asked = {"inlet": 3, "target": 2, "guidewireLength": 300.0, "numberRodElements": 80,
             "wireSections": [{"from": 270.0, "to": 300.0, "numberRodElements": 30}]}
    (found,) = other_inlets(asked, anatomy([4.0] * 41))
    # From end 1 the way is 200 mm, from end 3 it is 120 mm: 1.15 times the difference, in elements of 5 mm.
    more = 5.0 * np.ceil(1.15 * 80.0 / 5.0)
    assert found == {"inlet": 1, "guidewireLength": 300.0 + more, "numberRodElements": 80 + more / 5.0,
                     "wireSections": [{"from": 270.0 + more, "to": 300.0 + more, "numberRodElements": 30}]}
    assert other_inlets(asked | {"inlet": [0.0, 0.0, 0.0]}, anatomy([4.0] * 41)) == []

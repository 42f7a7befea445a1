"""The scenes of instruments in one another do what the docs say of them."""

import json

import numpy as np
import pytest

from guidewire.logs.logs import read_entries, read_log
from guidewire.logs.surfaces import read_obj
from guidewire.prepare import ROOT
from guidewire.runs.runner import Request

PARAMS = ROOT / "params"


@pytest.fixture
def run_scene(live, tmp_path):
    """A function that runs a scene, with keys set, to its end; its log with all spheres, and its summary."""
    def run(name, **given):
        folder = tmp_path / "-".join([name, *map(str, given.values())])
        answer = live.run(Request(name, PARAMS / f"{name}.json", folder, given))
        assert answer.exit_code == 0, answer.message
        summary = json.loads((folder / "summary.json").read_text())
        assert summary["outcome"] == "finished"
        return read_log(folder, "all"), summary

    return run


def bend(nodes, length):
    """Degrees between the last element of a centreline (m+1, 3) and the one that is so far behind it, units."""
    along = np.diff(nodes, axis=0)
    sizes = np.linalg.norm(along, axis=1)
    before = len(sizes) - 1 - round(length / sizes[-1])
    return np.degrees(np.arccos(np.clip(along[-1] @ along[before] / (sizes[-1] * sizes[before]), -1.0, 1.0)))


class Branch:
    """The straight branch of the vessel of catheter-branch, from its mesh: all of it that lies beyond z = 103."""

    def __init__(self):
        scene = json.loads((PARAMS / "catheter-branch.json").read_text())
        vertices = np.array(scene["scale"]) * read_obj(PARAMS / scene["vessel"]["file"]).vertices
        wall = vertices[vertices[:, 2] > 103.0]
        self._middle = wall.mean(axis=0)
        self._axis = np.linalg.svd(wall - self._middle)[2][0]
        self._axis *= np.sign(self._axis[2])
        self._radius = self._off(wall).max()
        self._ostium = ((wall - self._middle) @ self._axis).min() - 2.0 * self._radius

    def _off(self, points):
        """Distance of points from its axis."""
        along = (points - self._middle) @ self._axis
        return np.linalg.norm(points - self._middle - np.multiply.outer(along, self._axis), axis=-1)

    def holds(self, point):
        """Whether a point is in it."""
        return bool((point - self._middle) @ self._axis > self._ostium and self._off(point) < self._radius)


def test_the_catheter_follows_the_wire_into_the_branch_and_takes_its_shape_there(run_scene):
    log, summary = run_scene("catheter-branch")
    assert summary["reliable"] and summary["warnings"] == []
    (catheter,) = log.catheters
    branch = Branch()
    at = {time: int(np.abs(log.time - time).argmin()) for time in (3.0, 4.5, 6.5, 9.0)}
    held = {time: (branch.holds(log.positions[k, -1]), branch.holds(catheter[k, -1])) for time, k in at.items()}
    assert held == {3.0: (False, False), 4.5: (True, False), 6.5: (True, True), 9.0: (False, True)}
    # Angled by 45 degrees, straightened by the stiff part of the wire, and angled again.
    bends = {time: bend(catheter[k], 25.0) for time, k in at.items()}
    assert bends[3.0] > 38.0 and bends[4.5] < 8.0 and bends[9.0] > max(38.0, bends[6.5] + 8.0)
    assert summary["catheters"][0]["extension"] < -0.04, "the wire is drawn back into the catheter"


@pytest.mark.long("another catheter follows its wire into a branch")
def test_the_microcatheter_follows_its_wire_out_of_the_guide_through_the_siphon(run_scene):
    log, summary = run_scene("microcatheter")
    assert ["of play in the catheter" in one for one in summary["warnings"]] == [True]    # in the siphon
    (catheter,) = log.catheters
    knots = np.array(json.loads((PARAMS / "microcatheter.json").read_text())["vessel"]["knots"])
    stations = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(knots, axis=0), axis=1))])

    def bends_passed(point):
        """Degrees by which the vessel's centreline has turned up to where a point is nearest to it."""
        start, along = knots[:-1], np.diff(knots, axis=0)
        part = np.clip(np.einsum("ij,ij->i", point - start, along) / np.einsum("ij,ij->i", along, along), 0.0, 1.0)
        nearest = np.linalg.norm(start + part[:, None] * along - point, axis=1).argmin()
        unit = along / np.diff(stations)[:, None]
        turns = np.degrees(np.arccos(np.clip(np.einsum("ij,ij->i", unit[1:], unit[:-1]), -1.0, 1.0)))
        return turns[:nearest].sum()

    at = {time: int(np.abs(log.time - time).argmin()) for time in (2.5, 7.0, 9.0)}
    wire = {time: bends_passed(log.positions[k, -1]) for time, k in at.items()}
    over = {time: bends_passed(catheter[k, -1]) for time, k in at.items()}
    assert wire[2.5] > 150.0 and over[2.5] == 0.0, "the wire first"
    assert wire[7.0] == pytest.approx(turned_in_all(knots), abs=1.0), "through all of it"
    assert over[7.0] > 170.0 and over[9.0] > 170.0 and wire[9.0] < over[9.0] - 40.0, "the wire is drawn back"


def turned_in_all(knots):
    """Degrees by which a polyline turns."""
    along = np.diff(knots, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    return np.degrees(np.arccos(np.clip(np.einsum("ij,ij->i", along[1:], along[:-1]), -1.0, 1.0))).sum()


@pytest.mark.parametrize("name", [
    "catheter", "catheter-branch",
    pytest.param("microcatheter", marks=pytest.mark.long("another catheter and its wire")),
    pytest.param("guide-catheter", marks=pytest.mark.long("three instruments")),
])
@pytest.mark.parametrize("tolerance", [1e-4, 1e-5])
@pytest.mark.few(1)
def test_the_shape_is_as_exact_as_asked_though_tips_are_soft(run_scene, name, tolerance):
    exact, summary = run_scene(name, solverTolerance=1e-9)
    log, rough = run_scene(name, solverTolerance=tolerance)
    length = json.loads((PARAMS / f"{name}.json").read_text())["guidewireLength"]
    # A force that is left over in a fifth of a wire, 25 tolerance EI/L^2, moves a free tip by no more than L^3/(3 EI).
    allowed = 25.0 / 3.0 * tolerance * length
    assert np.linalg.norm(log.positions - exact.positions, axis=-1).max() < allowed
    assert rough["extremes"]["strain"] == pytest.approx(summary["extremes"]["strain"], rel=1e-3)


def angle_of_the_snap(scene):
    """Rotation of the inner tube's hub, rad, beyond which two tubes in one another have no equilibrium: the largest of
    those that lead to a shape of theta'' = c sin(theta), theta the angle between the two, free at the tip."""
    (outer,) = scene["catheters"]

    def stiffness(tube, bore):
        second = 0.25 * np.pi * (tube["wireRadius"] ** 4 - bore ** 4)
        return tube["youngsModulus"] * second, 2.0 * tube["shearModulus"] * second

    (bend1, twist1), (bend2, twist2) = stiffness(outer, outer["lumenRadius"]), stiffness(scene, scene["innerRadius"])
    c = (outer["restCurvature"][0] * scene["restCurvature"][0] * bend1 * bend2 / (bend1 + bend2)
         * (1.0 / twist1 + 1.0 / twist2))
    theta, slope = np.linspace(0.0, np.pi, 2000), np.zeros(2000)    # at the tip, and back from there
    steps = 2000
    length = 1e-3 * outer["length"] / steps
    for _ in range(steps):    # leapfrog
        slope -= 0.5 * length * c * np.sin(theta)
        theta = theta - length * slope
        slope -= 0.5 * length * c * np.sin(theta)
    return (theta - 1e-3 * outer["start"] * slope * twist1 / (twist1 + twist2)).max()


def test_the_tubes_snap_where_theory_says_and_only_there(run_scene):
    log, summary = run_scene("concentric-tubes")
    assert summary["reliable"]
    hub = [(entry["hub"]["turn"], entry["hub"]["torque"]) for _, entry in read_entries(log.source)]
    turn, torque = np.array(hub).T
    moved = np.linalg.norm(np.diff(log.catheters[0][:, -1], axis=0), axis=1)
    snap = int(moved.argmax())
    expected = angle_of_the_snap(json.loads((PARAMS / "concentric-tubes.json").read_text()))
    assert turn[snap] - 0.01 < expected < turn[snap + 1] + 0.01, "rad, between two entries of the log"
    assert moved[snap] > 50.0 and np.delete(moved, snap).max() < 0.15 * moved[snap]
    assert torque[snap] > 0.05 and torque[snap + 1] < -0.05, "N m"

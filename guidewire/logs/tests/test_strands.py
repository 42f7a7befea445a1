"""The judge of passages against curves whose writhe and passages are known."""

import json
import math
import subprocess

import numpy as np
import pytest

from guidewire.logs.array_logs import ArrayLog
from guidewire.logs.strands import crossings, link, passages, writhe
from guidewire.prepare import ROOT


def _trefoil(n: int) -> np.ndarray:
    t = np.linspace(0.0, 1.9 * np.pi, n)    # open
    return np.column_stack([np.sin(t) + 2.0 * np.sin(2.0 * t), np.cos(t) - 2.0 * np.cos(2.0 * t), -np.sin(3.0 * t)])


def test_writhe_of_a_plane_curve_is_zero_and_that_of_a_mirror_image_is_opposite() -> None:
    plane = np.column_stack([np.arange(9.0), np.sin(np.arange(9.0)), np.zeros(9)])
    assert writhe(plane) == pytest.approx(0.0, abs=1e-12)
    knot = _trefoil(80)
    assert writhe(knot * [1, 1, -1]) == pytest.approx(-writhe(knot), abs=1e-9)
    turned = knot @ np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    assert abs(writhe(turned)) == pytest.approx(abs(writhe(knot)), abs=1e-9)


def test_writhe_of_a_helix_is_that_of_fuller() -> None:
    """Held along its axis, extended: a helix of N turns has N (1 - sin a), a its pitch angle (Fuller 1971)."""
    turns, radius, pitch = 40.0, 1.0, 3.0
    t = np.linspace(0.0, 2.0 * np.pi * turns, 1201)
    helix = np.column_stack([radius * np.cos(t), radius * np.sin(t), pitch * t / (2.0 * np.pi)])
    sine = pitch / np.hypot(pitch, 2.0 * np.pi * radius)
    assert writhe(helix, 10.0) == pytest.approx(turns * (1.0 - sine), rel=0.005)


def _strands(height: float) -> np.ndarray:
    """A loop whose last strand lies at a height over its first one."""
    rest = [[2.0, 0.1, 0.0], [3.0, 2.0, 0.3], [0.5, 3.0, 0.4]]
    return np.array([[-1.0, 0.07, 0.0], [0.0, 0.0, 0.0], [1.0, 0.05, 0.0], *rest, [0.3, 1.0, height],
                     [0.2, -1.0, height]])


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_strand_through_strand_is_one_passage_and_a_jump_of_two(sense: float) -> None:
    frames = np.array([_strands(height) for height in sense * np.linspace(0.2, -0.2, 8)])
    found = passages(frames)
    assert len(found) == 1
    assert abs(found[0].writhe) == pytest.approx(2.0, abs=0.2) and not found[0].may_be_round_the_tip
    far = _strands(-0.2 * sense)
    far[4] += [0.0, 3.0, 0.0]
    coarse, = passages(np.array([frames[0], far]))
    assert coarse.may_be_round_the_tip
    assert sum(len(crossings(a, b)) for a, b in zip(frames[:-1], frames[1:], strict=True)) == 1


def test_strand_round_the_end_is_no_passage() -> None:
    """The tip goes back over the strand, down beside it and forth below."""
    path = [(-1.0, 0.2), (0.5, 0.2), (0.5, -0.2), (-1.0, -0.2)]
    frames = []
    for (y0, z0), (y1, z1) in zip(path[:-1], path[1:], strict=True):
        for s in np.linspace(0.0, 1.0, 12, endpoint=False):
            points = _strands(0.0)
            points[-1] = [0.2, y0 + s * (y1 - y0), z0 + s * (z1 - z0)]
            points[-2] = [0.3, 1.0, z0 + s * (z1 - z0)]
            frames.append(points)
    assert passages(np.array(frames)) == []


@pytest.mark.parametrize("steps", [60, pytest.param(170, marks=pytest.mark.long("60 steps make a loop that touches"))])
def test_no_motion_between_held_ends_changes_the_link(runner_command, tmp_path, steps):
    """Twist and writhe of a wire that is turned at its hub sum up to the hub's turns: as helix, loop and plectoneme."""
    scene = json.loads((ROOT / "params" / "plectoneme.json").read_text())
    scene |= {"numberRodElements": 120, "twistPerStep": 0.1, "maxSimulationSteps": steps, "logFormat": "npz",
              "logOrientations": True}
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    subprocess.run([*runner_command, "-parameters", str(tmp_path / "scene.json"), "-out", str(tmp_path / "run")],
                   check=True, capture_output=True)
    log = ArrayLog(tmp_path / "run" / "positions.npz")
    worst = 0.0
    for positions, orientations, turn in zip(*(np.asarray(log[name]) for name in (
            "positions", "orientations", "hubTurn")), strict=True):
        # The clamps are elements of their own.
        ends = [positions[0] - [0, 0, 1], positions[-1] + [0, 0, 1]]
        frames = [[0, 0, math.sin(0.5 * turn), math.cos(0.5 * turn)], [0, 0, 0, 1]]
        turns = link(np.vstack([ends[0], positions, ends[1]]), np.vstack([frames[0], orientations, frames[1]]))
        worst = max(worst, abs(turns + turn / (2.0 * math.pi)))
    assert worst < 1e-9

"""Wires pushed, pulled and turned at random in anatomies, and steered to targets: what logs and summaries say, compared
with an independent search."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest

from experiments.campaigns import anatomy_campaign, artery_folder
from experiments.campaigns.anatomy_campaign import Vessel, campaign, violations
from experiments.campaigns.anatomy_independence import is_other_equilibrium
from guidewire import navigation
from guidewire.commands.commands import parse, run
from guidewire.benches.library import files
from guidewire.logs.logs import read_log
from guidewire.prepare import ROOT
from guidewire.runs.runner import Request, Runner
from tools.seeds import keep, of_the_day, seeds

FULL = os.environ.get("GUIDEWIRE_ALL") == "1"
NAMES = sorted(files())
MADE = ("arch", "iliac", "siphon", "coronary")


@pytest.fixture(scope="module")
def artery(tmp_path_factory):
    return Vessel(artery_folder.write(tmp_path_factory.mktemp("artery"), 2).parent)


def _broken(runs):
    return [f"{run.vessel} {run.seed} {run.outcome}: {run.claims}" for run in runs if run.claims]


@pytest.mark.long("the wire of a test below goes through the same checks")
def test_pushes_pulls_and_turns_pass_no_wall_and_say_what_is_true(runner_command, artery, tmp_path):
    runs = list(campaign(runner_command, artery, seeds("artery", [], 20), tmp_path))
    keep("artery", [run.seed for run in runs if run.claims])
    assert not _broken(runs), "\n".join(_broken(runs))
    assert sum(run.outcome != "refused" for run in runs) > 0.5 * len(runs)


@pytest.mark.long("drawn wires go through the same checks; instruments are read in test_instruments.py")
@pytest.mark.parametrize("name", NAMES)
def test_an_instrument_passes_no_wall_and_says_what_is_true(runner_command, artery, tmp_path, name):
    run, = campaign(runner_command, artery, [2], tmp_path, name)
    assert not run.claims and run.outcome != "refused", (run.claims, run.reason)


@pytest.mark.skipif(not FULL, reason="makes a vessel and its runs; the artery's are made in either case")
@pytest.mark.parametrize("kind", [MADE[of_the_day(1, len(MADE))[0]]])
def test_wires_in_vessels_made_by_code_pass_no_wall(runner_command, tmp_path, kind):
    pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")
    folder = tmp_path / kind
    subprocess.run([sys.executable, str(ROOT / "guidewire.py"), "anatomy", "--make", kind, "--out", str(folder)],
                   check=True)
    runs = list(campaign(runner_command, Vessel(folder), of_the_day(12), tmp_path))
    assert not _broken(runs), "\n".join(_broken(runs))


@pytest.mark.long("the judge of a campaign that runs in full only")
def test_a_wire_beside_the_wall_and_a_hub_that_lies_are_claimed(runner_command, artery, tmp_path):
    path = anatomy_campaign.draw(artery, 2, tmp_path)
    runner = Runner(runner_command)
    runner.run(Request("2", path, tmp_path / "run"))
    runner.close()
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    scene = json.loads((tmp_path / "run" / "parameters.json").read_text()) | {
        "driveFile": str(path.with_suffix(".csv"))}
    log = read_log(tmp_path / "run", spheres="all").positions
    positions = np.concatenate([log[:1], log[-5:]])  # the hub's motion from its start, and places enough
    assert violations(artery, scene, summary, positions) == []
    through = positions.copy()
    through[-1, -1] += [30.0, 0.0, 0.0]
    assert any("crosses the wall" in claim for claim in violations(artery, scene, summary, through))
    touching = positions.copy()
    tip = touching[-1, -1]
    out = np.array([1.0, 0.0, 0.0])
    steps = np.linspace(0.0, 30.0, 3001)
    is_in = artery.closed.inside(tip + steps[:, None] * out)
    touching[-1, -1] = tip + (steps[is_in.argmin()] - 0.05) * out  # a wire of 0.18 mm or more in the wall
    claims = violations(artery, scene, summary, touching)
    assert any("the surface is in the wall" in claim or "crosses" in claim for claim in claims)
    assert violations(artery, scene, summary | {"passages": 1}, positions) == ["passages = 1"]
    hub = summary["hub"] | {"insertion": summary["hub"]["insertion"] + 1e-3}
    assert any("the hub went" in claim for claim in violations(artery, scene, summary | {"hub": hub}, positions))
    assert any("reliable" in claim for claim in violations(
        artery, scene, summary | {"reliable": not summary["reliable"]}, positions))
    for wrong, said in (({"lengthInBody": summary["hub"]["lengthInBody"] + 1e-3}, "m in the body"),
                        ({"spheresInBody": summary["hub"]["spheresInBody"] + 1}, "spheres in the body")):
        claims = violations(artery, scene, summary | {"hub": summary["hub"] | wrong}, positions)
        assert len(claims) == 1 and said in claims[0]


def _mask(path, side, ends, radius):
    """A trunk along z that forks at 24 mm into arms to `ends`, in voxels of a side, mm, as a .nrrd file."""
    low = np.min([[0.0, 0.0, 0.0], *ends], axis=0) - radius - 2.0 * side
    shape = np.ceil((np.max([[0.0, 0.0, 24.0], *ends], axis=0) + radius + 2.0 * side - low) / side).astype(int)
    grid = side * np.indices(tuple(shape)).transpose(1, 2, 3, 0) + low
    inside = np.zeros(grid.shape[:3], bool)
    fork = np.array([0.0, 0.0, 24.0])
    for start, end in ((np.zeros(3), fork), *((fork, np.array(end)) for end in ends)):
        part = np.clip((grid - start) @ (end - start) / np.sum((end - start) ** 2), 0.0, 1.0)
        inside |= np.linalg.norm(grid - start - part[..., None] * (end - start), axis=-1) < radius
    vectors = " ".join(f"({','.join(str(side * (i == k)) for k in range(3))})" for i in range(3))
    path.write_bytes(f"NRRD0004\ntype: uchar\ndimension: 3\nsizes: {shape[0]} {shape[1]} {shape[2]}\nencoding: raw\n"
                     f"space: left-posterior-superior\nspace directions: {vectors}\n"
                     f"space origin: ({low[0]},{low[1]},{low[2]})\n\n".encode()
                     + inside.astype(np.uint8).ravel(order="F").tobytes())
    return path


@pytest.mark.skipif(not FULL, reason="14 s; the example of docs/anatomy.md makes a vessel of a mask in any case")
@pytest.mark.parametrize("target", [2, 3])
def test_two_commands_bring_a_wire_from_a_mask_to_its_target(tmp_path, target):
    pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")
    ends = np.array([[9.0, 2.0, 44.0], [-8.0, 3.0, 42.0]])
    mask, folder, out = _mask(tmp_path / "fork.nrrd", 0.6, ends, 1.9), tmp_path / "fork", tmp_path / "run"
    for words in (f"anatomy {mask} --open --inlet 1 --target {target} --out {folder}",
                  f"steer {folder / 'scene.json'} --out {out}"):
        assert run(parse(words.split())) == 0
    summary = json.loads((out / "summary.json").read_text())
    assert summary["centreline"]["reached"] and summary["passages"] == 0 and summary["reliable"]
    found = json.loads((folder / "anatomy.json").read_text())["ends"]
    # The tip is in the arm that was asked for, by the numbers that the mask was made from.
    tip, asked = np.array(summary["hub"]["tipPosition"]), np.array(found[target - 1]["centre"])
    assert np.argmin(np.linalg.norm(ends - tip, axis=1)) == np.argmin(np.linalg.norm(ends - asked, axis=1))
    vessel, scene = Vessel(folder), json.loads((out / "parameters.json").read_text())
    positions = read_log(out, spheres="all").positions
    assert violations(vessel, scene | {"inlet": 1, "driveFile": str(folder / "drive.csv")}, summary, positions) == []


@pytest.mark.parametrize("target", [2, 3] if FULL else [3])  # the other arm takes twice the attempts
@pytest.mark.long("steered tables repeat their bits in the tests of the page")
def test_a_wire_is_steered_into_each_arm_and_its_drive_repeats_it(runner_command, tmp_path, target):
    scene = artery_folder.write(tmp_path / "artery", target)
    found = navigation.steer(scene)
    assert found.is_reached and found.farthest > 0.9 * found.length
    steered = navigation.write(scene, found)
    subprocess.run([*runner_command, "-parameters", str(steered), "-out", str(tmp_path / "run")], check=True)
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert summary["centreline"]["reached"] and summary["passages"] == 0
    assert summary["centreline"]["target"] == f"end {target}"


def test_tips_that_part_at_a_jump_are_in_other_equilibria_and_those_that_drift_apart_are_not():
    push = np.arange(101.0)[:, None] * [0.0, 0.0, 1.0]  # a record a mm
    drift = push + np.linspace(0.0, 0.3, 101)[:, None] * [1.0, 0.0, 0.0]
    jumped = push + np.where(np.arange(101) < 60, 0.0, 20.0)[:, None] * [1.0, 0.0, 0.0]
    early = jumped + np.where(np.arange(101) < 30, 0.0, 0.5)[:, None] * [0.0, 1.0, 0.0]
    just_before = jumped + np.where(np.arange(101) < 52, 0.0, 0.5)[:, None] * [0.0, 1.0, 0.0]
    returned = np.where(np.arange(101)[:, None] < 80, jumped, push)
    beside = np.where(np.arange(101)[:, None] < 80, jumped, push + [0.0, 0.3, 0.0])
    assert is_other_equilibrium(push, jumped, 0.2) and is_other_equilibrium(jumped, push, 0.2)
    assert is_other_equilibrium(push, just_before, 0.2)
    assert not is_other_equilibrium(push, drift, 0.2)
    assert not is_other_equilibrium(push, early, 0.2), "apart 30 mm before the jump"
    assert not is_other_equilibrium(jumped, jumped + [0.0, 0.3, 0.0], 0.2), "apart from the start"
    assert not is_other_equilibrium(push, push + [0.0, 0.1, 0.0], 0.2)
    assert not is_other_equilibrium(push, returned, 0.2), "at the end in the same place"
    assert not is_other_equilibrium(push, beside, 0.2), "at the end nearer than a jump"

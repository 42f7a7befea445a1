"""Whole patients by two commands, and a wire in a catheter at random: a fraction of both campaigns, and their
judges."""

import json
import os
from contextlib import closing
from dataclasses import replace

import numpy as np
import pytest

from experiments.campaigns import artery_folder, coaxial_campaign, patient_campaign, patient_files
from experiments.campaigns.anatomy_campaign import STEP, Vessel
from guidewire.logs.logs import read_log
from guidewire.runs.runner import Request, Runner
from tools.seeds import of_the_day

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

FULL = os.environ.get("GUIDEWIRE_ALL") == "1"


@pytest.mark.skipif(not FULL, reason="some minutes; one of them is taken below")
def test_of_twenty_vessels_those_of_the_day_are_right_or_refused(tmp_path):
    names = [patient_files.NAMES[k] for k in of_the_day(2, len(patient_files.NAMES))]
    rows = [patient_campaign.take(patient, tmp_path / patient.file.name)
            for patient in patient_files.write(tmp_path / "files", names.__contains__)]
    assert len(rows) == 2
    assert not [row for row in rows if not (row.is_right or row.refused)]


@pytest.mark.long("the dome of an aneurysm is no inlet in the tests of loops")
def test_a_mask_with_an_aneurysm_is_right_and_the_judge_sees_what_is_not(tmp_path):
    patient, = patient_files.write(tmp_path / "files", lambda name: name == "neck.nrrd")
    row = patient_campaign.take(patient, tmp_path / "taken")
    assert row.is_right, row
    vessel, = (tmp_path / "taken" / "results" / "anatomy").iterdir()
    mirrored = replace(patient, truth=patient.truth * [-1.0, 1.0, 1.0, 1.0])
    wider = replace(patient, truth=patient.truth * [1.0, 1.0, 1.0, 1.5])
    assert any("outside" in line for line in patient_campaign.judge(mirrored, vessel))
    assert any("wall off" in line for line in patient_campaign.judge(wider, vessel))
    assert patient_campaign.judge(replace(patient, axes=""), vessel) == ["axes 'LPS'"]


@pytest.mark.long("wires in catheters pass no wall in test_random_pushes.py")
def test_a_catheter_run_passes_no_wall_and_the_judge_sees_one_that_does(runner_command, tmp_path):
    vessel = Vessel(artery_folder.write(tmp_path / "artery", 2).parent)
    path = coaxial_campaign.draw(vessel, 1, tmp_path)
    with closing(Runner(runner_command)) as runner:
        runner.run(Request("1", path, tmp_path / "run"))
    scene, summary = json.loads(path.read_text()), json.loads((tmp_path / "run" / "summary.json").read_text())
    log = read_log(tmp_path / "run", spheres="all")
    assert coaxial_campaign.violations(vessel, scene, summary, log) == []
    through = log.positions.copy()
    through[-1, -1] += [60.0, 0.0, 0.0]
    catheter = log.catheters[0].copy()
    catheter[-1, -1] += [60.0, 0.0, 0.0]
    assert any("crosses the wall" in claim for claim in coaxial_campaign.violations(
        vessel, scene, summary, replace(log, catheters=(catheter,))))
    reached = {**summary, "centreline": {**summary["centreline"], "reached": True}}
    far = np.broadcast_to(log.positions[:1], log.positions.shape)
    assert any("'reached', but" in claim for claim in coaxial_campaign.violations(
        vessel, scene, reached, replace(log, positions=np.array(far))))


def test_the_hubs_of_drives_that_are_drawn_never_meet(tmp_path):
    vessel = Vessel(artery_folder.write(tmp_path / "artery", 2).parent)
    at = STEP * np.arange(coaxial_campaign.MOST_STEPS + 1)
    starts = []
    for seed in range(20):
        scene = json.loads(coaxial_campaign.draw(vessel, seed, tmp_path).read_text())
        catheter, = scene["catheters"]
        wire, over = (1e3 * np.interp(at, *np.loadtxt(file, delimiter=",", skiprows=1)[:, :2].T)
                      for file in (scene["driveFile"], catheter["driveFile"]))
        assert (wire - over).max() <= catheter["start"]
        assert catheter["start"] + catheter["length"] < scene["guidewireLength"]
        starts.append(catheter["start"])
    assert min(starts) == 60.0 < max(starts)

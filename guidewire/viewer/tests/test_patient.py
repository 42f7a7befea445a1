"""The generic patient that the page draws around a vessel."""

import json

import numpy as np
import pytest

from guidewire.prepare import ROOT
from guidewire.sessions.session import session_of
from guidewire.viewer.cases import MISSIONS
from guidewire.viewer.tests.test_page_session import doubles, follow

CHEST = 40.0    # mm above the eighth thoracic vertebra: its outline is 172 mm wide and 116 mm deep
PARTS = """
import { patientAround } from "./patient.js";
const parts = patientAround(data.patient, data.box, data.millimetres);
const skin = parts.at(-1);
"""


def in_patient(points, patient, millimetres):
    """(n, 3): mm to the left, the back and the head."""
    axes = np.array([patient["left"], -np.array(patient["chest"]), patient["head"]])
    assert np.linalg.det(axes) == pytest.approx(1.0)    # a patient is no mirror image
    return np.array(patient["origin"]) + millimetres * points @ axes.T


def test_each_mission_lies_within_its_patient_and_arches_run_from_front_right_to_back_left(runner_command):
    known = {}
    for scene in MISSIONS:
        own = json.loads((ROOT / scene).read_text())
        placed = own["patientAxes"], tuple(own["patientOrigin"]), own["vessel"]["file"].split("-")[0]
        if placed in known:    # the same vessel in the same place, or its sibling
            continue
        known[placed] = scene
        with session_of(ROOT / scene, native=False) as session:
            described, vertices = session.describe(), session.walls()[0].vertices
        patient, millimetres = described["patient"], described["millimetresPerUnit"]
        box = [vertices.min(axis=0).tolist(), vertices.max(axis=0).tolist()]
        told = follow(PARTS + "console.log(JSON.stringify({ skin: told(skin.vertices), bones: parts.length - 1 }));",
                      patient=patient, box=box, millimetres=millimetres)
        rings = in_patient(doubles(told["skin"]).reshape(-1, 3), patient, millimetres).reshape(-1, 40, 3)
        heights = rings[:, 0, 2]
        own = in_patient(vertices, patient, millimetres)
        assert heights[0] < own[:, 2].min() and own[:, 2].max() < heights[-1] and told["bones"] > 10
        ring = rings[np.abs(heights[:, None] - own[:, 2]).argmin(axis=0)]
        sides = np.roll(ring, -1, axis=1) - ring
        to = own[:, None] - ring
        assert (sides[..., 0] * to[..., 1] - sides[..., 1] * to[..., 0] > 0.0).all(axis=1).mean() > 0.995
        if "arch" in placed[2]:
            _check_arch(patient)
    assert len(known) == 3


def _check_arch(patient):
    anatomy = json.loads((ROOT / "guidewire/env/data/vessels/arch-1/anatomy.json").read_text())
    ends = {end["name"]: in_patient(np.array(end["centre"]), patient, 1.0) for end in anatomy["ends"]}
    along = ends["descending aorta"] - ends["ascending aorta"]
    assert along[0] > 40.0 and along[1] > 40.0    # left and back
    for vessel, apart in (("subclavian", 50.0), ("common carotid", 15.0)):
        assert ends[f"right {vessel}"][0] < ends[f"left {vessel}"][0] - apart
    # Beside the body of a vertebra that is 40 mm wide, and in front of its middle.
    assert 15.0 < ends["descending aorta"][0] < 50.0 and ends["descending aorta"][1] < 60.0


def test_x_rays_through_the_patient_are_weakened_by_what_they_pass():
    """The skin's outline is an ellipse with its widths; a polygon of 40 sides is narrower by 1 - cos(pi/40)."""
    told = follow(PARTS + """
        import { CArm } from "./carm.js";
        import { Lumen } from "./lumen.js";
        const through = (lao) => {
          const arm = new CArm(lao, 0, data.centre, 40, 9, data.patient);
          const sum = new Float64Array(81);
          new Lumen({ isStill: true, vertices: Float32Array.from(skin.vertices),
            triangles: Uint32Array.from(skin.triangles) }).sum(arm, sum, skin.attenuation / arm.scale);
          return sum[40];
        };
        console.log(JSON.stringify([through(0), through(90)]));
        """, patient={"left": [0.0, 1.0, 0.0], "chest": [1.0, 0.0, 0.0], "head": [0.0, 0.0, 1.0],
                      "origin": [0.0, 0.0, CHEST]},
                  box=[[-50.0, -50.0, -50.0], [50.0, 50.0, 50.0]], centre=[6.0, 0.0, 0.0], millimetres=1.0)
    np.testing.assert_allclose(told, [0.005 * 2.0 * 116.0, 0.005 * 2.0 * 172.0], rtol=0.01)


def test_without_a_place_in_the_patient_nothing_is_drawn():
    patient = {"left": [0.0, 1.0, 0.0], "chest": [1.0, 0.0, 0.0], "head": [0.0, 0.0, 1.0], "origin": None}
    assert follow('import { patientAround } from "./patient.js";'
                  "console.log(JSON.stringify(patientAround(data.patient, [[0, 0, 0], [1, 1, 1]], 1)));",
                  patient=patient) == []

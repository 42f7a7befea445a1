"""Exports: what other programs read is where the run is, in the axes that were asked for."""

from __future__ import annotations

import csv
import json
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest

from guidewire.anatomy.mesh import AnatomyError
from guidewire.anatomy.vtp import write_vtp
from guidewire.commands.commands import parse, run
from guidewire.export.curves import Curve, curves_of
from guidewire.export.frame import frame_of
from guidewire.export.usd import CODES, Wall, write_usd
from guidewire.logs.logs import read_log
from guidewire.logs.surfaces import Surface
from guidewire.prepare import ROOT, PreparationError
from guidewire.runs.runner import Request
from guidewire.viewer.recording import Channel, Recording

LPS = {"left": [1.0, 0.0, 0.0], "chest": [0.0, -1.0, 0.0], "head": [0.0, 0.0, 1.0]}
MATERIAL = {"metresPerUnit": 1e-3, "wireRadius": 1e-4}


def read_vtp(file: Path):
    """Points, cells and arrays, by VTK."""
    pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    failed: list[str] = []
    reader.AddObserver("ErrorEvent", lambda *_: failed.append("VTK cannot read it"))
    reader.Update()
    assert not failed
    data = reader.GetOutput()
    at = data.GetPointData()
    space = data.GetFieldData().GetAbstractArray("SPACE")
    return (vtk_to_numpy(data.GetPoints().GetData()),
            [vtk_to_numpy(cells.GetConnectivityArray()) for cells in (data.GetLines(), data.GetPolys())],
            {at.GetArrayName(k): vtk_to_numpy(at.GetArray(k)) for k in range(at.GetNumberOfArrays())},
            space.GetValue(0) if space else "", data)


def test_vtk_reads_what_is_written(tmp_path: Path) -> None:
    points = np.random.default_rng(1).normal(size=(7, 3))
    arrays = {'a "b" <c>': np.arange(7), "force": points[::-1], "is": points[:, 0] > 0.0}
    write_vtp(tmp_path / "a.vtp", points, [np.arange(4), np.array([3, 5, 6])], at_points=arrays,
              of_cells={"Branch": np.array([1, 2])}, space="RAS")
    seen, (lines, polys), found, space, data = read_vtp(tmp_path / "a.vtp")
    np.testing.assert_array_equal(seen, points)
    assert lines.tolist() == [0, 1, 2, 3, 3, 5, 6] and not len(polys) and space == "RAS"
    assert data.GetNumberOfLines() == 2 and data.GetCellData().GetArray("Branch").GetValue(1) == 2
    for name, values in arrays.items():
        np.testing.assert_array_equal(found[name], values)
    write_vtp(tmp_path / "b.vtp", points, triangles=np.array([[0, 1, 2], [2, 3, 6]]))
    seen, (lines, polys), found, space, data = read_vtp(tmp_path / "b.vtp")
    assert polys.tolist() == [0, 1, 2, 2, 3, 6] and data.GetNumberOfPolys() == 2 and not found and space == ""


@pytest.mark.parametrize("patient, asked, expected, letters", [
    (LPS, None, [1.0, 2.0, 3.0], "LPS"), (LPS, "RAS", [-1.0, -2.0, 3.0], "RAS"), (LPS, "SLA", [3.0, 1.0, -2.0], "SLA"),
    ({"left": [0.0, 1.0, 0.0], "chest": [1.0, 0.0, 0.0], "head": [0.0, 0.0, 1.0]}, None, [2.0, -1.0, 3.0], "LPS"),
    (None, None, [1.0, 2.0, 3.0], ""),
])
def test_a_frame_has_the_axes_that_are_asked_for(patient, asked, expected, letters) -> None:
    frame = frame_of({"metresPerUnit": 0.01, "wireRadius": 1e-4}, patient, asked)
    np.testing.assert_allclose(frame.points(np.array([0.1, 0.2, 0.3])), expected, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(frame.vectors(np.array([3.0, 0.0, 4.0]))), 5.0)
    assert frame.letters == letters and frame.unit == "mm"
    assert frame.space == (letters if letters in ("LPS", "RAS") else "")


@pytest.mark.parametrize("patient", (LPS, {"left": [1.0, 0.0, 0.0], "chest": [0.0, 1.0, 0.0], "head": [0.0, 0.0, 1.0]}))
def test_triangles_face_where_they_did_also_where_a_run_is_mirrored(patient) -> None:
    frame = frame_of({"metresPerUnit": 0.01, "wireRadius": 1e-4}, patient, None)
    wall = Surface(np.eye(3), np.array([[0, 1, 2]]), np.zeros(3))
    vertices, triangles = frame.surface(wall)
    first, second, third = vertices[triangles[0]]
    assert np.cross(second - first, third - first) @ frame.vectors(np.ones(3)) > 0.0


def test_axes_of_a_run_that_has_none_are_refused_and_gains_have_no_mm() -> None:
    with pytest.raises(AnatomyError, match="--axes RAS: nothing says how the axes of this run lie"):
        frame_of(MATERIAL, None, "RAS")
    assert frame_of({"metresPerUnit": 1e-3}, None, None).describe().startswith("the scene's own axes, units")


def test_a_wire_goes_through_the_tip_of_its_catheter() -> None:
    """The element from (0, 0, 2) to (1, 0, 3) comes out of a tip at (0, 0, 3)."""
    positions = np.array([[[0.0, 0, 0], [0, 0, 2], [1, 0, 3], [3, 0, 3]]] * 2)
    positions[1] = [[0.0, 0, -2], [0, 0, 0], [0, 0, 2], [1, 0, 3]]
    catheter = np.array([[[0.0, 0, 0], [0, 0, 1.5], [0, 0, 3]]] * 2)
    channels = [Channel("positions", "", "units", "vector", positions.reshape(2, -1)),
                Channel("positions1", "", "units", "vector", catheter.reshape(2, -1)),
                Channel("curvature", "", "rad/m", "sphere", np.array([[0.0, 4, 6, 0]] * 2)),
                Channel("contactForces", "", "N", "vector", np.tile([0.0, 2.0, 0.0], (2, 4))),
                Channel("inBody", "", "spheres", "frame", np.array([[3.0], [2.0]]))]
    recording = Recording("a", "finished", (), (), 0.1, channels, ())
    described = {"instruments": [{"title": "wire", "radii": [0.2, 0.2, 0.1]}, {"title": "tube", "radii": [0.5, 0.5]}]}
    wire, tube = curves_of(recording, described, frame_of(MATERIAL, LPS, "RAS"))
    np.testing.assert_allclose(wire.points[0], [[0, 0, 0], [0, 0, 2], [0, 0, 3], [-1, 0, 3], [-3, 0, 3]])
    np.testing.assert_allclose(wire.radii[0], [0.2, 0.2, 0.175, 0.15, 0.1])
    np.testing.assert_allclose(wire.arrays["Curvature"][0], [0, 4, 5, 6, 0])
    np.testing.assert_allclose(wire.arrays["InSheath"][0], [1, 0, 0, 0, 0])
    np.testing.assert_allclose(wire.arrays["ContactForce"][0], [[0, -2, 0]] * 5)
    assert wire.name == "wire" and tube.name == "catheter-1" and len(tube.points[0]) == 3


def prims_of(text: str) -> dict[str, dict[str, str]]:
    """Attributes of prims of a .usda by name, by a parser of its grammar: strings, lists and brackets in pairs."""
    assert text.startswith("#usda 1.0\n")
    tokens = re.findall(r'"(?:\\.|[^"\\])*"|[\[\](){}=,:]|[^\s\[\](){}=,:"]+', text[len("#usda 1.0\n"):])
    depth, pairs, found, prim = [], {"(": ")", "[": "]", "{": "}"}, {}, ""
    for k, token in enumerate(tokens):
        if token in pairs:
            depth.append(pairs[token])
        elif token in pairs.values():
            assert depth.pop() == token
        elif token == "def":
            prim = tokens[k + 2].strip('"')
            found[prim] = {"": tokens[k + 1]}
        elif token == "=" and depth and depth[-1] == "}":
            begin, level, end = k + 1, 0, k + 1
            while level > 0 or end == begin:
                level += (tokens[end] in pairs) - (tokens[end] in pairs.values())
                end += 1
            name = tokens[k - 1] if tokens[k - 2] != ":" else "".join(tokens[k - 3:k])
            found[prim][name] = "".join(tokens[begin:end])
    assert not depth
    return found


def numbers_of(text: str) -> np.ndarray:
    return np.array(re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", text), dtype=float)


def samples_of(text: str) -> dict[float, np.ndarray]:
    return {float(code): numbers_of(values) for code, values in re.findall(r"([-\d.e]+):(\[.*?\](?=,))", text)}


def test_usd_holds_curves_over_time_with_widths(tmp_path: Path) -> None:
    points = [np.array([[0.0, 0, 0], [0, 0, 1], [0, 1, 1]]), np.array([[0.0, 0, 1], [0, 0, 2], [0, 1, 2], [5, 1, 2]])]
    radii = [np.array([0.2, 0.2, 0.1]), np.array([0.2, 0.2, 0.1, 0.1])]
    same = Curve("catheter-1", 'a "b"', [points[0]] * 2, [radii[0]] * 2)
    triangle = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    write_usd(tmp_path / "a.usda", [Curve("wire", "wire", points, radii), same], np.array([0.0, 0.5]),
              [Wall("vessel", [triangle], np.array([[0, 1, 2]]))], frame_of(MATERIAL, LPS, None), "a run")
    prims = prims_of((tmp_path / "a.usda").read_text())
    assert {name: own[""] for name, own in prims.items()} == {
        "Run": "Xform", "Wire": "BasisCurves", "Catheter1": "BasisCurves", "Vessel": "Mesh"}
    seen = samples_of(prims["Wire"]["points.timeSamples"])
    assert list(seen) == [0.0, 0.5 * CODES]
    for values, own in zip(seen.values(), points):
        np.testing.assert_array_equal(values.reshape(-1, 3), own)
    for values, own in zip(samples_of(prims["Wire"]["widths.timeSamples"]).values(), radii):
        np.testing.assert_allclose(values, 2.0 * own)
    counts = samples_of(prims["Wire"]["curveVertexCounts.timeSamples"])
    assert [values.tolist() for values in counts.values()] == [[3], [4]]
    assert prims["Catheter1"]["curveVertexCounts"] == "[3]" and prims["Catheter1"]["type"] == '"linear"'
    np.testing.assert_array_equal(numbers_of(prims["Vessel"]["points"]).reshape(-1, 3), triangle)
    text = (tmp_path / "a.usda").read_text()
    assert 'interpolation = "vertex"' in text and "metersPerUnit = 0.001" in text and "endTimeCode = 12\n" in text


def test_a_run_of_a_wire_in_a_catheter_is_exported_where_it_is(live, tmp_path: Path, capsys) -> None:
    answer = live.run(Request("a", ROOT / "params" / "catheter-branch.json", tmp_path / "run", {
        "maxSimulationSteps": 4, "logEvery": 2, "logContacts": True, "logHub": True}))
    assert answer.exit_code == 0
    (tmp_path / "run" / "export").mkdir()
    for name in ("wire-00007.vtp", "wire-mine.vtp"):
        (tmp_path / "run" / "export" / name).write_text("of an earlier export, or mine")
    assert run(parse(["export", str(tmp_path / "run"), "--axes", "RAS"])) == 0
    assert "frame: axes RAS of the patient, mm" in capsys.readouterr().out
    folder, log = tmp_path / "run" / "export", read_log(tmp_path / "run", "all")
    assert {file.name for file in folder.iterdir()} == {
        "run.pvd", "run.csv", "run.usda", "vessel.vtp", "wire-mine.vtp", *(
            f"{name}-{k:05d}.vtp" for name in ("wire", "catheter-1") for k in range(3))}
    rows = ElementTree.parse(folder / "run.pvd").getroot().findall("Collection/DataSet")
    assert [float(row.get("timestep")) for row in rows[::2]] == pytest.approx(log.time.tolist())
    mirror = [-1.0, -1.0, 1.0]    # the scene is in LPS and mm
    for row in rows:
        points, _, arrays, space, _ = read_vtp(folder / row.get("file"))
        moment = int(row.get("file")[-9:-4])
        own = log.positions[moment] if row.get("name") == "wire" else log.catheters[0][moment]
        away = np.linalg.norm(points[:, None] - (own * mirror)[None], axis=2).min(axis=0)
        assert away.max() < 1e-9 and len(points) <= len(own) + 1 and space == "RAS"
        assert arrays["Radius"].min() > 0.1 and arrays["ContactForce"].shape == points.shape
    seen = samples_of(prims_of((folder / "run.usda").read_text())["Catheter1"]["points.timeSamples"])
    last = list(seen.values())[-1].reshape(-1, 3)
    np.testing.assert_allclose(last, log.catheters[0][-1] * mirror, rtol=1e-6, atol=1e-6)
    with (folder / "run.csv").open() as file:
        table = list(csv.DictReader(file))
    assert [int(row["step"]) for row in table] == [0, 2, 4]
    assert [float(row["tip x (mm)"]) for row in table] == pytest.approx((-log.positions[:, -1, 0]).tolist(), abs=1e-9)
    hubs = json.loads((tmp_path / "run" / "summary.json").read_text())["hub"]
    assert float(table[-1]["force at the hub (N)"]) == pytest.approx(hubs["force"], rel=1e-6)
    vessel = read_vtp(folder / "vessel.vtp")[1][1]
    assert len(vessel) > 3000
    with pytest.raises(PreparationError, match="three letters that say where"):
        run(parse(["export", str(tmp_path / "run"), "--axes", "RAX"]))


def test_a_vessel_that_moves_is_exported_as_a_series(live, tmp_path: Path) -> None:
    scene = {"solver": "direct", "guidewireLength": 40, "guidewireOffset": -20, "numberRodElements": 10,
             "proximalEnd": "clamped", "drive": "hold", "displacement": 0, "timeStep": 0.05, "deltaThreshold": 0,
             "maxSimulationSteps": 4, "logEvery": 1, "vessel": {"shape": "tube", "knots": [[0, 0, -60], [0, 0, 60]],
             "radius": 4, "motion": {"period": 1, "rampTime": 0, "rigid": {"translation": [0, 1, 0.5]}}},
             "obstacles": [{"shape": "sphere", "centre": [30, 0, 0], "radius": 5}]}
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    assert live.run(Request("a", tmp_path / "scene.json", tmp_path / "run")).exit_code == 0
    assert run(parse(["export", str(tmp_path / "run")])) == 0
    folder = tmp_path / "run" / "export"
    places = [read_vtp(folder / f"vessel-{k:05d}.vtp")[0] for k in range(5)]
    rows = ElementTree.parse(folder / "run.pvd").getroot().findall("Collection/DataSet[@name='vessel']")
    prims = prims_of((folder / "run.usda").read_text())
    seen = [one.reshape(-1, 3) for one in samples_of(prims["Vessel"]["points.timeSamples"]).values()]
    for k in range(5):
        moved = places[0] + np.sin(2 * np.pi * 0.05 * k) * np.array([0.0, 1.0, 0.5])
        np.testing.assert_allclose(places[k], moved, atol=1e-9)
        np.testing.assert_allclose(seen[k], moved, atol=1e-6)
        assert (rows[k].get("timestep"), rows[k].get("file")) == (f"{0.05 * k:.9g}", f"vessel-{k:05d}.vtp")
    assert (folder / "obstacle-1.vtp").is_file() and "points" in prims["Obstacle1"]


def test_a_folder_without_a_run_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(PreparationError, match="parameters.json"):
        run(parse(["export", str(tmp_path)]))
    assert not (tmp_path / "export").exists()

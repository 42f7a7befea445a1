"""A run beside measurements that were made from it, so that every error is known."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from analysis.tests.chain import write_log
from guidewire.figures.measured import draw_comparison
from guidewire.logs.logs import LogError
from guidewire.logs.measured import ComparedForce, ComparedShapes, compare
from guidewire.logs.measurement import FORMS, read_measurement
from guidewire.logs.runs import read_run
from guidewire.studies.keys import TABLE

NODES, ENTRIES, STEP = 5, 4, 0.5  # steps in s


def _run(folder: Path, spheres: int = NODES, hub: bool = True) -> Path:
    """A straight wire along z, 10 units a piece, that moves by 2 units a step across; the hub pushes by 3 N/s t."""
    hubs = [{"hub": {"insertion": 0.0, "turn": 0.0, "force": 3.0 * STEP * k, "torque": 0.0, "twist": 0.0,
                     "tipDirection": {"x": 0.0, "y": 0.0, "z": 1.0}, "largestCurvature": 0.0}} for k in range(ENTRIES)]
    write_log(folder, [[(0.0, 2.0 * k, 10.0 * i) for i in range(spheres)] for k in range(ENTRIES)], STEP,
              hubs if hub else ())
    (folder / "parameters.json").write_text('{"metresPerUnit": 0.001}')
    return folder


def _csv(folder: Path, text: str) -> Path:
    file = folder / "measured.csv"
    file.write_text(text)
    return file


def test_force_is_compared_at_the_measured_times_with_known_errors(tmp_path):
    file = _csv(tmp_path, "Time, Force\n0.1,0.3\n0.7,2.0\n1.4,4.2\n9,1\n\n")
    found = compare(_run(tmp_path), file)
    assert isinstance(found, ComparedForce) and found.left_out == 1
    np.testing.assert_allclose(found.run, [0.3, 2.1, 4.2], atol=1e-12)
    np.testing.assert_allclose(found.errors, [0.0, 0.1, 0.0], atol=1e-12)
    said = found.summary()
    assert "RMS error 0.0577 N (1.37 % of the measured peak), largest 0.1 N at t = 0.7 s" in said
    assert "3 values within the run, 1 more outside" in said
    figure = draw_comparison(found)
    assert [line.get_xdata().size for line in figure.axes[0].lines] == [3, 3]
    pulled = ComparedForce(np.arange(2.0), np.array([-2.0, -4.0]), np.array([-2.0, -3.0]), 0)
    assert "RMS error 0.707 N (17.7 % of the measured peak)" in pulled.summary()


def test_shape_is_compared_by_the_distance_of_its_points_from_the_wire(tmp_path):
    # At 0.2 s the wire lies at y = 0.8: one point on it, one 3 beside, one 4 beyond its tip; at 1.5 s at y = 6.
    file = _csv(tmp_path, "time,x,y,z\n0.2,0,0.8,7\n0.2,3,0.8,15\n0.2,0,0.8,44\n1.5,0,5,20\n")
    found = compare(_run(tmp_path), file)
    assert isinstance(found, ComparedShapes) and found.left_out == 0
    np.testing.assert_allclose(found.distances[0], [0.0, 3.0, 4.0], atol=1e-12)
    np.testing.assert_allclose(found.distances[1], [1.0], atol=1e-12)
    assert "RMS distance 2.55 units, largest 4 units at t = 0.2 s; 4 points, 2 shapes" in found.summary()
    figure = draw_comparison(found)
    assert [line.get_xdata().size for line in figure.axes[0].lines] == [NODES, 3, NODES, 1]
    assert figure.axes[2].lines[0].get_ydata() == pytest.approx([4.0, 1.0])


@pytest.mark.parametrize("text, said", [
    ("", "the first line is \"\", must be time,force or time,x,y,z"),
    ("t,f\n0,1\n", "the first line is \"t,f\", must be time,force or time,x,y,z"),
    ("time,force\n", "holds no line of numbers"),
    ("time,force\n0,1\n0.1,one\n", "line 3 is \"0.1,one\", must be 2 finite numbers: time,force"),
    ("time,force\n0,nan\n", "line 2 is \"0,nan\""),
    ("time,force\n0,1,2\n", "line 2 is \"0,1,2\""),
    ("time;force\n0;1\n", "semicolons are no separators: write commas between columns"),
    ("time,force\n0;1\n", "semicolons are no separators"),
    ("time,force\n0,0,1,5\n", "decimal commas separate columns: write points in numbers"),
    ("time,force\n0.2,1\n0.1,1\n", "line 3: time 0.1 s after 0.2 s, times must ascend"),
    ("time,force\n7,1\n8,1\n", "times from 7 to 8 s, none within the run's 0 to 1.5 s"),
])
def test_file_that_cannot_be_compared_is_named_with_the_line(tmp_path, text, said):
    file = _csv(tmp_path, text)
    with pytest.raises(LogError) as error:
        compare(_run(tmp_path), file)
    assert str(error.value).startswith(f"{file}: ") and said in str(error.value) and "\n" not in str(error.value)


def test_file_that_is_none_or_no_text_is_named(tmp_path):
    _run(tmp_path)
    with pytest.raises(LogError, match="absent.csv: No such file"):
        compare(tmp_path, tmp_path / "absent.csv")
    (tmp_path / "picture.csv").write_bytes(b"\x89PNG\xff\xfe\x00")
    with pytest.raises(LogError, match="picture.csv: is not a comma-separated text"):
        compare(tmp_path, tmp_path / "picture.csv")


def test_run_that_is_not_finite_is_refused(tmp_path):
    log = json.loads((_run(tmp_path) / "positions.json").read_text())
    log["1"]["hub"]["force"] = float("nan")
    log["1"]["sphere"]["2"]["y"] = float("inf")
    (tmp_path / "positions.json").write_text(json.dumps(log))
    for text in ("time,force\n0.5,1\n", "time,x,y,z\n0.4,1,1,1\n"):
        with pytest.raises(LogError, match="not finite"):
            compare(tmp_path, _csv(tmp_path, text))


def test_run_that_does_not_log_what_was_measured_is_refused(tmp_path):
    _run(tmp_path, spheres=1, hub=False)
    with pytest.raises(LogError, match="logHub"):
        compare(tmp_path, _csv(tmp_path, "time,force\n0,1\n"))
    with pytest.raises(LogError, match="logSpheres"):
        compare(tmp_path, _csv(tmp_path, "time,x,y,z\n0,1,1,1\n"))


def test_every_form_that_is_named_is_taken(tmp_path):
    """And no other: the line of an error has all."""
    for form in FORMS:
        columns = form.replace("KEY", "distalRotation").split(",")
        row = ",".join("A" if name == "view" else str(k) for k, name in enumerate(columns))
        file = _csv(tmp_path, f"{','.join(columns)}\n{row}\n")
        assert read_measurement(file, 1.0).count == 1, form
    for column, metres in (("insertion", 2e-3), ("insertion_cm", 2e-2), ("insertion_m", 2.0)):
        assert read_measurement(_csv(tmp_path, f"{column},force\n2,1\n"), 1e-3).over[0] == pytest.approx(metres)
    with pytest.raises(LogError) as error:
        read_measurement(_csv(tmp_path, "time,way\n0,1\n"), 1.0)
    assert all(form in str(error.value) for form in ("turn,force", "insertion,torque", "y,z", "time,x,z", "view,u,v"))


def test_the_folder_of_a_study_names_its_runs(tmp_path):
    rows = [{"key": f"timeStep={k}", "variant": "", "values": {}, "repeat": None, "folder": f"../runs/{k}"}
            for k in range(7)]
    (tmp_path / TABLE).write_text(json.dumps({"study": "a", "runs": rows}))
    with pytest.raises(LogError, match="the folder of a study, not of a run") as error:
        read_run(tmp_path)
    assert "(timeStep=0)" in str(error.value) and "and 2 more" in str(error.value)

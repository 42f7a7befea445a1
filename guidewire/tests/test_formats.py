"""Files of every format version load: parameter files, results of runs, saved states; newer ones are refused."""

import base64
import json
import re
import shutil
from pathlib import Path

import numpy as np
import pytest

from guidewire.logs.logs import LogError, read_log
from guidewire.logs.runs import FORMAT, read_run
from guidewire.prepare import ROOT
from guidewire.runs.runner import Request
from guidewire.sessions.session import Session, SessionError

KEPT = Path(__file__).parent / "formats"
CASES = sorted(path.parent for path in KEPT.glob("*/*/given.json"))
SAME = 1e-6  # of the wire's length; what a later program may compute otherwise is not the concern here
OLD_MODEL = 6e-6  # version 1 had another model of instruments in one another: nodes were 5.12e-6 elsewhere
ONE_LINE = r"^[^\n]*formatVersion = {} is not allowed: [^\n]* versions 1 to 2$"


@pytest.fixture(params=CASES, ids=lambda path: f"{path.parent.name}, {path.name}")
def kept(request):
    return request.param


def test_every_version_is_kept():
    assert {path.parent.name for path in CASES} == {"unnumbered", *map(str, range(1, FORMAT + 1))}
    text = (ROOT / "Assets/Guidewire/Io/FileFormat.cs").read_text(encoding="utf-8")
    assert int(re.search(r"const int Version = (\d+);", text)[1]) == FORMAT


def test_a_run_is_read(kept):
    run, log = read_run(kept / "run"), read_log(kept / "run", "all")
    assert run.outcome == "finished" and log.complete and log.steps.tolist() == list(range(7))
    assert log.positions.shape == (7, int(run.number("numberRodElements")) + 1, 3)
    assert len(log.catheters) == len(run.parameters.get("catheters") or [])


@pytest.mark.parametrize("file", ["given.json", "run/parameters.json"])
@pytest.mark.few(6)
def test_a_parameter_file_gives_its_run(kept, file):
    log = read_log(kept / "run", "all")
    with Session(kept / file, hand=False, native=False) as session:
        end = session.step(steps=6)
    is_old = end.catheters and kept.parent.name != str(FORMAT)
    near = (OLD_MODEL if is_old else SAME) * session.parameters["guidewireLength"]
    np.testing.assert_allclose(end.positions, log.positions[-1], atol=near)
    for catheter, logged in zip(end.catheters, log.catheters, strict=True):
        np.testing.assert_allclose(catheter.positions, logged[-1], atol=near)


@pytest.mark.parametrize("kept", [path for path in CASES if path.parent.name == str(FORMAT)],
                         ids=lambda path: path.name)
def test_a_saved_state_is_restored_and_goes_on(kept):
    state = json.loads((kept / "state.json").read_text(encoding="utf-8"))
    with Session(kept / "given.json", native=False, maxSimulationSteps=100) as session:
        restored = session.restore(base64.b64decode((kept / "snapshot.txt").read_text(encoding="ascii")))
        assert (restored.step, restored.time) == (state["step"], state["time"])
        np.testing.assert_array_equal(restored.positions, state["positions"])
        np.testing.assert_array_equal(restored.velocities, state["velocities"])
        for catheter, positions in zip(restored.catheters, state.get("catheters", []), strict=True):
            np.testing.assert_array_equal(catheter.positions, positions)
        goes_on = session.step(steps=3)
        session.reset()
        made = session.step(steps=6)
    near = SAME * session.parameters["guidewireLength"]
    np.testing.assert_allclose(goes_on.positions, made.positions, atol=near)
    for catheter, other in zip(goes_on.catheters, made.catheters, strict=True):
        np.testing.assert_allclose(catheter.positions, other.positions, atol=near)


@pytest.mark.parametrize("kept", [path for path in CASES if path.parent.name != str(FORMAT)], ids=str)
def test_a_saved_state_of_an_older_version_is_refused_in_one_line(kept):
    """A step keeps other numbers now; parameter files, runs and recorded drives go on loading."""
    with Session(kept / "given.json", native=False, maxSimulationSteps=100) as session:
        before = session.state
        with pytest.raises(SessionError, match=r"^the snapshot has format 1: guidewire \S+ reads format 2: save "
                                               r"it anew$"):
            session.restore(base64.b64decode((kept / "snapshot.txt").read_text(encoding="ascii")))
        assert session.state is before


@pytest.mark.parametrize("stated", [0, 3, -1, 1.5, "1", True, None, 10**20])
def test_a_parameter_file_of_another_version_is_refused(live, tmp_path, stated):
    file = tmp_path / "scene.json"
    file.write_text(json.dumps({"formatVersion": stated}), encoding="utf-8")
    answer = live.run(Request("other", file, tmp_path / "out"))
    assert answer.exit_code == 2 and re.search(ONE_LINE.format(re.escape(json.dumps(stated))), answer.message)


@pytest.mark.parametrize("stated", [0, 3, 1.0, "1", True, None])
def test_a_run_of_another_version_is_refused(tmp_path, stated):
    shutil.copytree(KEPT / "1" / "pbd" / "run", tmp_path / "run")
    file = tmp_path / "run" / "parameters.json"
    file.write_text(json.dumps({**json.loads(file.read_text(encoding="utf-8")), "formatVersion": stated}))
    with pytest.raises(LogError, match="formatVersion"):
        read_run(tmp_path / "run")


@pytest.mark.parametrize("old, new, said", [
    (b" 2 ", b" 3 ", "format 3: guidewire .* reads format 2: save it anew$"), (b" hand ", b" drive ", "is incomplete$"),
    (b"guidewire-snapshot", b"guidewire-snapshop", "is incomplete$"),
])
def test_a_saved_state_of_another_version_is_refused(old, new, said):
    case = KEPT / str(FORMAT) / "pbd"
    saved = base64.b64decode((case / "snapshot.txt").read_text(encoding="ascii"))
    assert old in saved
    with Session(case / "given.json", native=False) as session:
        before = session.state
        with pytest.raises(SessionError, match=said):
            session.restore(saved.replace(old, new, 1))
        assert session.state is before


def test_a_saved_state_of_another_build_and_other_wire_is_refused():
    saved = base64.b64decode((KEPT / str(FORMAT) / "pbd" / "snapshot.txt").read_text(encoding="ascii"))
    head, line, numbers = saved.partition(b"\n")
    words = head.split(b" ")
    words[3] = b"0" * len(words[3])    # the build that saved it
    with Session(native=False, numberRodElements=7) as session, pytest.raises(SessionError, match="3 elements$"):
        session.restore(b" ".join(words) + line + numbers)


def test_runs_and_summaries_state_the_version(live, tmp_path):
    assert live.run(Request("run", KEPT / "1" / "pbd" / "given.json", tmp_path / "run")).exit_code == 0
    run = read_run(tmp_path / "run")
    assert run.value("formatVersion") == run.summary["versions"]["format"] == FORMAT

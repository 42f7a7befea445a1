"""`guidewire.py site`: the folder, and its page in browsers: steered by keys, repeated by the runner."""

import gzip
import http.server
import json
import subprocess
import threading
from functools import partial

import numpy as np
import pytest

from guidewire.commands import commands
from guidewire.logs.logs import read_log
from guidewire.prepare import ROOT, PreparationError
from guidewire.runs import building
from guidewire.runs.runner import Request
from guidewire.sessions.session import Session, session_of
from guidewire.viewer.cases import MISSIONS
from guidewire.viewer.live import ENDLESS, PUSH_SPEED
from guidewire.viewer.site import _course
from guidewire.viewer.tests.browsing import from_npm
from guidewire.viewer.tests.test_desk_browser import DEBRIEF, OVERLAPS
from guidewire.viewer.tests.test_view_browser import GAMEPAD

SCENES = ("insertion", "sheath", "catheter-branch")
MODEL = "viewer.shown.model"
OPEN = ["until", "globalThis.viewer?.shown?.model && viewer.stage.drawn > 0"]
HUB = f"{MODEL}.recording.at('hubInsertion', {MODEL}.recording.count - 1)[0]"
CATHETER = HUB.replace("hubInsertion", "hub1Insertion")
STEP = f"{MODEL}.recording.at('step', {MODEL}.recording.count - 1)[0]"
PAUSED = ["until", "viewer.shown.status.isPaused"]
FASTEST = ["choose", ["#pace", "10"]]


def site(*words):
    return commands.run(commands.parse(["site", *map(str, words)]))


@pytest.fixture
def framework(tmp_path, monkeypatch):
    """A folder that stands for the core for browsers."""
    folder = tmp_path / "framework"
    folder.mkdir()
    (folder / "dotnet.js").write_text("export const dotnet = 1;")
    (folder / "core.wasm").write_bytes(b"\0asm" * 1000)
    monkeypatch.setattr(building, "build_browser", lambda is_ahead, tell: folder)
    from_npm("dependencies")


def test_a_site_has_all_that_its_scenes_name_and_replaces_an_earlier_one(framework, runner_command, tmp_path, capsys):
    out = tmp_path / "site"
    assert site(out, ROOT / "params" / "catheter-branch.json") == 0 and "1 scenes" in capsys.readouterr().out
    show = json.loads((out / "show.json").read_text())["site"]
    (scene,) = show["scenes"]
    assert scene["file"] == "params/catheter-branch.json" and scene["sentence"]
    assert scene["meshes"] == ["params/meshes/arch.obj"] and (out / scene["picture"]).stat().st_size > 1000
    texts = json.loads(gzip.decompress((out / "texts.json.gz").read_bytes()))
    for name in ("params/catheter-branch.json", "params/catheter-branch.csv", "params/catheter-branch-wire.csv",
                 "instruments/catheter-angled-5f.json"):
        assert texts[name] == (ROOT / name).read_text()
    assert gzip.decompress((out / "files/params/meshes/arch.obj.gz").read_bytes()) == (
        ROOT / "params/meshes/arch.obj").read_bytes()
    assert gzip.decompress((out / "framework/core.wasm.gz").read_bytes()) == b"\0asm" * 1000
    assert (out / "framework/dotnet.js").is_file() and show["rules"]["choices"]["solver"]
    notices = (out / "THIRD-PARTY-NOTICES.md").read_text()
    assert all(name in notices for name in ("three.js", ".NET runtime", "Newtonsoft.Json"))
    assert (out / "LICENSE").is_file()
    (tmp_path / "small.json").write_text(json.dumps({
        "guidewireLength": 60, "numberRodElements": 6, "constraintSolverSteps": 1, "maxSimulationSteps": 2}))
    assert site(out, tmp_path / "small.json") == 0    # an earlier site is replaced
    assert not (out / "files/params/meshes/arch.obj.gz").exists() and not list(tmp_path.glob("*.partial"))


def test_what_cannot_be_a_site_is_one_line_and_nothing_is_written(framework, runner_command, tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("mine")
    with pytest.raises(PreparationError, match="is there already and no site"):
        site(tmp_path / "mine")
    (tmp_path / "scene.json").write_text('{"solver": "direct", "numberRodElement": 3}')
    with pytest.raises(PreparationError, match="numberRodElements"):
        site(tmp_path / "out", tmp_path / "scene.json")
    (tmp_path / "mine" / "far.json").write_text(json.dumps({
        "vessel": {"shape": "mesh", "file": str(ROOT / "params/meshes/arch.obj"),
                   "openRims": {"entrance": [0, 0, -320]}},
        "guidewireLength": 300.0, "guidewireOffset": -310.0, "maxSimulationSteps": 2}))
    with pytest.raises(PreparationError, match="own folder and below"):
        site(tmp_path / "out", tmp_path / "mine" / "far.json")
    assert not list(tmp_path.glob("out*")) and (tmp_path / "mine" / "notes.txt").read_text() == "mine"


@pytest.fixture(scope="module")
def address(runner_command, tmp_path_factory):
    """Of a plain server of files; with the site of three scenes."""
    from_npm("dependencies")
    folder = tmp_path_factory.mktemp("served") / "site"
    assert site(folder, *(ROOT / "params" / f"{name}.json" for name in ("missions/first-branch", *SCENES))) == 0
    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=folder)) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/"
        server.shutdown()


BROWSERS = pytest.mark.parametrize("browser", ["browse", "firefox"])
LONG = pytest.mark.long("the core for browsers is built, and interpreted: minutes")


def steered(request, browser, address, name, *orders):
    """What was seen, and the drive tables that the page saves; without another network."""
    count = 2 if name.startswith("catheter") else 1
    tables = f"Promise.all([0, 1].slice(0, {count}).map((k) => viewer.shown._connection.steered(k)))"
    answer = request.getfixturevalue(browser)(
        ["open", f"{address}?scene={name}"], OPEN, FASTEST, ["see", "document.activeElement.blur()"], *orders,
        ["press", " "], PAUSED, ["see", f"[...{MODEL}.tip]"], ["see", STEP], ["see", tables])
    assert all(asked.startswith((address, "blob:", "data:")) for asked in answer["asked"])
    return answer["seen"][1:]


def repeated(runner_command, folder, name, steps, tables):
    """The tip of the runner's run with these tables."""
    words = []
    for k, table in enumerate(tables):
        assert table["ok"], table["text"]
        (folder / f"{k}.csv").write_text(table["text"])
        own = "" if k == 0 else f"catheters[{k - 1}]."
        words += [f"-{own}driveFile", str(folder / f"{k}.csv"), *([] if k else ["-insertionSpeed", "0"])]
    subprocess.run([*runner_command, "-parameters", str(ROOT / "params" / f"{name}.json"), "-out", str(folder / "run"),
                    *words, "-maxSimulationSteps", str(int(steps)), "-deltaThreshold", "0"], check=True,
                   capture_output=True)
    return read_log(folder / "run", "all").positions[-1, -1]


@LONG
@BROWSERS
def test_gains_steered_by_keys_into_a_branch_have_the_bits_of_a_session(request, browser, address, runner_command):
    at_rest = "for (const message of [{do: 'reset'}, {do: 'pause', value: true}]) viewer.shown.send(message)"
    wire = f"{MODEL}.centreline(0)"
    answer = request.getfixturevalue(browser)(
        ["open", f"{address}?scene=insertion"], OPEN, ["see", f"(() => {{ {at_rest} }})()"],
        ["until", f"viewer.shown.status.isPaused && viewer.shown.status.opened === 2 && {STEP} === 0"], FASTEST,
        ["see", "document.activeElement.blur()"], ["down", "w"], ["until", "viewer.shown.steering.push === 1"],
        ["press", " "], ["until", f"{wire}[2] >= -310 + 240"], ["press", " "], PAUSED, ["up", "w"],
        ["see", STEP], ["see", f"[...{wire}]"], ["see", "viewer.shown._connection.steered(0)"])
    step, positions, saved = answer["seen"][2:]
    with Session(ROOT / "params" / "insertion.json", hand=True, native=False, **ENDLESS) as session:
        for _ in range(int(step)):
            state = session.step(PUSH_SPEED * session.parameters["timeStep"])
    np.testing.assert_array_equal(np.reshape(positions, (-1, 3)), state.positions)
    x, y, z = state.positions[-1]
    assert abs(x) < 10 and 30 < y < 80 and z > 205    # in the branch, as on the server's page
    assert not saved["ok"] and "drive table" in saved["text"]


@LONG
@BROWSERS
def test_a_wire_out_of_its_sheath_is_steered_into_a_branch_and_the_runner_repeats_it(
        request, browser, address, runner_command, tmp_path):
    tip, step, tables = steered(request, browser, address, "sheath", ["down", "w"], ["until", f"{HUB} > 0.15"],
                                ["up", "w"])
    np.testing.assert_allclose(repeated(runner_command, tmp_path, "sheath", step, tables), tip, atol=1e-6)
    assert np.hypot(tip[0], tip[1]) > 20    # of the inlet's axis; the artery has a radius of 4


@LONG
@BROWSERS
def test_a_catheter_and_its_wire_are_steered_into_a_branch_and_the_runner_repeats_it(
        request, browser, address, runner_command, tmp_path):
    held = lambda k: [["press", "i"], ["until", f"viewer.shown.status.held === {k}"]]    # noqa: E731
    pushed = lambda hub, to: [["down", "w"], ["until", f"{hub} > {to}"], ["up", "w"]]    # noqa: E731
    turn = CATHETER.replace("Insertion", "Turn")
    orders = [*held(1), ["down", "d"], ["until", f"{turn} > 3.1"], ["up", "d"], *held(0)]
    for to in (0.035, 0.07):
        orders += [*pushed(HUB, to), *held(1), *pushed(CATHETER, to), *held(0)]
    tip, step, tables = steered(request, browser, address, "catheter-branch", *orders, *pushed(HUB, 0.13))
    np.testing.assert_allclose(repeated(runner_command, tmp_path, "catheter-branch", step, tables), tip, atol=1e-6)
    assert np.hypot(tip[0], tip[1]) > 10


@LONG
def test_a_finger_and_a_gamepad_steer_without_a_server(browse, address):
    seen = browse(
        ["open", f"{address}?scene=sheath"], OPEN, ["touch", ["#slide", 0.5, 0.02]],
        ["until", f"{HUB} > 0.005"], ["touch", ["#slide"]], ["until", "viewer.shown.steering.push === 0"],
        ["see", GAMEPAD], ["see", f"pad.axes[1] = -1; window.before = {HUB}"],
        ["until", f"{HUB} > before + 0.005"], ["see", "pad.buttons[0].pressed = true"], PAUSED,
        ["see", f"[viewer.shown._connection.constructor.name, {STEP}]"], size=(390, 844))["seen"]
    assert seen[-1][0] == "WorkerConnection" and seen[-1][1] > 0


CARDS = "document.querySelectorAll('#start .scenes button').length"
GALLERY = "!document.getElementById('start').hidden"


@LONG
def test_a_first_visitor_wins_a_mission_by_keys_and_finds_the_stars_in_the_gallery(browse, address):
    """Each step takes what the page says and what has the focus."""
    report = "document.getElementById('report')"
    seen = browse(
        ["open", address], ["until", f"{CARDS} === 4"], ["axe", None], ["see", "document.activeElement.innerText"],
        ["press", "Enter"], OPEN, ["see", "[location.search, document.title, viewer.shown.status.isWaiting]"],
        ["axe", None], ["see", "document.getElementById('coach').innerText"], FASTEST,
        ["down", "w"], ["until", DEBRIEF], ["up", "w"], ["see", f"{report}.textContent"],
        ["axe", None], ["click", "all missions"], ["until", f"!({DEBRIEF})"], ["until", GALLERY],
        ["see", "[location.search, document.title, document.querySelector('#start .scenes button').innerText]"],
        ["back", None], ["until", f"!({GALLERY})"], ["see", "[location.search, document.title]"],
        ["see", "new Promise((done) => { addEventListener('popstate', done); history.back(); })"], ["until", GALLERY],
        size=(1280, 720))["seen"]
    assert "next for you" in seen[1] and seen[2] == ["?scene=first-branch", "Into the artery · Guidewire", True]
    assert "push" in seen[4] and "★★★" in seen[5] and "reached at" in seen[5]
    assert seen[7][:2] == ["", "Guidewire"] and "★★★" in seen[7][2]
    assert seen[8] == seen[2][:2]
    assert seen[0] == seen[3] == seen[6] == []


CARD = {"role": "button", "name": "Into the artery"}
PAD = {"role": "application", "name": "up pushes"}
MEANS = {    # what is said leads to what is done; nothing here knows the page from inside
    "keys": [["press", "Enter"], ["said", "Hold W"], ["down", "w"], ["said", "target reached"], ["up", "w"]],
    "touch": [["touch", [CARD, 0.5, 0.5]], ["touch", [CARD]], ["said", "upper edge of the push pad"],
              ["touch", [PAD, 0.5, 0.02]], ["said", "target reached"], ["touch", [PAD]]],
    "gamepad": [["see", GAMEPAD], ["see", "pad.buttons[0].pressed = true"], ["said", "Hold"],
                ["see", "pad.buttons[0].pressed = false"], ["see", "pad.axes[1] = -1"], ["said", "target reached"]],
}


@LONG
@pytest.mark.parametrize("browser, means", [*(("browse", means) for means in MEANS), ("firefox", "keys")])
def test_the_first_mission_is_won_by_the_pages_texts_and_its_accessibility_tree_alone(request, browser, address, means):
    """At most three clicks: a card, and a pad that is held."""
    size = {} if browser == "firefox" else {"size": (390, 844) if means == "touch" else (1280, 720)}
    laid_out = ["until", f"!({OVERLAPS}).length"]
    request.getfixturevalue(browser)(["open", address], ["said", "next for you"], laid_out, *MEANS[means],
                                     ["said", "try again"], laid_out, **size)


@LONG
def test_what_an_address_names_and_is_not_there_is_said_in_the_gallery_and_loading_can_be_cancelled(browse, address):
    said = "document.querySelector('#start [role=alert]')?.textContent"
    seen = browse(
        ["open", f"{address}?scene=none"], ["until", f"{CARDS} === 4"], ["see", said],
        ["see", "document.querySelector('#start .scenes button').click()"], ["click", "cancel"],
        ["until", f"{GALLERY} && document.getElementById('loading').hidden"], ["see", "viewer.shown.model"],
        ["open", f"{address}?own=mine.json"], ["until", f"{CARDS} === 4"], ["see", said])["seen"]
    assert seen[0].startswith('there is no scene "none"') and seen[2] is None and "drop them again" in seen[3]


@pytest.mark.parametrize("name", MISSIONS)
def test_each_mission_is_won_by_its_own_drive_within_its_par_time(live, tmp_path, name):
    live.run(Request("mission", ROOT / name, tmp_path / "run"))
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert summary["outcome"] == "finished" and summary["reliable"]
    assert summary["centreline"]["reached"] and summary["centreline"]["reachedAt"] <= MISSIONS[name].par


def test_a_ghost_goes_from_its_start_to_the_target(runner_command):
    with session_of(ROOT / next(iter(MISSIONS)), native=False) as session:
        course = _course(session, int(session.parameters["maxSimulationSteps"]))
        target = session.describe()["target"]
    way, wires = np.array(course["way"]), np.array(course["wire"]).reshape(len(course["way"]), -1, 3)
    assert way[0] == 0.0 and (np.diff(way) > -0.5).all() and way[-1] > 190.0
    assert np.linalg.norm(wires[-1, -1] - target["points"][-1]) < target["reach"] + 5.0
    tips = np.linalg.norm(np.diff(wires[:, -1], axis=0), axis=1)
    assert tips.max() < 10.0 and tips.sum() > 190.0


@LONG
def test_files_of_ones_own_open_errors_are_the_programs_and_a_stuck_step_is_ended(browse, address, runner_command,
                                                                                  tmp_path):
    slow = {"guidewireLength": 60, "guidewireOffset": -60, "numberRodElements": 2000,
            "constraintSolverSteps": 1_000_000}
    wrong = json.dumps({"solver": "direct", "numberRodElement": 3})
    (tmp_path / "wrong.json").write_text(wrong)
    opens = ("((scene, text) => viewer.shown.send({do: 'open', scene, files: [{path: scene, bytes: new TextEncoder()"
             ".encode(text)}]}))(%s, %s)")
    status = "viewer.shown.status"
    seen = browse(
        ["open", address], ["until", f"globalThis.viewer && {CARDS} === 4"],
        ["drop", [str(tmp_path / "wrong.json")]], ["until", f"{status}?.problem"],
        ["see", f"{status}.problem"], ["until", f"{GALLERY} && document.getElementById('loading').hidden"],
        ["see", "document.querySelector('#start [role=alert]').textContent"],
        ["see", opens % ("'slow.json'", json.dumps(json.dumps(slow)))], ["until", f"{status}.opened === 1"],
        ["see", "viewer.shown.send({do: 'reset'})"], ["until", f"{status}.opened === 2"], ["see", f"{status}.scene"],
    )["seen"]
    done = subprocess.run([*runner_command, "-parameters", "wrong.json", "-out", "run"], cwd=tmp_path, text=True,
                          capture_output=True, check=False)
    assert f"guidewire: {seen[0]}\n" == done.stderr and seen[1] == seen[0]
    assert seen[-1] == "slow.json"

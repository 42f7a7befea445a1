"""The page in a real browser: a wire pushed by keys, replays, and the file that needs no server."""

import json
import os
import signal
import subprocess
import sys
from base64 import b64decode

import numpy as np
import pytest
from PIL import Image

from guidewire.env import Environment, RecordedDrive
from guidewire.logs.logs import read_log
from guidewire.logs.paths import lengths_of, through_tips
from guidewire.prepare import ROOT
from guidewire.runs.runner import Request
from guidewire.sessions.session import Session
from guidewire.viewer import parts
from guidewire.viewer.tests.browsing import DRAWN, from_npm
from guidewire.viewer.tests.test_view import serving

FULL = bool(os.environ.get("GUIDEWIRE_ALL"))


def pushed(runner_command, folder, name, sweeps="100"):
    """A run that is pushed into the vessel, with so many iterations."""
    subprocess.run([*runner_command, "-parameters", str(ROOT / "params/insertion.json"), "-out", str(folder / name),
                    "-constraintSolverSteps", sweeps, "-logContacts", "true", "-logEvery", "2"], check=True,
                   capture_output=True)
    return folder / name


def test_types_of_the_page_are_right(browse):
    modules = from_npm("devDependencies")
    done = subprocess.run([str(modules / ".bin" / "tsc"), "-p", str(parts.PAGE / "jsconfig.json")], capture_output=True,
                          text=True, check=False)
    assert done.returncode == 0, done.stdout


@pytest.mark.long("keys steer as the page says in the tests of the suite")
def test_who_reads_the_page_alone_brings_the_wire_into_the_branch(browse, runner_command, tmp_path):
    """What is pressed, and when, is as its texts say. What was reached is not."""
    def dial(label):
        return f"parseFloat(document.querySelector('[aria-label^=\"{label}: \"] output').innerText)"

    rows = "[...document.querySelectorAll('#keys tr')].map((one) => one.innerText.split(/\\s*\\t\\s*/))"
    with serving(tmp_path, str(ROOT / "params/branch.json"), with_three=True) as (address, _):
        seen = browse(
            ["open", address], DRAWN, ["press", "h"], ["see", rows], ["click", "got it"], ["press", "g"],
            ["down", "d"], ["until", f"{dial('turn')} > 90"], ["up", "d"], ["press", "g"],
            ["choose", ['[aria-label="speed"]', "10 x real time"]],
            ["down", "w"], ["until", f"{dial('insertion')} > 240"],
            ["up", "w"], ["press", "c"],
            ["see", "[viewer.shown.received, ...viewer.shown.model.tip]"],
            SPACE, ["picture", str(tmp_path / "live.png")],
            ["see", "document.getElementById('said').textContent"],
            ["see", "document.getElementById('panes').textContent"], ["until", "viewer.shown.delays.length >= 2"],
            ["see", "[document.getElementById('keys').hidden, viewer.xray.drawn]"],
        )["seen"]
    told = {text: keys.replace(" ", "") for keys, text in seen[0]}
    assert told["push and pull"][0] == "W" and told["turn"][1] == "D" and told["fine steering"] == "G"
    received, x, y, z = seen[1]
    # The branch goes on as the inlet came, and the arch turns back at z = 200.
    assert received > 10 and abs(x) < 10 and 30 < y < 80 and z > 205
    assert seen[2] == "" and "times real time" in seen[3]
    assert seen[4][0] and seen[4][1] > 10  # the help has gone with the first key, and X-ray pictures were drawn
    assert is_drawn(tmp_path / "live.png")


def test_a_file_works_without_server_or_network(browse, runner_command, tmp_path):
    file, run = tmp_path / "run.html", pushed(runner_command, tmp_path, "many")
    done = subprocess.run([sys.executable, str(ROOT / "guidewire.py"), "view", str(run), "--html", str(file)],
                          capture_output=True, text=True, check=True)
    assert "run.html" in done.stdout and file.stat().st_size < 4e6
    log = read_log(run, "all")
    answer = browse(["open", file.as_uri()], DRAWN, ["see", "viewer.shown.go(99); [...viewer.shown.models[0].tip]"],
                    SPACE, ["picture", str(tmp_path / "file.png")], offline=True)
    near = np.ptp(log.positions.reshape(-1, 3), axis=0).max() / 65535.0
    np.testing.assert_allclose(answer["seen"][0], log.positions[-1, -1], atol=near)
    assert all(asked.startswith(("file:", "blob:", "data:")) for asked in answer["asked"])
    assert is_drawn(tmp_path / "file.png")


ALERT = "[document.querySelector('#said[role=alert]').innerText, document.getElementById('said').className]"
LOST = {"stretchStiffness": 2.5, "displacementDirection": [0, 1, 0], "maxSimulationSteps": 400}


@pytest.mark.long("outcomes of replays stand in the tests of recordings")
def test_a_run_that_diverged_says_so_in_the_alert_live_and_replayed_alone_or_beside_another(browse, live, tmp_path):
    for name, values in (("lost", LOST), ("good", {"maxSimulationSteps": 20})):
        live.run(Request(name, None, tmp_path / name, values))
    (tmp_path / "scene.json").write_text(json.dumps(LOST))
    said = {}
    for names in (("lost",), ("good", "lost"), ("good",), ("scene.json",)):
        wait = ["until", f"/{'finished' if names == ('good',) else 'diverged'}/.test({ALERT}[0])"]
        with serving(tmp_path, *(str(tmp_path / name) for name in names), with_three=True) as (address, _):
            begin = [["press", " "]] if names == ("scene.json",) else []
            said[names] = browse(["open", address], DRAWN, *begin, wait, ["see", ALERT])["seen"][0]
    line = "diverged, not reliable: "
    assert said["lost",][0].startswith(line) and said["lost",][1] == ""
    assert said["good", "lost"][0].startswith("good: finished, reliable: ") and said["good", "lost"][1] == ""
    assert f"\nlost: {line}" in said["good", "lost"][0]
    assert said["good",][0].startswith("finished, reliable: ") and said["good",][1] == "good"
    assert line in said["scene.json",][0] and said["scene.json",][1] == ""


@pytest.mark.long("positions of replays stand in the tests of recordings")
def test_two_replays_show_the_positions_of_their_logs_side_by_side_and_one_over_the_other(
        browse, runner_command, tmp_path):
    runs = [pushed(runner_command, tmp_path, name, sweeps) for name, sweeps in (("many", "100"), ("few", "10"))]
    logs = [read_log(run, "all") for run in runs]
    with serving(tmp_path, *map(str, runs), with_three=True) as (address, _):
        seen = browse(
            ["open", address], DRAWN,
            ["see", "viewer.shown.models.map((model) => [...model.recording.channel('positions').values])"],
            ["press", "ArrowRight"], ["see", "viewer.shown.frames[0]"],
            ["see", "viewer.shown.go(1.6); viewer.shown.models.map((model) => [...model.tip])"],
            ["see", "document.getElementById('panes').children.length"], SPACE, ["picture", str(tmp_path / "side.png")],
            ["click", "superimposed"], ["see", "document.getElementById('panes').children.length"],
            ["see", "document.getElementById('panes').textContent"], SPACE, ["picture", str(tmp_path / "over.png")],
            ["click", "play"], ["until", "viewer.shown.time > 1.65"],
        )["seen"]
    for positions, tip, log in zip(seen[0], seen[2], logs):
        np.testing.assert_array_equal(np.array(positions).reshape(log.positions.shape), log.positions)
        assert tip == log.positions[np.argmin(np.abs(log.time - 1.6)), -1].tolist()
    assert seen[1] == 1
    assert (seen[3], seen[4]) == (2, 1) and "many" in seen[5] and "orange: few" in seen[5]
    assert is_drawn(tmp_path / "side.png") and is_drawn(tmp_path / "over.png")


@pytest.mark.long("a refused value leaves the wire going in the tests of the server")
def test_a_refused_value_goes_from_its_field_and_axes_tell_their_ends_apart(browse, runner_command, tmp_path):
    field = ("[...document.querySelectorAll('#controls label')].find((one) => one.textContent === 'timeStep')"
             ".firstElementChild")
    enter = (f"{{ const field = {field}; field.focus(); field.value = '-1';"
             " field.dispatchEvent(new Event('change')); }")
    labels = ("import('./curves.js').then(({endLabels}) => [endLabels(300.001, 300.0012), endLabels(2, 2), "
              "endLabels(0, 1)])")
    rows = ("import('./colours.js').then(({row, roundUp}) => [row(0, 0, false), row(0, 0, true), row(0, 1, true), "
            "roundUp(0), roundUp(0.0473)])")
    with serving(tmp_path, str(ROOT / "params/insertion.json"), with_three=True) as (address, _):
        seen = browse(
            ["open", address], DRAWN, ["press", " "], ["until", "!viewer.shown.status.isPaused"],
            ["see", "[...document.querySelectorAll('.drive')].map((one) => one.textContent).join()"],
            ["see", "document.getElementById('settings').open = true"], ["see", enter],
            ["until", "document.getElementById('said').textContent"], ["until", f"Number({field}.value) > 0"],
            ["see", "document.getElementById('said').textContent"], ["see", "viewer.shown.status.isPaused"],
            ["see", labels], ["see", rows], ["see", "document.getElementById('thicker').textContent"],
        )["seen"]
    assert seen[0] == "push W,pull S,turn left A,turn right D"
    assert seen[3] == "timeStep = -1 is not allowed: needs a number > 0 (s)" and seen[4] is False
    assert seen[5] == [["300.001", "300.0012"], ["2", "2"], ["0", "1"]]
    assert seen[6] == [0, 128, 128, 0, pytest.approx(0.048)]
    assert seen[7] == ""  # a wire of 10 units across is seen as it is


LOOKS = (
    {"lao": 0, "cranial": 0, "vessel": "roadmap"}, {"lao": 30, "cranial": 20, "vessel": "contrast", "contrast": 0.02},
    {"lao": -80, "cranial": -35, "vessel": "none", "field": 60, "centre": [0, 20, 10]},
    {"lao": 45, "cranial": 0, "vessel": "contrast", "field": 150, "centre": [0, 0, -60], "background": 1},
)


def test_the_shader_draws_the_pictures_of_the_core(browse, runner_command, tmp_path):
    subprocess.run([*runner_command, "-parameters", str(ROOT / "params/insertion-accurate.json"), "-out",
                    str(tmp_path / "run")], check=True, capture_output=True)
    log = read_log(tmp_path / "run", "all")
    assert np.ptp(log.positions[-1][:, 1]) > 20, "the wire is bent"
    take = ("(look) => { const x = viewer.xray.fluoroscopy; x.resize(512, 512); Object.assign(x.look, {lao: 0, "
            "cranial: 0, centre: null, field: null, vessel: 'none', contrast: 0.1, background: 0.75, noise: 0, "
            "seed: 3}, look); const [model] = viewer.shown.models; const grey = "
            "x.grey(model.recording.instruments.map((one, k) => [one, model.centreline(k)])); let text = ''; for (let "
            "k = 0; k < grey.length; k += 4096) text += String.fromCharCode(...grey.subarray(k, k + 4096)); return "
            "btoa(text); }")
    with serving(tmp_path, str(tmp_path / "run"), with_three=True) as (address, _):
        noisy = {**LOOKS[0], "noise": 0.05}
        answer = browse(["open", address], DRAWN, ["see", "viewer.shown.go(99)"],
                        *(["see", f"({take})({json.dumps(look)})"] for look in (*LOOKS, noisy)))
    pictures = [np.frombuffer(b64decode(grey), np.uint8).reshape(512, 512).astype(int) for grey in answer["seen"][1:]]
    with Session(tmp_path / "run" / "parameters.json", hand=False) as session:
        for look, picture in zip((*LOOKS, noisy), pictures):
            view = {"field_of_view" if name == "field" else name: value for name, value in look.items()}
            core = session.picture_of(log.positions[-1], pixels=512, seed=3, **view).astype(int)
            assert np.ptp(core) > 30, "something is seen"
            apart = np.abs(core - picture)
            if look is noisy:    # the same noise, but for roundings of its root
                assert (apart > 2).mean() < 1e-3
            else:
                assert apart.max() <= 2, look


GAMEPAD = ("window.pad = {connected: true, axes: [0, 0, 0, 0], buttons: Array.from({length: 17}, () => "
           "({pressed: false}))};navigator.getGamepads = () => [window.pad]; "
           "dispatchEvent(new Event('gamepadconnected'))")
STEERED = "[viewer.shown.steering.push, viewer.shown.steering.turn]"
HUB = "viewer.shown.model.recording.at('hubInsertion', viewer.shown.model.recording.count - 1)[0]"


@pytest.mark.long("keys and sticks steer in the tests of the suite, and the run is repeated")
def test_a_gamepad_and_a_finger_steer_and_what_was_steered_is_saved(browse, runner_command, tmp_path):
    touch = ("{ const pad = document.getElementById('slide'); const box = pad.getBoundingClientRect();"
             " pad.setPointerCapture = () => {}; pad.dispatchEvent(new PointerEvent('pointerdown',"
             " {clientX: box.x + box.width / 2, clientY: box.y + 1, pointerId: 1, bubbles: true})); }")
    lift = "document.getElementById('slide').dispatchEvent(new PointerEvent('pointerup', {pointerId: 1}))"
    with serving(tmp_path, str(ROOT / "params/insertion-accurate.json"), with_three=True) as (address, _):
        seen = browse(
            ["open", address], DRAWN, ["see", GAMEPAD], ["see", "pad.axes[1] = -0.5"],
            ["until", "viewer.shown.steering.push === 0.5"], ["until", f"{HUB} > 0.001"],
            ["see", "pad.axes[1] = 0.05"], ["until", "viewer.shown.steering.push === 0"],
            ["see", touch], ["see", STEERED], ["until", f"{HUB} > 0.01"], ["see", lift], ["see", STEERED],
            ["see", "pad.buttons[0].pressed = true"], ["until", "viewer.shown.status.isPaused"],
            ["see", "fetch('steered.csv').then((answer) => answer.text()).then((text) => window.saved = text)"],
            ["until", f"Math.abs({HUB} - saved.trim().split('\\n').pop().split(',')[1]) < 1e-9 * {HUB}"], ["see", HUB],
            ["see", "[...document.querySelectorAll('button, select, input, canvas[tabindex]')].filter((one) =>"
                    " !(one.textContent.trim() || one.getAttribute('aria-label') || one.closest('label')))"
                    ".map((one) => one.outerHTML)"],
            ["see", "document.documentElement.scrollWidth"], ["picture", str(tmp_path / "phone.png")],
            size=(390, 844))["seen"]
    assert seen[4] == [pytest.approx(1.0, abs=0.05), 0] and seen[6] == [0, 0]
    times, insertion, _ = np.loadtxt(seen[8].splitlines(), delimiter=",", skiprows=1).T
    assert (np.diff(times) > 0).all() and insertion[-1] == pytest.approx(seen[9], rel=1e-9)
    assert seen[10] == []    # every control has a name
    assert seen[11] <= 390


SLOW_ANSWERS = "((real) => { window.fetch = async (...all) => { const answer = await real(...all);" \
    " await new Promise((go) => setTimeout(go, 300)); return answer; }; })(window.fetch)"    # frames come before
HUB_OF_CATHETER = HUB.replace("hubInsertion", "hub1Insertion")


@pytest.mark.long("two hands steer wire and catheter in the tests of the suite")
def test_a_key_puts_the_catheter_into_the_hand_and_each_instrument_has_its_colour_and_its_name(
        browse, runner_command, tmp_path):
    (tmp_path / "instruments").mkdir()
    own = json.loads((ROOT / "instruments/bentson-0.035.json").read_text())
    (tmp_path / "instruments/wire-of-mine.json").write_text(json.dumps(own))
    scene = json.loads((ROOT / "params/catheter.json").read_text())
    for part, table in ((scene, "catheter-wire.csv"), (scene["catheters"][0], "catheter.csv")):
        part["driveFile"] = str(ROOT / "params" / table)
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    status = "viewer.shown.status"
    said = "document.getElementById('said').textContent"
    with serving(tmp_path, str(tmp_path / "scene.json"), with_three=True) as (address, _):
        seen = browse(
            ["open", address], DRAWN, ["see", "document.getElementById('legend').textContent"],
            ["see", f"{status}.named.map((names) => names.length)"],
            ["see", f"{status}.named[0].includes('wire-of-mine')"],
            ["press", "i"], ["until", f"{status}.held === 1"],
            ["see", "document.querySelector('#legend .held').textContent"],
            ["down", "w"], ["until", f"{HUB_OF_CATHETER} > 0.01"], ["up", "w"], ["see", HUB],
            ["until", "document.getElementById('hold').click() || true"], ["until", f"{status}.held === 0"],
            ["down", "w"], ["until", f"{HUB} > 0.005"], ["up", "w"],
            ["see", "viewer.shown.model.drawn.map((_, k) => viewer.shown.model.recording.radiusOf(k))"],
            ["see", "viewer.shown.model.drawn.map((one) => "
                    "[...one.tube.geometry.getAttribute('color').array.slice(-3)])"],
            ["press", "c"], ["press", "c"], ["press", " "], ["until", f"{status}.isPaused"],
            SPACE, ["picture", str(tmp_path / "hands.png")],
            ["see", "viewer.shown.saveSteering()"], ["until", f"{said}.includes('steered-1.csv')"], ["see", said],
            ["see", SLOW_ANSWERS], ["see", "viewer.shown.send({do: 'name', instrument: 0, name: 'wire-of-mine'})"],
            ["until", f"{status}.chosen[0] === 'wire-of-mine' && {HUB} === 0"],
            ["see", "document.getElementById('legend').textContent"],
        )["seen"]
    assert seen[0] == "bentson-0.035catheter-angled-5f" and seen[1] == [17, 4] and seen[2]
    assert seen[3] == "catheter-angled-5f" and seen[4] == 0
    assert seen[5] == [pytest.approx(0.4445), pytest.approx(5 / 6)]    # of 0.035 in and 5 F
    assert seen[6][1] == pytest.approx([1.0, 0x9D / 255, 0x2E / 255])
    assert '--set "catheters[0].driveFile=steered-1.csv"' in seen[8]
    assert seen[11] == "wire-of-minecatheter-angled-5f"
    assert is_drawn(tmp_path / "hands.png")


@pytest.mark.parametrize("task, turned, pushed", [
    ("artery", 2.2, 0.16), pytest.param("arch", 0.0, 0.2, marks=pytest.mark.long("the artery is turned and pushed"))])
def test_a_task_steered_by_keys_is_recorded_and_done_again_to_the_same_bits(browse, runner_command, tmp_path, task,
                                                                            turned, pushed):
    """turned, pushed : rad and m, which lead to the first target."""
    hub_turn = HUB.replace("hubInsertion", "hubTurn")
    turn = [["down", "ArrowRight"], ["until", f"{hub_turn} > {turned}"], ["up", "ArrowRight"]]
    with serving(tmp_path, task, "--record", str(tmp_path / "drive.json"), with_three=True, what="tasks"
                 ) as (address, process):
        browse(["open", address], DRAWN, *(turn if turned else []),
               ["see", "viewer.shown.send({do: 'pace', value: 2})"], ["down", "ArrowUp"],
               ["until", f"{HUB} > {pushed}"],
               ["up", "ArrowUp"], ["see", "viewer.shown.pause(true)"], ["until", "viewer.shown.status.isPaused"])
        process.send_signal(signal.SIGINT)
        assert (said := process.stdout.read()).startswith("recorded: "), said
    drive = RecordedDrive.load(tmp_path / "drive.json")
    with Environment(task) as own:
        assert own.replay(drive).success


# The 3D picture is the large one.
SPACE = ["until", "(document.body.dataset.views = 'space') && new Promise((done) => { setTimeout(done, 1500, 1); })"]


def is_drawn(path):
    """Whether the picture shows more than its background where the wire is."""
    with Image.open(path) as picture:
        width, height = picture.size
        middle = (0.36 * width, 0.11 * height, 0.68 * width, 0.84 * height)
        pixels = np.asarray(picture.convert("RGB").crop(middle)).astype(int)
    return (np.abs(pixels - (15, 22, 30)).max(axis=2) > 20).mean() > 0.01


@pytest.mark.long("a key puts the catheter into the hand")
def test_each_of_three_instruments_is_drawn_and_taken_into_the_hand(browse, runner_command, tmp_path):
    status = "viewer.shown.status"
    with serving(tmp_path, str(ROOT / "params/guide-catheter.json"), with_three=True) as (address, _):
        seen = browse(
            ["open", address], DRAWN, ["see", "document.getElementById('legend').textContent"],
            ["see", "viewer.shown.model.drawn.length"],
            ["press", "i"], ["until", f"{status}.held === 1"], ["press", "i"], ["until", f"{status}.held === 2"],
            ["see", "document.querySelector('#legend .held').textContent"],
            SPACE, ["picture", str(tmp_path / "three.png")],
            ["press", "i"], ["until", f"{status}.held === 0"],
        )["seen"]
    assert seen == ["workhorse-0.014catheter-guide-6fmicrocatheter-2.4f", 3, "microcatheter-2.4f"]
    assert is_drawn(tmp_path / "three.png")


@pytest.mark.long("positions of each instrument stand in the tests of sessions of the page")
def test_a_wire_is_drawn_through_the_tip_that_it_comes_out_of(browse, runner_command, tmp_path):
    subprocess.run([*runner_command, "-parameters", str(ROOT / "params/catheter.json"), "-out", str(tmp_path / "run"),
                    "-maxSimulationSteps", "60", "-logEvery", "10"], check=True, capture_output=True)
    log = read_log(tmp_path / "run", "all")
    with serving(tmp_path, str(tmp_path / "run"), with_three=True) as (address, _):
        seen = browse(["open", address], DRAWN, *(step for k in range(len(log.steps)) for step in (
            ["see", f"viewer.shown.go({log.time[k]})"], ["see",
                                                         "[...viewer.shown.models[0].wirePath().points]"])))["seen"]
    crossed = 0
    for k, points in enumerate(seen[1::2]):
        drawn = np.array(points).reshape(-1, 3)
        lengths = lengths_of(log.positions[:k + 1])
        path, _ = through_tips(log.positions[k], [log.catheters[0][k]], lengths)
        assert len(drawn) == len(log.positions[k]) + 1
        crossed += len(path) == len(drawn)
        if len(path) == len(drawn):
            np.testing.assert_allclose(drawn, path, atol=1e-5)
    assert crossed > 0

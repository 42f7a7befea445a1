"""The operator's desk in a real browser: what it does with keys, where it looks, what it says, and how it is laid
out."""

import asyncio
import json
import re
import shlex
import subprocess
import sys
import threading

import numpy as np
import pytest
from aiohttp import ClientSession

from guidewire.logs.logs import read_log
from guidewire.prepare import ROOT
from guidewire.viewer.tests.browsing import BEGUN, DRAWN, FAINT, near_target
from guidewire.viewer.tests.test_page_session import follow
from guidewire.viewer.tests.test_view import serving
from guidewire.viewer.tests.test_view_browser import HUB, STEERED

STATUS = "viewer.shown.status"
DEBRIEF = "'debrief' in document.body.dataset"
PAUSED = ["until", f"{STATUS}.isPaused"]
SHEATH = str(ROOT / "params/sheath.json")


def text(one):
    return f"document.querySelector('{one}').textContent"


@pytest.mark.long("keys steer both hands in the tests of the suite")
def test_lists_let_the_hand_steer_and_another_case_asks_first(browse, runner_command, tmp_path):
    focus = "document.getElementById('scenes').focus()"
    shown = "document.getElementById('scenes').value"
    is_asked = "document.getElementById('card').open"
    with serving(tmp_path, SHEATH, with_three=True) as (address, _):
        seen = browse(
            ["open", address], DRAWN, ["see", focus], ["down", "d"], ["see", STEERED], ["up", "d"], ["down", "s"],
            ["see", STEERED], ["up", "s"], ["down", "w"], ["until", f"{HUB} > 0.01"], ["up", "w"],
            ["see", f"[{shown}, {STATUS}.opened]"],
            ["choose", ["#scenes", "default.json"]], ["until", is_asked], ["see", "document.activeElement.id"],
            ["click", "stay"], ["see", f"[{shown}, {STATUS}.scene, {is_asked}]"],
            ["down", "w"], ["see", STEERED], ["up", "w"],
            ["choose", ["#scenes", "default.json"]], ["until", is_asked], ["click", "leave"],
            ["until", f"{STATUS}.scene === 'default.json'"],
        )["seen"]
    assert seen[1:4] == [[0, 1], [-1, 0], ["sheath.json", 1]]
    assert seen[4] != "scenes" and seen[5] == ["sheath.json", "sheath.json", False] and seen[6] == [1, 0]


@pytest.mark.long("who has the hand stands in the tests of the server")
def test_who_looks_on_is_told_when_the_run_is_free(browse, runner_command, tmp_path):
    with serving(tmp_path, SHEATH, with_three=True) as (address, _):
        began = threading.Event()

        async def hold():
            async with ClientSession() as client, client.ws_connect(
                    f"{address.replace('http', 'ws')}live", headers={"Origin": address.split("/", 3)[0] + "//"
                                                                     + address.split("/")[2]}
            ) as socket:
                assert json.loads((await socket.receive()).data)["hand"]
                began.set()
                await socket.receive()    # another page has come
                await asyncio.sleep(3)

        holder = threading.Thread(target=lambda: asyncio.run(hold()))
        holder.start()
        assert began.wait(30)
        seen = browse(["open", address], DRAWN, ["until", f"{text('#bar')}.includes('take control')"],
                      ["click", "take control"], ["until", f"{STATUS}.hand"], ["see", f"{STATUS}.isPaused"])["seen"]
        holder.join(30)
    assert seen == [True]


@pytest.mark.long("both hands are saved and repeat the run")
def test_the_command_that_saving_prints_repeats_the_run(browse, runner_command, tmp_path):
    with serving(tmp_path, SHEATH, with_three=True) as (address, _):
        seen = browse(
            ["open", address], DRAWN, ["down", "w"], ["until", f"{HUB} > 0.02"], ["up", "w"], ["press", " "], PAUSED,
            ["see", "viewer.shown.saveSteering()"], ["until", f"{text('#said')}.includes('guidewire.py run')"],
            ["see", text("#said")], ["see", "fetch('steered.csv').then((answer) => answer.text())"],
            ["see", "[...viewer.shown.model.tip]"])["seen"]
    (tmp_path / "steered.csv").write_text(seen[2])
    python, program, *words = shlex.split(seen[1].splitlines()[1])
    assert (python, program) == ("python3", "guidewire.py")
    done = subprocess.run([sys.executable, str(ROOT / program), *words, "--out", "again"], cwd=tmp_path, text=True,
                          capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
    assert read_log(tmp_path / "again", "all").positions[-1, -1].tolist() == seen[3]


@pytest.mark.long("the X-ray picture is that of the core")
def test_without_webgl_there_is_a_line_and_the_x_ray_picture(browse, runner_command, tmp_path):
    none = ("const real = HTMLCanvasElement.prototype.getContext; HTMLCanvasElement.prototype.getContext = "
            "function (kind, ...more) { return kind.startsWith('webgl') ? null : real.call(this, kind, ...more); };"
            " console.error = () => {};")
    levels = ("(() => { const one = document.getElementById('fluoroscopy'); const { data } = one.getContext('2d')"
              ".getImageData(0, 0, one.width, one.height); return [...new Set(data.filter((_, k) => k % 4 === "
              "0))].length; })()")
    with serving(tmp_path, SHEATH, with_three=True) as (address, _):
        seen = browse(["init", none], ["open", address], ["until", "globalThis.viewer?.xray.drawn > 0"], ["down", "w"],
                      ["until", f"{HUB} > 0.01"], ["up", "w"], ["see", levels], ["see", text("#notice")],
                      ["see", "getComputedStyle(document.getElementById('view')).display"])["seen"]
    assert seen[0] > 20 and seen[1].startswith("No WebGL") and seen[2] == "none"


@pytest.mark.long("a pause of the server stands in its own tests")
def test_a_paused_wire_and_slow_steps_are_said_beside_the_picture(browse, runner_command, tmp_path):
    slow = "viewer.shown._note(0.4)"
    with serving(tmp_path, SHEATH, with_three=True) as (address, _):
        seen = browse(
            ["open", address], DRAWN, ["down", "w"], ["until", f"{HUB} > 0.01"], ["up", "w"],
            ["see", f"{slow}; {text('#note')}"], ["press", " "], PAUSED, ["down", "w"],
            ["see", f"[{text('#note')}, document.getElementById('note').className]"], ["up", "w"],
            ["until", "!document.getElementById('note').className"], ["see", text("#note")],
            ["see", f"{text('#gauges .basis')}"],
            ["see", "[...document.querySelectorAll('.gauge')].map((one) => one.getAttribute('aria-valuemax'))"],
            ["see", "for (const one of document.querySelectorAll('details')) one.open = true"],
            *(["see", f"document.querySelector('.gauge').dataset.band = '{band}'; {FAINT}"]
              for band in ("caution", "stop")), ["press", "h"], ["down", "w"], ["see", FAINT], ["up", "w"],
            ["see", f"viewer.shown._panel.say(['one']); {FAINT}"], ["click", "biplane"], ["see", FAINT])["seen"]
    assert all(faint == [] for faint in (*seen[6:8], *seen[8:])), seen[6:]
    assert seen[0] == "slower than real time: 0.4 x"
    assert seen[1] == ['paused: nothing moves until "go on" (space)', "loud"] and seen[2] == "paused"
    # Euler's loads of a wire of 0.36 mm: 60 GPa held at both ends of 5 cm, 6 GPa as a column of 1 cm.
    inertia = np.pi * 1.8e-4 ** 4 / 4
    shaft, tip = 4 * np.pi ** 2 * 60e9 * inertia / 0.05 ** 2, np.pi ** 2 * 6e9 * inertia / (4 * 0.01 ** 2)
    assert f"{shaft:.2f} N" in seen[3] and f"{tip:.2f} N" in seen[3]
    assert [float(most) for most in seen[4]] == pytest.approx([1.5 * shaft, 3 * tip])


@pytest.mark.long("events and score stand in the test below, a report in the tests of the suite")
def test_success_ends_with_a_report_in_the_words_of_the_case(browse, runner_command, tmp_path):
    words = ("[...document.querySelectorAll('body *')].filter((one) => !one.children.length).map((one) =>"
             " `${one.textContent} ${one.title} ${one.getAttribute('aria-label') ?? ''}`).join(' ')")
    report = "document.getElementById('report')"
    score = "viewer.shown._desk.score"
    with serving(tmp_path, near_target(tmp_path), with_three=True) as (address, _):
        seen = browse(
            ["open", address], DRAWN, ["see", text("#score")], ["see", words],
            ["see", f"window.kept = {STATUS}.opened"], ["down", "w"], ["until", f"{HUB} > 0.02"], ["up", "w"],
            ["press", " "],
            PAUSED, ["see", "new Promise((go) => { setTimeout(go, 1500); })"],
            ["see", f"[{score}.path, {score}.first, {text('#score')}]"],
            ["open", address], DRAWN, ["see", f"[{score}.path, {score}.first, {text('#score')}]"],
            ["press", " "], ["until", f"!{STATUS}.isPaused"], ["down", "w"],
            ["until", DEBRIEF], ["up", "w"], PAUSED, ["see", f"{report}.textContent"],
            ["see", FAINT], ["picture", str(tmp_path / "report.png")],
            ["see", "window.saved = null; URL.createObjectURL = (blob) => { blob.text().then((one) => { saved = "
                    "one; }); return 'blob:none'; }; HTMLAnchorElement.prototype.click = function () { window.file = "
                    "this.download; }"],
            ["click", "save report"], ["until", "window.saved"], ["see", "[file, saved]"],
            ["click", "go on"], ["until", f"!{STATUS}.isPaused"])["seen"]
    assert seen[0] == "0" and not re.findall(r".{20}(?:\brim\b|scene).{20}", seen[1].lower())
    assert seen[4][0] > 10 and 0 < int(seen[4][2]) < 100
    # After a reload the same, and frames that a busy page was not sent.
    assert seen[5][1] == pytest.approx(seen[4][1]) and int(seen[5][2]) >= int(seen[4][2])
    assert seen[4][0] - 1e-6 <= seen[5][0] < seen[4][0] + 20
    for word in ("reached at", "radiation", "contrast", "largest wall force", "new attempts", "way of the tip",
                 "events"):
        assert word in seen[6]
    assert seen[7] == []
    assert seen[9][0] == "report.txt" and "score: " in seen[9][1]


EVENTS = """
import { Score } from "./score.js";
const columns = { time: 1, positions: 6, contactForce: 2, curvature: 2, hubForce: 1, hubInsertion: 1, lumen: 3,
  contactForces1: 6 };
const channels = new Map(Object.entries(columns).filter(([name]) => name in data.frames[0]).map(([name, width]) =>
  [name, { name, width, unit: name === "curvature" ? "rad/m" : "N" }]));
const recording = { channels, instruments: [{ radii: [0.18, 0.18], tipLoad: 0.1, shaftLoad: 1 }], millimetres: 1,
  count: data.frames.length, firstShown: () => 0,
  at: (name, frame) => Float64Array.from(data.frames[frame][name]) };
const score = new Score(recording);
score.show(data.frames.length - 1);
console.log(JSON.stringify({ ...score, _recording: 0 }));
"""


def test_forces_kinks_and_leaving_the_vessel_are_events_and_attempts_are_counted():
    def frame(time, tip, force=0.0, curvature=0.0, hub=0.0, insertion=0.0, left=50.0, inside=1.0):
        return {"time": [time], "positions": [0, 0, 0, 0, 0, tip], "contactForce": [0.01, force],
                "curvature": [0, curvature],
                "hubForce": [hub], "hubInsertion": [insertion], "lumen": [left, 0.0, inside]}

    frames = [frame(0, 0, left=60, inside=0), frame(0.5, 10, force=0.15, insertion=0.01),
              frame(1.0, 20, force=0.25, insertion=0.02), frame(1.5, 18, force=0.15, insertion=0.018),
              frame(2.0, 10, force=0.25, insertion=0.01),    # still the same: it was not below the yellow band
              frame(2.5, 10, curvature=475.0, insertion=0.01, hub=1.2),
              frame(3.0, 30, inside=0, insertion=0.03, left=30),
              frame(3.5, 10, insertion=0.01), frame(9.0, 10, force=0.15, insertion=0.01)]
    got = follow(EVENTS, frames=frames)
    assert [(one["kind"], one["time"]) for one in got["mishaps"]] == [
        ("wall", 1), ("hub", 2.5), ("kink", 2.5), ("left", 3)]
    assert "8.6 % strain" in got["mishaps"][2]["text"]    # 475 rad/m times 0.18 mm
    assert got["retries"] == 2 and got["path"] == pytest.approx(10 + 10 + 2 + 8 + 20 + 20)
    # of the 5.5 s before the last frame nothing is known
    assert (got["caution"], got["stop"]) == pytest.approx((1.0, 1.0))
    assert got["best"] == pytest.approx(0.5) and got["wallForce"] == 0.25
    # A tip that is bent by itself, where nothing presses it, is no kink; 8.6 % more is.
    bent = [{**one, "curvature": [0, 475.0], "contactForce": [0, 0]} for one in frames[:2]]
    assert not [one for one in follow(EVENTS, frames=bent)["mishaps"] if one["kind"] == "kink"]
    pressed = [*bent, {**frames[2], "curvature": [0, 950.0]}]
    assert [one["text"] for one in follow(EVENTS, frames=pressed)["mishaps"] if one["kind"] == "kink"] == [
        "wire kinked: 8.6 % strain"]
    # The mark of the gauge is that of all instruments: a catheter had 0.5 N, as 0.3 and 0.4 across.
    with_catheter = [{**one, "contactForces1": [0, 0, 0, 0.3, 0.4, 0] if k == 3 else [0] * 6}
                     for k, one in enumerate(frames)]
    assert follow(EVENTS, frames=with_catheter)["wallForce"] == pytest.approx(0.5)


JUDGE = """
import { judge } from "./missions.js";
console.log(JSON.stringify(data.cases.map(([score, beam, contrast]) => judge({ par: 10 }, score, beam, contrast))));
"""


def test_stars_are_for_time_for_wall_forces_and_for_radiation_with_contrast():
    def case(time, points, beam, contrast):
        return [{"reachedAt": time, "points": points}, beam, contrast]

    cases = [case(10, 90, 10, 10), case(10.1, 90, 10, 10), case(10, 89, 10, 10), case(10, 90, 10.1, 0),
             case(10, 90, 0, 10.1), case(11, 0, 11, 11)]
    judged = follow(JUDGE, cases=cases)
    assert [one["result"]["stars"] for one in judged] == [3, 2, 2, 2, 2, 0]
    assert judged[0]["text"] == "★★★" and judged[1]["text"] == "★★☆, missed: within 10 s"


def test_by_keyboard_alone_and_without_barriers(browse, desk):
    """Enter and the space bar press what a keyboard has reached; time stands until the first push."""
    def focus(one):
        return ["see", f"document.querySelector('{one}').focus()"]

    waits = f"{STATUS}.isWaiting"
    _, *seen = browse(
        ["open", desk], *BEGUN, ["see", text("#coach")], ["see", "document.title"],
        ["axe", None], focus("#fine"), ["press", "Enter"], ["see", "viewer.shown.steering.isFine"],
        focus("#fine"), ["press", " "], ["see", f"[viewer.shown.steering.isFine, {waits}]"],
        ["see", "document.getElementById('bar').getBoundingClientRect().height"],
        focus("footer .drive"), ["down", "Enter"], ["until", f"{HUB} > 0.02"], ["up", "Enter"],
        ["until", "viewer.shown.steering.push === 0"], ["see", text("#coach")],
        focus("#pause"), ["press", " "], PAUSED, ["see", "document.activeElement.id"],
        ["see", "document.getElementById('bar').getBoundingClientRect().height"],
        ["press", "Enter"], ["until", f"!{STATUS}.isPaused"],
        ["click", "fine G"], ["see", "document.activeElement.tagName"], ["press", " "], PAUSED,
        ["see", "viewer.shown.steering.isFine"], ["press", "h"], ["axe", None], ["press", "Escape"],
        ["see", "document.querySelectorAll('details').forEach((one) => { one.open = true; })"], ["axe", None],
        ["see", "document.getElementById('theme').click()"], ["axe", None], size=(1280, 720))["seen"]
    first, title, findings, *seen = seen
    assert "push" in first and title.endswith(" · Guidewire") and findings == []
    assert seen[1] and seen[3] == [False, True] and "turn" in seen[6]
    assert seen[8] == "pause" and seen[9] == seen[4]
    assert seen[10:12] == ["BODY", True]
    assert seen[12] == seen[14] == seen[16] == []


# Pairs of controls, figures and texts of which one lies over another; those out of the window; buttons that cut a text.
OVERLAPS = """(() => {
  const what = 'button, select, input, summary, output, h1, h2, strong, label, .note, .pad, .gauge, .dial, .card,'
    + ' .strip,'
    + ' .advice, #arm, #note, #scaleBar, #coach, #armTools, main > section';
  const shown = [...document.querySelectorAll(what)].filter((one) => !one.closest('[inert]')
    && one.checkVisibility({ visibilityProperty: true, opacityProperty: true }));
  const clipped = (one) => {
    let { left, top, right, bottom } = one.getBoundingClientRect();
    for (let up = one.parentElement; up && up !== document.body; up = up.parentElement) {
      if (getComputedStyle(up).overflowY === 'visible') continue;
      const box = up.getBoundingClientRect();
      [left, top] = [Math.max(left, box.left), Math.max(top, box.top)];
      [right, bottom] = [Math.min(right, box.right), Math.min(bottom, box.bottom)];
    }
    return { one, left, top, right, bottom,
      name: one.id || `${one.tagName}.${one.className} ${one.textContent.trim().slice(0, 20)}` };
  };
  const boxes = shown.map(clipped).filter(({ left, top, right, bottom }) => right - left > 1 && bottom - top > 1);
  const isPicture = (one) => one.matches('main > section');
  const wrong = [];
  boxes.forEach((a, i) => {
    if (Math.min(a.left, a.top, innerWidth - a.right, innerHeight - a.bottom) < -1) wrong.push(`${a.name} outside`);
    const { clientWidth, scrollWidth } = a.one;
    const isCut = clientWidth && scrollWidth > clientWidth + 1;
    if (a.one.matches('button, summary, output') && isCut) wrong.push(`${a.name} cut`);
    for (const b of boxes.slice(i + 1)) {
      if (a.one.contains(b.one) || b.one.contains(a.one) || (isPicture(a.one) && isPicture(b.one))) continue;
      if ([a, b].some(({ one }) => one.id === 'swap') && [a, b].some(({ one }) => isPicture(one))) continue;
      if (Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1
        && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1) wrong.push(`${a.name} over ${b.name}`);
    }
  });
  return wrong;
})()"""


@pytest.mark.parametrize("size", [(390, 844), *(pytest.param(size, marks=pytest.mark.long("a phone is measured"))
                                                for size in ((844, 390), (1024, 768), (1440, 900)))])
def test_nothing_lies_over_another_and_a_strip_leads_to_its_moment(browse, desk, tmp_path, size):
    """While the page waits, in the first minute, with the report."""
    strip = ("(x) => { const one = document.querySelector('.strip'); const { left, width, top } ="
             " one.getBoundingClientRect(); one.dispatchEvent(new PointerEvent('pointerdown', "
             "{clientX: left + x * width, clientY: top + 20, bubbles: true})); }")
    times = "[viewer.shown.model.recording.at('time', viewer.shown.frames.shown)[0], viewer.shown._desk.score.time]"
    _, *seen = browse(["open", desk], *BEGUN, ["see", OVERLAPS],
                      ["see", "document.documentElement.scrollWidth"], ["see", f"{text('#slide')} + {text('#spin')}"],
                      ["down", "w"], ["until", f"{HUB} > 0.02"], ["up", "w"], ["see", OVERLAPS], ["down", "w"],
                      ["until", DEBRIEF], ["up", "w"], PAUSED, ["see", OVERLAPS], ["see", f"({strip})(0.6)"],
                      ["see", times], ["see", text(".advice")], ["axe", None],
                      ["picture", str(tmp_path / "report.png")], size=size)["seen"]
    assert seen[0] == seen[3] == seen[4] == seen[8] == []
    assert seen[1] <= size[0] and seen[2] == "push ↑pull ↓↺ turnturn ↻"
    assert 0.2 * seen[6][1] < seen[6][0] < 0.8 * seen[6][1] and seen[7].endswith(".")

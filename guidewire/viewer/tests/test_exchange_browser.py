"""An instrument is exchanged on the page: withdrawn, another one chosen, advanced over the wire; the case goes on."""

import pytest

from guidewire.prepare import ROOT
from guidewire.viewer.tests.browsing import DRAWN
from guidewire.viewer.tests.test_desk_browser import DEBRIEF, STATUS, text
from guidewire.viewer.tests.test_view import serving
from guidewire.viewer.tests.test_view_browser import GAMEPAD, HUB, HUB_OF_CATHETER

BRANCH = str(ROOT / "params/catheter-branch.json")
CARD = "document.getElementById('card')"
OTHER = "catheter-guide-6f"
CHOOSE = ["see", f"document.querySelector('#card select').value = '{OTHER}'"]
SCORE = "viewer.shown._desk.score"
TIME = "viewer.shown.model.recording.at('time', viewer.shown.model.recording.count - 1)[0]"
EXCHANGED = ["until", f"{STATUS}.exchanges.length === 1 && viewer.shown._exchanged === 1"]


def by_keys():
    return {"open": [["press", "q"]], "do": [["click", "exchange"]], "next": [["press", "i"]],
            "pull": [["down", "s"]], "push": [["down", "w"]], "rest": [["up", "s"], ["up", "w"]],
            "report": [["click", "report"]]}


def by_finger():
    def tap(one):
        return [["touch", [one, 0.5, 0.5]], ["touch", [one]]]

    menu = ["until", "(document.getElementById('rest').open = true)"]
    return {"open": [menu, *tap("#exchange")],
            "do": tap("#card button.on"), "next": tap("#hold"), "pull": [["touch", ["#slide", 0.5, 0.98]]],
            "push": [["touch", ["#slide", 0.5, 0.02]]], "rest": [["touch", ["#slide"]]],
            "report": [menu, *tap("#reporting")]}


def by_gamepad():
    def now(what):    # nothing is seen of it
        return ["until", f"(pad.{what}, true)"]

    def press(button, until):
        return [now(f"buttons[{button}].pressed = true"), ["until", until], now(f"buttons[{button}].pressed = false")]

    return {"open": press(12, f"{CARD}.open"),
            "do": press(0, f"!{CARD}.open || {text('#card')}.includes('not exchanged')"),
            "next": press(4, f"{STATUS}.held === 1"),
            "pull": [now("axes[1] = 1")], "push": [now("axes[1] = -1")], "rest": [now("axes[1] = 0")],
            "report": [["click", "report"]]}


@pytest.mark.parametrize("hand, size", [(by_keys, (720, 520)), (by_finger, (390, 844)), (by_gamepad, (844, 390))])
@pytest.mark.long("an exchange stands in the tests of sessions, keys in those of the suite")
def test_a_catheter_is_withdrawn_and_another_one_goes_over_the_wire(browse, runner_command, tmp_path, hand, size):
    do = hand()
    with serving(tmp_path, BRANCH, with_three=True) as (address, _):
        seen = browse(
            ["open", address], DRAWN,
            ["see", GAMEPAD if hand is by_gamepad else "0"],
            *do["push"], ["until", f"{HUB} > 0.005"], *do["rest"], *do["next"], ["until", f"{STATUS}.held === 1"],
            *do["open"], ["until", f"{CARD}.open"], ["picture", str(tmp_path / "choose.png")], CHOOSE, *do["do"],
            ["until", f"{CARD}.open && {text('#card')}.includes('not exchanged')"], ["see", text("#card")],
            ["picture", str(tmp_path / "refused.png")], ["see", f"{CARD}.close()"],
            *do["pull"], ["until", f"{HUB_OF_CATHETER} < -0.0105"], *do["rest"],
            ["see", f"window.before = [{TIME}, {SCORE}.path, {STATUS}.opened]"],
            ["see", "window.tip = [...viewer.shown.model.tip]"],
            *do["open"], ["until", f"{CARD}.open"], CHOOSE, *do["do"], EXCHANGED,
            ["see", f"[{TIME} >= before[0], {SCORE}.path >= before[1], {STATUS}.opened - before[2]]"],
            ["see", "Math.hypot(...viewer.shown.model.tip.map((one, k) => one - tip[k])) < 0.1"],
            ["see", text("#legend")], ["see", f"[{STATUS}.problem, {STATUS}.steered]"],
            *do["push"], ["until", f"{HUB_OF_CATHETER} > 0"], *do["rest"],
            ["picture", str(tmp_path / "exchanged.png")],
            *do["report"], ["until", DEBRIEF], ["see", "document.getElementById('report').textContent"],
            ["picture", str(tmp_path / "report.png")], size=size)["seen"]
    assert any("The catheter needs to be withdrawn by 10 mm more, into the sheath." in str(one) for one in seen)
    again, near, legend, (problem, steered), report = seen[-5:]
    assert again == [True, True, 1] and near and OTHER in legend and problem == ""
    assert steered == "an instrument was exchanged within the run: start anew to record"
    assert f"{OTHER} in place of catheter-angled-5f" in report

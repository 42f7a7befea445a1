"""What a page without a server computes itself, against the server's: channels, frames, instruments, drive tables."""

import base64
import json
import math
import random
import re
import shutil
import subprocess
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from guidewire.prepare import ROOT
from guidewire.sessions.session import Session
from guidewire.viewer import live
from guidewire.viewer.cases import MISSIONS
from guidewire.viewer.held import HeldInstruments
from guidewire.viewer.live import LiveFrames
from guidewire.viewer.parts import PAGE
from guidewire.viewer.recording import facts_of, largest_shown, radius_of

SCENES = [*(pytest.param(name, {}, id=name) for name in ("insertion", "insertion-accurate", "catheter-branch")),
          pytest.param("cantilever", {"solver": "xpbd", "timeStep": 0.001}, id="xpbd"),
          pytest.param("sheath", {"sheath": {}, "inlet": None}, id="sheath",
                       marks=pytest.mark.long("one sheath is there"))]


def follow(script, **data):
    """What a module of the page prints as JSON; `data` and `rules` are there."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("no Node.js")
    text = f"""import {{ readFileSync }} from "node:fs";
        const data = JSON.parse(readFileSync(0, "utf-8"));
        const numbers = (text) => new Float64Array(Uint8Array.from(atob(text), (one) => one.charCodeAt(0)).buffer);
        const told = (values) => Buffer.from(Float64Array.from(values).buffer).toString("base64");
        {script}"""
    done = subprocess.run([node, "--input-type=module", "-e", text], input=json.dumps(data), cwd=PAGE, text=True,
                          capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def doubles(text):
    return np.frombuffer(base64.b64decode(text), "<f8")


class Recorder:
    """A session's host that keeps its answers."""

    def __init__(self, host):
        self.host, self.answers = host, []

    def __getattr__(self, name):
        return getattr(self.host, name)

    def ask(self, line):
        self.answers.append(self.host.ask(line))
        return self.answers[-1]


def test_the_pages_words_are_there_in_each_language_with_the_same_places_for_values():
    said = {text.replace('\\"', '"') for path in PAGE.glob("*.js")
            for text in re.findall(r'\bsay\("((?:[^"\\\n]|\\.)*)"',
                                   re.sub(r'"\s*\+\s*"', "", path.read_text(encoding="utf-8")))}
    missions = {text for one in MISSIONS.values() for text in (one.title, one.goal)}
    for path in (PAGE / "words").glob("*.json"):
        words = json.loads(path.read_text(encoding="utf-8"))
        assert (said | missions) - set(words) == set() and len(said) > 60
        for text, other in words.items():
            assert other and sorted(re.findall(r"{\d}", text)) == sorted(re.findall(r"{\d}", other)), text
    first, second = (set(json.loads(path.read_text(encoding="utf-8"))) for path in (PAGE / "words").glob("*.json"))
    assert first == second


CHANNELS = """
import { factsOf, largestShown, makeChannels, radiusOf, sheathOf } from "./channels.js";
import { Run } from "./run.js";
const messages = [];
const queue = [...data.answers];
// The program's answers are those that Python's session had: a page's own run takes them, one after the other.
const program = { ask: ({ session }) => (session === "describe" ? data.described : queue.shift()),
  walls: () => new Uint8Array(Buffer.from(data.walls, "base64")), step: () => new Float64Array([0, 0, 1, 0]) };
const run = new Run(program, data.rules, [], 4, (message) => messages.push(message));
run.hear({ do: "open", scene: "scene", hand: data.hand });
run.hear({ do: "pause", value: true });
const { recording } = messages.find((message) => message.recording);
for (let k = 0; k < data.steps; k++) {
  run.hear({ do: "step" });
  run._go();
  run.hear({ do: "shown" });
}
const frames = messages.filter((message) => message.frame).map(({ frame }) => told(new Float64Array(frame)));
run._ports.port1.close();
console.log(JSON.stringify({ frames, status: messages.filter((message) => message.status).pop().status,
  recording: { ...recording, walls: recording.walls.map(({ kind, vertices, triangles }) =>
    [kind, told(vertices), told(triangles)]), channels: recording.channels.map(({ values, ...channel }) =>
    ({ ...channel, values: told(values) })) } }));
"""


@pytest.mark.parametrize("name, changes", SCENES)
@pytest.mark.few(2)
def test_channels_frames_and_status_are_those_of_the_server(runner_command, name, changes):
    file = ROOT / "params" / f"{name}.json"
    server = live.LiveRun({name: file}, name, {"solver": ["direct", "pbd"]})
    with Session(file, hand=name != "cantilever", native=False, records_steering=True, **live.ENDLESS,
                 **changes) as session:
        session._host = recorder = Recorder(session._host)
        described, surfaces = session.describe(), session.walls()
        walls = recorder.answers.pop()["walls"]
        server._session, server._frames = session, LiveFrames(session, name, ["one"])
        recorder.answers.clear()
        server._instruments = HeldInstruments(described)
        states = [session.reset()]
        states += [session.step(push=0.4 * session.hand, turn=0.01 * session.hand) for _ in range(4)]
        wanted = [server._frames._channels(0.0, state) for state in states]
        parameters = session.parameters
        status = server._status(None)
    answers = [{**answer, "effective": dict(parameters), "hand": session.hand, "warnings": ["one"]}
               for answer in recorder.answers]
    got = follow(CHANNELS, answers=answers, described=described, walls=walls, rules=live.rules(server._choices),
                 hand=session.hand, steps=len(states) - 1)
    recording = got["recording"]
    sheath = server._frames._sheath
    assert recording["facts"] == [list(fact) for fact in facts_of(parameters, None)]
    assert recording["radius"] == radius_of(parameters) and recording["warnings"] == ["one"]
    assert (sheath is None) == (recording["sheath"] is None)
    if sheath is not None:
        np.testing.assert_allclose(recording["sheath"], sheath, rtol=1e-13, atol=1e-9)
    for (kind, vertices, triangles), surface in zip(recording["walls"], surfaces, strict=True):
        np.testing.assert_array_equal(doubles(vertices), surface.vertices.astype("f4").ravel())
        np.testing.assert_array_equal(doubles(triangles), surface.triangles.ravel())
        assert kind == ("vessel" if surface is surfaces[0] and parameters.get("vessel") else "obstacle")
    for channel, own in zip(wanted[0], recording["channels"], strict=True):
        assert (own["name"], own["label"], own["unit"], own["place"], own["isSigned"], own["width"]) == (
            channel.name, channel.label, channel.unit, channel.place, channel.is_signed, channel.values.shape[1])
    most = largest_shown(wanted[0])
    timed = [channel.name in ("stepTime", "realTime") for channel in wanted[0]]
    for frame, channels in zip(got["frames"], wanted[1:], strict=True):
        numbers = doubles(frame)
        most = np.maximum(most, largest_shown(channels))
        assert numbers[1] == 5    # scenes opened
        for k, channel in enumerate(channels):
            if not timed[k]:
                assert numbers[2 + k] == pytest.approx(most[k], rel=1e-12, abs=1e-12), channel.name
        at = 2 + len(channels)
        for k, channel in enumerate(channels):
            values = numbers[at:at + channel.values.size]
            at += channel.values.size
            exact = channel.name.startswith(("positions", "time", "step", "hub", "contactForces", "tip", "inBody"))
            exact &= channel.name != "hubForce"
            if not timed[k]:    # a processor's root and arc cosine are another library's here
                near = {"rtol": 0.0, "atol": 0.0} if exact else {"rtol": 1e-9, "atol": 1e-7}
                np.testing.assert_allclose(values, channel.values.ravel(), **near, err_msg=channel.name)
    same = set(status) - {"opened", "scene", "scenes", "titles", "file", "hand", "isFree", "isPaused"}
    told = json.loads(json.dumps(status))
    assert {key: got["status"][key] for key in same} == {key: told[key] for key in same}
    assert set(got["status"]) == set(status)


HELD = """
import { HeldInstruments } from "./run.js";
console.log(JSON.stringify(data.hands.map(({ number, aim, turn, steps, most, hand, other }) => {
  const held = new HeldInstruments(data.described.instruments, 0);
  held.hold(number);
  held.aim = aim;
  const hub = number ? `catheter${number}` : "hub";
  return [held.towardsAim({ [hub]: [0, turn] }, steps, most), held.motion(hand, other)];
})));
"""


@pytest.mark.parametrize("hubs", [1, 2, 3])
def test_what_hands_ask_of_each_hub_is_what_the_server_asks(hubs):
    dice = random.Random(65)
    described = {"instruments": [{"title": "", "name": "", "choices": []}] * hubs}
    hands = [{"number": dice.randrange(hubs), "aim": dice.choice([None, 0.0, 2.0]), "turn": dice.uniform(-1, 3),
              "steps": 2 ** dice.randrange(5), "most": dice.uniform(0, 0.3),
              "hand": [dice.uniform(-1, 1), 0.25], "other": [0.5, dice.uniform(-1, 1)]} for _ in range(50)]
    turns = set()
    for one, (turn, motion) in zip(hands, follow(HELD, hands=hands, described=described), strict=True):
        own = HeldInstruments(described)
        own.hold(one["number"])
        own.aim, there = one["aim"], [SimpleNamespace(turn=math.nan) for _ in range(hubs)]
        there[one["number"]].turn = one["turn"]
        assert own.towards_aim(SimpleNamespace(hub=there[0], catheters=there[1:]), one["steps"], one["most"]) == turn
        assert [list(each) for each in own.motion(one["hand"], one["other"])] == motion
        assert motion[one["number"]] == one["hand"] and motion.count([0.0, 0.0]) + motion.count([0, 0]) >= hubs - 2
        turns.add(turn == 0)
    assert turns == {True, False}


RIMS = """
import { sceneOf } from "./rims.js";
console.log(JSON.stringify(data.files.map(([name, text]) =>
  sceneOf(name, new Uint8Array(Buffer.from(text, "base64")), data.wire))));
"""


def test_a_wire_starts_at_the_widest_end_of_a_mesh_alone(runner_command, tmp_path):
    file = ROOT / "params" / "meshes" / "artery.obj"
    rows = [line.split() for line in file.read_text().splitlines()]
    vertices = np.array([row[1:4] for row in rows if row[:1] == ["v"]], dtype=float)
    triangles = np.array([[one.split("/")[0] for one in row[1:]] for row in rows if row[:1] == ["f"]], dtype=int) - 1
    edges, counts = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0, return_counts=True)
    a, b = edges[counts == 1].T
    number = len(vertices)
    _, rim_of = connected_components(coo_matrix((np.ones(len(a)), (a, b)), (number, number)), directed=False)
    ends = np.unique([a, b])
    rims = [vertices[ends[rim_of[ends] == rim]] for rim in np.unique(rim_of[ends])]
    radii = sorted((np.linalg.norm(rim - rim.mean(axis=0), axis=1).mean() for rim in rims), reverse=True)
    corners = vertices[triangles].astype("<f4")
    stl = np.zeros(len(corners), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    stl["corners"] = corners
    (tmp_path / "artery.stl").write_bytes(bytes(80) + np.uint32(len(stl)).tobytes() + stl.tobytes())
    text = "\n".join("vertex {} {} {}".format(*corner) for corner in corners.reshape(-1, 3).tolist())
    files = [("artery.obj", file.read_bytes()), ("artery.stl", (tmp_path / "artery.stl").read_bytes()),
             ("text.stl", f"solid s\n{text}\nendsolid".encode())]
    wire = json.loads((ROOT / "params" / "sheath.json").read_text())
    wire = {key: value for key, value in wire.items() if key not in ("vessel", "sheath", "guidewireOffset")}
    got = follow(RIMS, wire=wire, files=[(name, base64.b64encode(content).decode()) for name, content in files])
    for (name, content), made in zip(files, got, strict=True):
        ends = made["ends"]["ends"]
        assert len(ends) == len(radii) >= 1
        np.testing.assert_allclose(ends[0]["centre"], [0.0, 0.0, -20.0], atol=0.05)    # as params/sheath.json says
        np.testing.assert_allclose(ends[0]["direction"], [0.0, 0.0, 1.0], atol=0.05)
        np.testing.assert_allclose([end["radius"] for end in ends], radii, rtol=1e-5)
        (tmp_path / name).write_bytes(content)
        (tmp_path / f"{name}.ends.json").write_text(json.dumps(made["ends"]))
        (tmp_path / f"{name}.json").write_text(json.dumps(made["scene"]))
    with Session(tmp_path / "artery.obj.json", hand=True, native=False, **live.ENDLESS) as session:
        before = session.state.positions[-1]
        after = session.step(push=30.0, steps=20).positions[-1]
    assert before[2] < after[2] and after[2] > 5.0

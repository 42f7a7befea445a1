"""What the page of guidewire.py view is given of a run: channels, their precision, and the page as one file."""

import json
import shutil
import struct

import numpy as np
import pytest

from guidewire.logs.hub import read_hub
from guidewire.logs.logs import read_log
from guidewire.logs.runs import read_run
from guidewire.logs.surfaces import Surface, curvature
from guidewire.runs.runner import Request
from guidewire.viewer import command
from guidewire.viewer.export import to_html
from guidewire.viewer.recording import (
    Recording, Units, ending_of, largest_shown, make_channels, read_recording, sheath_of,
)
from guidewire.viewer.server import page_files


def recording(frames=300, elements=60, wall=None):
    """A wire that swings, of so many frames."""
    time_ = np.linspace(0.0, 3.0, frames)
    s = np.linspace(0.0, 300.0, elements + 1)
    x = 40.0 * np.sin(s / 50.0 + time_[:, None]) + 0.1 * np.sin(7.0 * s * time_[:, None])
    positions = np.stack([x, 20.0 * np.cos(s / 40.0 - time_[:, None]), np.broadcast_to(s, x.shape)], axis=2)
    forces = np.where(x[..., None] > 30.0, positions, 0.0)
    orientations = np.zeros((frames, elements, 4))
    half = 0.5 * 0.02 * np.arange(elements) + np.zeros((frames, 1))
    orientations[..., 2], orientations[..., 3] = np.sin(half), np.cos(half)
    channels = make_channels(Units(None), {
        "time": time_, "step": np.arange(frames), "positions": positions, "orientations": orientations,
        "contact_forces": forces, "reaction": forces[:, 3] + 1.0})
    return Recording("swing", "finished", [], [], 1.0, channels, [("vessel", wall)] if wall else [])


def unpack(block):
    """Channels by name, as the page reads them, with what the header says of them."""
    (length,) = struct.unpack_from("<I", block)
    header = json.loads(block[4:4 + length])
    channels = {}
    for channel in header["channels"]:
        start = 4 + length + channel["offset"]
        values = np.frombuffer(block, "<" + channel["type"], channel["count"], start).astype(float)
        if "low" in channel:
            low, high = np.array(channel["low"]), np.array(channel["high"])
            values = (low + values.reshape(-1, len(low)) / 65535.0 * (high - low)).ravel()
        channels[channel["name"]] = (channel, values.reshape(-1, channel["width"]))
    return channels


def test_a_recording_is_exact_or_as_near_as_16_bits_are():
    whole = recording(20, 8)
    exact, near = unpack(whole.to_bytes()), unpack(whole.to_bytes(exact=False))
    for channel in whole.channels:
        np.testing.assert_array_equal(exact[channel.name][1], channel.values)
        span = channel.values.max() - channel.values.min()
        fraction = 1e-7 if channel.place == "frame" else 0.51 / 65535.0
        np.testing.assert_allclose(near[channel.name][1], channel.values, atol=fraction * span + 1e-7, rtol=1e-7)


@pytest.mark.parametrize("ending, said", [
    (("diverged", False, "sphere 3 is lost"), "diverged, not reliable: sphere 3 is lost"),
    (("finished", True, "all 3 steps are done"), "finished, reliable: all 3 steps are done"),
    (("finished", None, ""), "finished"), (("killed", None, ""), "killed"), ((None, None, ""), ""),
])
def test_how_a_run_ended_is_one_line(ending, said):
    assert ending_of(*ending) == said


def test_a_diverged_run_replays_with_its_outcome_and_that_it_is_not_reliable(live, tmp_path):
    answer = live.run(Request("a", None, tmp_path / "run", {"stretchStiffness": 2.5, "displacementDirection": [0, 1, 0],
                                                            "maxSimulationSteps": 400}))
    assert answer.outcome == "diverged"
    run = read_run(tmp_path / "run")
    shown = read_recording(run, [], 10, {}, lambda positions: [])
    steps = {channel.name: channel for channel in shown.channels}["stepTime"]
    log = read_log(run.folder)
    assert steps.unit == "ms"
    assert steps.values[-1] == pytest.approx(1e3 * (log.elapsed[-1] - log.elapsed[-2]))
    assert shown.outcome == f"diverged, not reliable: {answer.message}"


def test_what_colours_the_wire_is_its_own():
    channels = {channel.name: channel.values for channel in recording(3, 12).channels}
    for k in range(3):
        np.testing.assert_allclose(channels["curvature"][k], curvature(channels["positions"][k].reshape(-1, 3)))
    # Each element turned about its axis by 0.02 rad against the one before.
    lengths = np.linalg.norm(np.diff(channels["positions"].reshape(3, 13, 3), axis=1), axis=2)
    np.testing.assert_allclose(channels["twist"][:, 1:-1], 0.02 / (0.5 * (lengths[:, 1:] + lengths[:, :-1])))
    np.testing.assert_allclose(channels["tipz"][:, 0], 300.0)


def test_the_sign_of_a_quaternion_does_not_twist_the_wire():
    numbers = {"time": np.zeros(1), "step": np.zeros(1), "positions": np.cumsum(np.ones((1, 4, 3)), axis=1),
               "orientations": np.array([[[0.0, 0.0, np.sin(half), np.cos(half)] for half in (0.0, 0.2, 0.1)]])}
    once = {channel.name: channel.values for channel in make_channels(Units(None), numbers)}
    numbers["orientations"][0, 1] *= -1.0
    again = {channel.name: channel.values for channel in make_channels(Units(None), numbers)}
    np.testing.assert_allclose(again["twist"], once["twist"], rtol=1e-12)


def test_what_is_read_off_at_the_hub_is_shown_and_where_a_sheath_ends():
    # Five spheres along z, 10 mm apart; pushed by 3 mm.
    first = np.array([[0.0, 0.0, z] for z in (-30.0, -20.0, -10.0, 0.0, 10.0)])
    numbers = {
        "step": np.array([0, 1]), "time": np.array([0.0, 0.1]), "positions": np.array([first, first + [0.0, 0.0, 3.0]]),
        "reaction": np.array([[0.0, 0.0, 9.0], [0.0, 0.0, 9.0]]), "hub.force": np.array([0.5, 0.25]),
        "hub.insertion": np.array([0.0, 0.003]), "kineticEnergy": np.array([1.0, 2.0]),
        "elasticEnergy": np.array([3.0, 5.0]), "inBody": np.array([2, 2]),
    }
    shown = {channel.name: channel for channel in make_channels(Units(1e-3), numbers)}
    assert shown["hubForce"].values.ravel().tolist() == [0.5, 0.25] and shown["hubForce"].unit == "N"
    assert shown["hubInsertion"].values.ravel().tolist() == [0.0, 0.003]
    assert shown["energy"].values.ravel().tolist() == [4.0, 7.0]
    assert shown["elasticEnergy"].label == "elastic energy" and "potentialEnergy" not in shown
    parameters = {"sheath": {}, "metresPerUnit": 1e-3}
    assert sheath_of({**parameters, "sheath": None}, numbers) is None
    assert sheath_of(parameters, numbers).tolist() == [[0.0, 0.0, -10.0], [0.0, 0.0, -30.0]]
    by_length = {**numbers, "hub.lengthInBody": np.array([0.015, 0.018])}
    assert sheath_of(parameters, by_length) == pytest.approx(np.array([[0.0, 0.0, -5.0], [0.0, 0.0, -30.0]]))
    given = sheath_of({**parameters, "sheath": {"exit": [0, 0, -7]}}, numbers)
    assert given.tolist() == [[0.0, 0.0, -7.0], [0.0, 0.0, -30.0]]


def test_scales_go_by_what_is_shown():
    first = np.array([[0.0, 0.0, z] for z in (-30.0, -20.0, -10.0, 0.0, 10.0)])
    forces = np.zeros((1, 5, 3))
    forces[0, 1, 0], forces[0, 4, 1] = 7.0, -2.0  # the first is in the sheath
    channels = make_channels(Units(1e-3), {
        "step": np.array([0]), "time": np.array([0.0]), "positions": first[None], "contact_forces": forces,
        "curvature": np.full((1, 5, 3), [np.nan, 0.0, 0.0]), "inBody": np.array([2])})
    largest = dict(zip((channel.name for channel in channels), largest_shown(channels)))
    assert largest["contactForce"] == largest["contactForces"] == 2.0
    assert largest["curvature"] == 0.0  # not a number: nothing to go by


def test_300_frames_and_a_vessel_of_50_000_triangles_are_a_file_of_less_than_4_MB(tmp_path):
    s, around = np.meshgrid(np.linspace(0.0, 300.0, 251), 0.02 * np.pi * np.arange(100), indexing="ij")
    radius = 8.0 + np.sin(0.3 * s) + 0.1 * np.random.default_rng(1).standard_normal(s.shape)
    vertices = np.stack([radius * np.cos(around), radius * np.sin(around) + 0.001 * s**2, s], axis=2).reshape(-1, 3)
    a = np.arange(250 * 100)
    b = np.where(a % 100 == 99, a - 99, a + 1)
    triangles = np.concatenate([np.stack([a, b, a + 100], 1), np.stack([b, b + 100, a + 100], 1)])
    assert len(triangles) == 50_000
    block = recording(wall=Surface(vertices, triangles, np.zeros(len(vertices)))).to_bytes(exact=False)
    three = tmp_path / "three.module.js"  # as much text as three has, and as hard to press
    three.write_text("import { a } from './three.core.js';\n" + np.random.default_rng(2).bytes(400_000).hex())
    html = to_html(page_files({"three.module.js": three}), [block])
    assert len(html) < 4e6
    assert "src=" not in html and "./" not in html.split("<script", 1)[0]


def test_a_run_brings_the_band_of_its_checks_and_a_study_that_of_its_runs(live, runner_command, tmp_path):
    own = {"solver": "direct", "guidewireLength": 60, "numberRodElements": 20, "wireRadius": 2e-4, "massDamping": 20,
           "proximalEnd": "clamped", "drive": "displace", "insertionSpeed": 0.05, "logHub": True, "deltaThreshold": 0,
           "vessel": {"shape": "tube", "knots": [[0, 0, -80], [0, 0, -40], [0, 10, 0], [0, 40, 30]], "radius": 2}}
    for name, dt, steps in (("one", 0.02, 20), ("one/check/half", 0.01, 40)):
        request = Request(name, None, tmp_path / name, {**own, "timeStep": dt, "maxSimulationSteps": steps})
        answer = live.run(request)
        assert answer.exit_code == 0, answer.message
    log, other = read_hub(tmp_path / "one"), read_hub(tmp_path / "one/check/half")
    other_force = np.interp(log.time, other.time, other.force)
    for folder in ("one", "study"):
        if folder == "study":
            (tmp_path / "study").mkdir()
            (tmp_path / "study/runs.csv").write_text("")
            shutil.copytree(tmp_path / "one", tmp_path / "study/a", ignore=shutil.ignore_patterns("check"))
            shutil.copytree(tmp_path / "one/check/half", tmp_path / "study/b")
        channels = unpack(command._read(tmp_path / folder, 100, True))
        band = channels["hubForceBand"][1]
        np.testing.assert_allclose(band[:, 0], np.minimum(log.force, other_force), atol=1e-12)
        np.testing.assert_allclose(band[:, 1], np.maximum(log.force, other_force), atol=1e-12)
        assert (band[:, 0] < band[:, 1]).any() and channels["hubTorqueBand"][1].shape == band.shape
        assert (channels["hubForce"][1][:, 0] == log.force).all()

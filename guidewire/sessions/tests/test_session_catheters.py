"""Sessions of a wire with catheters: whose hub the hand moves, pictures, another instrument for a withdrawn one."""

import json
import math
import subprocess

import numpy as np
import pytest

from guidewire.prepare import ROOT
from guidewire.sessions.session import Session, SessionError

CATHETER = ROOT / "params" / "catheter.json"


def test_the_hub_says_whose_instrument_the_hand_moves_and_a_state_has_each_of_them():
    with Session(CATHETER, hand=True, native=False) as session:
        start = session.state
        by_catheter = session.step(push=6.0, turn=0.5, steps=6, hub=1)
        (catheter,) = by_catheter.catheters
        assert catheter.insertion == pytest.approx(6e-3, rel=1e-12) and catheter.turn == pytest.approx(0.5, rel=1e-12)
        assert (by_catheter.hub.insertion, by_catheter.hub.turn) == (0.0, 0.0)
        by_wire = session.step(push=9.0, turn=-0.25, steps=6)
        assert by_wire.hub.insertion == pytest.approx(9e-3, rel=1e-12) and by_wire.hub.turn == pytest.approx(-0.25)
        assert by_wire.catheters[0].insertion == catheter.insertion
        described = session.describe()["instruments"]
    assert start.catheters[0].extension == pytest.approx(0.4 - 0.2 - 0.19) and start.hub.insertion == 0.0
    assert by_wire.catheters[0].extension == pytest.approx(0.01 + 3e-3)
    assert by_wire.catheters[0].overlap == pytest.approx(0.19)
    np.testing.assert_array_equal(catheter.tip_position, catheter.positions[-1])
    assert np.linalg.norm(catheter.tip_direction) == pytest.approx(1.0)
    assert catheter.tip_direction @ np.diff(catheter.positions[-2:], axis=0)[0] > 0.0
    assert [one["name"] for one in described] == ["bentson-0.035", "catheter-angled-5f"]
    assert [one["key"] for one in described] == ["instrument", "catheters[0].instrument"]
    folder = sorted(file.stem for file in (ROOT / "instruments").glob("*.json"))
    assert [one["choices"] for one in described] == [folder, [name for name in folder if "catheter" in name]]
    for one, nodes in zip(described, (by_wire.positions, catheter.positions)):
        assert len(one["radii"]) == len(one["innerRadii"]) == len(one["attenuations"]) == len(nodes) - 1
    assert max(described[1]["radii"]) == pytest.approx(5.0 / 6.0) and min(described[1]["innerRadii"]) > 0.4445


def assert_hubs_that_are_not_there_are_refused(native):
    for file, least, asked in ((CATHETER, "0, the wire's, or that of a catheter, from 1 to 1", (2, 3, 2**31 - 1)),
                               (ROOT / "params/cantilever.json", "0, the wire's, where there is no catheter", (1, 7))):
        for hand in (True, False):
            with Session(file, hand=hand, native=native) as session:
                for hub in asked:
                    with pytest.raises(SessionError) as refused:
                        session.step(hub=hub)
                    assert str(refused.value) == f"hub = {hub} is not allowed: needs {least}"
                for hub in (-1, 2**40, True, 0.5, "1", None):
                    with pytest.raises(SessionError, match="hub = .* is not allowed: needs a whole number from 0"):
                        session.step(hub=hub)
                assert session.state.step == 0 and session.step(hub=0).step == 1


def test_a_hub_that_is_not_there_is_refused_in_one_line_and_nothing_has_moved():
    assert_hubs_that_are_not_there_are_refused(native=False)


def test_a_picture_shows_the_catheter_and_takes_the_nodes_of_all_instruments():
    view = {"pixels": 96, "field_of_view": 60.0, "vessel": "none", "lao": 90.0}
    with Session(CATHETER, hand=True, native=False) as session:
        state = session.state
        count = len(state.positions) + len(state.catheters[0].positions)
        own = {**view, "centre": state.catheters[0].positions[20].tolist()}
        seen = state.picture(**own).astype(int)
        away = [state.positions, state.catheters[0].positions + [500.0, 500.0, 0.0]]
        wire_alone = session.picture_of(away, **own).astype(int)
        with pytest.raises(SessionError, match=f"positions needs to be of {count} nodes, three numbers each"):
            session.picture_of(state.positions, **own)
    darker = (wire_alone > seen).sum(axis=1)    # in each row of a picture of a catheter that goes upwards
    assert np.all(np.abs(darker[5:-5] - 2 * (5.0 / 6.0) / 60.0 * 96) <= 2), "as wide as the catheter is"
    assert np.array_equal(seen[:, :30], wire_alone[:, :30])


def test_the_largest_wall_force_of_a_run_is_that_of_one_of_its_instruments(runner_command, tmp_path):
    """The run's summary takes it from the chain of all, a session from the instruments."""
    file = ROOT / "params" / "catheter-sheath.json"
    subprocess.run([*runner_command, "-parameters", str(file), "-out", str(tmp_path / "run"), "-maxSimulationSteps",
                    "60"], check=True, capture_output=True)
    largest = 0.0
    with Session(file, hand=False, maxSimulationSteps=60) as session:
        assert session.hubs == 2
        while session.state.outcome is None:
            state = session.step()
            for one in (state, *state.catheters):
                assert one.contact_forces.shape == one.positions.shape
                largest = max(largest, np.linalg.norm(one.contact_forces, axis=1).max())
    assert largest > 0.1
    assert largest == json.loads((tmp_path / "run" / "summary.json").read_text())["largestContactForce"]


@pytest.mark.parametrize("push, turn", [([1.0], 0.0), ([1.0, 2.0, 3.0], 0.0), (1.0, [0.1, 0.2]), ("far", [0.0, 0.0]),
                                        ([1.0, None], 0.0), ([1.0, math.nan], 0.0), (0.0, np.zeros((2, 1))), (0.0, [])])
def test_lists_of_another_length_or_of_no_numbers_are_refused_and_nothing_moves(push, turn):
    with Session(CATHETER, hand=True) as session:
        with pytest.raises(SessionError, match="is not allowed: needs a") as refused:
            session.step(push, turn)
        assert "\n" not in str(refused.value) and session.state.step == 0
        with pytest.raises(SessionError, match="needs a number, or a list of one for each of the 2 hubs"):
            session.step([1.0, 1.0], hub=1)


def test_a_picture_shows_the_wire_bent_at_the_tip_that_it_comes_out_of():
    with Session(CATHETER, hand=True, native=False) as session:
        state = session.state
        wire, catheter = state.positions.copy(), state.catheters[0].positions.copy()
        lengths = np.linalg.norm(np.diff(wire, axis=0), axis=1)
        k = len(lengths) // 2
        along = np.cumsum(np.r_[0.0, lengths])
        corner = 0.4 * lengths[k]  # the tip's distance from the chord
        wire = np.outer(along, [0.0, 0.0, 1.0])
        wire[k + 1:, 2] -= lengths[k] - 2.0 * np.sqrt(0.25 * lengths[k]**2 - corner**2)
        tip = 0.5 * (wire[k] + wire[k + 1]) + [0.0, corner, 0.0]
        catheter = tip + np.outer(np.arange(len(catheter))[::-1], [0.0, 2.0, 0.0])  # comes from the side
        middle = 0.5 * (tip + wire[k + 1])
        view = {"pixels": 65, "field_of_view": 4.0 * corner, "vessel": "none", "noise": 0.0, "blur": 0.0,
                "centre": middle.tolist()}
        bent = session.picture_of([wire, catheter], **view).astype(int)
        # The same shadow along the beam, and no tip on the wire's way.
        far = session.picture_of([wire, catheter + [lengths[k], 0.0, 0.0]], **view).astype(int)
        assert bent[32, 32] < far[32, 32] - 5, "the piece from the tip to the next node is there"


BRANCH = ROOT / "params" / "catheter-branch.json"


def test_a_run_begins_where_the_state_of_another_has_all_instruments():
    with Session(CATHETER, hand=True, **{"vessel.frictionCoefficient": 0.0}) as session:
        session.step(push=[40.0, 20.0], turn=[1.2, -9.0], steps=40)
        state = session.step(push=[0.5, 0.25])
        whole = [session.step(push=[0.5, 0.25], turn=[0.1, 0.0]) for _ in range(40)]
    with Session(CATHETER, hand=True, start=state.start(), **{"vessel.frictionCoefficient": 0.0}) as session:
        parts = [session.step(push=[0.5, 0.25], turn=[0.1, 0.0]) for _ in range(40)]
    # A start does not have what tips bear, of which a fourth is taken in each step: the rest goes with 0.75^k.
    differences = [max(np.abs(one.positions - part.positions).max(),
                       np.abs(one.catheters[0].positions - part.catheters[0].positions).max())
                   for one, part in zip(whole, parts)]
    assert differences[0] < 0.2 and differences[20] < 1.1 * 0.75**19 * differences[1] and differences[-1] < 1e-4
    assert parts[-1].hub.insertion == pytest.approx(whole[-1].hub.insertion, abs=1e-12)
    assert parts[-1].catheters[0].turn == pytest.approx(whole[-1].catheters[0].turn, abs=1e-12)
    assert parts[-1].hub.force == pytest.approx(whole[-1].hub.force, abs=1e-6)


def test_another_catheter_takes_the_place_of_a_withdrawn_one_over_the_wire_that_stays():
    with Session(BRANCH, hand=True, native=False, maxSimulationSteps=10**9) as session:
        session.step(push=[30.0, 0.0], steps=20)
        with pytest.raises(SessionError) as refused:
            session.exchange(1, "catheter-guide-6f")
        assert str(refused.value) == "the catheter needs to be withdrawn by 10 mm more, into the sheath"
        before = session.step(push=[0.0, -10.5], steps=10)
        for asked, said in ((dict(length=300.0), "the wire is 20.5 mm too short: the hub"),
                            (dict(instrument="no-such-catheter"), "no-such-catheter"),
                            (dict(length=-1.0), "catheters[0].length")):
            with pytest.raises(SessionError) as refused:
                session.exchange(1, **asked)
            assert said in str(refused.value) and "\n" not in str(refused.value)
        state = session.exchange(1, "catheter-guide-6f", length=180.0, elements=30)
        (catheter,) = state.catheters
        assert state.time == before.time and len(catheter.positions) != len(before.catheters[0].positions)
        assert catheter.insertion == before.catheters[0].insertion
        np.testing.assert_allclose(state.positions, before.positions, atol=1e-5)
        np.testing.assert_allclose(catheter.tip_position, before.catheters[0].tip_position, atol=1e-6)
        assert session.describe()["instruments"][1]["name"] == "catheter-guide-6f"
        state = session.step(push=[0.0, 20.0], steps=10)
        assert state.outcome is None and state.catheters[0].tip_position[2] == pytest.approx(-10.5, abs=0.5)
        saved = session.save()
        following = session.step(push=[0.0, 2.0], steps=2)
        again = session.restore(saved)
        np.testing.assert_array_equal(again.positions, state.positions)
        np.testing.assert_array_equal(session.step(push=[0.0, 2.0], steps=2).positions, following.positions)
        start = session.reset()
        assert start.time == 0.0 and start.catheters[0].tip_position[2] == pytest.approx(-20.0)
        assert len(start.catheters[0].positions) == len(catheter.positions)
        with pytest.raises(SessionError, match="hub = 2 is not allowed"):
            session.exchange(2, "catheter-guide-6f")


def test_another_wire_takes_the_place_of_a_withdrawn_one():
    with Session(BRANCH, hand=True, native=False, maxSimulationSteps=10**9) as session:
        before = session.step(push=[-20.5, 15.0], steps=20)
        state = session.exchange(0, "radifocus-angled-0.035", length=350.0, elements=60)
        assert state.time == before.time and len(state.positions) != len(before.positions)
        np.testing.assert_allclose(state.positions[-1], before.positions[-1], atol=1e-6)
        # What is deep in the sheath comes in, and is found by other sums.
        np.testing.assert_allclose(state.catheters[0].positions, before.catheters[0].positions, atol=1e-11)
        state = session.step(push=[40.0, 0.0], steps=30)
        assert state.outcome is None and state.positions[-1, 2] > 5.0


def test_a_wire_alone_is_not_exchanged():
    with Session(ROOT / "params" / "sheath.json", hand=True, native=False) as session:
        with pytest.raises(SessionError, match="^a wire alone cannot be exchanged: the run has to start anew$"):
            session.exchange(0, "bentson-0.035")

"""What of a state is read off, and when: on a stand-in for the native library that notes what it is asked for."""

import base64
import copy
import gc
import pickle
import threading
import time

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from guidewire.sessions import session as sessions
from guidewire.sessions import session_hosts
from guidewire.sessions.session import Session, SessionError
from guidewire.sessions.session_state import INSTRUMENTS, MOTION, STRAINS, directors_of


class StandIn(session_hosts.Library):
    """A wire all of whose numbers are the steps done."""

    def __init__(self):
        self.done, self.spheres, self.refuses, self.closed = 0, 3, False, 0
        self.reads = []    # parts, and after how many steps each was read

    def ask(self, line):
        if "reset" in line:
            self.done = 0
        return self.last()

    def last(self):
        rows = {"positions": (self.spheres, 3), "velocities": (self.spheres, 3), "orientations": (self.spheres - 1, 4),
                "angularVelocities": (self.spheres - 1, 3), "hub": (1, 14), "strain": (self.spheres - 1, 3),
                "energy": (1, 3)}
        texts = {name: base64.b64encode(np.full(shape, float(self.done)).tobytes()) for name, shape in rows.items()}
        return {"exitCode": 0, "step": self.done, "time": 0.5 * self.done, "outcome": None, "message": "",
                "predictionError": 0.0, "effective": {}, "hand": True, "warnings": [], **texts}

    def step(self, motion, steps):
        if self.refuses:
            return {"exitCode": 2, "message": "request: not so"}
        self.done += steps
        return self.done, 0.5 * self.done, 0.0

    def read(self, part, layout):
        self.reads.append((part, self.done))
        if layout["positions"][0] != self.spheres:
            return None
        return {name: np.full(shape, float(self.done)) for name, shape in layout.items()}

    def close(self):
        self.closed += 1


@pytest.fixture(name="stand_in")
def _stand_in(monkeypatch):
    host = StandIn()
    monkeypatch.setattr(sessions, "host_of", lambda native: host)
    return host


def test_directors_are_the_axes_turned_by_their_quaternion():
    random = np.random.default_rng(3).normal(size=(20, 4))
    quaternions = random / np.linalg.norm(random, axis=1)[:, None]
    expected = Rotation.from_quat(quaternions).as_matrix().transpose(0, 2, 1)
    np.testing.assert_allclose(directors_of(quaternions), expected, atol=1e-14)


def test_only_what_is_asked_for_is_read_and_once(stand_in):
    session = Session()
    for _ in range(5):
        session.step()
    assert stand_in.reads == [] and session.state.step == 5 and session.state.time == 2.5
    assert session.state.positions[0, 0] == session.state.velocities[0, 0] == 5.0
    assert session.state.directors.shape == (2, 3, 3)
    assert stand_in.reads == [(MOTION, 5)]
    assert session.state.energy.elastic == 5.0 and session.state.strain is session.state.strain
    assert session.state.hub.insertion == 5.0 and session.state.couple is None
    assert stand_in.reads == [(MOTION, 5), (STRAINS, 5), (INSTRUMENTS, 5)]
    with pytest.raises(AttributeError, match="a state has no colour"):
        _ = session.state.colour


def test_what_somebody_keeps_is_read_before_the_run_goes_on(stand_in):
    session = Session()
    kept = [session.step() for _ in range(3)]
    kept[-1].positions.fill(-1.0)    # the caller's own
    session.reset()
    assert [state.velocities[0, 0] for state in kept] == [1.0, 2.0, 3.0]
    assert [state.hub.turn for state in kept] == [1.0, 2.0, 3.0]
    assert stand_in.reads == [(part, step) for step in (1, 2) for part in (MOTION, INSTRUMENTS, STRAINS)] + [
        (MOTION, 3), (INSTRUMENTS, 3), (STRAINS, 3)]
    assert session.state.step == 0 and session.state.positions[0, 0] == 0.0


def test_a_refused_step_leaves_the_state_whether_or_not_somebody_has_it(stand_in):
    session = Session()
    for keep in (False, True):
        state = session.step()
        expected = state.step
        if not keep:
            del state
        stand_in.refuses = True
        with pytest.raises(SessionError, match="^not so"):
            session.step()
        stand_in.refuses = False
        assert session.state.step == session.state.positions[0, 0] == expected
        assert not keep or session.state is state


@pytest.mark.parametrize("keep", [False, True])
def test_a_closed_session_still_says_its_state(stand_in, keep):
    with Session() as session:
        state = session.step(steps=4)  # noqa: F841 kept, or not
        if not keep:
            del state
    assert stand_in.closed == 1
    assert session.state.step == session.state.positions[0, 0] == session.state.hub.force == 4.0
    session.close()
    assert stand_in.closed == 1


def test_a_state_outlives_its_session_and_is_copied_whole(stand_in):
    session = Session()
    copies = [copy.copy(session.step()), copy.deepcopy(session.step()), pickle.loads(pickle.dumps(session.step()))]
    assert [[one.step, one.positions[0, 0], one.energy.kinetic] for one in copies] == [[k, k, k] for k in (1, 2, 3)]
    state = session.step()
    del session    # whose state is not read off yet
    assert stand_in.closed == 0 and state.hub.twist == state.positions[2, 2] == state.strain[0, 0] == 4.0
    del copies
    gc.collect()
    assert stand_in.closed == 1 and repr(state) == "State(step 4, 2 s, 2 elements)"


def test_other_arrays_than_before_are_read_with_their_new_shapes(stand_in):
    session = Session()
    state = session.step()
    stand_in.spheres = 5
    assert state.hub.insertion == 1.0 and state.positions.shape == (5, 3) and state.strain.shape == (4, 3)
    assert session.step().positions.shape == (5, 3)


def test_a_state_may_be_read_in_another_thread_while_the_session_goes_on(stand_in):
    session, wrong = Session(), []

    def read():
        for _ in range(300):
            state = session.state
            if not state.step == state.positions[0, 0] == state.energy.kinetic:
                wrong.append(state.step)

    readers = [threading.Thread(target=read) for _ in range(3)]
    for reader in readers:
        reader.start()
    while any(reader.is_alive() for reader in readers):
        session.step()
    assert not wrong


def test_the_state_before_long_steps_is_there_for_other_threads_while_they_last(stand_in):
    session = Session()
    session.step(steps=3)
    seen = []

    def step(motion, steps):
        other = threading.Thread(target=lambda: seen.append((session.state.step, session.state.positions[0, 0])))
        other.start()
        other.join(timeout=20.0)
        return 3 + steps, 0.0, 0.0

    stand_in.step = step
    assert session.step(steps=1000).step == 1003
    assert seen == [(3, 3.0)]


def test_a_session_is_closed_in_the_midst_of_steps_of_another_thread(monkeypatch):
    monkeypatch.setattr(sessions, "SECONDS_TO_END", 0.3)
    session, raised = Session(native=False, maxSimulationSteps=10**9, deltaThreshold=0), []

    def step():
        try:
            session.step(steps=10**9)
        except SessionError as error:
            raised.append(str(error))

    stepping = threading.Thread(target=step)
    stepping.start()
    time.sleep(0.2)
    session.close()
    stepping.join(timeout=20.0)
    assert not session.is_open and len(raised) == 1 and "killed" in raised[0]
    assert session.state.step == 0

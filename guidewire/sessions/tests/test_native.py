"""Sessions of the native library against those of the runner: the same bits, the same refusals."""

import os
import threading
from dataclasses import fields

import numpy as np
import pytest

from guidewire.prepare import ROOT
from guidewire.runs import building
from guidewire.sessions import session_hosts
from guidewire.sessions.session import Session, SessionError
from guidewire.sessions.tests.test_session import ACCURATE, MATERIAL, TUBE, WIRE, assert_same_bits
from guidewire.sessions.tests.test_session_catheters import CATHETER, assert_hubs_that_are_not_there_are_refused

ENDLESS = {"maxSimulationSteps": 10**9, "deltaThreshold": 0}


@pytest.fixture(scope="module", autouse=True)
def library():
    """The library, built where all tests run; elsewhere only where somebody has built it."""
    if os.environ.get("GUIDEWIRE_ALL"):
        return building.build_native(print)
    return building.native_library() or pytest.skip("the native library is not built: 'guidewire.py native'")


def numbers_of(state):
    """All that a state says."""
    arrays = [value for value in (getattr(state, field.name) for field in fields(state))
              if isinstance(value, np.ndarray)]
    return np.concatenate([array.ravel() for array in arrays]), repr(state.hub), state.energy, state.time, state.reason


def pushed(native, calls, file=None, **scene):
    with Session(file, native=native, **scene) as session:
        return [session.state, *(session.step(push=2.0, turn=0.05, steps=3) for _ in range(calls)), session.reset()]


@pytest.mark.parametrize("file, scene", [
    (None, {**TUBE, "maxSimulationSteps": 10**9}), (None, {**MATERIAL, **ENDLESS, "hand": True}),
    (ACCURATE, {**ENDLESS, "hand": True}), (ROOT / "params" / "sheath.json", {**ENDLESS, "hand": True}),
], ids=["pbd in a tube", "material", "mesh", "sheath"])
@pytest.mark.few(2)
def test_the_library_gives_the_runners_bits(file, scene):
    for one, other in zip(pushed(True, 30, file, **scene), pushed(False, 30, file, **scene), strict=True):
        (numbers, *texts), (others, *other_texts) = numbers_of(one), numbers_of(other)
        np.testing.assert_array_equal(numbers, others)
        assert texts == other_texts


@pytest.mark.parametrize("file", [ACCURATE, ROOT / "params" / "sheath.json"], ids=["mesh", "sheath"])
@pytest.mark.few(1)
def test_states_that_are_kept_say_what_they_said_then_and_each_part_may_be_read_first(file):
    """Of a sheath too, where the wire out of it, and with it the arrays, grow."""
    kept, first = [], ("positions", "hub", "energy", "strain", "contact_forces")
    with Session(file, native=True, **ENDLESS, hand=True) as session:
        for k in range(15):
            state = session.step(push=2.0, turn=0.05, steps=3)
            if k % 3 != 1:    # the others are let go of
                if k % 2:
                    getattr(state, first[k % len(first)])
                kept.append((k, state))
    found = pushed(False, 15, file, **ENDLESS, hand=True)[1:]
    for k, state in kept:
        np.testing.assert_array_equal(numbers_of(state)[0], numbers_of(found[k])[0])
        assert numbers_of(state)[1:] == numbers_of(found[k])[1:]


def test_pictures_have_the_same_grey_levels():
    looks = ({}, {"pixels": 100, "lao": 20, "cranial": -10, "noise": 0.05, "seed": 9, "blur": 0.3}, {"pixels": 512})
    with Session(ACCURATE, native=True, **ENDLESS, hand=True) as one, \
            Session(ACCURATE, native=False, **ENDLESS, hand=True) as other:
        for session in (one, other):
            session.step(push=150.0, turn=0.5, steps=150)
        for look in looks:
            np.testing.assert_array_equal(one.picture(**look), other.picture(**look))
            np.testing.assert_array_equal(one.state.picture(**look), other.picture(**look))
        with pytest.raises(SessionError, match="lao"):
            one.picture(lao=1000)


def test_vector_paths_are_on(library):
    assert session_hosts.lanes(library) == 4


def test_what_one_saves_the_other_restores_or_refuses():
    """A snapshot is bound to the build; both are of these sources."""
    with Session(**TUBE, native=True) as one, Session(**TUBE, native=True) as other:
        one.step(push=30.0, steps=30)
        saved = one.save()
        end = one.step(push=20.0, steps=100)
        other.restore(saved)
        np.testing.assert_array_equal(other.step(push=20.0, steps=100).positions, end.positions)


def test_an_end_within_a_call_has_its_reason_and_a_step_after_it_is_refused():
    for native in (True, False):
        with Session(**WIRE, native=native, hand=False, maxSimulationSteps=90) as session:
            ended = session.step(steps=200)
            assert (ended.step, ended.outcome, ended.reason) == (90, "finished", "all 90 steps are done")
            with pytest.raises(SessionError, match="^the run has ended after step 90"):
                session.step()


def test_refusals_leave_the_session_as_it_is():
    with Session(**MATERIAL, native=True) as session:
        before = session.state
        for wrong, said in ((lambda: session.step(push=1.0), "a steered session"),
                            (lambda: session.step(steps=0), "steps = 0"),
                            (lambda: session.change(damping=-1), "damping"),
                            (lambda: session.restore(b""), "is incomplete")):
            with pytest.raises(SessionError, match=said):
                wrong()
        np.testing.assert_array_equal(session.step(steps=1).positions, pushed_once().positions)
        assert before.step == 0


def pushed_once():
    with Session(**MATERIAL, native=False) as session:
        return session.step()


def test_other_arrays_after_a_change_are_read_anew():
    tube = {"shape": "tube", "knots": [[0, 0, -400], [0, 0, 400]], "radius": 30.0}
    with Session(native=True, vessel=tube) as session:
        session.step(steps=2)
        state = session.change(**{"vessel.radius": 25.0})
        assert session.step().step == state.step + 1


def test_sessions_in_threads_take_the_same_steps_as_alone():
    alone = pushed(True, 20, ACCURATE, **ENDLESS, hand=True)
    found = {}

    def make(k):
        found[k] = pushed(True, 20, ACCURATE, **ENDLESS, hand=True)

    threads = [threading.Thread(target=make, args=(k,)) for k in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 3
    for states in found.values():
        for one, other in zip(states, alone, strict=True):
            np.testing.assert_array_equal(numbers_of(one)[0], numbers_of(other)[0])


def test_a_session_that_is_killed_ends_its_steps():
    session = Session(**TUBE, native=True, maxSimulationSteps=10**9)
    timer = threading.Timer(0.2, session.kill)
    timer.start()
    with pytest.raises(SessionError, match="ended while it made steps"):
        session.step(steps=10**7)
    assert not session.is_open
    assert session.state.step > 0 and np.isfinite(session.state.positions).all()
    with pytest.raises(SessionError, match="closed"):
        session.step()


def test_a_fork_of_a_process_with_native_sessions_takes_runners():
    with Session(**WIRE, native=True) as session:
        session.step()
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            with Session(**WIRE) as session:
                os.write(writer, type(session._host).__name__.encode())
        finally:
            os._exit(0)
    os.close(writer)
    assert os.waitpid(child, 0)[1] == 0
    with open(reader, "rb") as said:
        assert said.read() == b"Process"


def test_a_library_that_was_not_built_is_said(monkeypatch):
    monkeypatch.setattr(building, "native_library", lambda: None)
    with pytest.raises(SessionError, match="guidewire.py native' builds it"):
        Session(native=True)


def test_the_library_gives_the_runners_bits_of_every_instrument():
    states = []
    for native in (False, True):
        with Session(CATHETER, hand=True, native=native) as session:
            session.step(push=5.0, turn=0.3, steps=5, hub=1)
            saved = session.save()
            session.step(push=4.0, turn=0.1, steps=3)
            later = session.restore(saved)
            states.append((later, session.step(push=-2.0, turn=0.2, steps=70, hub=1), session.state.picture(pixels=48)))
    for one, other in zip(states[0][:2], states[1][:2]):
        assert_same_bits(one, other)
        for name in vars(one.catheters[0]):
            np.testing.assert_array_equal(getattr(one.catheters[0], name), getattr(other.catheters[0], name), name)
    np.testing.assert_array_equal(states[0][2], states[1][2])


def test_the_library_refuses_a_hub_that_is_not_there():
    assert_hubs_that_are_not_there_are_refused(native=True)

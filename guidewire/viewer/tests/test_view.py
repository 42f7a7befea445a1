"""guidewire.py view: who is answered and who is not, one hand and many eyes, and how it ends; with the real runner."""

import asyncio
import http.client
import json
import os
import re
import signal
import socket
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import urlsplit

import aiohttp
import numpy as np
import pytest

from guidewire.prepare import ROOT, report
from guidewire.viewer import parts
from guidewire.viewer.live import LiveRun
from guidewire.viewer.server import LONGEST_MESSAGE, MOST_PAGES
from guidewire.viewer.tests.test_recording import unpack

SCENE = {"guidewireLength": 60, "numberRodElements": 6, "guidewireOffset": -60, "displacement": 0, "sphereRadius": 2,
         "constraintSolverSteps": 5, "vessel": {"shape": "tube", "knots": [[0, 0, -70], [0, 0, 90]], "radius": 8}}
SECRET = "in no page"


@contextmanager
def serving(tmp_path, *words, with_three=False, what="view"):
    """A server of the page, and its address; Ctrl-C ends it well. Without three there is nothing to install."""
    stand_in = "" if with_three else "from guidewire.viewer import command; command.three = lambda tell: {}; "
    start = (f"import sys; {stand_in}from guidewire.commands import commands; "
             f"sys.exit(commands.run(commands.parse({[what, *words]!r})))")
    with (tmp_path / "errors").open("w") as errors:
        process = subprocess.Popen([sys.executable, "-c", start], cwd=tmp_path, stdout=subprocess.PIPE, stderr=errors,
                                   text=True, env={**os.environ, "PYTHONPATH": str(ROOT)})
    try:
        line = process.stdout.readline()
        assert line.startswith("open http://127.0.0.1:"), (tmp_path / "errors").read_text()
        yield line.split()[1], process
        process.send_signal(signal.SIGINT)
        assert process.wait(60) == 0
        assert (tmp_path / "errors").read_text() == ""
    finally:
        process.kill()
        process.wait()
        process.stdout.close()


@pytest.fixture(scope="module")
def live(runner_command, tmp_path_factory):
    """Address and process of a server with a run that goes on."""
    folder = tmp_path_factory.mktemp("live")
    (folder / "secret.json").write_text(SECRET)
    (folder / "scene.json").write_text(json.dumps(SCENE))
    with serving(folder, "scene.json") as (address, process):
        yield address, process


def ask(address, path, method="GET", **headers):
    """Status and text of an answer to a request as it stands, without anything put right before it is sent."""
    where = urlsplit(address)
    connection = http.client.HTTPConnection(where.hostname, where.port, timeout=60)
    connection.putrequest(method, path, skip_host="Host" in headers)
    for name, value in headers.items():
        connection.putheader(name, value)
    connection.endheaders()
    answer = connection.getresponse()
    text = answer.read().decode("utf-8", "replace")
    connection.close()
    return answer.status, text, answer.headers


def with_pages(address, talk, count=1):
    """Run a conversation of pages that have joined one after the other."""
    async def talk_with_all():
        origin = "http://" + urlsplit(address).netloc
        async with aiohttp.ClientSession() as session:
            pages = []
            for _ in range(count):
                pages.append(await session.ws_connect(address + "live", headers={"Origin": origin}, max_msg_size=0))
                await pages[-1].receive_json(timeout=60)
                pages[-1].session, pages[-1].recording = session, address + "recording/0"
            try:
                return await asyncio.wait_for(talk(*pages), 120)
            finally:
                for page in pages:
                    await page.close()

    return asyncio.run(talk_with_all())


async def hear(page, wanted):
    """The next status of which something is true; states between are let pass."""
    while True:
        message = await page.receive()
        if message.type in (aiohttp.WSMsgType.CLOSE, aiohttp.WSMsgType.CLOSED, aiohttp.WSMsgType.ERROR):
            raise AssertionError(f"closed: {message}")
        if message.type == aiohttp.WSMsgType.BINARY:
            await page.send_json({"do": "shown"})
        if message.type == aiohttp.WSMsgType.TEXT and wanted(json.loads(message.data)):
            return json.loads(message.data)


async def take_hand(page):
    """Wait until the page before is gone, and take the hand."""
    status = {"hand": False}
    while not status["hand"]:
        await page.send_json({"do": "take"})
        status = await hear(page, lambda status: status["hand"] or status["isFree"])


async def see(page, count):
    """So many states: the mark of the hand, then the channels. Left out: the scene's number, the largest of each."""
    async with page.session.get(page.recording) as answer:
        channels = len(unpack(await answer.read()))
    states = []
    while len(states) < count:
        message = await page.receive()
        if message.type == aiohttp.WSMsgType.BINARY:
            await page.send_json({"do": "shown"})
            states.append(np.delete(np.frombuffer(message.data), slice(1, 2 + channels)))
    return np.array(states)


async def rest(page):
    """The step at which a wire stands that was paused: what was begun before has come to its end."""
    read = []
    while len(read) < 4 or len(set(read[-4:])) > 1:
        async with page.session.get(page.recording) as answer:
            read.append(unpack(await answer.read())["step"][1][-1, 0])
        await asyncio.sleep(0.1)
    return read[-1]


async def step_once(page):
    """State after one more step of a wire that was paused; pictures of earlier ones are passed over."""
    before = await rest(page)
    await page.send_json({"do": "step"})
    while True:
        (state,) = await see(page, 1)
        if state[2] > before:
            assert state[2] == before + 1
            return state


def test_only_its_own_page_with_the_token_is_answered(live):
    address, _ = live
    path, host = urlsplit(address).path, urlsplit(address).netloc
    status, text, headers = ask(address, path)
    assert status == 200 and "<title>Guidewire</title>" in text
    assert "default-src 'self'" in headers["Content-Security-Policy"] and headers["X-Content-Type-Options"] == "nosniff"
    assert ask(address, path + "main.js", Origin=f"http://{host}")[0] == 200
    for wrong in ({"Host": "guidewire.example"}, {"Host": "127.0.0.1"}, {"Origin": "http://guidewire.example"},
                  {"Origin": "null"}, {"Origin": "https://" + host}, {"Origin": f"http://{host}.example"}):
        assert ask(address, path, **wrong)[0] == 403, wrong
    for wrong in ("/", "/main.js", "/" + path[2:], path[:-2] + "/", "/x" * 3, path.upper()):
        assert ask(address, wrong)[0] == 404, wrong
    for method in ("POST", "PUT", "DELETE", "OPTIONS"):
        assert ask(address, path + "show.json", method)[0] in (404, 405)


@pytest.mark.parametrize("name", [
    "../secret.json", "secret.json", "%2e%2e/secret.json", "..%2fsecret.json", "/etc/passwd", "//etc/passwd",
    "main.js/../../server.py", "package.json", "jsconfig.json", "main.js%00", "recording/1", "recording/-1",
    "recording/00", "recording/../show.json", "page/main.js",
])
def test_nothing_is_served_that_is_not_in_the_table(live, name):
    address, _ = live
    status, text, _ = ask(address, urlsplit(address).path + name)
    assert status in (400, 404) and SECRET not in text and "root:" not in text


@pytest.mark.parametrize("name", ["index.html", "anatomy.html"])
def test_elements_of_the_page_have_names_of_their_own(name):
    names = re.findall(r'\bid="([^"]+)"', (parts.PAGE / name).read_text(encoding="utf-8"))
    assert len(names) > 5 and len(set(names)) == len(names)


def test_it_listens_on_this_machine_alone(live):
    port = urlsplit(live[0]).port
    with pytest.raises(ConnectionRefusedError):  # of the loop of this machine, too, only the one address
        socket.create_connection(("127.0.0.2", port), timeout=5)


def test_a_run_is_for_its_own_page(live):
    address, _ = live
    upgrade = {"Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13",
               "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA=="}
    assert ask(address, urlsplit(address).path + "live", **upgrade)[0] == 403
    assert ask(address, urlsplit(address).path + "live", Origin="http://guidewire.example", **upgrade)[0] == 403


def test_a_page_moves_the_wire_and_another_looks_on_until_the_first_is_gone(live):
    async def talk(hand, eye):
        await hand.send_json({"do": "hand", "push": 1, "turn": 0, "mark": 7})
        states = await see(hand, 12)
        assert states[-1][0] == 7  # what the hand last said
        assert states[-1][5] - states[0][5] > 0  # z of sphere 0: mark, time, step, x, y, z
        assert (np.diff(states[:, 2]) > 0).all()
        await eye.send_json({"do": "hand", "push": -1, "turn": 0, "mark": 9})
        await eye.send_json({"do": "pause", "value": True})
        await eye.send_json({"do": "take"})
        for _ in range(3):
            status = await hear(eye, lambda status: True)
            assert not status["hand"] and not status["isFree"] and not status["isPaused"]
        assert ((await see(hand, 3))[:, 0] == 7).all()
        await hand.close()
        status = await hear(eye, lambda status: status["isFree"])
        assert status["isPaused"] and not status["hand"]
        await eye.send_json({"do": "take"})
        assert (await hear(eye, lambda status: status["hand"]))["isPaused"]
        await eye.send_json({"do": "reset"})
        assert (await hear(eye, lambda status: status["opened"] > 1))["problem"] == ""

    with_pages(live[0], talk, 2)


def test_a_page_that_was_busy_gets_the_last_frame_before_the_pause(live):
    async def talk(page):
        async def recorded():
            async with page.session.get(page.recording) as answer:
                return unpack(await answer.read())

        await take_hand(page)
        await page.send_json({"do": "pause", "value": True})
        await hear(page, lambda status: status["isPaused"])
        first = await rest(page)
        for _ in range(6):    # more than may be on the way, with one that waits
            await page.send_json({"do": "shown"})
        for k in range(1, 6):    # and says of none that it is shown
            await page.send_json({"do": "step"})
            while (await recorded())["step"][1][-1, 0] < first + k:
                await asyncio.sleep(0.02)
        channels, steps = len(await recorded()), []
        while not steps or steps[-1] < first + 5:
            message = await page.receive(timeout=20)
            if message.type == aiohttp.WSMsgType.BINARY:
                await page.send_json({"do": "shown"})
                steps += [step for step in np.frombuffer(message.data)[[3 + channels]] if step > first]
        assert steps == [first + 1, first + 2, first + 5]

    with_pages(live[0], talk)


def test_a_hand_pauses_steps_changes_and_opens_scenes(live):
    async def talk(page):
        await page.send_json({"do": "pause", "value": True})
        await hear(page, lambda status: status["isPaused"])
        before = await step_once(page)
        after = await step_once(page)
        assert after[2] == before[2] + 1
        await page.send_json({"do": "set", "key": "timeStep", "value": 0.004})
        assert (await hear(page, lambda status: status["values"]["timeStep"] == 0.004))["problem"] == ""
        later = await step_once(page)
        assert later[1] - after[1] == pytest.approx(0.004)
        await page.send_json({"do": "set", "key": "timeStep", "value": -1})
        refused = await hear(page, lambda status: status["problem"])
        assert refused["problem"] == "timeStep = -1 is not allowed: needs a number > 0 (s)"
        assert refused["values"]["timeStep"] == 0.004
        await page.send_json({"do": "set", "key": "solver", "value": "explicit"})
        assert (await hear(page, lambda status: "solver" in status["problem"]))["problem"] == (
            'solver = "explicit" does not go with vessel, which needs solver pbd, xpbd or direct; this run has solver '
            'explicit')
        await page.send_json({"do": "open", "scene": "cantilever.json"})
        status = await hear(page, lambda status: status["scene"] == "cantilever.json")
        assert status["isSteered"] and status["isWaiting"] and status["values"]["solver"] == "direct"
        await page.send_json({"do": "open", "scene": "scene.json", "hand": False})
        status = await hear(page, lambda status: status["scene"] == "scene.json")
        assert not status["isSteered"] and status["isPaused"]
        await page.send_json({"do": "open", "scene": "scene.json"})
        await hear(page, lambda status: status["isSteered"])

    with_pages(live[0], talk)


def test_what_no_drive_table_can_say_is_not_saved(live):
    address, _ = live
    status, text, _ = ask(address, urlsplit(address).path + "steered.csv")
    assert status == 409 and text == 'only a wire of solver direct with drive "displace" takes a drive table'


def test_a_refused_value_and_a_long_time_step_leave_the_wire_going(live):
    async def talk(page):
        await take_hand(page)
        await page.send_json({"do": "open", "scene": "scene.json"})
        await page.send_json({"do": "pause", "value": False})
        await hear(page, lambda status: not status["isPaused"])
        await page.send_json({"do": "set", "key": "timeStep", "value": -1})
        assert not (await hear(page, lambda status: status["problem"]))["isPaused"]
        assert len(await see(page, 2)) == 2
        # A step of 1000 s of in-game time is no wait of 1000 s on the clock, for a start anew least of all.
        await page.send_json({"do": "set", "key": "timeStep", "value": 1000})
        await hear(page, lambda status: status["values"]["timeStep"] == 1000)
        assert len(await see(page, 3)) == 3
        began = time.monotonic()
        await page.send_json({"do": "reset"})
        await page.send_json({"do": "set", "key": "timeStep", "value": 0.01})
        assert (await hear(page, lambda status: status["values"]["timeStep"] == 0.01))["isWaiting"]
        await page.send_json({"do": "hand", "push": 0, "turn": 0.5, "mark": 1})    # the first push
        assert len(await see(page, 5)) == 5 and time.monotonic() - began < 60.0

    with_pages(live[0], talk)


def test_a_start_anew_ends_a_step_that_takes_too_long(runner_command, tmp_path, monkeypatch):
    (tmp_path / "slow.json").write_text(json.dumps({
        **SCENE, "numberRodElements": 2000, "constraintSolverSteps": 1_000_000}))
    monkeypatch.setattr("guidewire.viewer.live._PATIENCE", 0.1)

    async def talk():
        run = LiveRun({"slow": tmp_path / "slow.json"}, "slow", {})
        run.open()
        run._hand, run._is_paused = object(), False
        going = asyncio.ensure_future(run.go())
        await asyncio.sleep(0.3)  # its first step, of some 100 s, is under way
        began = time.monotonic()
        await run._do_reset({})
        assert time.monotonic() - began < 30.0 and run._session.is_open and run._session.state.step == 0
        run._is_paused = True
        run._session.kill()
        going.cancel()
        await asyncio.gather(going, return_exceptions=True)
        await run.close()

    asyncio.run(talk())


def test_a_dial_is_followed_to_its_turn_however_late_its_page_sees_it(runner_command):
    """Here no page sees anything at all."""
    async def talk():
        run = LiveRun({"one": ROOT / "params" / "catheter.json"}, "one", {})
        run.open()
        run._hand, run._is_paused = object(), False
        session, going = run._session, asyncio.ensure_future(run.go())
        await run._do_hold({"instrument": 1})
        for aim in (0.7, -0.2):
            await run._do_aim({"turn": aim})
            while abs(session.state.catheters[0].turn - aim) > 1e-9:
                await asyncio.sleep(0.01)
            step = session.state.step
            while session.state.step < step + 20:
                await asyncio.sleep(0.01)
        turns = np.loadtxt((await run.steered_csv(1)).splitlines(), delimiter=",", skiprows=1)[:, 2]
        turned = np.loadtxt((await run.steered_csv(0)).splitlines(), delimiter=",", skiprows=1)[:, 2]
        await run._do_hand({"push": 0, "turn": 0.5, "mark": 1})    # a key takes over
        await run._do_hand({"push": 0, "turn": 0, "mark": 2})
        assert run._instruments.aim is None
        going.cancel()
        await asyncio.gather(going, return_exceptions=True)
        await run.close()
        highest = turns.argmax()
        assert (np.diff(turns[:highest + 1]) >= 0).all() and (np.diff(turns[highest:]) <= 0).all(), "no overshoot"
        assert turns[highest] == pytest.approx(0.7, abs=1e-9) and turns[-1] == pytest.approx(-0.2, abs=1e-9)
        assert (turned == 0).all()

    asyncio.run(asyncio.wait_for(talk(), 120))


@pytest.mark.parametrize("said", [
    "x" * 100_000_000, "no JSON", "[]",
    "[" * (LONGEST_MESSAGE - 1), b"bytes",
], ids=lambda said: str(said[:30]))
def test_a_page_that_says_what_no_page_says_is_closed_and_the_run_goes_on(live, said):
    async def talk(page):
        try:
            await (page.send_bytes if isinstance(said, bytes) else page.send_str)(said)
        except (ConnectionError, aiohttp.ClientError):
            return  # it did not even listen to the end
        while (await page.receive()).type not in (aiohttp.WSMsgType.CLOSE, aiohttp.WSMsgType.CLOSED,
                                                  aiohttp.WSMsgType.CLOSING, aiohttp.WSMsgType.ERROR):
            pass

    async def talk_after(page):
        await page.send_json({"do": "step"})
        assert len(await see(page, 1)) == 1

    with_pages(live[0], talk)
    with_pages(live[0], talk_after)


@pytest.mark.parametrize("said", [
    '{"do": "nothing"}', '{"do": ["hand"]}', '{"do": "open", "scene": "../secret.json"}',
    '{"do": "set", "key": "logFilePath", "value": "/tmp"}', '{"do": "hand", "push": 2, "turn": 0, "mark": 1}',
    '{"do": "hand", "push": NaN, "turn": 0, "mark": 1}', '{"do": "hand", "push": 0, "turn": 0, "mark": 1e999}',
    '{"do": "hand", "push": 0, "turn": 0, "mark": 1' + "0" * 400 + "}",
    '{"do": "name", "instrument": 9, "name": ""}', '{"do": "exchange", "instrument": -9, "name": ""}',
    '{"do": "aim", "turn": NaN}', '{"do": "aim", "turn": 1e999}', '{"do": "aim", "turn": "' + "9" * 500 + '"}',
    '{"do": "hold", "instrument": 1e999}', '{"do": "name", "instrument": 0, "name": 7}',
    '{"do": "inject", "amount": 1, "rate": 1, "instrument": 1e999}', '{"do": "pace", "value": [1]}',
], ids=lambda said: said[7:60])
def test_what_cannot_be_done_is_refused_and_the_page_goes_on(live, said):
    async def talk(page):
        await take_hand(page)
        await page.send_str(said)
        assert (await hear(page, lambda status: status["problem"]))["problem"].startswith("refused: ")
        await page.send_json({"do": "reset"})
        assert (await hear(page, lambda status: not status["problem"]))["hand"]

    with_pages(live[0], talk)


def test_an_error_of_the_server_is_a_file_without_its_token(live, capsys):
    token = urlsplit(live[0]).path.strip("/")
    try:
        raise ValueError(f"of {token}")
    except ValueError as error:
        report(error, token)
    (line,) = capsys.readouterr().err.splitlines()
    trace = Path(line.rpartition(" ")[2])
    assert token not in line + trace.read_text() and "ValueError" in trace.read_text()


def test_so_many_pages_and_no_more(live):
    async def talk(*pages):
        with pytest.raises(aiohttp.WSServerHandshakeError) as refused:
            async with aiohttp.ClientSession() as session:
                await session.ws_connect(live[0] + "live", headers={"Origin": "http://" + urlsplit(live[0]).netloc})
        assert refused.value.status == 503

    with_pages(live[0], talk, MOST_PAGES)


def test_a_runner_that_is_killed_is_said_and_a_new_one_takes_its_place(live):
    async def talk(page):
        await page.send_json({"do": "pause", "value": False})
        await see(page, 2)
        os.kill(children(live[1].pid)[0], signal.SIGKILL)
        status = await hear(page, lambda status: status["problem"])
        assert "killed by signal 9" in status["problem"] and status["isPaused"]
        await page.send_json({"do": "reset"})
        await page.send_json({"do": "pause", "value": True})
        await hear(page, lambda status: not status["problem"] and status["isPaused"])
        await page.send_json({"do": "step"})
        assert (await see(page, 1))[0][2] <= 20  # among its first steps

    with_pages(live[0], talk)


def test_a_server_that_ends_says_so_and_leaves_no_runner(runner_command, tmp_path):
    (tmp_path / "scene.json").write_text(json.dumps(SCENE))
    with serving(tmp_path, "scene.json") as (address, process):
        runners = children(process.pid)
        assert len(runners) == 1

        async def talk(page):
            process.send_signal(signal.SIGINT)
            while not (message := await page.receive()).type == aiohttp.WSMsgType.CLOSE:
                pass
            assert message.extra == "the server has ended"

        with_pages(address, talk)
        assert process.wait(60) == 0
    for _ in range(100):
        if not any(os.path.exists(f"/proc/{runner}") for runner in runners):
            return
        time.sleep(0.1)
    raise AssertionError("a runner is left")


def children(pid):
    with open(f"/proc/{pid}/task/{pid}/children", encoding="ascii") as file:
        named = [int(child) for child in file.read().split()]
    threads = os.listdir(f"/proc/{pid}/task")
    for thread in threads:  # a process that a thread started is listed there
        with open(f"/proc/{pid}/task/{thread}/children", encoding="ascii") as file:
            named += [int(child) for child in file.read().split()]
    return sorted(set(named))

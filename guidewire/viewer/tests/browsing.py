"""A browser for the tests of pages: one for all of them."""

import asyncio
import itertools
import json
import os
import shutil
import signal
import subprocess
import threading
from pathlib import Path

import pytest
from aiohttp import ClientSession

from guidewire.prepare import PreparationError
from guidewire.viewer import parts

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
DRAWN = ["until", "globalThis.viewer?.stage.drawn > 0"]


def from_npm(kind):
    try:
        return parts.require(kind, print)
    except PreparationError as error:
        pytest.skip(str(error))


@pytest.fixture(scope="session")
def browse():
    """A function that has a browser follow orders and returns what it saw."""
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    node = shutil.which("node")
    if browser is None or node is None:
        pytest.skip("no browser: as root 'apt-get install --no-install-recommends chromium' and nodejs")
    from_npm("dependencies")
    modules = from_npm("devDependencies")
    script = Path(__file__).with_name("browser.mjs")
    process = subprocess.Popen([node, str(script), str(modules.parent), browser], stdin=subprocess.PIPE,
                               stdout=subprocess.PIPE, text=True)

    def follow(*steps, offline=False, size=(720, 520)):
        process.stdin.write(json.dumps({"steps": steps, "offline": offline, "size": size}) + "\n")
        process.stdin.flush()
        answer = json.loads(process.stdout.readline())
        assert answer["troubles"] == [], answer["troubles"]
        return answer

    yield follow
    process.stdin.close()
    process.wait(20)
    process.stdout.close()


class Firefox:
    """Firefox by WebDriver BiDi, which follows the orders of `browse`, but for pictures and clicks."""

    def __init__(self, folder):
        (folder / "user.js").write_text('user_pref("webgl.force-enabled", true);\n')    # drawn by the processor
        self.process = subprocess.Popen(
            ["xvfb-run", "-a", "firefox-esr", "--no-remote", "--profile", str(folder), "--remote-debugging-port", "0"],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True)
        address = next(line for line in self.process.stderr if "WebDriver BiDi listening on" in line).split()[-1]
        threading.Thread(target=self.process.stderr.read, daemon=True).start()
        self.address = f"{address}/session"

    def follow(self, *steps):
        """As `browse`: what was seen, troubles of the page, and addresses that it asked for."""
        return asyncio.run(self._follow(steps))

    async def _follow(self, steps):
        seen, asked, numbers = [], [], itertools.count(1)
        async with ClientSession() as client, client.ws_connect(self.address, max_msg_size=0) as socket:
            async def ask(method, **parameters):
                number = next(numbers)
                await socket.send_json({"id": number, "method": method, "params": parameters})
                while (message := await socket.receive_json()).get("id") != number:
                    if message.get("method") == "network.beforeRequestSent":
                        asked.append(message["params"]["request"]["url"])
                    elif message.get("method") == "log.entryAdded" and message["params"]["level"] == "error":
                        raise AssertionError(message["params"]["text"])
                assert message["type"] == "success", message
                return message["result"]

            await ask("session.new", capabilities={})
            await ask("session.subscribe", events=["network.beforeRequestSent", "log.entryAdded"])
            page = (await ask("browsingContext.getTree"))["contexts"][0]["context"]

            async def see(expression):
                told = await ask("script.evaluate", expression=f"(async () => JSON.stringify(await ({expression})))()",
                                 target={"context": page}, awaitPromise=True)
                assert told["type"] == "success", told
                return json.loads(told["result"].get("value", "null"))

            async def key(kind, name):
                value = {"ArrowRight": "\ue014"}.get(name, name)
                await ask("input.performActions", context=page, actions=[
                    {"type": "key", "id": "keys", "actions": [{"type": one, "value": value} for one in kind]}])

            for order, value in steps:
                if order == "open":
                    await ask("browsingContext.navigate", context=page, url=value, wait="complete")
                elif order == "see":
                    seen.append(await see(value))
                elif order == "until":
                    for _ in range(2400):
                        if await see(f"!!({value})"):
                            break
                        await asyncio.sleep(0.05)
                    else:
                        raise AssertionError(f"not within 2 minutes: {value}")
                elif order == "choose":
                    await see(f"(one => {{ one.value = '{value[1]}'; one.onchange(); }})(document.querySelector('{value[0]}'))")
                else:
                    await key({"down": ["keyDown"], "up": ["keyUp"], "press": ["keyDown", "keyUp"]}[order], value)
            await ask("session.end")
        return {"seen": seen, "asked": asked, "troubles": []}

    def close(self):
        os.killpg(self.process.pid, signal.SIGTERM)
        self.process.wait(20)


@pytest.fixture(scope="session")
def firefox(tmp_path_factory):
    """The same for Firefox."""
    if shutil.which("firefox-esr") is None or shutil.which("xvfb-run") is None:
        pytest.skip("no Firefox: as root 'apt-get install --no-install-recommends firefox-esr xvfb xauth'")
    browser = Firefox(tmp_path_factory.mktemp("firefox"))
    yield browser.follow
    browser.close()

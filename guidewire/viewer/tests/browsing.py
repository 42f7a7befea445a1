"""A browser for the tests of pages: one for all of them."""

import asyncio
import itertools
import json
import os
import re
import shutil
import signal
import subprocess
import threading
from pathlib import Path

import pytest
from aiohttp import ClientSession

from guidewire.prepare import ROOT, PreparationError
from guidewire.viewer import parts

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
DRAWN = ["until", "globalThis.viewer?.stage.drawn > 0"]
# The run of a server that tests share is at its start, in this page's hand; one value is seen.
BEGUN = [DRAWN, ["until", "viewer.shown.status?.hand || (viewer.shown.send({do: 'take'}), false)"],
         ["see", "(() => { window.before = viewer.shown.status.opened; viewer.shown.send({do: 'reset'}); })()"],
         ["until", "viewer.shown.status.opened > before && viewer.shown.status.isWaiting"
                   " && viewer.shown._opened === viewer.shown.status.opened"]]

# Texts whose contrast to what is behind them is below 4.5 (WCAG 2.2), in both themes; behind those on a picture is
# anything from black to white.
FAINT = """["dark", "light"].flatMap((theme) => {
  const before = document.documentElement.dataset.theme;
  document.documentElement.dataset.theme = theme;
  const rgba = (text) => { const n = text.match(/[0-9.]+/g).map(Number);
    return [...n.slice(0, 3).map((one) => (text.startsWith("color") ? 255 * one : one)), n[3] ?? 1]; };
  const over = (colour, under) => under.map((one, k) => colour[k] * colour[3] + one * (1 - colour[3]));
  const light = (rgb) => rgb.map((one) => (one <= 10.31 ? one / 255 / 12.92 : ((one / 255 + 0.055) / 1.055) ** 2.4))
    .reduce((sum, one, k) => sum + one * [0.2126, 0.7152, 0.0722][k], 0);
  const ratio = (...colours) => { const [high, low] = colours.map(light).sort((a, b) => b - a);
    return (high + 0.05) / (low + 0.05); };
  const faint = [];
  for (const one of document.querySelectorAll("body *")) {
    const hasText = [...one.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
    if (!(hasText || one.matches("select, input[type=number]")) || one.closest(":disabled, option, script")) continue;
    if (!one.checkVisibility({ visibilityProperty: true }) || !one.offsetWidth) continue;
    const layers = [];
    let at = one;
    while (at && !at.matches("main > section:not(#debrief)") && !(layers[0]?.[3] === 1)) {
      layers.unshift(rgba(getComputedStyle(at).backgroundColor));
      at = at.parentElement;
    }
    const behind = (layers[0][3] === 1 ? [[0, 0, 0]] : [[0, 0, 0], [255, 255, 255]])
      .map((base) => layers.reduce((under, layer) => over(layer, under), base));
    const least = Math.min(...behind.map((under) => ratio(over(rgba(getComputedStyle(one).color), under), under)));
    const name = one.id || one.className || one.tagName;
    if (!(least >= 4.5)) faint.push(`${theme}: ${name} "${one.textContent.trim().slice(0, 40)}" ${least.toFixed(2)}`);
  }
  document.documentElement.dataset.theme = before;
  return faint;
})"""


def from_npm(kind):
    try:
        return parts.require(kind, print)
    except PreparationError as error:
        pytest.skip(str(error))


def near_target(tmp_path, **more):
    """A scene whose target is a few centimetres from its inlet."""
    scene = json.loads((ROOT / "params/sheath.json").read_text())
    scene["vessel"].update(file=str(ROOT / "params/meshes/artery.obj"),
                           anatomy=str(ROOT / "guidewire/env/data/artery.json"))
    del scene["vessel"]["openRims"], scene["guidewireOffset"]
    (tmp_path / "scene.json").write_text(json.dumps({**scene, "sheath": {}, "inlet": 1, "target": [0, 0, 90], **more}))
    return str(tmp_path / "scene.json")


@pytest.fixture(scope="session")
def desk(runner_command, tmp_path_factory):
    """Address of a server for all tests of a steered page: of a scene whose target is a few centimetres away."""
    from guidewire.viewer.tests.test_view import serving

    folder = tmp_path_factory.mktemp("desk")
    with serving(folder, near_target(folder), with_three=True) as (address, _):
        yield address


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
            # In the tab of the start keys press no button.
            page = (await ask("browsingContext.create", type="tab"))["context"]
            await ask("browsingContext.activate", context=page)

            async def see(expression):
                told = await ask("script.evaluate", expression=f"(async () => JSON.stringify(await ({expression})))()",
                                 target={"context": page}, awaitPromise=True)
                assert told["type"] == "success", told
                return json.loads(told["result"].get("value", "null"))

            async def key(kind, name):
                value = {"ArrowRight": "\ue014", "Enter": "\ue007"}.get(name, name)
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
                elif order == "said":
                    text = re.escape(value)
                    for _ in range(1200):
                        if re.search(text, await see("document.body.innerText"), re.IGNORECASE):
                            break
                        await asyncio.sleep(0.1)
                    else:
                        raise AssertionError(f"not within 2 minutes among the page's texts: {value}")
                elif order == "choose":
                    await see(f"(one => {{ one.value = '{value[1]}'; one.onchange(); }})"
                              f"(document.querySelector('{value[0]}'))")
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

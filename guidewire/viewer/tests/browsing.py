"""A browser for the tests of pages: one for all of them."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest

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

    def follow(*steps, offline=False, size=(540, 345)):
        process.stdin.write(json.dumps({"steps": steps, "offline": offline, "size": size}) + "\n")
        process.stdin.flush()
        answer = json.loads(process.stdout.readline())
        assert answer["troubles"] == []
        return answer

    yield follow
    process.stdin.close()
    process.wait(20)
    process.stdout.close()

"""Pictures and the film of the page for the docs: a mission from the gallery to its report, in a headless browser.

    python3 guidewire.py site results/site
    python3 guidewire.py python experiments/page_pictures.py results/site docs
"""

from __future__ import annotations

import http.server
import json
import shutil
import subprocess
import sys
import tempfile
import threading
from functools import partial
from pathlib import Path
from typing import Any

from PIL import Image

from guidewire.prepare import ROOT
from guidewire.viewer import parts

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
SHOWN = "globalThis.viewer?.shown?.model && viewer.stage.drawn > 0"
TIME = "(viewer.shown?._time ?? 0)"
REPORT = "'debrief' in document.body.dataset"
QUIET = ["see", "viewer.xray.fluoroscopy.look.noise = 0; viewer.xray.ask()"]    # noise does not pack
REST = ["see", "new Promise((done) => { setTimeout(done, 1200); })"]
FILM = (1120, 700)
WIDTHS = {"page-live": 1000, "page-missions": 900, "page-phone": 300, "page-report": 1000}
STEPS = [0.4 * k for k in range(1, 12)]    # s of the run at which a frame of the film is taken


def main(site: Path, out: Path) -> None:
    modules = parts.require("devDependencies", print)
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        sys.exit("page_pictures: needs a browser: as root 'apt-get install chromium'")
    handler = partial(http.server.SimpleHTTPRequestHandler, directory=site)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server, \
            tempfile.TemporaryDirectory(prefix="guidewire-") as made:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        address = f"http://127.0.0.1:{server.server_port}/"
        folder = Path(made)

        def take(size: tuple[int, int], *orders: list[Any]) -> None:
            line = json.dumps({"steps": orders, "offline": False, "size": size})
            program = str(ROOT / "guidewire/viewer/tests/browser.mjs")
            done = subprocess.run(["node", program, str(modules.parent), browser],
                                  input=line, capture_output=True, text=True, check=True)
            if troubles := json.loads(done.stdout)["troubles"]:
                sys.exit(f"page_pictures: {troubles}")

        def picture(name: str) -> list[Any]:
            return ["picture", str(folder / f"{name}.png")]

        begin = [["see", "document.documentElement.dataset.theme = 'dark'; document.getElementById('theme').click();"
                         " document.getElementById('theme').click()"]]
        shown = "document.querySelectorAll('#start .scenes button').length > 5"
        gallery = [["open", address], ["until", shown], *begin]
        mission = [["open", f"{address}?scene=left-arm"], ["until", SHOWN], *begin, QUIET, REST]
        take(FILM, *gallery, picture("gallery"), *mission, picture("first"), ["click", "skip"], ["down", "w"],
             *(order for k, at in enumerate(STEPS)
               for order in (["until", f"{TIME} > {at} || {REPORT}"], picture(f"film-{k:02}"))),
             ["until", REPORT], ["up", "w"], REST, picture("report"))
        take((1280, 800), *mission, ["click", "skip"], ["down", "w"], ["until", f"{TIME} > 4.2"], ["up", "w"],
             ["press", " "], REST, picture("page-live"), ["press", " "], ["down", "w"], ["until", REPORT], ["up", "w"],
             REST, picture("page-report"))
        take((1280, 800), *gallery, REST, picture("page-missions"))
        take((390, 844), *mission, picture("page-phone"))
        for name, width in WIDTHS.items():
            with Image.open(folder / f"{name}.png") as one:
                size = width, round(width * one.height / one.width)
                small = one.convert("RGB").resize(size, Image.Resampling.LANCZOS)
            packed = small.quantize(palette=palette_of(small, 256), dither=Image.Dither.NONE)
            packed.save(out / f"{name}.png", optimize=True)
        write_film(folder, out / "page.gif")


def palette_of(sample: Image.Image, count: int) -> Image.Image:
    """A palette of a picture: half of it the colours that are as far apart as can be, half those that fill it most."""
    half = count // 2
    palette = Image.new("P", (1, 1))
    palette.putpalette([level for method in (Image.Quantize.MAXCOVERAGE, Image.Quantize.MEDIANCUT)
                        for level in sample.quantize(half, method, dither=Image.Dither.NONE).getpalette()[:3 * half]])
    return palette


def write_film(folder: Path, file: Path) -> None:
    """The pictures one after the other, by one palette: the first and the last stand."""
    names = ["gallery", "first", *(f"film-{k:02}" for k in range(len(STEPS))), "report"]
    stands = {"gallery": 1500, "first": 1500, "report": 3000}
    frames = []
    for name in names:
        with Image.open(folder / f"{name}.png") as one:
            frames.append(one.convert("RGB").resize((640, 400), Image.Resampling.LANCZOS))
    sample = Image.new("RGB", (640, 1600))
    for k, at in enumerate((0, 1, len(frames) // 2, -1)):
        sample.paste(frames[at], (0, 400 * k))
    palette = palette_of(sample, 112)
    packed = [one.quantize(palette=palette, dither=Image.Dither.NONE) for one in frames]
    packed[0].save(file, save_all=True, append_images=packed[1:], loop=0, optimize=True,
                   duration=[stands.get(name, 400) for name in names])


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))

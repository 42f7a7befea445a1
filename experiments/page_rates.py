"""Pictures a second of the live page in a headless browser, X-ray and 3D together and each alone, and the time from a
key to the picture that shows what it did: insertion scenes of 60 elements, in the aorta's mesh made four times as fine.

    python3 guidewire.py python experiments/page_rates.py
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from guidewire.anatomy.sampling import cut_edges
from guidewire.anatomy.lumens import write_obj
from guidewire.anatomy.mesh import Edges, Mesh
from guidewire.logs.surfaces import read_obj
from guidewire.prepare import ROOT
from guidewire.viewer import parts

SCENES = ("insertion", "insertion-accurate")
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
SECONDS = 10
_DIGITS = 9  # of the mesh's coordinates
VIEWS = {"both": "X-ray and 3D", "xray": "X-ray", "space": "3D"}


def main() -> None:
    parts.require("dependencies", print)
    modules = parts.require("devDependencies", print)
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    node = shutil.which("node")
    if browser is None or node is None:
        sys.exit("page_rates: needs a browser and node: as root 'apt-get install chromium nodejs'")
    mesh = read_obj(ROOT / "params" / "meshes" / "arch.obj")
    mesh = Mesh(mesh.vertices, mesh.triangles)
    edges = Edges.of(mesh)
    mesh = cut_edges(mesh, edges, np.ones(len(edges.ends), bool))
    with tempfile.TemporaryDirectory() as folder:
        write_obj(Path(folder) / "arch.obj", mesh.vertices, mesh.triangles, _DIGITS)
        for name in SCENES:
            scene = json.loads((ROOT / "params" / f"{name}.json").read_text(encoding="utf-8"))
            scene |= {"numberRodElements": 60, "vessel": scene["vessel"] | {"file": "arch.obj"}}
            (Path(folder) / f"{name}.json").write_text(json.dumps(scene), encoding="utf-8")
            command = [node, str(ROOT / "experiments" / "page_rates.mjs"), str(modules.parent), browser]
            for views, shown in VIEWS.items():
                seen = measure(Path(folder) / f"{name}.json", command, views)
                print(f"{name} (60 elements, {len(mesh.triangles)} triangles), {shown}: {seen['rate']:.0f} pictures a"
                      f" second, each {seen['cost']:.0f} ms of processor time; from a key to its picture "
                      f"{seen['median']:.0f} ms (median of {seen['keys']}), at most {seen['worst']:.0f}", flush=True)


def measure(scene: Path, command: list[str], views: str) -> dict[str, float]:
    """What the browser saw of a live scene in one view or both."""
    server = subprocess.Popen([sys.executable, str(ROOT / "guidewire.py"), "view", str(scene)], text=True,
                              stdout=subprocess.PIPE, env={**os.environ, "PYTHONUNBUFFERED": "1"})
    try:
        address = server.stdout.readline().split()[1]
        return json.loads(subprocess.run([*command, address, str(SECONDS), views], check=True, capture_output=True,
                                         text=True).stdout)
    finally:
        server.send_signal(signal.SIGINT)
        server.wait()
        server.stdout.close()


if __name__ == "__main__":
    main()

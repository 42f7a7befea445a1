"""`guidewire.py site`: the page with the simulation in it, as files for any web server.

    index.html, boot.js, style.css, page.json.gz    the page; its modules are packed
    show.json, pictures/                            scenes, and what the page shares with guidewire/viewer/live.py
    worker.js, rims.js, run.js, channels.js    what steps a scene in the browser
    framework/                                      the core for browsers, packed but for three modules
    texts.json.gz, files/                           parameter files, tables, instruments; meshes
    LICENSE, THIRD-PARTY-NOTICES.md                 of the program, and of what is in the folder beside it

Packed files are unpacked by the page, so no server has to compress.
"""

from __future__ import annotations

import json
import math
import os
import shutil
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, ImageDraw, ImageFilter

from guidewire.prepare import ROOT, PreparationError
from guidewire.runs import building, checking
from guidewire.runs.key_table import read_key_table
from guidewire.sessions.session import Session, SessionError, session_of
from guidewire.viewer.cases import MISSIONS, SCENES, Mission, mission_of, title_of
from guidewire.viewer.export import modules_of, pack, page_of_packed
from guidewire.viewer.live import rules
from guidewire.viewer.parts import PAGE, three
from guidewire.viewer.server import page_files

_WORKER = ("worker.js", "rims.js", "run.js", "channels.js")
_PLAIN = (".js",)    # of the framework: a browser loads modules as they are
_SHOW = "show.json"
_NOTICES = ("LICENSE", "THIRD-PARTY-NOTICES.md")
_TEXTS = (".json", ".csv")
_PIXELS = 320
_PLACED = ("vessel", "sheath", "guidewireOffset", "contactDistance", "patientAxes", "patientOrigin")    # of a vessel
_GROUND, _TISSUE, _METAL, _GOAL = (10, 14, 19), (196, 62, 52), (255, 226, 160), (62, 230, 160)
_TURNS = (0.0, 30.0, -30.0, 60.0, -60.0, 90.0)    # of the C-arm, degrees
_BACKGROUND = 0.75    # of a picture, as of Session.picture
_MOMENTS = 80    # of a course
_SHAPE = 16    # points of a wire in it, as of report.js
_SEEN = 0.8    # part of its file's drive after which a scene is pictured
_POLICY = ("default-src 'self'; script-src 'self' blob: 'wasm-unsafe-eval'; img-src 'self' data:; object-src 'none'; "
           "base-uri 'none'")
_BOOT = (f'<meta http-equiv="Content-Security-Policy" content="{_POLICY}">\n'
         '<script type="module" src="./boot.js"></script>')


@dataclass(frozen=True)
class _Scene:
    """A scene of the site.

    Attributes
    ----------
    file : its name there.
    files : what it needs, by their names there, itself among them.
    picture : of the vessel and the instruments.
    mission : what there is to achieve; None: nothing.
    ghost : course of its own drive to the target; None without a mission.
    """

    file: str
    title: str
    sentence: str
    files: dict[str, Path]
    picture: Image.Image
    mission: Mission | None
    ghost: dict[str, list[Any]] | None


def write_site(out: Path, scenes: Sequence[Path], is_compiled_ahead: bool, build_runner: Callable[[], list[str]]
               ) -> int:
    """Write the folder; nothing is left of a part of it.

    Raises
    ------
    PreparationError : with one line, where a scene cannot be used or the folder is another one's.
    """
    if out.exists() and not (out / _SHOW).is_file() and (not out.is_dir() or any(out.iterdir())):
        raise PreparationError(f"{out}: is there already and no site: give another folder")
    checking.check_out(out.parent)
    keys = read_key_table(build_runner())
    shipped = [ROOT / name for name in (*MISSIONS, *(f"params/{name}.json" for name in SCENES))]
    found = [_read(file) for file in scenes or shipped]
    framework = building.build_browser(is_compiled_ahead, _say)
    partial = out.with_name(out.name + ".partial")
    shutil.rmtree(partial, ignore_errors=True)
    try:
        choices = {name: list(key.words) for name, key in keys.items() if key.words}
        _write(partial, found, choices, framework)
        shutil.rmtree(out, ignore_errors=True)
        os.replace(partial, out)
    finally:
        shutil.rmtree(partial, ignore_errors=True)
    meshes = sum(file.stat().st_size for file in (out / "files").rglob("*.gz"))
    whole = sum(file.stat().st_size for file in out.rglob("*") if file.is_file())
    print(f"site: {os.path.relpath(out)} ({len(found)} scenes; {(whole - meshes) / 1e6:.1f} MB, "
          f"and meshes of {meshes / 1e6:.1f} MB)\n"
          f"try it: python3 -m http.server --directory {os.path.relpath(out)}")
    return 0


def _write(folder: Path, scenes: Sequence[_Scene], choices: dict[str, list[str]], framework: Path) -> None:
    for name in ("framework", "pictures", "files"):
        (folder / name).mkdir(parents=True)
    (folder / "index.html").write_text(page_of_packed(_BOOT), encoding="utf-8")
    (folder / "page.json.gz").write_bytes(modules_of(page_files(three(_say))))
    for name in ("boot.js", "style.css", *_WORKER):
        shutil.copyfile(PAGE / name, folder / name)
    for name in _NOTICES:
        shutil.copyfile(ROOT / name, folder / name)
    for file in framework.iterdir():
        _put(folder / "framework" / file.name, file, file.suffix in _PLAIN)
    texts = {f"instruments/{file.name}": file for file in sorted((ROOT / "instruments").glob("*.json"))}
    listed = []
    for scene in scenes:
        picture = f"pictures/{Path(scene.file).stem}.png"
        scene.picture.save(folder / picture)
        meshes = [name for name in scene.files if not name.endswith(_TEXTS)]
        listed.append({"file": scene.file, "title": scene.title, "sentence": scene.sentence, "picture": picture,
                       "meshes": meshes,
                       **({"mission": {**asdict(scene.mission), "ghost": scene.ghost}} if scene.mission else {})})
        texts |= {name: file for name, file in scene.files.items() if name.endswith(_TEXTS)}
        for name in meshes:
            (folder / "files" / name).parent.mkdir(parents=True, exist_ok=True)
            _put(folder / "files" / name, scene.files[name], False)
    block = json.dumps({name: file.read_text(encoding="utf-8") for name, file in texts.items()}).encode()
    (folder / "texts.json.gz").write_bytes(pack(block))
    wire = json.loads((ROOT / "params" / "sheath.json").read_text(encoding="utf-8"))
    own = {key: value for key, value in wire.items() if key not in _PLACED}    # the wire of a mesh that is dropped
    show = {"isLive": True, "recordings": 0, "site": {
        "rules": {**rules(choices), "titles": {scene.file: scene.title for scene in scenes}}, "scenes": listed,
        "wire": own}}
    (folder / _SHOW).write_text(json.dumps(show), encoding="utf-8")


def _put(place: Path, file: Path, is_plain: bool) -> None:
    if is_plain:
        shutil.copyfile(file, place)
    else:
        place.with_name(place.name + ".gz").write_bytes(pack(file.read_bytes()))


def _read(file: Path) -> _Scene:
    """Return a scene with what it names, pictured on the way of its own drive."""
    checking.check_file(file)
    try:
        with session_of(file, native=False) as session:
            steps = int(session.parameters["maxSimulationSteps"])
            session.step(steps=max(1, int(_SEEN * steps)))
            picture = _picture(session)
            named = [file, *_named(session.parameters)]
            ghost = _course(session, steps) if mission_of(file) else None
    except SessionError as error:
        raise PreparationError(str(error)) from error
    files = {}
    mission = mission_of(file)
    is_shipped = mission is not None or (ROOT / "params") in file.resolve().parents
    base, above = (ROOT, "") if is_shipped else (file.resolve().parent, "params/")
    own = (file.parent / "instruments").glob("*.json")
    for one in (*named, *own):
        name = os.path.relpath(one, base)
        if name.startswith(".."):
            raise PreparationError(f"{file}: names {name}: a site takes files of the scene's own folder and below")
        files[above + Path(name).as_posix()] = Path(one)
    _, sentence = SCENES.get(file.stem, ("", ""))
    return _Scene(next(iter(files)), title_of(file), sentence, files, picture, mission, ghost)


def _course(session: Session, steps: int) -> dict[str, list[Any]]:
    """Return the course of a scene's own drive, as report.js has it: s, mm of the way to the target, N at a wall, and
    points of the wire."""
    millimetres = 1e3 * session.parameters.get("metresPerUnit", 1e-3)
    course: dict[str, list[Any]] = {"time": [], "way": [], "force": [], "wire": []}
    state = session.reset()
    first = state.place.left
    while True:
        forces = [state.contact_forces, *(one.contact_forces for one in state.catheters)]
        largest = max(float(np.linalg.norm(one, axis=1).max()) for one in forces)
        left = 0.0 if state.place.is_at_target else state.place.left
        course["time"].append(float(f"{state.time:.4g}"))
        course["way"].append(round(millimetres * (first - left), 1) + 0.0)
        course["force"].append(float(f"{largest:.4g}"))
        last = len(state.positions) - 1
        shown = last if state.hub is None else min(state.hub.spheres_in_body or last, last)
        shape = state.positions[np.linspace(last - shown, last, _SHAPE).round().astype(int)]
        course["wire"].append([round(float(value), 1) for value in shape.ravel()])
        if state.place.is_at_target or state.outcome:
            return course
        state = session.step(steps=max(1, steps // _MOMENTS))


def _picture(session: Session) -> Image.Image:
    """The vessel as tissue, the instruments as metal, wider than they are, and the target as a ring."""
    described = session.describe()
    target = described.get("target")
    view: dict[str, Any] = {"pixels": 2 * _PIXELS}
    if target:    # the second half of the way to it, from where that is seen at its widest
        places = np.array(target["points"])
        places = places[len(places) // 2:]
        low, high = places.min(axis=0), places.max(axis=0)
        unit = 1e3 * session.parameters.get("metresPerUnit", 1e-3)
        axes = described.get("patient") or {"left": [0.0, 1.0, 0.0], "chest": [1.0, 0.0, 0.0], "head": [0.0, 0.0, 1.0]}
        left, chest = np.array(axes["left"]), np.array(axes["chest"])
        turns = {lao: math.cos(math.radians(lao)) * left - math.sin(math.radians(lao)) * chest for lao in _TURNS}
        lao, right = max(turns.items(), key=lambda turn: np.ptp(places @ turn[1]))
        view |= {"centre": (0.5 * (low + high)).tolist(), "lao": lao,
                 "field_of_view": float(1.7 * unit * np.max(high - low))}
    shade = session.picture(**view, vessel="contrast", attenuation=0.0) / (255.0 * _BACKGROUND)
    metal = Image.fromarray(session.picture(**view, vessel="none", attenuation=20.0)).filter(ImageFilter.MinFilter(5))
    tissue = 1.0 - np.clip(shade, 0.0, 1.0) ** 1.5
    wire = 1.0 - np.clip(np.asarray(metal) / (255.0 * _BACKGROUND), 0.0, 1.0)
    rgb = np.full((*tissue.shape, 3), _GROUND, dtype=float)
    for part, colour in ((tissue, _TISSUE), (wire, _METAL)):
        rgb += part[..., None] * (np.array(colour) - rgb)
    picture = Image.fromarray(rgb.round().astype(np.uint8))
    if target:
        away = (places[-1] - view["centre"]) * unit * 2 * _PIXELS / view["field_of_view"]
        x, y = _PIXELS + np.dot(away, right), _PIXELS - np.dot(away, axes["head"])
        ImageDraw.Draw(picture).ellipse((x - 20, y - 20, x + 20, y + 20), outline=_GOAL, width=6)
    return picture.resize((_PIXELS, _PIXELS), Image.Resampling.LANCZOS)


def _named(value: Any) -> Iterator[Path]:
    """The files among the texts of effective values: there each has the path at which it was found."""
    if isinstance(value, str):
        if value.endswith((".csv", ".json", ".obj", ".stl", ".ply")) and Path(value).is_file():
            yield Path(value)
    elif isinstance(value, (dict, list)):
        for one in value.values() if isinstance(value, dict) else value:
            yield from _named(one)


def _say(line: str) -> None:
    print(f"guidewire: {line}", file=sys.stderr, flush=True)

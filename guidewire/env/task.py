"""Definition of a task: scenes, targets, and the ranges from which episodes are drawn by seed."""

from __future__ import annotations

import difflib
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property, lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.env.instruments import of_each
from guidewire.env.randomisation import Draw, bounds_of, check_distribution
from guidewire.env.spaces import Error, NameNotFound
from guidewire.env.vessels import made_vessel
from guidewire.json_text import problem_of, without_notes
from guidewire.prepare import DOOR, ROOT

FOLDER = Path(__file__).resolve().parent / "data"
TASKS_FILE = FOLDER / "tasks.json"
_WIRE = {"wireRadius", "youngsModulus", "shearModulus", "density", "wireSections"}  # what an instrument stands for
_STEP = 0.14  # s, of a drive as it comes: time steps are to be a fraction of it
_KEYS = {"summary", "scene", "overrides", "anatomies", "targets", "instruments", "frictions", "tipTurns",
         "insertion", "time", "tolerance", "hold", "speed", "rotation", "follow", "random", "baseline", "tier"}
# Of what `random` draws, what is no parameter of the scene by itself.
_DRAWN = ("friction", "tip_turn", "insertion", "noise", "stiffness", "seed", "type", "warp", "entry")
# What a task, its `random` or an option may say.
LIMITS = {"friction": (0.0, 10.0), "tip_turn": (-100.0, 100.0), "insertion": (0.0, 10.0), "noise": (0.0, 10.0),
          "stiffness": (1e-3, 1e3)}
_BY_LISTS = ("anatomy", "target", "instrument", "nominal", "snapshot")  # options that no distribution draws
_EACH = ("insertion", "speed", "rotation")  # number, or a list of one for each hub
BASELINES = ("", "retry", "follow", "lead")
_FILES = ("file", "anatomy", "centreline", "rigid")  # of a vessel and its motion
_STIFF = ("youngsModulus", "shearModulus")


@dataclass(frozen=True)
class Task:
    """A task. Lengths are units of the scene, mm in those that ship.

    Attributes
    ----------
    name, summary : as listed.
    scene : parameter file; "" where each anatomy has its own.
    overrides : keys that override the scene's.
    anatomies : of each vessel an episode may have: path of its anatomy.json beside which, with no `scene`, is its
        scene.json; "from", such a path, and "warp", the seed of nine numbers by which its shape is another; or "make",
        "type", "seed", "inlet" and "target" of one that is generated when it is first needed. In a file, "warps" and
        "seeds" for several of a kind.
    targets : ends by name or number, or branches with the distance from their beginning; an episode has one.
    instruments : names of a wire that an episode may have, or lists of them, the wire first, then the catheters; none:
        the scene's own.
    frictions : coefficients that an episode may have.
    tip_turns : number of even steps of a turn in which the tip may be turned at the start; 1: as in the scene.
    insertion : of each hub, or of all, at the start of an episode, m.
    time : simulated time after which an episode is truncated, s.
    tolerance : distance along the centreline at which the target is reached, units.
    hold : for how long the tip is to stay there, s; 0: it may pass.
    speed, rotation : fastest of each hub, or of all, m/s and rad/s.
    follow : within what distance before the target along the centreline the tip of each catheter is to come, or of all,
        units; None: it need not.
    tier : "dev", "train" or "test": of the benchmark's held-out vessels none but those of "train" may be trained on.
    baseline : policy that comes with it: "retry", "follow" or "lead"; "": retry, with catheters follow.
    random : distributions by name, drawn for each episode (`randomisation`): "friction", "tip_turn" (rad), "insertion"
        (m) in place of the lists above; "noise" of the drive; "stiffness", a factor on the moduli of a wire without a
        name; "seed" and "type" of a vessel that is generated; "warp" and "entry" of any (`reshaped`); or any parameter
        of the scene by its path, such as "scale", "rotation", "vessel.radius", "catheters[0].frictionCoefficient".
    """

    name: str
    summary: str = ""
    scene: str = ""
    overrides: Mapping[str, Any] = field(default_factory=dict)
    anatomies: Sequence[Any] = ()
    targets: Sequence[Any] = ()
    instruments: Sequence[str] = ()
    frictions: Sequence[float] = (0.0,)
    tip_turns: int = 1
    insertion: float | Sequence[float] = 0.0
    time: float = 20.0
    tolerance: float = 3.0
    hold: float = 0.0
    speed: float | Sequence[float] = 0.02
    rotation: float | Sequence[float] = 3.141592653589793
    follow: float | Sequence[float | None] | None = None
    random: Mapping[str, Any] = field(default_factory=dict)
    baseline: str = ""
    tier: str = "dev"

    @cached_property
    def hubs(self) -> int:
        """How many instruments it has."""
        given = self.overrides.get("catheters")
        if given is None:
            which = self.anatomies[0]
            which = which.get("from") if isinstance(which, Mapping) else which
            file = self.scene or (which and Path(which).with_name("scene.json"))
            given = _scene(Path(file)).get("catheters") if file else None
        return 1 + len(given or ())

    def scene_of(self, draw: Draw) -> tuple[dict[str, Any], Mapping[str, Any]]:
        """Parameters of an episode's scene, with absolute paths, and its anatomy.

        Raises
        ------
        Error : a file is missing, or is no JSON; the scene cannot have what was drawn.
        """
        which = self.anatomies[draw.anatomy]
        which = which["from"] if isinstance(which, Mapping) and "from" in which else which
        made = {key: draw.random[key] for key in ("seed", "type") if key in draw.random}
        if made and not isinstance(which, Mapping):
            raise Error(f"random \"{next(iter(made))}\" is not allowed: {which} is a file, not a vessel that is "
                        "generated")
        which = {**which, **made} if made else which
        folder = made_vessel(which) if isinstance(which, Mapping) else None
        file = folder / "anatomy.json" if folder else Path(which)
        scene_file = Path(self.scene) if self.scene else file.with_name("scene.json")
        scene = {**_scene(scene_file), **self.overrides}
        if not isinstance(scene.get("vessel"), Mapping):
            raise Error(f"{scene_file}: vessel = {json.dumps(scene.get('vessel'))} is not allowed: a task needs an "
                        "object")
        scene["vessel"] = {**_whole(scene["vessel"], scene_file.parent), "frictionCoefficient": draw.friction}
        scene.pop("driveFile", None)    # the drives of a file are not those of an episode
        if scene.get("catheters"):
            scene["catheters"] = [{key: value for key, value in one.items() if key != "driveFile"}
                                  for one in scene["catheters"]]
        names = [draw.instrument] if draw.instrument is None or isinstance(draw.instrument, str) else draw.instrument
        if len(names) > self.hubs:
            raise Error(f"instruments {list(names)} are not allowed: the scene has {self.hubs}")
        if names[0] is not None:
            scene = {key: value for key, value in scene.items() if key not in _WIRE} | {"instrument": names[0]}
        if names[1:]:
            scene["catheters"] = [{**{key: value for key, value in one.items() if key not in _WIRE},
                                   "instrument": name} for one, name in zip(scene["catheters"], names[1:])]
        if "stiffness" in draw.random:
            scene = _stiffer(scene, draw.random["stiffness"])
        drawn = {key: value for key, value in draw.random.items() if key not in _DRAWN}
        if isinstance(drawn.get("scale"), (int, float)):
            drawn["scale"] = [drawn["scale"]] * 3
        anatomy = _read(file)
        if not isinstance(anatomy, Mapping) or not {"metresPerUnit", "ends", "centreline"} <= set(anatomy):
            raise Error(f"{file}: no anatomy: '{DOOR} anatomy FILE' writes one")
        return scene | drawn, anatomy

    @cached_property
    def by_way(self) -> list[int]:
        """Return the numbers of the targets, the one with the shortest way from the inlet first, in the first
        vessel."""
        from guidewire.env.route import Route

        first = Draw(0, 0, self.instruments[0] if self.instruments else None, 0.0, 0.0, self.insertion)
        which = self.anatomies[0]
        if isinstance(which, Mapping) and "from" not in which:    # with a seed of its own in each episode
            return list(range(len(self.targets)))
        scene, anatomy = self.scene_of(first)
        inlet = next((end["point"] for end in anatomy["ends"] if str(scene.get("inlet", "")).lower() in (
            str(end["number"]), end["name"].lower())), 0)
        ways = [float(Route(anatomy, target).left[inlet]) for target in self.targets]
        return sorted(range(len(ways)), key=ways.__getitem__)

    def shape_of(self, draw: Draw) -> dict[str, Any]:
        """Return "warp" and "entry" of an episode, as of `reshaped`."""
        shape = {name: draw.random[name] for name in ("warp", "entry") if name in draw.random}
        which = self.anatomies[draw.anatomy]
        if isinstance(which, Mapping) and "warp" in which:
            own = np.random.default_rng(which["warp"]).uniform(-1.0, 1.0, 9)
            shape["warp"] = np.clip(own + shape.get("warp", 0.0), -1.0, 1.0).tolist()
        return shape


@cache
def _shipped() -> Mapping[str, Task]:
    return {name: _task(name, entry, TASKS_FILE) for name, entry in _read(TASKS_FILE).items()}


def all_tasks(tier: str | None = "dev") -> Mapping[str, Task]:
    """Return the tasks that ship, by name: of a tier, "dev", "train" or "test", or None for all."""
    return {name: task for name, task in _shipped().items() if tier in (None, task.tier)}


def find_task(task: str | Path | Task) -> Task:
    """A task by name, or that of a scene.json which `guidewire.py anatomy` has written, or a JSON file of a task.

    Raises
    ------
    NameNotFound : there is no such task.
    Error : a file cannot be used; one line says why.
    """
    if isinstance(task, Task):
        return task
    known = all_tasks(None)
    if str(task) in known:
        return known[str(task)]
    path = Path(task)
    if path.suffix != ".json":
        near = difflib.get_close_matches(str(task), known, 1)
        hint = f"did you mean '{near[0]}'?" if near else f"there are {', '.join(known)}, or a JSON file"
        raise NameNotFound(f"there is no task '{task}': {hint}")
    path = path.resolve()
    entry = _read(path)
    if not isinstance(entry, dict):
        raise Error(f"{path}: a task is one JSON object")
    if "vessel" not in entry:
        return _task(path.stem, entry, path)
    if not isinstance(entry["vessel"], dict) or not isinstance(entry["vessel"].get("anatomy"), str) or (
            "target" not in entry):
        raise Error(f"{path}: a task needs vessel.anatomy and target: '{DOOR} anatomy FILE' writes such a scene")
    time_step, steps = (_number(entry, key, 1e-9, 1e9, path) for key in ("timeStep", "maxSimulationSteps"))
    return Task(path.stem, f"{path.name} to end {entry['target']}", str(path),
                overrides={"timeStep": _dividing(time_step)},
                anatomies=(str(path.parent / entry["vessel"]["anatomy"]),), targets=(entry["target"],),
                frictions=(float(_number({"frictionCoefficient": 0.0, **entry["vessel"]}, "frictionCoefficient",
                                         *LIMITS["friction"], path)),),
                time=2.0 * steps * time_step + 10.0)


def _dividing(time_step: float) -> float:
    """The time step that divides an action's duration and is nearest to a scene's."""
    parts = max(1, round(_STEP / time_step))
    return time_step if abs(parts * time_step - _STEP) < 1e-9 * _STEP else _STEP / parts


def _task(name: str, entry: Mapping[str, Any], file: Path) -> Task:
    unknown = set(entry) - _KEYS
    if unknown:
        raise Error(f"{file}: task {name} has no key \"{sorted(unknown)[0]}\": there are {', '.join(sorted(_KEYS))}")
    if not isinstance(entry.get("overrides", {}), dict) or not all(
            isinstance(entry.get(key, ""), str) for key in ("scene", "summary")):
        raise Error(f"{file}: task {name}: overrides is an object, scene and summary are texts")
    catheters = entry.get("overrides", {}).get("catheters") or []
    if not isinstance(catheters, list) or not all(isinstance(one, dict) for one in catheters):
        raise Error(f"{file}: task {name}: overrides: catheters = {json.dumps(catheters)} is not allowed: needs a list "
                    "of objects")
    turns = entry.get("tipTurns", 1)
    for key, is_allowed, needs in (
            ("tier", entry.get("tier", "dev") in ("dev", "train", "test"), "dev, train or test"),
            ("baseline", entry.get("baseline", "") in BASELINES, f"one of {', '.join(filter(None, BASELINES))}"),
            ("random", isinstance(entry.get("random", {}), dict), "an object"),
            ("tipTurns", type(turns) is int and 1 <= turns <= 10**9, "a whole number from 1"),
            ("frictions", entry.get("frictions") != [], "numbers, or leave it out"),
            *((key, isinstance(entry.get(key, []), list), "a list")
              for key in ("anatomies", "targets", "instruments", "frictions"))):
        if not is_allowed:
            raise Error(f"{file}: task {name}: {key} = {json.dumps(entry[key])} is not allowed: needs {needs}")
    for key, distribution in entry.get("random", {}).items():
        try:
            if key in _BY_LISTS:
                raise Error(f"random \"{key}\" is not allowed: the task's lists say what is drawn")
            check_distribution(key, distribution)
            least, most = LIMITS.get(key, (-math.inf, math.inf))
            low, high = bounds_of(distribution)
            if key in LIMITS and not least <= low <= high <= most:
                raise Error(f"random \"{key}\" = {json.dumps(distribution)} is not allowed: needs numbers from "
                            f"{least:g} to {most:g}")
        except Error as error:
            raise Error(f"{file}: task {name}: {error}") from error
    for key, least, most in (("time", 1e-6, 1e9), ("tolerance", 1e-9, 1e9), ("hold", 0.0, 1e9), ("speed", 1e-9, 1e9),
                             ("rotation", 1e-9, 1e9), ("insertion", *LIMITS["insertion"])):
        given = [entry[key]] if key in entry else []
        for one in given[0] if given and key in _EACH and isinstance(given[0], list) else given:
            _number({key: one}, key, least, most, file)
    for one in entry.get("instruments", []):
        check_instruments(f"{file}: task {name}: instruments:", one)
    for one in entry.get("frictions", []):
        _number({"frictions": one}, "frictions", *LIMITS["friction"], file)
    for one in of_each(entry.get("follow"), 1):
        if one is not None:
            _number({"follow": one}, "follow", 0.0, 1e9, file)
    given = {{"tipTurns": "tip_turns"}.get(key, key): value for key, value in entry.items()}
    if "anatomies" in given:
        given["anatomies"] = [each for one in given["anatomies"] for each in _vessels(one, name, file)]
    if given.get("scene"):
        given["scene"] = _beside(file, given["scene"])
        if "timeStep" not in entry.get("overrides", {}) and Path(given["scene"]).is_file():
            scene = _scene(Path(given["scene"]))
            if "timeStep" in scene:
                step = _number(scene, "timeStep", 1e-9, 1e9, Path(given["scene"]))
                given["overrides"] = {**entry.get("overrides", {}), "timeStep": _dividing(step)}
    task = Task(name, **given)
    if not task.anatomies or not task.targets:
        raise Error(f"{file}: task {name} needs anatomies and targets")
    for key in (*_EACH, "follow"):
        value, count = getattr(task, key), task.hubs - (key == "follow")
        if isinstance(value, list) and len(value) != count:
            raise Error(f"{file}: task {name}: {key} = {json.dumps(value)} is not allowed: needs a number, or {count}")
    return task


def check_instruments(label: str, names: Any) -> None:
    """Raises Error where they are no name, or list of names, with None for what the scene has."""
    listed = names if isinstance(names, (list, tuple)) else [names]
    if not listed or not all(one is None or isinstance(one, str) and one for one in listed):
        raise Error(f"{label} {json.dumps(names, default=str)} is not allowed: needs a name, or a list of names")


def _stiffer(scene: Mapping[str, Any], factor: float) -> dict[str, Any]:
    """The wire of other moduli."""
    if "instrument" in scene or "youngsModulus" not in scene:
        raise Error("random \"stiffness\" is not allowed: it needs a wire whose scene states youngsModulus")

    def scaled(table: Mapping[str, Any]) -> dict[str, Any]:
        return {**table, **{key: factor * table[key] for key in _STIFF if key in table}}

    sections = [scaled(one) for one in scene.get("wireSections") or ()]
    return {**scaled(scene), **({"wireSections": sections} if sections else {})}


def _vessels(anatomy: Any, task: str, file: Path) -> list[Any]:
    """One vessel, or one for each of the "seeds" of a kind that is generated."""
    if isinstance(anatomy, str):
        return [_beside(file, anatomy)]
    if not isinstance(anatomy, dict):
        raise Error(f"{file}: task {task}: anatomies has {json.dumps(anatomy)}: needs files, or vessels to be made")
    seeds = anatomy.get("seeds", [anatomy.get("seed")])
    if "from" in anatomy:
        warps = anatomy.get("warps", [anatomy.get("warp")])
        is_list = isinstance(warps, list) and warps and all(type(seed) is int and seed >= 0 for seed in warps)
        if not is_list or not isinstance(anatomy["from"], str) or not set(anatomy) <= {"from", "warp", "warps"}:
            raise Error(f"{file}: task {task}: anatomies has {json.dumps(anatomy)}: a vessel of another shape needs "
                        "from, a file, and warp or warps, whole numbers from 0")
        return [{"from": _beside(file, anatomy["from"]), "warp": seed} for seed in warps]
    is_list = isinstance(seeds, list) and seeds and all(type(seed) is int and seed >= 0 for seed in seeds)
    if not is_list or "seeds" in anatomy and "seed" in anatomy or not {"make", "inlet", "target"} <= set(anatomy):
        raise Error(f"{file}: task {task}: anatomies has {json.dumps(anatomy)}: a generated vessel needs make, inlet, "
                    "target, and seed or a list of seeds, whole numbers from 0")
    kind = {key: value for key, value in anatomy.items() if key != "seeds"}
    return [{**kind, "seed": seed} for seed in seeds]


def _beside(file: Path, name: str) -> str:
    """A file that a task names: relative to the task's own file, else one that comes with the program."""
    return str(next((place for place in (file.parent / name, ROOT / name) if place.is_file()), file.parent / name))


def _whole(table: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """A vessel, or its motion, with whole names of its files."""
    return {key: _whole(value, folder) if key in ("motion", "breathing") and isinstance(value, Mapping)
            else str((folder / value).resolve()) if key in _FILES and isinstance(value, str)
            else [str((folder / str(one)).resolve()) for one in value] if key == "frames" and isinstance(value, list)
            else value
            for key, value in table.items()}


def _number(entry: Mapping[str, Any], key: str, least: float, most: float, file: Path) -> float:
    value = entry.get(key)
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not least <= value <= most:
        raise Error(f"{file}: {key} = {json.dumps(value)} is not allowed: needs a number from {least:g} to {most:g}")
    return value


def _scene(file: Path) -> dict[str, Any]:
    scene = _read(file)
    if not isinstance(scene, dict):
        raise Error(f"{file}: a scene is one JSON object")
    return scene


def _read(file: Path) -> Any:
    """What stands in a file, which nobody changes: an episode's reset asks again for the last ones."""
    try:
        status = file.stat()
    except OSError as error:
        raise Error(f"{file}: {error.strerror}") from error
    return _parsed(file, status.st_mtime_ns, status.st_size)


@lru_cache(maxsize=16)
def _parsed(file: Path, _time: int, _size: int) -> Any:
    try:
        text = file.read_text(encoding="utf-8-sig")
        return without_notes(json.loads(text))
    except OSError as error:
        raise Error(f"{file}: {error.strerror}") from error
    except json.JSONDecodeError as error:
        raise Error(f"{file}: no JSON: {problem_of(text, error)}") from error
    except ValueError as error:
        raise Error(f"{file}: no JSON: {error}") from error

"""Random wires with a material pushed into the vessels of `pushes`: by direct, by direct through a sheath ("sheath"),
in one catheter or in two, in two in a sheath ("sheathed"), and by xpbd. Lengths are millimetres, one unit each."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from experiments.campaigns import pushes

METHODS = ("direct", "sheath", "xpbd", "catheter", "catheters", "sheathed")
CATHETERS = {"catheter": 1, "catheters": 2, "sheathed": 2}    # by method
_SHEATHS = ("sheath", "sheathed")
SOFT = 0.9  # of the radius, by which a soft wall gives way at most
_LONG = 400.0  # mm of wire in a sheath
_ELEMENTS_IN_VESSEL = 2.5  # of a sheath's exit from the vessel's closed end


def draw(seed: int, method: str, folder: Path) -> tuple[str, dict[str, Any]]:
    """A random push: the kind of its vessel and its parameters; a mesh is written into the folder.

    The same seed and method give the same scene. Kinds take turns; a sheath needs a vessel with an inlet, so that the
    slope is left out there.
    """
    random = np.random.default_rng([21, METHODS.index(method), seed])
    kinds = [kind for kind in pushes.KINDS if method not in _SHEATHS or kind != "slope"]
    kind = kinds[seed % len(kinds)]
    radius = _between(random, 0.15, 0.6)
    widths = radius * np.cumprod([_between(random, 1.25, 2.0) for _ in range(CATHETERS.get(method, 0))])
    # What the vessel is drawn for: its narrow places let it through.
    ball = float(max([radius, *widths])) * _between(random, 1.02, 6.0)
    spacing = _between(random, 1.5, 8.0) * ball
    count = int(random.integers(6, 40))
    outside = spacing * count
    straight = spacing * (_ELEMENTS_IN_VESSEL + 2.5) if method in _SHEATHS else outside + 4.0 * ball
    vessel = pushes.KINDS[kind](random, ball, straight)
    if kind == "slope":  # no nearer to the tip than the wire is thick
        vessel.wall["point"][2] *= max(1.0, 1.2 * ball / _height(vessel.wall))
    distance = float(np.linalg.norm(np.diff(vessel.centreline, axis=0), axis=1).sum())
    per_step = _between(random, 0.02, 2.0) * radius
    stiffness = _between(random, 3e9, 1e11)
    scene = {
        "solver": "xpbd" if method == "xpbd" else "direct", "drive": "displace", "proximalEnd": "clamped",
        "guidewireLength": outside, "numberRodElements": count, "guidewireOffset": -outside,
        "wireRadius": 1e-3 * radius, "youngsModulus": stiffness, "shearModulus": 0.38 * stiffness,
        "density": _between(random, 1500.0, 13000.0), "massDamping": float(random.choice([0.0, 20.0, 100.0])),
        "timeStep": _between(random, 1e-3, 3e-2) * (0.1 if method == "xpbd" else 1.0), "displacementPerStep": per_step,
        "deltaThreshold": 0.0,
        "maxSimulationSteps": int(np.clip(random.uniform(0.3, 1.2) * distance / per_step, 12, 120)),
        "logFormat": "npz", "logContacts": True, "vessel": dict(vessel.wall),
    }
    if method != "xpbd":
        scene["logHub"] = True
    if random.uniform() < 0.5:
        scene["gravity"] = (9.81 * pushes.direction(random)).tolist()
    if random.uniform() < 0.4:
        scene["twistPerStep"] = random.uniform(-0.3, 0.3)
    if random.uniform() < 0.3 and method not in _SHEATHS:
        scene["obstacles"] = [pushes.obstacle(random, vessel, ball) for _ in range(random.integers(1, 3))]
    if method == "xpbd":
        scene["substeps"] = round(_between(random, 10.0, 100.0))
        scene["constraintSolverSteps"] = int(random.integers(1, 4))
    else:
        if random.uniform() < 0.4:
            scene["hubForceLimit"] = _between(random, 0.2, 5.0)
        if random.uniform() < 0.3:
            scene["materialDamping"] = _between(random, 1e-5, 1e-3)
    if method in _SHEATHS:
        _lead_in(random, scene, spacing, straight)
    else:
        scene["wireSections"] = _tip(random, scene, count)
    if method == "xpbd" and seed // len(kinds) % 2:
        _resolve(random, scene, distance)
    if len(vessel.faces):
        pushes.write_mesh(random, scene, vessel, folder / f"push-{seed}.obj")
    if random.uniform() < 0.5:
        for wall in (scene["vessel"], *scene.get("obstacles", [])):
            wall["frictionCoefficient"] = random.uniform(0.02, 0.4)
    if method in CATHETERS:
        _in_catheters(np.random.default_rng([57, seed]), scene, widths, distance, folder / f"push-{seed}.hub")
    elif seed % 3 == 2 and method != "xpbd":
        _turn_back(np.random.default_rng([67, seed]), scene, folder / f"push-{seed}.csv")
    return kind, scene


def soften(scene: dict[str, Any], seed: int) -> None:
    """Lets every wall of a push give way: wallStiffness from 1e4 to 1e7 Pa, and in half of all with a delay of 0.01 to
    1 s."""
    random = np.random.default_rng([63, seed])
    delay = np.random.default_rng([64, seed])
    for wall in (scene["vessel"], *scene.get("obstacles", [])):
        wall["wallStiffness"] = _between(random, 1e4, 1e7)
        if seed % 2:
            wall["relaxationTime"] = _between(delay, 0.01, 1.0)


def give_way(scene: dict[str, Any], seed: int) -> None:
    """Makes the core of a push's wire nitinol or steel of any strength: it leaves its line at 0.1 to 1.5 % of strain,
    with the hardening of the default or up to a tenth of E."""
    random = np.random.default_rng([80, seed])
    upper = scene["youngsModulus"] * _between(random, 1e-3, 1.5e-2)
    if seed % 2:
        scene["yieldStress"] = upper
    else:
        scene["plateau"] = {"upper": upper, "lower": upper * random.uniform(0.2, 0.95),
                            "strain": _between(random, 5e-3, 8e-2)}
    if random.uniform() < 0.3:
        scene["hardening"] = scene["youngsModulus"] * _between(random, 1e-4, 0.1)


def radii_of(scene: dict[str, Any]) -> np.ndarray:
    """Radius in units of each element, shape (n,): the largest along it. Sections with elements of their own are at the
    tip."""
    length, sections = scene["guidewireLength"], scene["wireSections"]
    own = [section for section in sections if section.get("numberRodElements")]
    parts = [(0.0, min((section["from"] for section in own), default=length), scene["numberRodElements"]),
             *((section["from"], section["to"], section["numberRodElements"]) for section in own)]
    ends = np.concatenate([np.linspace(a, b, n, endpoint=False) for a, b, n in parts] + [[length]])
    wide = [section for section in sections if section.get("wireRadius")]
    cuts = np.unique([*ends, *(section[end] for section in wide for end in ("from", "to"))])
    middles = 0.5 * (cuts[:-1] + cuts[1:])
    pieces = np.full(len(middles), scene["wireRadius"])
    for section in reversed(wide):
        pieces[(section["from"] <= middles) & (middles < section["to"])] = section["wireRadius"]
    return 1e3 * np.maximum.reduceat(pieces, np.searchsorted(cuts, ends[:-1]))


def core_radii_of(scene: dict[str, Any]) -> list[np.ndarray]:
    """Those of the wire and of each catheter, the outermost last, that no wall may come nearer than: of soft walls a
    tenth of the radii."""
    core = 1.0 - SOFT if "wallStiffness" in scene["vessel"] else 1.0
    return [core * radii_of(scene), *(np.full(one["elements"], core * 1e3 * one["wireRadius"])
                                      for one in reversed(scene.get("catheters", [])))]


def _height(plane: dict[str, Any]) -> float:
    """Distance of the origin from a plane, units."""
    return float(-np.array(plane["point"]) @ plane["normal"] / np.linalg.norm(plane["normal"]))


def _between(random, low: float, high: float) -> float:
    """A number whose logarithm is even between the limits."""
    return float(np.exp(random.uniform(np.log(low), np.log(high))))


def _tip(random, scene: dict[str, Any], elements: int) -> list[dict[str, Any]]:
    """Up to two softer, bent or thinner sections at the tip, in at most half of so many elements."""
    pieces = int(random.integers(0, 3))
    if pieces == 0 or elements < 6:
        return []
    length, count = scene["guidewireLength"], scene["numberRodElements"]
    spacing = length / count
    numbers = random.integers(1, elements // 4 + 1, pieces)
    sections, end = [], length
    for k, number in enumerate(numbers[::-1]):
        start = (count - int(numbers[::-1][:k + 1].sum())) * spacing
        section = {"from": start, "to": end, "numberRodElements": int(number),
                   "youngsModulus": scene["youngsModulus"] * _between(random, 0.03, 1.0)}
        section["shearModulus"] = 0.38 * section["youngsModulus"]
        if random.uniform() < 0.6:
            bend = random.uniform(0.0, 0.15) / (1e-3 * spacing)
            section["restCurvature"] = [*(bend * pushes.direction(random)[:2]).tolist(), 0.0]
        if random.uniform() < 0.4:
            section["wireRadius"] = scene["wireRadius"] * random.uniform(0.5, 1.0)
        sections.insert(0, section)
        end = start
    scene["numberRodElements"] = count - int(numbers.sum())
    return sections


def _resolve(random, scene: dict[str, Any], distance: float) -> None:
    """A soft wire, and substeps so short that xpbd converges in most vessels: in one of them a wave along the wire goes
    through a fraction of an element. It is pushed along so much of the vessel (mm) as a thousand steps allow."""
    element = 1e-3 * scene["guidewireLength"] / scene["numberRodElements"]
    softer = _between(random, 3e6, 3e8) / scene["youngsModulus"]
    for part in (scene, *scene["wireSections"]):
        part |= {key: softer * part[key] for key in ("youngsModulus", "shearModulus") if key in part}
    substep = _between(random, 0.05, 0.5) * element * np.sqrt(scene["density"] / scene["youngsModulus"])
    scene |= {"substeps": 50, "timeStep": float(50 * substep), "constraintSolverSteps": int(random.integers(1, 4))}
    per_step = 1e3 * _between(random, 0.3, 3.0) * scene["timeStep"]  # at 0.3 to 3 m/s
    steps = int(np.clip(random.uniform(0.3, 1.2) * distance / per_step, 12, 1000))
    scene |= {"displacementPerStep": per_step, "maxSimulationSteps": steps}


def _turn_back(random, scene: dict[str, Any], file: Path) -> None:
    """The wire is drawn back from half of its steps on, turning the other way."""
    half = scene["maxSimulationSteps"] // 2
    ahead, turn = (half * scene.pop(key, 0.0) for key in ("displacementPerStep", "twistPerStep"))
    middle, end = (steps * scene["timeStep"] for steps in (half, scene["maxSimulationSteps"]))
    file.write_text("time,insertion,rotation\n0,0,0\n"
                    f"{middle!r},{1e-3 * ahead!r},{turn!r}\n{end!r},{1e-3 * ahead * random.uniform(-0.2, 0.8)!r},0\n")
    scene["driveFile"] = str(file)


def _in_catheters(random, scene: dict[str, Any], widths: np.ndarray, distance: float, stem: Path) -> None:
    """Catheters of these radii (mm, the innermost first) around the wire, with bent tips; each hub has a drive of its
    own, along so much of the vessel (mm) as its steps allow. The tips start where the wire's would, or behind; each hub
    starts ahead of the one inside by what that goes farther."""
    scene.pop("materialDamping", None)
    del scene["displacementPerStep"]
    scene["maxSimulationSteps"] = 120
    ahead = min(random.uniform(0.5, 1.3) * distance, 120 * _between(random, 0.5, 4.0) * float(widths[-1]))
    if "sheath" in scene:    # no hub may come to its exit
        ahead = min(ahead, 0.95 * (scene["sheath"]["exit"][2] - scene["guidewireOffset"]))
    turn = scene["maxSimulationSteps"] * scene.pop("twistPerStep", 0.0)
    times = scene["maxSimulationSteps"] * scene["timeStep"] * np.array([0.0, 0.25, 0.5, 0.75, 1.0])
    drives = [[0.0, *(ahead * random.uniform([-0.1, 0.2, 0.4, -0.1], 1.0) * [0.4, 0.7, 1.0, 1.0])]
              for _ in range(1 + len(widths))]
    files = [stem.with_name(f"{stem.name}{k}.csv") for k in range(len(drives))]
    for file, drive in zip(files, drives):
        turns = [0.0, *random.uniform(-1.0, 1.0, 4) * (abs(turn) + np.pi)]
        file.write_text("time,insertion,rotation\n" + "".join(
            f"{at!r},{1e-3 * way!r},{angle!r}\n" for at, way, angle in zip(times.tolist(), drive, map(float, turns))))
    element = scene["guidewireLength"] / (scene["numberRodElements"] + sum(
        section["numberRodElements"] for section in scene["wireSections"]))
    length, start, inside = scene["guidewireLength"], 0.0, 1e3 * scene["wireRadius"]
    catheters = []
    for k, width in enumerate(widths):
        start += float(np.subtract(drives[k], drives[k + 1]).max()) + random.uniform(0.1, 3.0) * element
        count = int(random.integers(8, 30))
        stiffness = _between(random, 2e8, 1e10)
        catheter = {"start": start, "elements": count, "wireRadius": 1e-3 * float(width), "youngsModulus": stiffness,
                    "shearModulus": 0.38 * stiffness, "density": 1500.0, "driveFile": str(files[k + 1]),
                    "lumenRadius": 1e-3 * float(inside + (width - inside) * random.uniform(0.2, 0.7))}
        if random.uniform() < 0.3:
            catheter["hubForceLimit"] = _between(random, 0.2, 5.0)
        if random.uniform() < 0.3:
            catheter["lumenFriction"] = random.uniform(0.02, 0.3)
        catheters.insert(0, catheter)
        inside = width
    # The wire is longer by what the hubs stand ahead, so that the outermost one has the length that was drawn.
    scene |= {"guidewireLength": length + start, "guidewireOffset": scene["guidewireOffset"] - start,
              "driveFile": str(files[0]), "catheters": catheters}
    scene["numberRodElements"] += int(np.ceil(start / element))
    for section in scene["wireSections"]:
        section["from"] += start
        section["to"] += start
    for catheter in catheters:
        behind = random.choice([0.0, random.uniform(0.0, 0.4) * length])
        catheter["length"] = float(length + start - catheter["start"] - behind)
        bend = random.uniform(0.0, 0.1) / (1e-3 * element)
        tip = min(max(3.0 * element, 1.5 * catheter["length"] / catheter["elements"]), 0.5 * catheter["length"])
        catheter["wireSections"] = [{"from": catheter["length"] - tip, "to": catheter["length"],
                                     "restCurvature": [*(bend * pushes.direction(random)[:2]).tolist(), 0.0]}]


def _lead_in(random, scene: dict[str, Any], spacing: float, straight: float) -> None:
    """A long wire of which all but the tip is in a sheath that ends in the vessel's straight piece."""
    outside = random.uniform(0.1, 2.0) * spacing
    exit_at = -straight + _ELEMENTS_IN_VESSEL * spacing
    count = round(_LONG / spacing)
    length = count * spacing
    scene |= {"guidewireLength": length, "numberRodElements": count, "guidewireOffset": exit_at + outside - length,
              "sheath": {"exit": [0.0, 0.0, exit_at]}}
    scene["wireSections"] = _tip(random, scene, min(count, 40))

"""Random wires with a material pushed into the vessels of `pushes`: by direct, by direct through a sheath ("sheath"),
and by xpbd. Lengths are millimetres, one unit each."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from experiments.campaigns import pushes

METHODS = ("direct", "sheath", "xpbd")
SOFT = 0.9  # of the radius, by which a soft wall gives way at most
_LONG = 400.0  # mm of wire in a sheath
_ELEMENTS_IN_VESSEL = 2.5  # of a sheath's exit from the vessel's closed end


def draw(seed: int, method: str, folder: Path) -> tuple[str, dict[str, Any]]:
    """A random push: the kind of its vessel and its parameters; a mesh is written into the folder.

    The same seed and method give the same scene. Kinds take turns; a sheath needs a vessel with an inlet, so that the
    slope is left out there.
    """
    random = np.random.default_rng([21, METHODS.index(method), seed])
    kinds = [kind for kind in pushes.KINDS if method != "sheath" or kind != "slope"]
    kind = kinds[seed % len(kinds)]
    radius = _between(random, 0.15, 0.6)
    ball = radius * _between(random, 1.02, 6.0)  # what the vessel is drawn for: its narrow places let it through
    spacing = _between(random, 1.5, 8.0) * ball
    count = int(random.integers(6, 40))
    outside = spacing * count
    straight = spacing * (_ELEMENTS_IN_VESSEL + 2.5) if method == "sheath" else outside + 4.0 * ball
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
    if random.uniform() < 0.5:
        scene["gravity"] = (9.81 * pushes.direction(random)).tolist()
    if random.uniform() < 0.4:
        scene["twistPerStep"] = random.uniform(-0.3, 0.3)
    if random.uniform() < 0.3 and method != "sheath":
        scene["obstacles"] = [pushes.obstacle(random, vessel, ball) for _ in range(random.integers(1, 3))]
    if method == "xpbd":
        scene["substeps"] = round(_between(random, 10.0, 100.0))
        scene["constraintSolverSteps"] = int(random.integers(1, 4))
    else:
        if random.uniform() < 0.4:
            scene["hubForceLimit"] = _between(random, 0.2, 5.0)
        if random.uniform() < 0.3:
            scene["materialDamping"] = _between(random, 1e-5, 1e-3)
    if method == "sheath":
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
    if seed % 3 == 2 and method != "xpbd":
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


def radii_of(scene: dict[str, Any]) -> np.ndarray:
    """Radius in units of each element, shape (n,). Sections of a draw are at the tip, with elements of their own."""
    radii = [scene["wireRadius"]] * scene["numberRodElements"]
    for section in scene["wireSections"]:
        radii += [section.get("wireRadius", scene["wireRadius"])] * section["numberRodElements"]
    return 1e3 * np.array(radii)


def core_radii_of(scene: dict[str, Any]) -> np.ndarray:
    """Those that no wall may come nearer than: of soft walls a tenth of the radii."""
    return radii_of(scene) * (1.0 - SOFT if "wallStiffness" in scene["vessel"] else 1.0)


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


def _lead_in(random, scene: dict[str, Any], spacing: float, straight: float) -> None:
    """A long wire of which all but the tip is in a sheath that ends in the vessel's straight piece."""
    outside = random.uniform(0.1, 2.0) * spacing
    exit_at = -straight + _ELEMENTS_IN_VESSEL * spacing
    count = round(_LONG / spacing)
    length = count * spacing
    scene |= {"guidewireLength": length, "numberRodElements": count, "guidewireOffset": exit_at + outside - length,
              "sheath": {"exit": [0.0, 0.0, exit_at]}}
    scene["wireSections"] = _tip(random, scene, min(count, 40))

"""Random runs of all kinds, small and quick: those that do what they are asked and those that cannot."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

Scene = dict[str, Any]
LOGS = {"logFormat": "npz", "deltaThreshold": 0.0}


def draw(seed: int) -> tuple[str, Scene]:
    """A kind of run and its parameter file."""
    random = np.random.default_rng(seed)
    names = list(KINDS)
    kind = names[seed % len(names)]
    return kind, {**LOGS, **KINDS[kind](random)}


def _log(random: np.random.Generator, low: float, high: float) -> float:
    return float(math.exp(random.uniform(math.log(low), math.log(high))))


def _side(random: np.random.Generator, size: float) -> list[float]:
    angle = random.uniform(0.0, 2.0 * math.pi)
    return [size * math.cos(angle), size * math.sin(angle), 0.0]


def _pbd(random: np.random.Generator) -> Scene:
    n = int(random.integers(5, 25))
    return {"guidewireLength": 10.0 * n, "numberRodElements": n, "guidewireOffset": 0.0,
            "stretchStiffness": _log(random, 1e-3, 1.5), "bendStiffness": _log(random, 1e-3, 5.0),
            "constraintSolverSteps": int(random.integers(1, 40)), "maxSimulationSteps": int(random.integers(5, 60)),
            "sphereRadius": random.uniform(0.5, 2.0), "elementContact": str(random.choice(["barycentric", "none"]))}


def _walls(random: np.random.Generator, length: float, radius: float) -> Scene:
    """A wall around a wire that starts at z = 0 and is so long."""
    if random.random() < 0.3:
        far = length * random.uniform(1.02, 1.5) + radius
        return {"vessel": {"shape": "plane", "point": [0.0, 0.0, far], "normal": [0.0, 0.0, -1.0]}}
    return {"vessel": {"shape": "tube", "radius": radius * random.uniform(1.3, 5.0), "openStart": True,
                       "openEnd": bool(random.random() < 0.5),
                       "knots": [[0.0, 0.0, -0.5 * length], [0.0, 0.0, random.uniform(1.1, 2.0) * length]]}}


def _pbd_free(random: np.random.Generator) -> Scene:
    turned = random.random() < 0.3
    return {**_pbd(random), "displacement": random.uniform(0.0, 20.0), "displacementDirection": _side(random, 1.0),
            **({"twistPerStep": random.uniform(0.1, 3.0)} if turned else {})}


def _pbd_walls(random: np.random.Generator) -> Scene:
    scene = _pbd(random)
    along = random.random() < 0.6
    return {**scene, **_walls(random, scene["guidewireLength"], scene["sphereRadius"]), "drive": "displace",
            "displacementDirection": [0.0, 0.0, 1.0] if along else _side(random, 1.0),
            "displacementPerStep": _log(random, 0.01, 8.0)}


def _wire(random: np.random.Generator) -> Scene:
    n = int(random.integers(5, 25))
    return {"guidewireLength": random.uniform(50.0, 250.0), "numberRodElements": n, "guidewireOffset": 0.0,
            "wireRadius": _log(random, 1e-4, 6e-4), "youngsModulus": _log(random, 1e9, 2e11),
            "shearModulus": _log(random, 1e9, 8e10), "massDamping": _log(random, 1.0, 200.0),
            "proximalEnd": "clamped", "timeStep": _log(random, 1e-3, 2e-2),
            "maxSimulationSteps": int(random.integers(10, 60))}


def _bend(wire: Scene) -> float:
    """EI/L^2, N: the size of forces that bend a wire by much."""
    return wire["youngsModulus"] * math.pi * wire["wireRadius"] ** 4 / 4.0 / (1e-3 * wire["guidewireLength"]) ** 2


def _direct(random: np.random.Generator) -> Scene:
    return {**_wire(random), "solver": "direct", "integrator": "implicitEuler", "logContacts": True, "logHub": True,
            "logStrains": True}


def _direct_free(random: np.random.Generator) -> Scene:
    scene = _direct(random)
    force = _bend(scene) * _log(random, 1e-2, 3e3)
    return {**scene, "tipForce": _side(random, force), "gravity": [0.0, -9.81 * float(random.random() < 0.5), 0.0]}


def _direct_loose(random: np.random.Generator) -> Scene:
    scene = {**_direct(random), "proximalEnd": "free"}
    return {**scene, "massDamping": 0.0, "tipForce": _side(random, _bend(scene) * _log(random, 1e-3, 1.0))}


def _direct_stiff(random: np.random.Generator) -> Scene:
    return {**_direct(random), "distalEnd": "clamped", "youngsModulus": _log(random, 1e9, 1e18),
            "gravity": [0.0, -9.81, 0.0]}


def _direct_walls(random: np.random.Generator) -> Scene:
    scene = _direct(random)
    walls = _walls(random, scene["guidewireLength"], 1e3 * scene["wireRadius"])
    walls["vessel"]["frictionCoefficient"] = float(random.choice([0.0, 0.1, 0.5]))
    along = random.random() < 0.7
    reach = (0.5 if along else 2e-3) * scene["guidewireLength"] * random.random()
    limit = _log(random, 1e-3, 2.0) if random.random() < 0.4 else 0.0
    return {**scene, **walls, "drive": "displace", "hubForceLimit": limit,
            "displacementDirection": [0.0, 0.0, 1.0] if along else _side(random, 1.0),
            "displacementPerStep": reach / scene["maxSimulationSteps"]}


def _direct_at_rest(random: np.random.Generator) -> Scene:
    scene = _direct_walls(random)
    return {**scene, "displacementPerStep": 0.0, "gravity": [0.0, -9.81, 0.0]}


def _sheath(random: np.random.Generator) -> Scene:
    scene = _direct(random)
    length = scene["guidewireLength"]
    bent = float(random.choice([0.0, random.uniform(1.0, 60.0)]))
    wide = 1e3 * scene["wireRadius"] * random.uniform(1.5, 6.0)
    return {**scene, "guidewireOffset": -0.6 * length, "sheath": {"exit": [0.0, 0.0, 0.0]}, "drive": "displace",
            "vessel": {"shape": "tube", "radius": wide, "openStart": True, "openEnd": True,
                       "knots": [[0.0, 0.0, -length], [0.0, 0.0, 3.0 * length]],
                       "frictionCoefficient": float(random.choice([0.0, 0.3]))},
            "wireSections": [{"from": 0.8 * length, "to": length, "restCurvature": [bent, 0.0, 0.0]}],
            "hubForceLimit": _log(random, 1e-3, 2.0) if random.random() < 0.5 else 0.0,
            "displacementPerStep": random.uniform(-0.2, 0.5) * length / scene["maxSimulationSteps"]}


def _xpbd_walls(random: np.random.Generator) -> Scene:
    scene = {**_wire(random), "solver": "xpbd", "substeps": int(random.integers(1, 200)), "logContacts": True}
    return {**scene, **_walls(random, scene["guidewireLength"], 1e3 * scene["wireRadius"]), "drive": "displace",
            "displacementDirection": [0.0, 0.0, 1.0],
            "displacementPerStep": 0.3 * scene["guidewireLength"] * random.random() / scene["maxSimulationSteps"]}


def _explicit(random: np.random.Generator) -> Scene:
    scene = {**_wire(random), "solver": "explicit", "maxSimulationSteps": 5, "timeStep": 1e-3}
    return {**scene, "substeps": int(_log(random, 10, 20_000)), "tipForce": _side(random, _bend(scene))}


def _coaxial(random: np.random.Generator) -> Scene:
    length, start, steps = random.uniform(100.0, 200.0), 20.0, int(random.integers(5, 40))
    lumen = _log(random, 2.5e-4, 8e-4)
    moves = [float(random.choice([0.0, random.uniform(1.0, 30.0)])) for _ in range(2)]
    speed = 1e-3 / (0.02 * steps)
    catheter = {"start": start, "length": random.uniform(0.4, 0.7) * length, "elements": int(random.integers(8, 25)),
                "wireRadius": 1.4 * lumen, "lumenRadius": lumen,
                "insertionSpeed": speed * min(moves[1], moves[0] + 10.0),
                "restCurvature": [float(random.choice([0.0, 0.0, random.uniform(1.0, 40.0)])), 0.0, 0.0]}
    scene = {"solver": "direct", "guidewireLength": length, "numberRodElements": int(random.integers(10, 30)),
             "guidewireOffset": 0.0, "wireRadius": lumen * random.uniform(0.5, 0.95), "proximalEnd": "clamped",
             "drive": "displace", "insertionSpeed": speed * min(moves[0], 9.0 + moves[1]), "massDamping": 40.0,
             "timeStep": 0.02, "maxSimulationSteps": steps, "logHub": True, "catheters": [catheter]}
    if random.random() < 0.5:
        scene["vessel"] = {"shape": "tube", "radius": 1e3 * 1.4 * lumen * random.uniform(1.5, 4.0), "openStart": True,
                           "openEnd": True, "knots": [[0.0, 0.0, -50.0], [0.0, 0.0, 400.0]]}
        if random.random() < 0.3:
            scene["hubForceLimit"] = _log(random, 1e-2, 1.0)
    return scene


KINDS: dict[str, Callable[[np.random.Generator], Scene]] = {
    "pbd": _pbd_free, "pbd between walls": _pbd_walls, "direct": _direct_free, "direct between walls": _direct_walls,
    "direct, hub at rest": _direct_at_rest, "direct in a sheath": _sheath,
    "direct, held at both ends": _direct_stiff, "direct, not held": _direct_loose,
    "xpbd between walls": _xpbd_walls, "explicit": _explicit, "coaxial": _coaxial,
}

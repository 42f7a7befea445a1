"""Random wires pushed into random vessels: what is drawn, and the scenes that the runner is given.

Twelve kinds of vessel: a helix, a branch with a sharp apex, a stenosis, tubes of 8 sides, of 4 (a square channel) and
of many small triangles, tight bends in closed form, an S-bend of changing radius, cones as mesh and in closed form, a
bulge, and a slope. Every vessel begins with a straight piece along z in which the wire lies; meshes are closed, so that
a wire that is outside has passed a wall. ``python3 -m experiments.campaigns.push_campaign --help`` makes a campaign of
them.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from analysis.wall_search import rotation_of

CONTACT_RULES = ("barycentric", "none", "thesis")
LEAST_LUMEN = 1.07  # least width of a lumen ahead, over the wire's radius


@dataclass(frozen=True)
class Vessel:
    """A vessel before it is written down.

    Attributes
    ----------
    wall : the key `vessel` but for a mesh's file.
    centreline : ndarray, shape (k, 3), the middle of the lumen ahead of the wire, from (0, 0, 0) on, in units.
    width : radius of the lumen along it, units.
    vertices, faces : of a mesh, shapes (v, 3) in units and (t, 3); empty otherwise.
    """

    wall: dict[str, Any]
    centreline: np.ndarray
    width: float
    vertices: np.ndarray
    faces: np.ndarray


def bent_line(length: float, spacing: float, curvature, torsion=lambda s: 0.0) -> np.ndarray:
    """A line from the origin, at first along z, of given curvature and torsion (functions of arc length), (k, 3)."""
    count = max(2, int(np.ceil(length / spacing)) + 1)
    steps = np.linspace(0.0, length, count)
    tangent, normal = np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0])
    points = [np.zeros(3)]
    for s, h in zip(steps[:-1], np.diff(steps)):
        binormal = np.cross(tangent, normal)
        kappa, tau = curvature(s + 0.5 * h), torsion(s + 0.5 * h)
        points.append(points[-1] + h * (tangent + 0.5 * h * kappa * normal))
        tangent, normal = tangent + h * kappa * normal, normal + h * (tau * binormal - kappa * tangent)
        tangent /= np.linalg.norm(tangent)
        normal -= (normal @ tangent) * tangent
        normal /= np.linalg.norm(normal)
    return np.array(points)


def swept_mesh(centres: np.ndarray, radii: np.ndarray, sides: int, turn: float) -> tuple[np.ndarray, np.ndarray]:
    """A tube of polygons around a line, both ends closed by a fan: vertices (v, 3), triangles (t, 3)."""
    tangents = np.gradient(centres, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1)[:, None]
    across = np.array([np.cos(turn), np.sin(turn), 0.0])
    angles = 2.0 * np.pi * np.arange(sides) / sides
    rings = []
    for centre, tangent, radius in zip(centres, tangents, radii):
        across = across - (across @ tangent) * tangent
        across /= np.linalg.norm(across)
        other = np.cross(tangent, across)
        rings.append(centre + radius * (np.cos(angles)[:, None] * across + np.sin(angles)[:, None] * other))
    k, following = np.arange(sides), (np.arange(sides) + 1) % sides
    faces = []
    for i in range(len(rings) - 1):
        a, b = i * sides, (i + 1) * sides
        faces.append(np.column_stack([a + k, a + following, b + following]))
        faces.append(np.column_stack([a + k, b + following, b + k]))
    first, last = len(rings) * sides, len(rings) * sides + 1
    end = (len(rings) - 1) * sides
    faces += [np.column_stack([following, k, np.full(sides, first)]),
              np.column_stack([end + k, end + following, np.full(sides, last)])]
    return np.concatenate([*rings, [centres[0]], [centres[-1]]]), np.concatenate(faces)


def _swept(random, sheath, line, radii, sides):
    back = np.array([[0.0, 0.0, -sheath], [0.0, 0.0, -0.5 * sheath]])
    centres = np.concatenate([back, line])
    vertices, faces = swept_mesh(centres, np.concatenate([[radii[0]] * 2, radii]), sides, random.uniform(0.0, np.pi))
    return Vessel({"shape": "mesh"}, line, float(radii.min()), vertices, faces)


def _helix(random, radius, sheath):
    width = random.uniform(1.4, 4.0) * radius
    bend = random.uniform(2.0, 6.0) * width
    turn = random.uniform(0.35, 0.8) / bend
    line = bent_line(random.uniform(6.0, 15.0) * bend, 0.3 * bend, lambda s: 1.0 / bend, lambda s: turn)
    return _swept(random, sheath, line, np.full(len(line), width), int(random.integers(8, 20)))


def _s_bend(random, radius, sheath, sides=None, curved=True):
    width = random.uniform(1.4, 3.0) * radius / (np.cos(np.pi / sides) if sides else 0.95)
    bend = random.uniform(1.5, 5.0) * width * 1.5
    arc = random.uniform(0.4, 1.9) * bend
    line = bent_line(4.0 * arc, 0.25 * bend, lambda s: (1.0 if s < arc else -1.0 if s < 2.5 * arc else 0.5) / bend)
    wide = np.full(len(line), width)
    if curved:
        wide = width * (1.0 + 0.45 * np.sin(np.linspace(0.0, random.uniform(3.0, 15.0), len(line))) ** 2)
    return _swept(random, sheath, line, wide, sides or int(random.integers(9, 20)))


def _octagon(random, radius, sheath):
    return _s_bend(random, radius, sheath, 8, False)


def _channel(random, radius, sheath):
    return _s_bend(random, radius, sheath, 4, False)


def _stenosis(random, radius, sheath):
    sides = int(random.integers(8, 16))
    width = random.uniform(1.6, 4.0) * radius
    narrow = random.uniform(1.02, 1.3) * LEAST_LUMEN * radius / np.cos(np.pi / sides)
    length = random.uniform(10.0, 30.0) * width
    line = bent_line(length, 0.4 * width, lambda s: random.choice([0.0, 0.05]) / width)
    at, spread = random.uniform(0.2, 0.6) * length, random.uniform(0.4, 3.0) * width
    s = np.linspace(0.0, length, len(line))
    return _swept(random, sheath, line, width - (width - narrow) * np.exp(-((s - at) / spread) ** 2), sides)


def _fine(random, radius, sheath):
    width = random.uniform(1.4, 3.0) * radius
    bend = random.uniform(2.0, 5.0) * width
    line = bent_line(6.0 * bend, 0.03 * bend, lambda s: (1.0 if s < 1.5 * bend else -1.0) / bend)
    return _swept(random, sheath, line, np.full(len(line), width), int(random.integers(32, 64)))


def _cone(random, radius, sheath):
    sides = int(random.integers(6, 14))
    narrow = LEAST_LUMEN * radius / np.cos(np.pi / sides)
    wide = random.uniform(1.3, 4.0) * narrow
    line = bent_line(random.uniform(5.0, 30.0) * wide, 2.0 * wide, lambda s: 0.0)
    return _swept(random, sheath, line, np.linspace(wide, narrow, len(line)), sides)


def _bulge(random, radius, sheath):
    width = random.uniform(1.4, 3.0) * radius
    line = bent_line(12.0 * width, 0.3 * width, lambda s: 0.0)
    s = np.linspace(-1.0, 1.0, len(line))
    wide = width * (1.0 + random.uniform(1.0, 4.0) * np.exp(-(4.0 * s) ** 2))
    return _swept(random, sheath, line, wide, int(random.integers(8, 18)))


def _branch(random, radius, sheath):
    """Two arms between flat walls, an edge between them: an outline in the y-z plane, drawn out along x."""
    half = random.uniform(1.3, 3.0) * radius
    angle = random.uniform(0.15, 0.9)
    arm, length = random.uniform(2.4, 4.0) * radius, random.uniform(60.0, 250.0)
    apex = np.array([0.0, max(0.2 * half, (arm - half * np.cos(angle)) / np.sin(angle))])
    arm = half * np.cos(angle) + apex[1] * np.sin(angle)
    outline = [[half, -sheath], [half, 0.0]]
    outline.append(np.array(outline[1]) + length * np.array([np.sin(angle), np.cos(angle)]))
    outline.append(outline[2] + arm * np.array([-np.cos(angle), np.sin(angle)]))
    outline = np.array([*outline, apex, *[np.array(p) * [-1.0, 1.0] for p in outline[::-1]]])
    depth = random.uniform(1.1, 2.0) * half
    vertices = np.concatenate([np.column_stack([np.full(9, x), outline]) for x in (-depth, depth)])
    caps = [(0, 1, 7), (0, 7, 8), (1, 4, 7), (1, 2, 4), (2, 3, 4), (7, 4, 6), (4, 5, 6)]
    sides = [face for k in range(9) for face in ((k, (k + 1) % 9, k + 9), ((k + 1) % 9, (k + 1) % 9 + 9, k + 9))]
    faces = np.array([*caps, *[(a + 9, c + 9, b + 9) for a, b, c in caps], *[(a, c, b) for a, b, c in sides]])
    centreline = np.column_stack([np.zeros((5, 2)), np.linspace(0.0, apex[1] + half, 5)])
    return Vessel({"shape": "mesh"}, centreline, half, vertices, faces)


def _tube(sheath, line, radii):
    knots = [[0.0, 0.0, -sheath], *line.tolist()]
    wall = {"shape": "tube", "knots": knots, "radius": [float(radii[0]), *radii.tolist()]}
    return Vessel(wall, line, float(radii.min()), np.empty((0, 3)), np.empty((0, 3), int))


def _tight_bends(random, radius, sheath):
    width = random.uniform(1.3, 3.0) * radius
    pieces = int(random.integers(3, 20))
    direction, points = np.array([0.0, 0.0, 1.0]), [np.zeros(3)]
    for _ in range(pieces):
        points.append(points[-1] + random.uniform(2.0, 5.0) * width * direction)
        direction = direction + random.uniform(0.2, 0.9) * random.normal(size=3)
        direction[2] = abs(direction[2]) + 0.3
        direction /= np.linalg.norm(direction)
    return _tube(sheath, np.array(points), width * random.uniform(1.0, 1.3, pieces + 1))


def _closed_form_cone(random, radius, sheath):
    wide = random.uniform(1.3, 5.0) * radius * LEAST_LUMEN
    line = bent_line(random.uniform(5.0, 30.0) * wide, 5.0 * wide, lambda s: 0.02 / wide)
    return _tube(sheath, line, np.linspace(wide, LEAST_LUMEN * radius, len(line)))


def _slope(random, radius, sheath):
    normal = np.array([random.normal(0.0, 0.3), random.normal(0.0, 0.3), -random.uniform(0.1, 1.0)])
    wall = {"shape": "plane", "point": [0.0, 0.0, random.uniform(1.0, 8.0) * radius], "normal": normal.tolist()}
    centreline = np.column_stack([np.zeros((5, 2)), np.linspace(0.0, 20.0 * radius, 5)])
    return Vessel(wall, centreline, 5.0 * radius, np.empty((0, 3)), np.empty((0, 3), int))


KINDS = {
    "helix": _helix, "branch": _branch, "stenosis": _stenosis, "octagon": _octagon, "channel": _channel,
    "fine": _fine, "s-bend": _s_bend, "cone": _cone, "bulge": _bulge, "tight bends": _tight_bends,
    "closed cone": _closed_form_cone, "slope": _slope,
}


def draw(seed: int, folder: Path) -> tuple[str, dict[str, Any]]:
    """A random push: the kind of its vessel and its parameters; a mesh is written into the folder.

    The same seed gives the same scene. Kinds and contact rules take turns, so that any run of seeds has all of them.
    """
    random = np.random.default_rng([20, seed])
    kind = list(KINDS)[seed % len(KINDS)]
    radius = float(np.exp(random.uniform(np.log(0.5), np.log(5.0))))
    spacing = float(np.exp(random.uniform(np.log(4.0), np.log(100.0))))
    count = int(np.clip(round(random.uniform(60.0, 350.0) / spacing), 3, 60))
    length = count * spacing
    vessel = KINDS[kind](random, radius, length + 4.0 * radius)
    per_step = float(np.exp(random.uniform(np.log(0.1), np.log(20.0)))) * radius
    distance = float(np.linalg.norm(np.diff(vessel.centreline, axis=0), axis=1).sum())
    rule = CONTACT_RULES[seed // len(KINDS) % len(CONTACT_RULES)]
    scene = {
        "drive": str(random.choice(["push", "displace"])), "displacementPerStep": per_step, "guidewireLength": length,
        "numberRodElements": count, "guidewireOffset": -length, "sphereRadius": radius,
        "constraintSolverSteps": int(random.integers(10, 80)), "stretchStiffness": random.uniform(0.1, 1.5),
        "bendStiffness": random.uniform(0.01, 0.9) * spacing,
        "collisionStiffness": float(10.0 ** random.uniform(-3.0, 0.0)),
        "collisionMargin": float(random.choice([0.0, random.uniform(0.0, 0.5) * radius])), "elementContact": rule,
        "damping": float(random.choice([0.0, 1.0, random.uniform()])), "deltaThreshold": 0.0,
        "maxSimulationSteps": int(np.clip(random.uniform(0.5, 1.5) * (distance + 20.0 * radius) / per_step, 12, 90)),
        "integrator": str(random.choice(["verlet", "euler"])), "sweepOrder": str(random.choice(["naive", "bilateral"])),
        "timeStep": 0.01, "totalMass": 0.01, "vessel": dict(vessel.wall),
    }
    if seed // (len(KINDS) * len(CONTACT_RULES)) % 2:
        _resolve(random, scene, distance)
    if random.uniform() < 0.5:
        scene["gravity"] = (float(10.0 ** random.uniform(1.0, 4.0)) * direction(random)).tolist()
    if random.uniform() < 0.3:
        scene["twistPerStep"] = random.uniform(-0.5, 0.5)
    if random.uniform() < 0.5:
        scene["obstacles"] = [obstacle(random, vessel, radius) for _ in range(random.integers(1, 4))]
    if len(vessel.faces):
        write_mesh(random, scene, vessel, folder / f"push-{seed}.obj")
    if rule != "thesis" and random.uniform() < 0.3:
        for wall in (scene["vessel"], *scene.get("obstacles", [])):
            wall["frictionCoefficient"] = random.uniform(0.05, 0.8)
    return kind, scene


def _resolve(random, scene: dict[str, Any], distance: float) -> None:
    """So few elements, so many iterations and so slow a push that most wires keep their length."""
    scene["numberRodElements"] = min(scene["numberRodElements"], 20)
    scene["bendStiffness"] *= 0.1
    scene |= {"constraintSolverSteps": 300, "stretchStiffness": 1.0, "collisionStiffness": 1.0,
              "damping": random.uniform(0.05, 0.3)}
    per_step = 0.1 * scene["displacementPerStep"]
    steps = int(np.clip(random.uniform(0.3, 1.2) * distance / per_step, 12, 300))
    scene |= {"displacementPerStep": per_step, "maxSimulationSteps": steps}


def direction(random) -> np.ndarray:
    """A random unit vector, shape (3,)."""
    vector = random.normal(size=3)
    return vector / np.linalg.norm(vector)


def obstacle(random, vessel: Vessel, radius: float) -> dict[str, Any]:
    """A ball, capsule or box beside the middle of the lumen, some distance ahead of the wire."""
    size = random.uniform(0.2, 0.6) * vessel.width
    ahead = vessel.centreline[vessel.centreline[:, 2] > 2.0 * (radius + size)]
    place = ahead[random.integers(len(ahead))] if len(ahead) else np.array([0.0, 0.0, 4.0 * (radius + size)])
    side = direction(random) * [1.0, 1.0, 0.0]
    centre = place + random.uniform(0.4, 1.2) * vessel.width * side
    shape = str(random.choice(["sphere", "capsule", "box"]))
    if shape == "box":
        return {"shape": shape, "centre": centre.tolist(), "halfSize": (random.uniform(0.3, 1.0, 3) * size).tolist(),
                "rotation": random.uniform(-90.0, 90.0, 3).tolist()}
    if shape == "capsule":
        along = size * np.cross(direction(random), [0.0, 0.0, 1.0])
        return {"shape": shape, "from": (centre - along).tolist(), "to": (centre + along).tolist(),
                "radius": 0.5 * size}
    return {"shape": shape, "centre": centre.tolist(), "radius": size}


def write_mesh(random, scene: dict[str, Any], vessel: Vessel, file: Path) -> None:
    """The mesh as it stands, or in a quarter of the scenes placed, turned and stretched back into its place."""
    vertices = vessel.vertices
    if random.uniform() < 0.25:
        position, degrees = random.uniform(-200.0, 200.0, 3), random.uniform(-180.0, 180.0, 3)
        scale = random.uniform(0.4, 2.5, 3) * random.choice([-1.0, 1.0], 3)
        vertices = (vertices - position) @ rotation_of(degrees) / scale
        scene.update(position=position.tolist(), rotation=degrees.tolist(), scale=scale.tolist())
    scene["vessel"]["file"] = str(file)
    file.write_text("".join(f"v {x:.17g} {y:.17g} {z:.17g}\n" for x, y, z in vertices)
                    + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in vessel.faces))

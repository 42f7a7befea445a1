"""What a run's own word on its result, `reliable`, is held to, by its log alone. Nothing of the program is used here.

Criteria, written down before the first run. A result is not to be trusted where
1. the run did not converge or finish;
2. a number of its log is not finite;
3. a point of the wire, ten an element, is beyond a wall, or the wire's surface is in one by more than the method allows
   (pbd its radius, xpbd a twentieth of it, direct nothing);
4. the wire's length differs from that at rest by more than 1 %;
5. its outermost fibre is strained by more than 20 % (direct);
6. a hub went less far than asked, by more than a thousandth of that and than a millionth of the wire's length;
7. a hub's force is above its limit, by more than a fiftieth;
8. the forces on the wire and its change of momentum differ by more than a thousandth of the largest of them, or of
   EI/L^2 (direct);
9. one of its warnings is listed in docs/runs.md as one that makes it so.
What is nearer to a border than a twentieth may be either.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

SAMPLES = 10
_ROW = re.compile(r"^\| (.+?) \| (-|false) \| ", re.MULTILINE)
_ALLOWED = {"pbd": 1.0, "xpbd": 0.05, "direct": 0.0}
_NEAR = 0.05
# Warnings that a criterion here measures too, by their beginning.
_MEASURED = {
    "passed a wall": r"\d+ points of the wire passed a wall", "penetration": "the wire penetrated a wall by",
    "length": r"the wire is [\d.]+ % (?:shorter|longer)", "strain": "the outermost fibre was strained by",
    "shortfall": "the drive fell short: |the (?:wire's |catheter's )?hub fell short by",
}
_HAND = 10.0  # N, at most, of "hand": what two fingers hold


@dataclass(frozen=True)
class Found:
    """A quantity that a criterion is about.

    Attributes
    ----------
    value, limit : above the limit the result is not to be trusted.
    """

    value: float
    limit: float

    @property
    def is_beyond(self) -> bool:
        """Whether it is, clearly."""
        return not self.value <= self.limit * (1.0 + _NEAR) + 1e-12

    @property
    def is_within(self) -> bool:
        """Whether it is not, clearly."""
        return self.value <= self.limit * (1.0 - _NEAR)


def listed(docs: str) -> list[re.Pattern[str]]:
    """Patterns of the warnings that make a run unreliable, from the table of docs/runs.md."""
    block = docs.split("<!-- warnings -->")[1].split("<!-- /warnings -->")[0]
    return [re.compile(re.sub(r"\\\*[^*]+\\\*", ".+", re.escape(line))) for line, word in _ROW.findall(block)
            if word == "false"]


def violations(scene: Mapping[str, Any], summary: Mapping[str, Any], log: Mapping[str, np.ndarray],
               warnings: list[re.Pattern[str]]) -> list[str]:
    """Find where `reliable` is not what the criteria say, one line each.

    Parameters
    ----------
    scene : the effective parameters.
    log : the arrays of positions.npz, one entry a step.
    warnings : as `listed` has them.
    """
    told = "\n".join([*summary["warnings"], summary["reason"].partition(", but ")[2]])
    serious = [found[0] for pattern in warnings if (found := pattern.search(told))]
    is_whole = summary["outcome"] in ("converged", "finished")
    claims = []
    if summary["reliable"] != (is_whole and not serious):
        claims.append(f"reliable = {summary['reliable']}: {summary['outcome']}, {serious}")
    if not is_whole:
        return claims
    for name, found in measured(scene, summary, log).items():
        beginning = _MEASURED.get(name)
        is_said = beginning is not None and any(re.match(beginning, line) for line in serious)
        if found.is_beyond and summary["reliable"]:
            claims.append(f"{name}: {found.value:.4g} is above {found.limit:.4g}, and the run calls itself reliable")
        elif is_said and found.is_within:
            claims.append(f"{name}: {found.value:.4g} is within {found.limit:.4g}, and the run says otherwise: "
                          f"{serious}")
    return claims


def measured(scene: Mapping[str, Any], summary: Mapping[str, Any], log: Mapping[str, np.ndarray]) -> dict[str, Found]:
    """The quantities of criteria 2 to 8 that a run has."""
    x, solver = log["positions"], scene["solver"]
    broken = sum(not np.isfinite(array).all() for name, array in log.items() if name != "elapsedMilliseconds")
    found = {"not finite": Found(float(broken), 0.0)}
    chords = np.linalg.norm(np.diff(x[-1], axis=0), axis=1)
    found["length"] = Found(abs(float(chords.sum()) / scene["guidewireLength"] - 1.0), 0.01)
    if scene.get("vessel"):
        found |= _against(scene, x)
        found |= _driven(scene, summary, log)
    if "curvature" in log:
        bend = np.hypot(log["curvature"][..., 0] - _rest_curvature(scene), log["curvature"][..., 1])
        stretch = np.abs(log["strain"][..., 2])
        beside = np.concatenate([stretch[:, :1], np.maximum(stretch[:, 1:], stretch[:, :-1]), stretch[:, -1:]], axis=1)
        found["strain"] = Found(float((scene["wireRadius"] * bend + beside).max()), 0.2)
    if solver == "direct" and scene.get("hubForceLimit") and "hubForce" in log:
        limit = _HAND if scene["hubForceLimit"] == "hand" else scene["hubForceLimit"]
        found["hub's force"] = Found(float(np.abs(log["hubForce"][1:]).max(initial=0.0)), 1.02 * limit)
    is_whole = not scene.get("catheters") and not scene.get("sheath") and scene.get("distalEnd") == "free"
    if solver == "direct" and "reaction" in log and is_whole:
        found["balance"] = _balance(scene, summary, log)
    return found


def _rest_curvature(scene: Mapping[str, Any]) -> np.ndarray:
    """About d1 at each joint, 1/m, (n + 1,): the mean over its elements of the sections' one."""
    n, length = scene["numberRodElements"], scene["guidewireLength"]
    edges = length * np.arange(n + 1) / n
    middles = np.concatenate([[0.0], 0.5 * (edges[1:] + edges[:-1]), [length]])
    rest = np.zeros(n + 1)
    for section in scene["wireSections"]:
        overlap = np.minimum(middles[1:], section["to"]) - np.maximum(middles[:-1], section["from"])
        rest += section["restCurvature"][0] * np.maximum(overlap, 0.0) / (middles[1:] - middles[:-1])
    return rest


def _against(scene: Mapping[str, Any], x: np.ndarray) -> dict[str, Found]:
    """Distances of points along the wire from a plane or a straight tube along z."""
    vessel = scene["vessel"]
    part = (np.arange(SAMPLES) / SAMPLES)[:, None]
    points = np.concatenate([(x[:, :-1, None] * (1.0 - part) + x[:, 1:, None] * part).reshape(len(x), -1, 3),
                             x[:, -1:]],
                            axis=1)
    if vessel["shape"] == "plane":
        normal = np.asarray(vessel["normal"], dtype=float)
        distance = (points - np.asarray(vessel["point"])) @ (normal / np.linalg.norm(normal))
    else:
        first, last = vessel["knots"][0][2], vessel["knots"][-1][2]
        distance = vessel["radius"] - np.hypot(points[..., 0], points[..., 1])
        inside = (points[..., 2] > first) & (points[..., 2] < last)
        if not vessel.get("openEnd", False):
            distance = np.minimum(distance, np.where(points[..., 2] > last - vessel["radius"], np.inf, distance))
        distance = np.where(inside, distance, np.inf)
    radius = scene["sphereRadius"] if scene["solver"] == "pbd" else scene["wireRadius"] / scene["metresPerUnit"]
    if scene.get("catheters"):
        return {"passed a wall": Found(float(np.count_nonzero(distance < 0.0)), 0.0)}
    return {"passed a wall": Found(float(np.count_nonzero(distance < 0.0)), 0.0),
            "penetration": Found(float(radius - distance.min(initial=math.inf)) / radius,
                                 _ALLOWED[scene["solver"]] + 1e-9)}


def _driven(scene: Mapping[str, Any], summary: Mapping[str, Any], log: Mapping[str, np.ndarray]) -> dict[str, Found]:
    """Of the motion that was asked for, units: what is missing beyond what does not count."""
    if scene["drive"] != "displace":
        return {}
    steps, metres = summary["steps"], scene.get("metresPerUnit", 1.0)
    length = scene["guidewireLength"]

    def missing(asked: float, gone: float) -> float:
        return abs(asked - gone) / max(1e-3 * abs(asked), 1e-6 * length)

    if scene.get("catheters"):
        asked = [one["insertionSpeed"] * scene["timeStep"] * steps / metres for one in (scene, scene["catheters"][0])]
        gone = [log[name][-1] / metres for name in ("hubInsertion", "catheterInsertion")]
        return {"shortfall": Found(max(map(missing, asked, gone)), 1.0)}
    asked = (scene["displacementPerStep"] or scene.get("insertionSpeed", 0.0) * scene["timeStep"] / metres) * steps
    if scene.get("sheath"):
        return {"shortfall": Found(missing(asked, float(log["hubInsertion"][-1]) / metres), 1.0)}
    direction = np.asarray(scene["displacementDirection"]) / np.linalg.norm(scene["displacementDirection"])
    first = log["positions"][:, 0]
    return {"shortfall": Found(missing(asked, float((first[-1] - first[0]) @ direction)), 1.0)}


def _balance(scene: Mapping[str, Any], summary: Mapping[str, Any], log: Mapping[str, np.ndarray]) -> Found:
    """Change of momentum less all forces over the largest of these, of implicit Euler."""
    metres, dt = scene["metresPerUnit"], scene["timeStep"]
    area = math.pi * scene["wireRadius"] ** 2
    mass = scene["density"] * area * metres * scene["guidewireLength"]
    v = metres * log["velocities"]
    momentum = mass / (v.shape[1] - 1) * (0.5 * (v[:, :-1] + v[:, 1:])).sum(axis=1)
    change = np.diff(momentum, axis=0)
    inertia = change / dt + scene["massDamping"] * momentum[1:]
    walls = log["contactTotalMean"][1:] if "contactTotalMean" in log else np.zeros_like(inertia)
    reaction = log["reaction"][1:] if scene["proximalEnd"] != "free" else np.zeros_like(inertia)
    load = mass * np.asarray(scene["gravity"]) + np.asarray(scene["tipForce"])
    left = inertia - walls - reaction - load
    # Where steps were made in parts the mean of the drag is between those at a step's start and at its end.
    most = scene["massDamping"] * change * (summary["solver"]["innerSteps"] > summary["steps"])
    part = np.clip((left * most).sum(axis=1) / np.maximum((most * most).sum(axis=1), 1e-300), 0.0, 1.0)
    rest = np.linalg.norm(left - part[:, None] * most, axis=1).max()
    bend = scene["youngsModulus"] * math.pi * scene["wireRadius"] ** 4 / 4.0 / (metres * scene["guidewireLength"]) ** 2
    size = max(bend, *(float(np.linalg.norm(force, axis=-1).max()) for force in (inertia, walls, reaction, load)))
    return Found(float(rest) / size, 1e-3)

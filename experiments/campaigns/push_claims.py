"""What the log of a push between walls is held to, by an independent search (`wall_search`): no passage, no frozen
element, true figures in the summary."""

from __future__ import annotations

from typing import Any

import numpy as np

from analysis.passages import SAMPLES, sample_wire
from analysis.wall_search import ClosedForm, MeshSearch, Walls
from experiments.campaigns.reliable_claims import listed
from guidewire.prepare import ROOT

FINE_SAMPLES = 40  # points an element, on the last entry of a log
FROZEN_STEPS = 20
# Warnings that make a result unreliable; others are of a run's parameters, or of a tip that left.
SERIOUS = listed((ROOT / "docs" / "runs.md").read_text(encoding="utf-8"))
RIM = "the tip left the vessel by an open rim"
SAME = 1e-9  # of the radius, or of the displacement that was asked for: what figures may differ by


def violations(scene: dict[str, Any], summary: dict[str, Any], positions: np.ndarray, walls: Walls) -> list[str]:
    """The claims that a run breaks, one line each.

    Parameters
    ----------
    scene, summary : the run's parameter file and summary.json.
    positions : (k, n + 1, 3), of all spheres after every step from 0 on, in units.
    """
    has_friction = scene["vessel"].get("frictionCoefficient", 0.0) > 0.0  # friction may hold an element where it is
    return [*contradictions(summary), *_passages(scene, summary, positions, walls),
            *([] if has_friction else _frozen(positions)), *drive_claims(scene, summary, positions),
            *penetration_claims(scene, summary, positions, walls)]


def contradictions(summary: dict[str, Any]) -> list[str]:
    """Find where `reliable` is not what outcome, reason and warnings say."""
    serious = [warning for warning in summary["warnings"] if any(one.match(warning) for one in SERIOUS)]
    is_whole = summary["outcome"] in ("converged", "finished") and ", but " not in summary["reason"]
    may_be_trusted = is_whole and not serious
    if summary["reliable"] != may_be_trusted:
        return [f"reliable = {summary['reliable']}: {summary['outcome']}, {summary['reason']}, {serious}"]
    return []


def passage_bounds(beyond: np.ndarray, on_wall: np.ndarray) -> tuple[int, int]:
    """The least and the most passages, from one side of a wall to the other, where points that lie on it to rounding
    may be on either.

    Parameters
    ----------
    beyond, on_wall : (walls, entries, points), whether a point is beyond a wall, and whether it lies on it.
    """
    may_be = np.stack([~beyond | on_wall, beyond | on_wall])  # on this side, on the other
    bounds = []
    for worse, best in ((np.inf, np.minimum), (-np.inf, np.maximum)):
        here, there = np.where(may_be[:, :, 0], 0.0, worse)
        for entry in range(1, beyond.shape[1]):
            here, there = np.where(may_be[:, :, entry], [best(here, there), best(here + 1.0, there)], worse)
        bounds.append(int(best(here, there).sum()))
    return bounds[0], bounds[1]


def _passages(scene: dict[str, Any], summary: dict[str, Any], positions: np.ndarray, walls: Walls) -> list[str]:
    claims = []
    rule = scene["elementContact"]
    points = sample_wire(positions)
    samples = walls.beyond(points)
    spheres, n = samples[..., ::SAMPLES], positions.shape[1] - 1
    count = int(np.count_nonzero(~samples[:, :-1] & samples[:, 1:]))
    if summary["passages"] != count:
        least, most = passage_bounds(samples, walls.distances(points) < SAME * scene["sphereRadius"])
        if not least <= summary["passages"] <= most:
            claims.append(f"passages = {summary['passages']}, true are {least} to {most}")
    if summary["reliable"] and samples.any():
        claims.append(f"{np.count_nonzero(samples)} points are beyond a wall, and the run calls itself reliable")
    if rule != "thesis" and spheres.any():
        step, sphere = np.argwhere(spheres.any(axis=0))[0]
        claims.append(f"sphere {sphere} is beyond a wall after step {step}")
    if rule == "barycentric":
        fraction = np.arange(FINE_SAMPLES)[:, None, None] / FINE_SAMPLES
        last = positions[-1]
        if walls.beyond((1.0 - fraction) * last[:-1] + fraction * last[1:]).any():
            claims.append("a point of the wire ends beyond a wall")
        through = crossings(positions, walls)
        if len(through):
            claims.append(f"element {through[0] % n} crosses a wall after step {through[0] // n};"
                          f" {len(through)} times in all")
    return claims


def _elements(positions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return positions[:, :-1].reshape(-1, 3), positions[:, 1:].reshape(-1, 3)


def crossings(positions: np.ndarray, walls: Walls) -> np.ndarray:
    """Elements, numbered through all entries, whose core line goes through a wall."""
    return np.flatnonzero(walls.crosses(*_elements(positions)))


def _frozen(positions: np.ndarray) -> list[str]:
    """Elements whose spheres keep their bits over 20 steps in which the drive moves and a neighbouring sphere does."""
    still = np.all(positions[1:] == positions[:-1], axis=2)  # (steps, n + 1)
    steps, spheres = still.shape
    for first in range(steps - FROZEN_STEPS + 1):
        window = still[first:first + FROZEN_STEPS]
        if window[:, 0].all():
            continue
        for j in range(spheres - 1):
            beside = [i for i in (j - 1, j + 2) if 0 <= i < spheres]
            if window[:, j].all() and window[:, j + 1].all() and not window[:, beside].all():
                return [f"element {j} is frozen from step {first} to {first + FROZEN_STEPS}"]
    return []


def null_claims(summary: dict[str, Any]) -> list[str]:
    """Only a first sphere without a finite position makes the shortfall of the drive one that cannot be told."""
    is_lost = summary["outcome"] == "diverged" and "has no finite position" in summary["reason"]
    return ["driveShortfall is null"] if summary["driveShortfall"] is None and not is_lost else []


def drive_claims(scene: dict[str, Any], summary: dict[str, Any], positions: np.ndarray) -> list[str]:
    is_lost = summary["driveShortfall"] is None    # in a last step, whose positions are not finite and not logged
    asked = scene["displacementPerStep"] * (len(positions) - 1 + is_lost)
    gone = np.linalg.norm(np.diff(positions[:, 0], axis=0), axis=1).sum()
    claims = null_claims(summary)
    if abs(summary["driveAsked"] - asked) > SAME * asked:
        claims.append(f"driveAsked = {summary['driveAsked']}, true is {asked}")
    if not is_lost and abs(gone + summary["driveShortfall"] - asked) > SAME * asked:
        claims.append(f"asked {asked}, gone {gone}, driveShortfall = {summary['driveShortfall']}")
    return claims


def penetration_claims(
    scene: dict[str, Any], summary: dict[str, Any], positions: np.ndarray, walls: Walls
) -> list[str]:
    radius = scene["sphereRadius"]
    a, b = _elements(positions)
    least = radius
    for wall in walls.others:
        least = min(least, _least_other(wall, a, b, least, scene["elementContact"]))
    if walls.mesh:
        least = min(least, _least_mesh(walls.mesh, positions, least, scene["elementContact"]))
    true = radius - least
    if abs(summary["maxPenetration"] - true) > SAME * max(radius, true):
        return [f"maxPenetration = {summary['maxPenetration']!r}, true is {float(true)!r}"]
    return []


def _least_other(wall: ClosedForm, a: np.ndarray, b: np.ndarray, known: float, rule: str) -> float:
    """Least distance of a core line. With the published rule it may lie beyond the wall, at negative distances; with
    the others one that crosses the wall has 0."""
    if rule == "thesis":
        return wall.least_along(a, b, known)
    clear = (wall.distance(a) > 0.0) | (wall.distance(b) > 0.0)
    return min(known, max(0.0, wall.least_along(a[clear], b[clear], known)) if clear.any() else known)


def _least_mesh(mesh: MeshSearch, positions: np.ndarray, known: float, rule: str) -> float:
    a, b = _elements(positions)
    if rule == "thesis":
        spheres = np.unique(positions.reshape(-1, 3), axis=0)
        outside = spheres[~mesh.inside(spheres)]
        if len(outside):
            return min(known, -float(mesh.distance(outside).max()))
    if mesh.crosses(a, b).any():
        return min(known, 0.0)
    return mesh.least_distance(a[::-1], b[::-1], known)

"""What the log of a wire with a material between walls is held to, by the search of `wall_search`: no point of it
beyond a wall, the depth that its summary says, and what the drive asked for."""

from __future__ import annotations

from typing import Any

import numpy as np

from analysis.passages import SAMPLES, sample_wire
from analysis.wall_search import Walls
from experiments.campaigns.push_claims import contradictions

SAME = 1e-9  # of the wire's radius
OF_DISPLACEMENT = 1e-6  # of the displacement that was asked for: node 0 is on a stiff spring
DEEPEST = 0.05  # of the radius, from which on a wire of xpbd in a wall is to be warned of
WARNED = "the wire penetrated a wall"
KINKED = "the outermost fibre was strained by up to "
MOST_STRAIN = 0.2  # of the outermost fibre, from which on is to be warned of a kink


def violations(scene: dict[str, Any], summary: dict[str, Any], positions: np.ndarray, radii: np.ndarray, walls: Walls
          ) -> list[str]:
    """The claims that a run breaks, one line each; of all methods that a run which failed keeps, too.

    Where the run says itself that it is not reliable, a depth that a warning of its own names breaks none.

    Parameters
    ----------
    scene, summary : the run's parameter file and summary.json.
    positions : (k, n + 1, 3), of all nodes at the start and after every step, in units.
    radii : (n,), of the elements, in units.
    walls : the scene's.
    """
    if not np.isfinite(positions).all():
        return ["a position is not a finite number"]
    first = _first_outside(scene, positions)
    return [*contradictions(summary), *_passages(summary, positions, first, walls),
            *_depth(scene, summary, positions, first, radii, walls), *_drive(scene, summary, positions),
            *_strain(summary)]


def _first_outside(scene: dict[str, Any], positions: np.ndarray) -> np.ndarray:
    """The first node of each entry, shape (k,), from which on a wire is outside its sheath."""
    if "sheath" not in scene:
        return np.zeros(len(positions), int)
    return (positions[:, :, 2] > scene["sheath"]["exit"][2]).argmax(axis=1)


def _passages(summary: dict[str, Any], positions: np.ndarray, first: np.ndarray, walls: Walls) -> list[str]:
    claims = []
    beyond = walls.beyond(sample_wire(positions))  # (walls, k, samples)
    beyond &= np.arange(beyond.shape[-1]) >= SAMPLES * first[:, None]
    if beyond.any():
        _, entry, sample = np.argwhere(beyond)[0]
        claims.append(f"{np.count_nonzero(beyond)} points are beyond a wall, the first in entry {entry} at node"
                      f" {sample / SAMPLES}")
    if summary["passages"] != 0:
        claims.append(f"passages = {summary['passages']}")
    return claims


def _depth(scene: dict[str, Any], summary: dict[str, Any], positions: np.ndarray, first: np.ndarray,
           radii: np.ndarray, walls: Walls) -> list[str]:
    """Deepest that the surface of any element is in a wall, over all entries."""
    claims, deepest = [], 0.0
    outside = np.arange(len(radii)) >= first[:, None]
    for radius in np.unique(radii):
        chosen = outside & (radii == radius)
        a, b = positions[:, :-1][chosen], positions[:, 1:][chosen]
        if len(a) == 0:
            continue
        if walls.mesh and walls.mesh.crosses(a, b).any():
            claims.append("an element crosses the mesh")
            continue
        least = walls.mesh.least_distance(a[::-1], b[::-1], radius) if walls.mesh else radius
        for wall in walls.others:
            least = min(least, wall.least_along(a, b, least))
        deepest = max(deepest, radius - least)
    allowed = DEEPEST * radii.max() if scene["solver"] == "xpbd" else SAME * radii.max()
    is_named = not summary["reliable"] and any(WARNED in warning for warning in summary["warnings"])
    if deepest > allowed and not (is_named and scene["solver"] == "xpbd"):
        claims.append(f"the surface is in a wall by {deepest / radii.max():.3g} radii")
    if scene["solver"] != "xpbd" and summary["maxPenetration"] > allowed:
        claims.append(f"maxPenetration = {summary['maxPenetration']}, true is {deepest}")
    if scene["solver"] == "xpbd" and summary["maxPenetration"] < deepest - SAME * radii.max():
        claims.append(f"maxPenetration = {summary['maxPenetration']}, true is at least {deepest}")
    return claims


def _drive(scene: dict[str, Any], summary: dict[str, Any], positions: np.ndarray) -> list[str]:
    claims = []
    steps = len(positions) - 1  # a step without a state did not go
    if "driveFile" in scene:
        time, insertion, _ = np.loadtxt(scene["driveFile"], delimiter=",", skiprows=1).T
        way = np.diff(np.interp(scene["timeStep"] * np.arange(steps + 1), time, 1e3 * insertion))
        asked = np.abs(way).sum()
    else:
        asked = scene["displacementPerStep"] * steps
    if abs(summary["driveAsked"] - asked) > OF_DISPLACEMENT * asked:
        claims.append(f"driveAsked = {summary['driveAsked']}, true is {asked}")
    if "driveFile" in scene:  # of a way back and forth, what was not gone may have been made up for
        return claims
    gone = positions[-1, 0, 2] - positions[0, 0, 2]
    elastic = OF_DISPLACEMENT * asked + 1e-5 * scene["guidewireLength"] * ("sheath" in scene)
    if abs(gone + summary["driveShortfall"] - asked) > elastic:
        claims.append(f"asked {asked}, gone {gone}, driveShortfall = {summary['driveShortfall']}")
    return claims


def _strain(summary: dict[str, Any]) -> list[str]:
    """A warning of a bend that no instrument bears stands where there was one, and nowhere else."""
    strain = summary["extremes"]["strain"] if summary["extremes"] else 0.0
    if strain is not None and any(KINKED in warning for warning in summary["warnings"]) != (strain > MOST_STRAIN):
        return [f"strain = {strain}, warnings {summary['warnings']}"]
    return []

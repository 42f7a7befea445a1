"""What the log of a wire with a material between walls is held to, by the search of `wall_search`: no point of it
beyond a wall, the depth that its summary says, and what the drive asked for."""

from __future__ import annotations

from typing import Any

import numpy as np

from analysis.passages import SAMPLES, sample_wire
from analysis.wall_search import Walls
from experiments.campaigns.push_claims import contradictions, null_claims
from guidewire.logs.paths import lengths_of, through_tips

SAME = 1e-9  # of the wire's radius
OF_DISPLACEMENT = 1e-6  # of the displacement that was asked for: node 0 is on a stiff spring
SLIP_SPEED = 0.5  # m/s, slipSpeed by default
SAME_HUB = 1e-9  # m between what a hub was asked, went and fell short
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
    radii : (n,), of the elements, in units; (k, n) where they are others in each entry.
    walls : the scene's.
    """
    if not np.isfinite(positions).all():
        return ["a position is not a finite number"]
    first = _first_outside(scene, positions)
    radii = np.broadcast_to(radii, (len(positions), positions.shape[1] - 1))
    return [*contradictions(summary), *_passages(summary, positions, first, walls),
            *_depth(scene, summary, positions, first, radii, walls), *_drive(scene, summary, positions),
            *_hubs(scene, summary, len(positions) - 1), *_strain(summary)]


def chain(positions: np.ndarray, catheters: tuple[np.ndarray, ...], radii: list[np.ndarray]
          ) -> tuple[np.ndarray, np.ndarray]:
    """The outermost instrument at each place: nodes (k, m + 1, 3), and the radius of each element (k, m). Where an
    entry has fewer the last node stands several times.

    Parameters
    ----------
    positions, catheters : nodes of the wire, and of each catheter, the outermost first, (k, n + 1, 3) each.
    radii : of the elements of each, the wire first and the outermost catheter last.
    """
    instruments = [*catheters, positions]
    lengths = [lengths_of(own) for own in instruments]
    rows = []
    for entry in range(len(positions)):
        nodes, wide = instruments[0][entry], radii[-1]
        for own, length, width in zip(instruments[1:], lengths[1:], radii[-2::-1]):
            path, pieces = through_tips(own[entry], [nodes], length)
            at = np.flatnonzero((path == nodes[-1]).all(axis=1))
            if len(at):
                nodes = np.concatenate([nodes, path[at[0] + 1:]])
                wide = np.concatenate([wide, width[pieces[at[0]:]]])
        rows.append((nodes, wide))
    most = max(len(wide) for _, wide in rows)
    return (np.array([np.concatenate([nodes, np.repeat(nodes[-1:], most + 1 - len(nodes), axis=0)])
                      for nodes, _ in rows]),
            np.array([np.concatenate([wide, np.repeat(wide[-1:], most - len(wide))]) for _, wide in rows]))


def _first_outside(scene: dict[str, Any], positions: np.ndarray) -> np.ndarray:
    """The first node of each entry, shape (k,), from which on a wire is outside its sheath; n + 1 where none is."""
    if "sheath" not in scene:
        return np.zeros(len(positions), int)
    is_out = positions[:, :, 2] > scene["sheath"]["exit"][2]
    return np.where(is_out.any(axis=1), is_out.argmax(axis=1), positions.shape[1])


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
    outside = np.arange(radii.shape[1]) >= first[:, None]
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
    if "catheters" in scene:
        return claims
    asked = _asked(scene, scene, steps)
    if abs(summary["driveAsked"] - asked) > OF_DISPLACEMENT * asked:
        claims.append(f"driveAsked = {summary['driveAsked']}, true is {asked}")
    claims += null_claims(summary)
    # Of a way back and forth, what was not gone may have been made up for.
    if "driveFile" in scene or summary["driveShortfall"] is None:
        return claims
    gone = positions[-1, 0, 2] - positions[0, 0, 2]
    elastic = OF_DISPLACEMENT * asked + 1e-5 * scene["guidewireLength"] * ("sheath" in scene)
    if abs(gone + summary["driveShortfall"] - asked) > elastic:
        claims.append(f"asked {asked}, gone {gone}, driveShortfall = {summary['driveShortfall']}")
    return claims


def _asked(scene: dict[str, Any], driven: dict[str, Any], steps: int) -> float:
    """What a hub was asked to go in so many steps, there and back both counted, units."""
    if "driveFile" not in driven:
        return driven["displacementPerStep"] * steps
    time, insertion, _ = np.loadtxt(driven["driveFile"], delimiter=",", skiprows=1).T
    return float(np.abs(np.diff(np.interp(scene["timeStep"] * np.arange(steps + 1), time, 1e3 * insertion))).sum())


def _hubs(scene: dict[str, Any], summary: dict[str, Any], steps: int) -> list[str]:
    """Of several instruments what each hub was asked, and what it went and lost of that."""
    claims = []
    driven = [scene, *scene.get("catheters", [])] if "catheters" in scene else []
    for k, (one, said) in enumerate(zip(driven, summary.get("hubs") or [])):
        asked = 1e-3 * _asked(scene, one, steps)
        if abs(said["asked"] - asked) > SAME_HUB:
            claims.append(f"hub {k} was asked {said['asked']} m, true is {asked}")
        missing = asked - said["gone"] - said["shortfall"]
        if abs(missing) > SAME_HUB:
            claims.append(f"hub {k}: asked {asked} m, {said}")
    return claims


def order(scene: dict[str, Any], insertions: list[np.ndarray]) -> list[str]:
    """Hubs that pass the next one around; of the wire first, then of the outermost catheter, (k,) each, m."""
    own, *catheters = insertions
    starts = [one["start"] for one in scene.get("catheters", [])]
    hubs = [own, *(1e-3 * start + one for start, one in zip(reversed(starts), reversed(catheters)))]
    least = min((float((ahead - behind).min()) for behind, ahead in zip(hubs, hubs[1:])), default=0.0)
    return [f"a hub is {-least} m ahead of that around it"] if least < -1e-9 else []


def speeds(scene: dict[str, Any], insertions: list[np.ndarray]) -> list[str]:
    """Hubs that go faster than any of them is asked in that step and than they may slip; as `order`."""
    hubs, steps = [scene, *scene.get("catheters", [])], len(insertions[0]) - 1
    asked = np.max([_ways(scene, one, steps) for one in hubs], axis=0)
    claims = []
    for k, (one, insertion) in enumerate(zip(hubs, insertions)):
        slips = one.get("slipSpeed", SLIP_SPEED) * scene["timeStep"]
        over = np.abs(np.diff(insertion)) - np.maximum(asked, slips) - SAME_HUB
        if over.max(initial=0.0) > 0.0:
            claims.append(f"hub {k} goes {over.max()} m farther than it may in step {over.argmax() + 1}")
    return claims


def _ways(scene: dict[str, Any], driven: dict[str, Any], steps: int) -> np.ndarray:
    """How far a hub is asked to go in each step, there or back, (steps,), m."""
    if "driveFile" not in driven:
        return np.full(steps, 1e-3 * abs(driven.get("displacementPerStep", 0.0)))
    time, insertion, _ = np.loadtxt(driven["driveFile"], delimiter=",", skiprows=1).T
    return np.abs(np.diff(np.interp(scene["timeStep"] * np.arange(steps + 1), time, insertion)))


def force_sums(forces: list[np.ndarray], total: np.ndarray) -> list[str]:
    """What walls do on the nodes of each instrument, (k, n + 1, 3), N, against what they do in all, (k, 3)."""
    off = np.abs(sum(own.sum(axis=1) for own in forces) - total).max(initial=0.0)
    return [f"forces of walls on the instruments add up to {off} N less or more than all"] if off > 1e-9 else []


def beyond(scene: dict[str, Any], forces: list[np.ndarray]) -> float:
    """By what part of its hubForceLimit the force of a hub is above it in a step, at most; of the wire first, (k,),
    N. The first is that of the start, where nothing has slipped."""
    limits = [one.get("hubForceLimit", 0.0) for one in (scene, *scene.get("catheters", []))]
    return max((float(np.abs(force[1:]).max(initial=0.0)) / limit - 1.0
                for force, limit in zip(forces, limits) if limit > 0.0), default=0.0)


def _strain(summary: dict[str, Any]) -> list[str]:
    """A warning of a bend that no instrument bears stands where there was one, and nowhere else."""
    strain = summary["extremes"]["strain"] if summary["extremes"] else 0.0
    if strain is not None and any(KINKED in warning for warning in summary["warnings"]) != (strain > MOST_STRAIN):
        return [f"strain = {strain}, warnings {summary['warnings']}"]
    return []

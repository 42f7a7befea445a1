"""Generated anatomies: aortic arch, iliac bifurcation, carotid siphon, left coronary tree.

Sizes are drawn with a seed from normal distributions cut at two standard deviations, or evenly from ranges:

- thoracic aorta: diameters from Hager et al., J Thorac Cardiovasc Surg 123 (2002) 1060: ascending 30.9 +- 4.1 mm, arch
  27.7 +- 3.7, descending 24.3 +- 3.5;
- types of the arch: from the top of the arch down to the origin of the brachiocephalic trunk it is less than one
  diameter of the left common carotid (I), one to two (II), more (III); the usual definition, ascribed to Madhwal et
  al., J Invasive Cardiol 20 (2008) 200, whose text was not at hand (second hand);
- carotids: Krejza et al., Stroke 37 (2006) 1103: common 6.1 +- 0.8 mm, internal 4.7 +- 0.8 (women);
- left coronary tree: Dodge et al., Circulation 86 (1992) 232: main 4.5 +- 0.5 mm, anterior descending 3.7 +- 0.4 to
  1.9 +- 0.4, circumflex 3.4 +- 0.5; angle of the bifurcation: 80 +- 27 degrees, second hand from Pflederer et al., Eur
  Radiol 16 (2006) 2582, whose text was not at hand; read as abstracts, others have 75.5 +- 19.8 (Eur J Radiol 2011, 30
  patients, those with normal arteries), a median of 74 (J Invasive Cardiol 27 (2015) 401) and one of 88.5
  (Rodriguez-Granillo et al., Int J Cardiovasc Imaging 23 (2007) 389);
- what the literature gives no distribution for (lengths, bends, the iliac arteries) is drawn evenly from ranges that
  stand where they are used.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial import cKDTree

from guidewire.anatomy.mesh import Mesh
from guidewire.anatomy.sampling import resample
from guidewire.anatomy.tubes import Tube, mesh_of_tubes

# Of the tubes' ends, the start of the first one first.
_ENDS = {"arch": ("ascending aorta", "descending aorta", "", "left common carotid", "left subclavian",
                  "right subclavian", "right common carotid")}
_CARINA = 0.12  # radius of curvature of an edge between branches, of the largest branch's radius


def make(kind: str, number: int, seed: int, stenosis: float | None, aneurysm: float | None
         ) -> tuple[Mesh, str, list[str]]:
    """Return a mesh in mm, its unit, and what it is.

    Parameters
    ----------
    kind : "arch", "iliac", "siphon" or "coronary".
    number : type of the arch, 1 to 3.
    seed : of all that is drawn.
    stenosis, aneurysm : fraction of the diameter in the middle of a branch, or None.

    Raises
    ------
    AnatomyError : a kind or a type that there is not, or a fraction on the wrong side of 1.
    """
    from guidewire.anatomy.mesh import AnatomyError

    if kind not in _KINDS:
        raise AnatomyError(f"--make {kind}: there are {', '.join(_KINDS)}")
    if kind == "arch" and number not in (1, 2, 3):
        raise AnatomyError(f"--type {number}: arches are of type 1, 2 or 3")
    if stenosis is not None and not 0.1 <= stenosis < 1.0:
        raise AnatomyError(f"--stenosis {stenosis:g}: needs a fraction of the diameter from 0.1 to below 1")
    if aneurysm is not None and not 1.0 < aneurysm <= 4.0:
        raise AnatomyError(f"--aneurysm {aneurysm:g}: needs a multiple of the diameter above 1, 4 at most")
    tubes, diseased = tubes_of(kind, number, seed)
    notes = []
    for factor, (tube, place), name in zip((stenosis, aneurysm), diseased, ("stenosis", "aneurysm")):
        if factor is not None:
            tubes[tube] = _changed(tubes[tube], place, factor)
            at = tubes[tube].points[int(place * (len(tubes[tube].points) - 1))]
            notes.append(f"{name} of {factor:g} diameters at {np.round(at, 1).tolist()}")
    carina = _carina(tubes)
    notes.insert(0, f"{kind}{f' of type {number}' if kind == 'arch' else ''}, seed {seed}: {len(tubes)} tubes, edges "
                    f"between them rounded with {carina:.2g} mm")
    return mesh_of_tubes(tubes, carina), "mm", notes


def tubes_of(kind: str, number: int, seed: int) -> tuple[list[Tube], tuple[tuple[int, float], tuple[int, float]]]:
    """Return the tubes of an anatomy, mm, and where a stenosis and an aneurysm are: index of a tube, fraction of its
    length.
    """
    rng = np.random.default_rng([seed, number])
    while True:
        tubes, places = _KINDS[kind](rng, number)
        if _are_apart(tubes):
            return tubes, places


def name_of(kind: str, tubes: list[Tube], place: np.ndarray) -> str:
    """Return the name of the end of one of these tubes that a place (3,) is nearest to, or "" where ends of the kind
    have no names."""
    ends = np.array([tubes[0].points[0], *(tube.points[-1] for tube in tubes)])
    return _ENDS[kind][int(np.argmin(np.linalg.norm(ends - place, axis=1)))] if kind in _ENDS else ""


def _carina(tubes: list[Tube]) -> float:
    """Radius of curvature of the edges between tubes, mm."""
    return _CARINA * max(float(tube.radii.max()) for tube in tubes[1:])


def _are_apart(tubes: list[Tube]) -> bool:
    """Return whether walls that have parted stay farther apart than a carina is thick: the ball that rounds an edge
    does not fit between nearer ones, and their lumens would be joined there."""
    least = 2.0 * _carina(tubes)
    for k, tube in enumerate(tubes):
        for other in tubes[:k]:
            away, nearest = cKDTree(other.points).query(tube.points)
            is_apart = away - other.radii[nearest] - tube.radii > least
            if is_apart.any() and not is_apart[is_apart.argmax():].all():
                return False
    return True


def _arch(rng: np.random.Generator, number: int):
    ascending, middle = 0.5 * _normal(rng, 30.9, 4.1), 0.5 * _normal(rng, 27.7, 3.7)
    descending = min(0.5 * _normal(rng, 24.3, 3.5), middle)
    carotid = 0.5 * _normal(rng, 6.1, 0.8)
    bend = middle + rng.uniform(18.0, 26.0)  # radius of the arch's centreline
    up, down, back = rng.uniform(50.0, 70.0), rng.uniform(140.0, 180.0), rng.uniform(-35.0, -15.0)
    # Drop of the trunk's origin below the arch's top, in diameters of the left common carotid.
    drop = 2.0 * carotid * (number - 1.0 + rng.uniform(0.2, 0.9))
    angles = np.linspace(-np.pi / 2.0, np.pi / 2.0, 61)
    around = np.stack([bend * np.sin(angles), back * (angles / np.pi + 0.5), up + bend * np.cos(angles)], axis=1)
    line = np.concatenate([np.linspace([-bend, 0.0, 0.0], around[0], 20)[:-1], around,
                           np.linspace(around[-1], [bend, back, up - down], 40)[1:]])
    radii = np.interp(np.linspace(0.0, 1.0, len(line)), [0.0, 0.2, 0.45, 0.75, 1.0],
                      [ascending, ascending, middle, descending, descending])
    tubes = [Tube(line, radii, ends=(True, True))]
    # Heights of the outer curve from the arch's beginning to its top; the trunk leaves where it is so much lower.
    heights = up + (bend + radii[19:80]) * np.cos(angles)
    apex = int(np.argmax(heights))
    outer = float(heights[apex]) - up
    first = -float(np.interp(heights[apex] - drop, heights[:apex + 1], angles[:apex + 1]))
    spread = rng.uniform(0.30, 0.38)  # rad, between origins: 13 to 20 mm
    sizes = (0.5 * rng.uniform(11.0, 13.0), carotid, 0.5 * rng.uniform(8.5, 10.0))
    for k, radius in enumerate(sizes):
        angle = -first + k * spread
        origin = np.array([bend * np.sin(angle), back * (angle / np.pi + 0.5), up + bend * np.cos(angle)])
        lean = np.array([rng.uniform(-0.25, 0.05) + 0.12 * k, rng.uniform(-0.1, 0.15), 1.0])
        top = up + outer + (35.0 if k == 0 else 80.0)
        knots = [origin, origin + 0.5 * (top - origin[2]) * lean + rng.uniform(-3.0, 3.0, 3) * [1, 1, 0],
                 origin + (top - origin[2]) * lean]
        tubes.append(Tube(_spline(knots), np.full(40, radius), 0, (False, k > 0)))
    end = tubes[1].points[-1]
    for side, radius in ((np.array([-1.0, 0.1, 0.35]), 0.7 * sizes[0]), (np.array([-0.15, 0.05, 1.0]), carotid)):
        knots = [end, end + 20.0 * side / np.linalg.norm(side), end + 45.0 * side / np.linalg.norm(side) + [0, 0, 6.0]]
        tubes.append(Tube(_spline(knots), np.full(40, radius), 1))
    return tubes, ((2, 0.6), (0, 0.8))


def _iliac(rng: np.random.Generator, number: int):
    aorta, common = 0.5 * rng.uniform(15.0, 20.0), 0.5 * rng.uniform(8.5, 11.5)
    external, internal = 0.75 * common, 0.55 * common
    tubes = [Tube(np.linspace([0.0, 0.0, 80.0], [0.0, 0.0, 0.0], 40), np.full(40, aorta), ends=(True, False))]
    tubes[0].radii[-8:] = np.linspace(aorta, 0.85 * aorta, 8)
    for k, side in enumerate((-1.0, 1.0)):
        angle = np.radians(rng.uniform(20.0, 35.0))
        along = np.array([side * np.sin(angle), rng.uniform(-0.15, 0.15), -np.cos(angle)])
        fork = rng.uniform(45.0, 60.0) * along
        tubes.append(Tube(_spline([0.0 * fork, 0.5 * fork + [0.0, rng.uniform(-3.0, 3.0), 0.0], fork]),
                          np.full(40, common), 0, (False, False)))
        turn = rng.uniform(20.0, 35.0)
        tubes.append(Tube(_spline([fork, fork + turn * along + [0.0, 4.0, 0.0],
                                   fork + 2.2 * turn * along + [side * 6.0, 16.0, 0.0]]), np.full(40, external),
                          1 + 3 * k))
        tubes.append(Tube(_spline([fork, fork + [side * 4.0, -10.0, -14.0], fork + [side * 2.0, -22.0, -32.0]]),
                          np.full(40, internal), 1 + 3 * k))
    return tubes, ((2, 0.5), (0, 0.45))


def _siphon(rng: np.random.Generator, number: int):
    radius = 0.5 * _normal(rng, 4.7, 0.8)
    knee = radius + rng.uniform(2.2, 4.0)  # radius of the anterior bend's centreline
    rise, run, width = rng.uniform(10.0, 14.0), rng.uniform(10.0, 15.0), rng.uniform(-2.0, 2.0)
    knots = [[0.0, 0.0, -40.0], [0.0, 0.0, -20.0], [0.0, 1.0, -4.0], [-6.0, 6.0, 4.0], [-14.0, 13.0, 5.0],
             [-17.0, 15.0, 5.0 + 0.5 * rise], [-17.5 + width, 18.0, 5.0 + rise],
             [-18.0 + width, 18.0 + run, 7.0 + rise], [-18.0, 18.0 + run + knee, 7.0 + rise + knee],
             [-18.0 - width, 18.0 + run, 7.0 + rise + 2.0 * knee], [-19.0, 12.0 + run, 10.0 + rise + 2.0 * knee]]
    line = _spline(knots, 120)
    radii = radius * np.interp(np.linspace(0.0, 1.0, 120), [0.0, 0.5, 1.0], [1.0, 0.95, 0.8])
    tubes = [Tube(line, radii, ends=(True, False))]
    end = line[-1]
    for side, size in (([22.0, 2.0, 3.0], 0.6), ([-12.0, 8.0, 4.0], 0.48)):
        along = np.array(side)
        tubes.append(Tube(_spline([end, end + 0.5 * along + [0.0, 0.0, 2.0], end + along]), np.full(40, size * radius),
                          0))
    return tubes, ((1, 0.5), (0, 0.62))


def _coronary(rng: np.random.Generator, number: int):
    main, first, last = (0.5 * _normal(rng, *size) for size in ((4.5, 0.5), (3.7, 0.4), (1.9, 0.4)))
    first = min(first, main)
    around = min(0.5 * _normal(rng, 3.4, 0.5), main)
    angle = np.radians(_normal(rng, 80.0, 27.0))
    length = rng.uniform(8.0, 14.0)
    fork = np.array([length, 0.0, 0.0])
    tubes = [Tube(np.linspace([0.0, 0.0, 0.0], fork, 20), np.full(20, main), ends=(True, False))]
    for size, ends, side, extent in ((first, last, 1.0, rng.uniform(85.0, 110.0)),
                                     (around, 0.6 * around, -1.0, rng.uniform(50.0, 65.0))):
        way = np.array([np.cos(0.5 * angle), side * np.sin(0.5 * angle), -0.25])
        bow = np.array([0.15 * extent, -side * 0.1 * extent, -0.55 * extent])
        line = _spline([fork, fork + 0.3 * extent * way, fork + 0.6 * extent * way + 0.4 * bow,
                        fork + 0.75 * extent * way + bow], 80)
        tubes.append(Tube(line, np.linspace(size, ends, 80), 0))
    for parent, place in ((1, 0.3), (1, 0.55), (2, 0.45)):
        at = int(place * 79)
        origin, along = tubes[parent].points[at], tubes[parent].points[at + 1] - tubes[parent].points[at]
        along /= np.linalg.norm(along)
        off = np.cross(along, [0.0, 0.0, 1.0]) * (1.0 if parent == 2 else -1.0)
        way = np.cos(np.radians(50.0)) * along + np.sin(np.radians(50.0)) * off / np.linalg.norm(off)
        extent = rng.uniform(25.0, 40.0)
        size = 0.7 * float(tubes[parent].radii[at])
        tubes.append(Tube(_spline([origin, origin + 0.5 * extent * way, origin + extent * way + [0.0, 0.0, -8.0]]),
                          np.linspace(size, 0.8 * size, 40), parent))
    return tubes, ((1, 0.2), (2, 0.25))


_KINDS: dict[str, Callable] = {"arch": _arch, "iliac": _iliac, "siphon": _siphon, "coronary": _coronary}


def _normal(rng: np.random.Generator, mean: float, deviation: float) -> float:
    return mean + deviation * float(np.clip(rng.standard_normal(), -2.0, 2.0))


def _spline(knots, count: int = 40) -> np.ndarray:
    """Return points at even steps on a cubic through knots."""
    knots = np.asarray(knots, dtype=float)
    arc = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(knots, axis=0), axis=1))]
    line = CubicSpline(arc, knots)(np.linspace(0.0, arc[-1], 8 * count))
    steps = float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum())
    return resample(line, steps / (count - 1))


def _changed(tube: Tube, place: float, factor: float) -> Tube:
    """Return a tube that is narrower or wider around a place, over three diameters on each side, smoothly."""
    arc = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(tube.points, axis=0), axis=1))]
    centre = place * arc[-1]
    reach = min(6.0 * float(np.interp(centre, arc, tube.radii)), 0.9 * centre, 0.9 * (arc[-1] - centre))
    bump = 0.5 * (1.0 + np.cos(np.pi * np.clip((arc - centre) / reach, -1.0, 1.0)))
    return Tube(tube.points, tube.radii * (1.0 + (factor - 1.0) * bump), tube.parent, tube.ends)

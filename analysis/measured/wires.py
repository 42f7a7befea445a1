"""Three electric wires: identified from hanging loops and from the twist at which these snap, then predicted between
clamps in space.

Data: repository qj25/adapteddlo_muj at 6ed3708 (MIT licence, hanging-wires/LICENSE), of arXiv 2310.00911. A loop is a
wire of 1.5 m hung from two clamps 0.12 m apart, 51 points of a photograph, digitised five times; y points down. A pose
is a wire of 0.4 m between two clamps in space, 11 points of a depth camera. The authors' two simulations of each pose
give the places and directions of its clamps.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from guidewire.identification import Identified, identify
from guidewire.identification.trials import Trials
from guidewire.logs.curves import by_arc
from guidewire.logs.logs import LogError, read_log
from guidewire.runs import building

DATA = Path(__file__).with_name("hanging-wires")
LOOP, POSE = 1.5, 0.4    # m, lengths
LOOP_ELEMENTS, POSE_ELEMENTS = 80, 40
GRAVITY = 9.81
TURNS = (2.0 * math.pi, -4.0 * math.pi, 2.0 * math.pi, -4.0 * math.pi)    # of an end, by pose
COUNTED = (0, 1, 2)    # poses; 3 comes near contact with itself
PEERS = {"adapt": "authors' discrete elastic rods", "native": "MuJoCo's cable"}
_SPAN = 0.12    # m, between the clamps of a loop


@dataclass(frozen=True)
class Wire:
    """A wire: kg/m, degrees of the twists at which its loop left its plane, and N m2 to start from."""

    name: str
    line_density: float
    twists: tuple[float, ...]
    guess: float


WIRES = (Wire("white", 0.087 / 5.0, (970.0, 970.0, 980.0, 975.0, 980.0), 1.2e-4),
         Wire("black", 0.081 / 2.98, (470.0, 500.0, 480.0, 470.0, 490.0), 6e-4), Wire("red", 0.043 / 2.0, (), 6e-4))


def fit_loop(wire: Wire, number: int, with_curvature: bool = False) -> Identified:
    """Return EI and the two angles of the clamps, and a curvature of the wire's own, from one digitisation."""
    points = _table(f"loop_{wire.name}_{number}.csv")
    keys = ["bendingStiffness", "start.proximalFrame.z", "start.distalFrame.z"]
    return _identify(loop_scene(wire, points[-1]), "x_m,y_m", points, keys + ["restCurvature[0]"] * with_curvature)


def fit_twist(wire: Wire, bending: float, angles: tuple[float, float]) -> Identified:
    """Return GJ from the five twists, with the EI and the clamps of the loops."""
    scene = loop_scene(wire, np.array([-_SPAN, 0.0]), bending, angles)
    return _identify(scene, "critical distalRotation_deg", np.array(wire.twists)[:, None], ["torsionalStiffness"])


def loop_scene(wire: Wire, end: np.ndarray, bending: float | None = None, angles: tuple[float, float] = (0.2, -0.2)
               ) -> dict[str, Any]:
    """Return a loop at rest that starts as half of an ellipse.

    Parameters
    ----------
    end : (2,), the second clamp, the first at the origin, m.
    angles : of the tangents at the clamps from the x axis, rad.
    """
    t = np.linspace(0.0, np.pi, 2001)
    width = 0.06 + 0.05 * np.sin(t)
    line = np.stack([width * np.cos(t), 0.7 * np.sin(t), 0.0 * t], axis=1)
    nodes = by_arc(line - line[0], np.linspace(0.0, 1.0, LOOP_ELEMENTS + 1))
    nodes[-1, :2] = end
    frames = [_in_plane(math.atan2(chord[1], chord[0])) for chord in np.diff(nodes, axis=0)]
    stiffness = bending or wire.guess
    return {**_scene(wire, LOOP, LOOP_ELEMENTS), "bendingStiffness": stiffness, "torsionalStiffness": stiffness,
            "gravity": [0.0, GRAVITY, 0.0],
            "start": {"positions": (1e3 * nodes).tolist(), "orientations": frames,
                      "proximalFrame": _in_plane(angles[0]), "distalFrame": _in_plane(angles[1])}}


def predict(wire: Wire, pose: int, bending: float, torsion: float) -> np.ndarray:
    """Nodes (n + 1, 3), m, of a pose: nothing but the clamps is taken from it."""
    peer = _table(f"peer_adapt_{wire.name}_{pose}.csv")
    first, last = _tangent(peer[:3]), -_tangent(peer[:-4:-1])
    nodes = between(peer[0], first, peer[-1], last)
    frame = _turn(np.array([0.0, 0.0, 1.0]), first)
    carried, frames, along = frame, [], first
    for chord in np.diff(nodes, axis=0):
        chord = chord / np.linalg.norm(chord)
        carried, along = _turn(along, chord) * carried, chord
        frames.append(carried.as_quat().tolist())
    scene = {**_scene(wire, POSE, POSE_ELEMENTS), "bendingStiffness": bending, "torsionalStiffness": torsion,
             "gravity": [0.0, 0.0, -GRAVITY], "distalRotation": TURNS[pose], "maxNewtonIterations": 2000,
             "start": {"positions": (1e3 * nodes).tolist(), "orientations": frames,
                       "proximalFrame": frame.as_quat().tolist(),
                       "distalFrame": (_turn(first, last) * frame).as_quat().tolist()}}
    with Trials(building.build(building.RUNNER, print), None, scene, 1) as trials:
        (folder,) = trials.run([{}])
        if isinstance(folder, str):
            raise LogError(f"{wire.name}, pose {pose}: {folder}")
        return 1e-3 * read_log(folder, spheres="all").positions[-1]


def peer_of(wire: Wire, pose: int, name: str) -> np.ndarray:
    """Nodes (51, 3), m, of one of the authors' simulations."""
    return _table(f"peer_{name}_{wire.name}_{pose}.csv")


def miss(wire: Wire, pose: int, nodes: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
    """Mean distance, m, of the 11 measured points from points at equal parts of the arc, after the best rigid
    alignment; and both sets of points."""
    measured = _table(f"pose_{wire.name}_{pose}.csv")
    line = by_arc(nodes, np.linspace(0.0, 1.0, len(measured)))
    a, b = measured.mean(axis=0), line.mean(axis=0)
    turn, _ = Rotation.align_vectors(line - b, measured - a)
    moved = turn.apply(measured - a) + b
    return float(np.mean(np.linalg.norm(moved - line, axis=1))), moved, line


def measured_length(wire: Wire, pose: int) -> float:
    """Of the camera's points, m: a wire of 0.4 m, so that what is missing is the camera's own error."""
    return float(np.sum(np.linalg.norm(np.diff(_table(f"pose_{wire.name}_{pose}.csv"), axis=0), axis=1)))


def between(start: np.ndarray, first: np.ndarray, end: np.ndarray, last: np.ndarray) -> np.ndarray:
    """Nodes of a cubic of the wire's length between two clamps, from which the search of the rest begins."""
    s = np.linspace(0.0, 1.0, 401)[:, None]

    def cubic(reach: float) -> np.ndarray:
        return ((2 * s**3 - 3 * s**2 + 1) * start + (s**3 - 2 * s**2 + s) * reach * first
                + (-2 * s**3 + 3 * s**2) * end + (s**3 - s**2) * reach * last)

    def excess(reach: float) -> float:
        return float(np.sum(np.linalg.norm(np.diff(cubic(reach), axis=0), axis=1))) - POSE

    reaches = np.linspace(0.05, 3.0, 60)
    signs = [excess(reach) for reach in reaches]
    k = next(k for k in range(len(signs) - 1) if signs[k] * signs[k + 1] < 0.0)
    return by_arc(cubic(brentq(excess, reaches[k], reaches[k + 1])), np.linspace(0.0, 1.0, POSE_ELEMENTS + 1))


def _scene(wire: Wire, length: float, elements: int) -> dict[str, Any]:
    # The radius is that of a wire as stiff along its axis as one that does not stretch; nothing touches it.
    return {"solver": "direct", "metresPerUnit": 0.001, "guidewireLength": 1e3 * length, "guidewireOffset": 0.0,
            "numberRodElements": elements, "wireRadius": 0.0003, "massPerLength": wire.line_density,
            "restCurvature": [0.0, 0.0, 0.0], "proximalEnd": "clamped", "distalEnd": "clamped",
            "initialState": "equilibrium", "maxSimulationSteps": 0}


def _identify(scene: dict[str, Any], header: str, rows: np.ndarray, keys: list[str],
              tell: Callable[[str], None] = lambda line: None) -> Identified:
    with tempfile.TemporaryDirectory(prefix="guidewire-measured-") as folder:
        file = Path(folder) / "measured.csv"
        file.write_text("\n".join([header, *(",".join(map(repr, map(float, row))) for row in rows)]), encoding="utf-8")
        return identify(scene, file, keys, tell=tell)


def _table(name: str) -> np.ndarray:
    return np.loadtxt(DATA / name, delimiter=",", skiprows=1)


def _in_plane(angle: float) -> list[float]:
    """Return the frame along a direction of the plane whose first director is the plane's normal."""
    third, first = np.array([math.cos(angle), math.sin(angle), 0.0]), np.array([0.0, 0.0, 1.0])
    return Rotation.from_matrix(np.stack([first, np.cross(third, first), third], axis=1)).as_quat().tolist()


def _turn(a: np.ndarray, b: np.ndarray) -> Rotation:
    """Return the shortest turn of one direction into another."""
    return Rotation.from_quat(np.append(np.cross(a, b), 1.0 + a @ b))


def _tangent(nodes: np.ndarray) -> np.ndarray:
    """Return the tangent at the first of three nodes, to second order."""
    one, two = (chord / np.linalg.norm(chord) for chord in np.diff(nodes, axis=0))
    made = one + 0.5 * (one - two)
    return made / np.linalg.norm(made)

"""What the voxels of a mask cost a wire's path: tip and hub force in a bend, against the exact tube.

    python3 guidewire.py python experiments/voxel_bias.py [RADII] [DRAWS]

A lumen of 3 mm radius goes straight for 30 mm, round a bend of 90 degrees and 40 mm radius, and on for 25 mm. It is
voxelised with voxels of 3 mm over each of the radii ("1,1.5,2,3,4,6"), at random places between them, made into a wall
by `anatomy`, and a wire of 0.36 mm with friction is pushed 100 mm into it. The same is done in the tube given by
numbers. Printed are differences of the tip's place (mm) and of the hub's force (of the exact one, mean over the last
20 mm), their mean and largest over the draws.
"""

from __future__ import annotations

import contextlib
import io
import json
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.logs.logs import read_columns, read_log
from guidewire.prepare import ROOT
from guidewire.runs import building
from guidewire.runs.runner import Request, Runner

RADIUS, BEND, LEGS = 3.0, 40.0, (30.0, 25.0)    # mm
SCENE: dict[str, Any] = {
    "solver": "direct", "integrator": "implicitEuler", "guidewireLength": 150.0, "numberRodElements": 75,
    "guidewireOffset": -144.0, "wireRadius": 0.00018, "youngsModulus": 60e9, "shearModulus": 23e9, "density": 6450.0,
    "massDamping": 20.0, "proximalEnd": "clamped", "drive": "displace", "insertionSpeed": 0.02, "sheath": {},
    "timeStep": 0.02, "deltaThreshold": 0.0, "maxSimulationSteps": 250, "logHub": True, "contactDistance": 2e-5,
}
FRICTION = {"frictionCoefficient": 0.1}


def axis() -> np.ndarray:
    """Points of the axis, (k, 3) in mm: along z, then round a bend to y."""
    angles = np.linspace(0.0, 0.5 * np.pi, 91)
    arc = np.stack([0.0 * angles, BEND * (1.0 - np.cos(angles)), LEGS[0] + BEND * np.sin(angles)], axis=1)
    return np.concatenate([[[0.0, 0.0, 0.0]], arc, [arc[-1] + [0.0, LEGS[1], 0.0]]])


def distance(points: np.ndarray) -> np.ndarray:
    """Distance of points (..., 3) from the axis, which goes on straight beyond its ends, mm."""
    x, y, z = np.moveaxis(points, -1, 0)
    round_y, round_z = y - BEND, z - LEGS[0]
    ring = np.hypot(np.hypot(round_y, round_z) - BEND, x)
    in_bend = (round_y <= 0.0) & (round_z >= 0.0)
    along_z, along_y = np.hypot(x, y), np.hypot(x, z - LEGS[0] - BEND)
    return np.where(in_bend, ring, np.where(round_z < 0.0, along_z, along_y))


def write_mask(file: Path, side: float, shift: np.ndarray) -> None:
    """Write the lumen in voxels of a side; the image's borders cut both ends."""
    low = np.array([-RADIUS - 3 * side, -RADIUS - 3 * side, 0.0]) + side * shift * [1.0, 1.0, 0.0] + 0.5 * side
    high = np.array([RADIUS + 3 * side, BEND + LEGS[1], LEGS[0] + BEND + RADIUS + 3 * side])
    sizes = np.ceil((high - low) / side).astype(int)
    places = low + side * np.indices(sizes).transpose(1, 2, 3, 0)
    file.write_bytes((f"NRRD0005\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\nsizes: "
                      f"{' '.join(map(str, sizes))}\nspace directions: ({side},0,0) (0,{side},0) (0,0,{side})\n"
                      f"encoding: raw\nspace origin: ({','.join(map(str, low))})\n\n").encode()
                     + (distance(places) < RADIUS).astype("u1").ravel(order="F").tobytes())


def pushed(runner: Runner, out: Path, vessel: dict[str, Any]) -> tuple[np.ndarray, float]:
    """Tip at the end, mm, and mean force of the hub over the last 20 mm, N."""
    answer = runner.run(Request(out.name, None, out, {**SCENE, "vessel": {**vessel, **FRICTION}}))
    if answer.exit_code != 0:
        raise SystemExit(f"{out.name}: {answer.message}")
    hub = read_columns(out, ["hubForce", "hubInsertion"])
    last = hub["hubInsertion"] > hub["hubInsertion"][-1] - 0.02
    return read_log(out).final_positions[-1], float(hub["hubForce"][last].mean())


def main() -> None:
    """Print the table."""
    from guidewire.commands import commands

    radii = [float(word) for word in (sys.argv[1] if len(sys.argv) > 1 else "1,1.5,2,3,4,6").split(",")]
    draws = int(sys.argv[2]) if len(sys.argv) > 2 else 3
    random = np.random.default_rng(1)
    runner = Runner(building.build(building.RUNNER, lambda line: None), ROOT)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        tip, force = pushed(runner, folder / "exact", {"shape": "tube", "knots": axis().tolist(), "radius": RADIUS,
                                                       "smooth": True, "openStart": True, "openEnd": True})
        print(f"exact tube: tip at {tip.round(3).tolist()} mm, force {force:.4f} N")
        print("| radius, voxels | tip, mm | hub force |\n|---|---|---|")
        for radius in radii:
            found = []
            for draw in range(draws):
                place = folder / f"{radius}-{draw}"
                write_mask(folder / "mask.nrrd", RADIUS / radius, random.random(3))
                arguments = commands.parse(["anatomy", str(folder / "mask.nrrd"), "--out", str(place), "--force"])
                with contextlib.redirect_stdout(io.StringIO()):
                    code = commands.run(arguments)
                if code != 0:
                    raise SystemExit(f"{place.name}: no vessel")
                at, own = pushed(runner, folder / f"{place.name}-run", {
                    "shape": "mesh", "file": str(place / "vessel.obj"), "anatomy": str(place / "anatomy.json")})
                found.append((np.linalg.norm(at - tip), own / force - 1.0))
                print(json.dumps([radius, draw, *map(float, found[-1])]), file=sys.stderr, flush=True)
            ways, forces = np.array(found).T
            print(f"| {radius:g} | {ways.mean():.2f}, at most {ways.max():.2f} | {forces.mean():+.1%}, "
                  f"{forces[np.abs(forces).argmax()]:+.1%} |", flush=True)
    runner.close()


if __name__ == "__main__":
    main()

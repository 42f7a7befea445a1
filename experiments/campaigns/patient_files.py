"""Twenty vessels as files of scanners and of other programs have them: meshes open and closed, masks in several axes,
lines; with staircases, a neck, a stent, a loop, two walls that touch. Of each the truth is known: its centreline."""

from __future__ import annotations

import gzip
import struct
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from guidewire.anatomy.mesh import Edges, Mesh, close_rims, find_rims
from guidewire.anatomy.sampling import resample
from guidewire.anatomy.shapes import make, tubes_of
from guidewire.anatomy.surfaces import contour

LPS = {"R": -1.0, "L": 1.0, "A": -1.0, "P": 1.0, "I": -1.0, "S": 1.0}


@dataclass(frozen=True)
class Patient:
    """file : as it was written; axes : of the vessel that is to come of it, "LPS" or "" where the file does not say
    them; truth : (k, 4), points and radii of its centreline, mm, in these axes; voxel : mm, 0 of a mesh."""

    file: Path
    axes: str
    truth: np.ndarray
    voxel: float = 0.0


def write(folder: Path, chosen: Callable[[str], bool] = lambda name: True) -> Iterator[Patient]:
    """One after the other, all of them or those whose names are chosen."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, made in _PATIENTS.items():
        if chosen(name):
            yield made(folder / name)


def _lines(kind: str, number: int, seed: int) -> list[np.ndarray]:
    return [np.column_stack([tube.points, tube.radii]) for tube in tubes_of(kind, number, seed)[0]]


def _mesh(kind: str, number: int, seed: int, is_closed: bool = False, scale: float = 1.0,
          stenosis: float | None = None):
    def made(file: Path) -> Patient:
        mesh, _, _ = make(kind, number, seed, stenosis, None)
        mesh = mesh.turned()
        if is_closed:
            mesh = close_rims(mesh, find_rims(mesh, Edges.of(mesh)))
        _write_mesh(file, Mesh(scale * mesh.vertices, mesh.triangles))
        lines = np.concatenate(_lines(kind, number, seed))
        return Patient(file, "", lines if stenosis is None else lines[:0])

    return made


def _write_mesh(file: Path, mesh: Mesh) -> None:
    if file.suffix == ".stl":
        rows = np.zeros(len(mesh.triangles), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("end", "<u2")])
        rows["corners"] = mesh.corners
        file.write_bytes(b"\0" * 80 + struct.pack("<I", len(rows)) + rows.tobytes())
    elif file.suffix == ".obj":
        file.write_text("".join(f"v {x:.6g} {y:.6g} {z:.6g}\n" for x, y, z in mesh.vertices)
                        + "".join(f"f {a}// {b}// {c}//\n" for a, b, c in mesh.triangles + 1))
    else:
        file.write_text(f"ply\nformat ascii 1.0\nelement vertex {len(mesh.vertices)}\nproperty float x\nproperty "
                        f"float y\nproperty float z\nelement face {len(mesh.triangles)}\nproperty list uchar int "
                        "vertex_indices\nend_header\n" + "".join(f"{x:.6g} {y:.6g} {z:.6g}\n" for x, y,
                                                                 z in mesh.vertices)
                        + "".join(f"3 {a} {b} {c}\n" for a, b, c in mesh.triangles))


def _voxels(lines: list[np.ndarray], side: float) -> tuple[np.ndarray, np.ndarray]:
    """Voxels within spheres along lines, mm, and where the first one is."""
    fine = []
    for line in lines:
        points = resample(line[:, :3], 0.4 * side)
        arc = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(line[:, :3], axis=0), axis=1))]
        fine.append(np.column_stack([points, np.interp(np.linspace(0.0, arc[-1], len(points)), arc, line[:, 3])]))
    every = np.concatenate(fine)
    low = (every[:, :3] - every[:, 3:]).min(axis=0) - 2.0 * side
    shape = np.ceil(((every[:, :3] + every[:, 3:]).max(axis=0) - low) / side).astype(int) + 3
    inside = np.zeros(tuple(shape), dtype=bool)
    for *point, radius in every:
        first = np.floor((point - radius - low) / side).astype(int)
        last = np.ceil((point + radius - low) / side).astype(int) + 1
        box = tuple(slice(a, b) for a, b in zip(first, last))
        grid = np.stack(np.meshgrid(*(low[k] + side * np.arange(first[k], last[k]) for k in range(3)), indexing="ij"),
                        -1)
        inside[box] |= ((grid - point) ** 2).sum(axis=-1) < radius * radius
    return inside, low


def _mask(lines: Callable[[], list[np.ndarray]], side: float, letters: str = "LPS", change=None):
    """A mask whose voxels run along axes of the patient."""
    def made(file: Path) -> Patient:
        own = lines()
        inside, low = _voxels(own, side)
        if change is not None:
            change(inside)
        values = inside.astype(np.uint8)
        steps, origin = np.zeros((3, 3)), low.copy()
        for axis, letter in enumerate(letters):
            along = "LPS".index({"R": "L", "A": "P", "I": "S"}.get(letter, letter))
            steps[axis, along] = side * LPS[letter]
            if LPS[letter] < 0.0:
                origin[along] += side * (inside.shape[along] - 1)
                values = np.flip(values, along)
        values = values.transpose([int(np.flatnonzero(step)[0]) for step in steps])
        (_write_nifti if file.name.endswith(".gz") else _write_nrrd)(file, values, steps, origin, letters)
        return Patient(file, "LPS", np.concatenate(own), side)

    return made


def _write_nrrd(file: Path, values: np.ndarray, steps: np.ndarray, origin: np.ndarray, letters: str) -> None:
    """Write it in the axes of its letters, where these are a space that NRRD knows, else in LPS."""
    words = {"RAS": "right-anterior-superior", "LAS": "left-anterior-superior"}
    signs = np.array([LPS["L" if letter in "LR" else letter] for letter in "LPS"])
    if letters in words:
        signs = np.array([LPS[letter] for letter in letters])
    def text(vector: np.ndarray) -> str:
        return "(" + ",".join(f"{number:.6g}" for number in vector * signs) + ")"
    head = (f"NRRD0004\ntype: short\ndimension: 3\nsizes: {' '.join(map(str, values.shape))}\nencoding: "
            f"gzip\nendian: big\nspace: {words.get(letters, 'left-posterior-superior')}\nspace directions: "
            f"{' '.join(map(text, steps))}\nspace origin: {text(origin)}\n\n")
    file.write_bytes(head.encode() + gzip.compress(values.astype(">i2").ravel(order="F").tobytes()))


def _write_nifti(file: Path, values: np.ndarray, steps: np.ndarray, origin: np.ndarray, letters: str) -> None:
    head = bytearray(352)
    struct.pack_into("<i", head, 0, 348)
    struct.pack_into("<8h", head, 40, 3, *values.shape, 1, 1, 1, 1)
    struct.pack_into("<2h", head, 70, 512, 16)
    struct.pack_into("<3f", head, 108, 352.0, 1.0, -1024.0)
    head[123] = 2
    struct.pack_into("<2h", head, 252, 0, 1)
    to_ras = np.column_stack([steps.T, origin]) * np.array([[-1.0], [-1.0], [1.0]])
    struct.pack_into("<12f", head, 280, *to_ras.ravel())
    head[344:348] = b"n+1\0"
    file.write_bytes(gzip.compress(bytes(head) + (values.astype("<u2") + 1024).ravel(order="F").tobytes()))


def _staircase(file: Path) -> Patient:
    """The surface of voxels as marching cubes leave it."""
    lines = _lines("iliac", 1, 7)
    inside, low = _voxels(lines, 1.0)
    _write_mesh(file, contour(inside.astype(np.float32), 0.5, low, 1.0))
    return Patient(file, "", np.concatenate(lines), 1.0)


def _tree(file: Path) -> Patient:
    """Lines with radii from one inlet, the trunk in each."""
    tubes = tubes_of("coronary", 1, 12)[0]
    paths = []
    for tube in tubes[1:3]:
        paths.append(np.vstack([np.column_stack([tubes[0].points, tubes[0].radii]),
                                np.column_stack([tube.points, tube.radii])[1:]]))
    every, borders = np.concatenate(paths), np.cumsum([len(path) for path in paths])
    file.write_text(
        '<?xml version="1.0"?>\n<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>'
        f'<Piece NumberOfPoints="{len(every)}" NumberOfVerts="0" NumberOfLines="{len(paths)}" NumberOfStrips="0" '
        'NumberOfPolys="0"><PointData><DataArray type="Float64" Name="MaximumInscribedSphereRadius" format="ascii">'
        + " ".join(f"{radius:.6g}" for radius in every[:, 3]) + '</DataArray></PointData><Points><DataArray '
                                                                'type="Float64" '
        'NumberOfComponents="3" format="ascii">' + " ".join(f"{number:.6g}" for number in every[:, :3].ravel())
        + '</DataArray></Points><Lines><DataArray type="Int64" Name="connectivity" format="ascii">'
        + " ".join(map(str, range(len(every)))) + '</DataArray><DataArray type="Int64" Name="offsets" format="ascii">'
        + " ".join(map(str, borders)) + "</DataArray></Lines></Piece></PolyData></VTKFile>\n")
    return Patient(file, "", every)


def _capsules(*parts: tuple[list[float], list[float], float]) -> Callable[[], list[np.ndarray]]:
    return lambda: [np.column_stack([resample(np.array([start, end], float), 0.5) if start != end else
                                     np.array([start, start], float),
                                     np.full(len(resample(np.array([start, end], float), 0.5)) if start != end else 2,
                                             radius)]) for start, end, radius in parts]


def _struts(inside: np.ndarray) -> None:
    """A stent: every fourth slice, in its middle part, loses its outermost voxels."""
    for k in range(inside.shape[2] // 3, 2 * inside.shape[2] // 3, 4):
        own = inside[:, :, k]
        core = own.copy()
        for axis in (0, 1):
            core &= np.roll(own, 1, axis) & np.roll(own, -1, axis)
        inside[:, :, k] = core


_RING = [([0, 0, 10], [s * 9, 0, 19], 1.8) for s in (1, -1)] + [([s * 9, 0, 19], [s * 9, 0, 29], 1.8)
                                                                for s in (1, -1)] + [
    ([s * 9, 0, 29], [0, 0, 38], 1.8) for s in (1, -1)]
_PATIENTS: dict[str, Callable[[Path], Patient]] = {
    "arch-1.stl": _mesh("arch", 1, 21),
    "arch-2.nii.gz": _mask(lambda: _lines("arch", 2, 22), 1.0, "RAS"),
    "arch-3-closed.obj": _mesh("arch", 3, 23, is_closed=True),
    "arch-1-las.nrrd": _mask(lambda: _lines("arch", 1, 24), 1.0, "LAS"),
    "siphon.stl": _mesh("siphon", 1, 21),
    "siphon-closed.ply": _mesh("siphon", 1, 22, is_closed=True),
    "siphon-mask.nrrd": _mask(lambda: _lines("siphon", 1, 23), 0.4, "RAS"),
    "siphon-stenosis.ply": _mesh("siphon", 1, 24, stenosis=0.6),
    "iliac.obj": _mesh("iliac", 1, 21),
    "iliac-mask.nii.gz": _mask(lambda: _lines("iliac", 1, 22), 0.8, "LPS"),
    "iliac-turned.nrrd": _mask(lambda: _lines("iliac", 1, 23), 0.8, "SLA"),
    "iliac-closed-m.stl": _mesh("iliac", 1, 24, is_closed=True, scale=1e-3),
    "coronary.stl": _mesh("coronary", 1, 21),
    "coronary-mask.nrrd": _mask(lambda: _lines("coronary", 1, 22), 0.3),
    "coronary-lines.vtp": _tree,
    "staircase.stl": _staircase,
    "neck.nrrd": _mask(_capsules(([0, 0, 0], [0, 0, 46], 2.0), ([0, 0, 24], [5.5, 0, 24], 1.1),
                                 ([8, 0, 24], [8, 0, 24], 4.0)), 0.6, "RAS"),
    "stent.nii.gz": _mask(_capsules(([0, 0, 0], [0, 0, 40], 3.0), ([0, 0, 40], [8, 3, 66], 2.2),
                                    ([0, 0, 40], [-8, 2, 64], 1.8)), 0.5, "RAS", _struts),
    "loop.nrrd": _mask(_capsules(([0, 0, 0], [0, 0, 10], 2.2), ([0, 0, 38], [0, 0, 47], 2.2), *_RING), 0.6, "LAS"),
    "kissing.nrrd": _mask(_capsules(([0, 0, 0], [0, 0, 20], 3.0), ([0, 0, 20], [8, 0, 34], 2.0),
                                    ([0, 0, 20], [-8, 0, 34], 2.0), ([8, 0, 34], [2.0, 0, 50], 2.0),
                                    ([-8, 0, 34], [-2.0, 0, 50], 2.0), ([2.0, 0, 50], [9, 0, 70], 2.0),
                                    ([-2.0, 0, 50], [-9, 0, 68], 2.0)), 0.6, "RAS"),
}
NAMES = tuple(_PATIENTS)

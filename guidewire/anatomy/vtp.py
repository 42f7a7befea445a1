"""Writes VTK's polygonal data in XML (.vtp), which ParaView and 3D Slicer open: numpy alone, no VTK.

Arrays stand in the file itself, as base64 of their length (8 bytes) and their bytes, lowest first.
https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
"""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np

from guidewire.runs.whole_files import write_whole

_TYPES = {"f": ("Float64", "<f8"), "i": ("Int64", "<i8"), "u": ("Int64", "<i8"), "b": ("UInt8", "u1")}


def write_vtp(path: Path, points: np.ndarray, lines: Sequence[np.ndarray] = (), triangles: np.ndarray | None = None,
              at_points: Mapping[str, np.ndarray] = {}, of_cells: Mapping[str, np.ndarray] = {},
              space: str = "") -> None:
    """Write lines or triangles.

    Parameters
    ----------
    points : ndarray (k, 3).
    lines : of each the indices of its points.
    triangles : ndarray of int (t, 3).
    at_points, of_cells : by name, ndarrays (k,) or (k, 3), and the same of the cells, lines first.
    space : "LPS" or "RAS", for 3D Slicer; empty where it is not known.
    """
    faces = np.empty((0, 3), dtype=np.int64) if triangles is None else triangles
    ends = np.cumsum([len(line) for line in lines], dtype=np.int64)
    index = np.concatenate(lines).astype(np.int64) if len(lines) else np.empty(0, np.int64)
    field = (f'<FieldData><Array type="String" Name="SPACE" NumberOfTuples="1" format="ascii">'
             f'{" ".join(str(ord(letter)) for letter in space)} 0</Array></FieldData>' if space else "")
    parts = [
        '<?xml version="1.0"?>', f"<!-- SPACE={space} -->" if space else "",
        '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64"><PolyData>', field,
        f'<Piece NumberOfPoints="{len(points)}" NumberOfVerts="0" NumberOfLines="{len(lines)}" NumberOfStrips="0" '
        f'NumberOfPolys="{len(faces)}">',
        *_block("PointData", at_points), *_block("CellData", of_cells),
        "<Points>", _array("Points", np.asarray(points, dtype=float)), "</Points>",
        *_block("Lines", {"connectivity": index, "offsets": ends}),
        *_block("Polys", {"connectivity": faces.ravel(), "offsets": 3 * np.arange(1, len(faces) + 1)}),
        "</Piece></PolyData></VTKFile>",
    ]
    write_whole(path, "\n".join(part for part in parts if part) + "\n")


def _block(name: str, arrays: Mapping[str, np.ndarray]) -> list[str]:
    return [f"<{name}>", *(_array(key, np.asarray(values)) for key, values in arrays.items()), f"</{name}>"]


def _array(name: str, values: np.ndarray) -> str:
    kind, stored = _TYPES[values.dtype.kind]
    data = np.ascontiguousarray(values, dtype=stored).tobytes()
    width = values.shape[1] if values.ndim > 1 else 1
    text = base64.b64encode(len(data).to_bytes(8, "little") + data).decode("ascii")
    return (f'<DataArray type="{kind}" Name={quoteattr(name)} NumberOfComponents="{width}" format="binary">{text}'
            "</DataArray>")

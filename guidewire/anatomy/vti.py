"""Voxels of VTK's image data in XML (.vti)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from guidewire.anatomy.mesh import AnatomyError
from guidewire.anatomy.voxels import Voxels, check_count
from guidewire.anatomy.vtk_files import read_by_vtk


def read_vti(file: Path) -> Voxels:
    """Voxels in axes and a unit that the file does not name.

    Values at points lie there; values of cells lie in the middle of the cells.

    Raises
    ------
    AnatomyError : one line that says what is wrong with the file.
    """
    from vtkmodules.util.numpy_support import vtk_to_numpy

    data = read_by_vtk(file, ".vti")
    sizes = np.array(data.GetDimensions())
    at, is_of_cells = data.GetPointData(), False
    if not at.GetNumberOfArrays():
        at, is_of_cells, sizes = data.GetCellData(), True, np.maximum(sizes - 1, 1)
    check_count(sizes.tolist())
    names = [at.GetArrayName(k) or "" for k in range(at.GetNumberOfArrays())]
    found = at.GetScalars() or (at.GetArray(0) if len(names) == 1 else None)
    if found is None:
        raise AnatomyError("it has " + (f"the values {', '.join(names)}, none of them as its scalars: one is needed"
                                        if names else "no values at its points or cells"))
    if found.GetNumberOfComponents() != 1:
        raise AnatomyError(f"{found.GetNumberOfComponents()} numbers a voxel: a mask has one")
    if min(sizes) < 1 or found.GetNumberOfTuples() != int(np.prod(sizes)):
        raise AnatomyError(f"{found.GetNumberOfTuples()} values of {' x '.join(map(str, sizes))} voxels")
    turn = data.GetDirectionMatrix()
    to_file = np.eye(4)
    to_file[:3, :3] = np.array([[turn.GetElement(i, j) for j in range(3)] for i in range(3)]) * data.GetSpacing()
    first = np.array(data.GetExtent()[::2]) + (0.5 if is_of_cells else 0.0)
    to_file[:3, 3] = np.array(data.GetOrigin()) + to_file[:3, :3] @ first
    return Voxels(vtk_to_numpy(found).reshape(sizes, order="F"), to_file, unit="")

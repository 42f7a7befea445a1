"""Meshes in VTK's form and back, and the filters of VTK that are used."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from guidewire.anatomy.mesh import Edges, Mesh

_REDUCTIONS = (0.9, 0.75, 0.5, 0.3)  # of the triangles
_SAMPLES = 4000  # points at which the error of a decimation is measured


def to_vtk(mesh: Mesh):
    """vtkPolyData with the same triangles."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(mesh.vertices, dtype=float), deep=True))
    cells = vtkCellArray()
    offsets = np.arange(0, 3 * len(mesh.triangles) + 1, 3, dtype=np.int64)
    cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(mesh.triangles, dtype=np.int64).ravel(), deep=True))
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(cells)
    return data


def from_vtk(data) -> Mesh:
    """Return the triangles of vtkPolyData that has no other polygons."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    vertices = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3).astype(np.int64)
    return Mesh(vertices, triangles)


def contour(values: np.ndarray, level: float, origin: np.ndarray, spacing: np.ndarray) -> Mesh:
    """Return the surface where values on a grid (i, j, k) have a level, normals towards smaller values."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D

    image = vtkImageData()
    image.SetDimensions(*values.shape)
    image.SetOrigin(*origin)
    image.SetSpacing(*np.broadcast_to(spacing, 3))
    image.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(values.transpose(2, 1, 0)).ravel(), deep=True))
    march = vtkFlyingEdges3D()
    march.SetInputData(image)
    march.SetValue(0, level)
    march.ComputeNormalsOff()
    march.ComputeGradientsOff()
    march.ComputeScalarsOff()
    march.Update()
    return from_vtk(march.GetOutput())


def smooth(mesh: Mesh, passes: int, band: float) -> Mesh:
    """Windowed sinc smoothing (Taubin et al. 1996), which passes what varies slowly along the surface.

    passes : degree of the polynomial; band : frequency up to which detail stays, of 2.
    """
    from vtkmodules.vtkFiltersCore import vtkWindowedSincPolyDataFilter

    sinc = vtkWindowedSincPolyDataFilter()
    sinc.SetInputData(to_vtk(mesh))
    sinc.SetNumberOfIterations(passes)
    sinc.SetPassBand(band)
    sinc.BoundarySmoothingOff()
    sinc.FeatureEdgeSmoothingOff()
    sinc.NonManifoldSmoothingOff()
    sinc.NormalizeCoordinatesOn()
    sinc.Update()
    return from_vtk(sinc.GetOutput())


def decimate(mesh: Mesh, error: float, reductions: Sequence[float] = _REDUCTIONS) -> Mesh:
    """Fewer triangles, of which no sampled point is farther than an error from the surface before, or the other way.

    Quadric error of VTK, which states no bound: so the error is measured, and reductions are tried from the largest.
    """
    from vtkmodules.vtkFiltersCore import vtkQuadricDecimation

    for reduction in reductions:
        reduce = vtkQuadricDecimation()
        reduce.SetInputData(to_vtk(mesh))
        reduce.SetTargetReduction(reduction)
        reduce.VolumePreservationOn()
        reduce.Update()
        reduced = from_vtk(reduce.GetOutput())
        if (len(reduced.triangles) and (Edges.of(reduced).counts <= 2).all()
                and farthest(mesh, reduced, _SAMPLES) <= error and farthest(mesh, reduced) <= error):
            return reduced
    return mesh


def distances(points: np.ndarray, mesh: Mesh) -> np.ndarray:
    """Return (k,): unsigned distances of points (k, 3) from the triangles of a mesh."""
    return nearest(points, mesh)[0]


def nearest(points: np.ndarray, mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Return (k,): unsigned distances of points (k, 3) from the triangles of a mesh, and (k,): the nearest triangle."""
    from vtkmodules.vtkCommonCore import mutable
    from vtkmodules.vtkCommonDataModel import vtkGenericCell, vtkStaticCellLocator

    locator = vtkStaticCellLocator()
    locator.SetDataSet(to_vtk(mesh))
    locator.BuildLocator()
    cell, number, part, squared = vtkGenericCell(), mutable(0), mutable(0), mutable(0.0)
    place = [0.0, 0.0, 0.0]
    found, triangles = np.empty(len(points)), np.empty(len(points), dtype=int)
    for k, point in enumerate(points):
        locator.FindClosestPoint(point, place, cell, number, part, squared)
        found[k], triangles[k] = float(squared), int(number)
    return np.sqrt(found), triangles


def farthest(before: Mesh, after: Mesh, most: int = 20000) -> float:
    """Return the largest distance of sampled vertices and middles of triangles of each from the other."""
    def sample(mesh: Mesh) -> np.ndarray:
        points = np.concatenate([mesh.vertices, mesh.corners.mean(axis=1)])
        return points[:: max(1, len(points) // most)]

    return float(max(distances(sample(before), after).max(), distances(sample(after), before).max()))

"""File extensions of vessels, without the packages needed to read them."""

from __future__ import annotations

from pathlib import Path

MESHES = (".stl", ".obj", ".ply", ".vtp", ".vtk", ".vtu")
MASKS = (".nii", ".nii.gz", ".nrrd", ".nhdr", ".mha", ".mhd", ".vti")
DICOM = ".dcm"  # a slice; of the files of a series many have no ending
CENTRELINES = (".csv", ".mrk.json")
ENDINGS = (*MESHES, *MASKS, DICOM, *CENTRELINES)
_MAGIC = 128  # bytes before the mark of a DICOM file

# What is not read: the nearest way to what is.
_IMAGE, _MESH = "3D Slicer opens it and saves it as .nrrd", "3D Slicer or ParaView opens it and saves it as .stl"
_TABLE = "save x, y, z and radius as .csv"
OTHERS = {
    **dict.fromkeys((".hdr", ".img", ".mgz", ".mgh", ".gipl", ".tif", ".tiff", ".raw", ".nia", ".npy"), _IMAGE),
    **dict.fromkeys((".3mf", ".glb", ".gltf", ".off", ".dae", ".x3d", ".wrl", ".usd", ".usda", ".usdc", ".fbx"),
                    _MESH),
    ".mdl": "the surface of SimVascular's model is the .vtp of the same name beside it",
    **dict.fromkeys((".step", ".stp", ".iges", ".igs"), "a CAD program saves it as .stl"),
    **dict.fromkeys((".mrb", ".mrml"), "3D Slicer opens the scene: export the segmentation as .seg.nrrd"),
    **dict.fromkeys((".zip", ".tar", ".gz", ".7z", ".rar"), "unpack it, and give the file or the folder of the series"),
    **dict.fromkeys((".xlsx", ".xls", ".ods", ".txt"), _TABLE),
    ".fcsv": "3D Slicer saves the curve, with its radii, as .mrk.json",
}


def is_anatomy(file: Path) -> bool:
    """Return whether a path is named as a file that `guidewire.py anatomy` reads, and is no folder."""
    return not file.is_dir() and file.name.lower().endswith(ENDINGS)


def is_dicom(path: Path) -> bool:
    """Return whether a path is a folder, which may hold slices, or a slice by its name or its mark."""
    name = path.name.lower()
    if path.is_dir() or name.endswith(DICOM):
        return True
    if name.endswith(ENDINGS):
        return False
    try:
        with path.open("rb") as file:
            return file.read(_MAGIC + 4)[_MAGIC:] == b"DICM"
    except OSError:
        return False

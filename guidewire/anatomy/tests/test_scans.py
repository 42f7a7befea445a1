"""The same scan in all formats of voxels, and folders of slices as clinics have them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy import reading  # noqa: E402
from guidewire.anatomy.images import read_image  # noqa: E402
from guidewire.anatomy.masks import Taking, mesh_of_image  # noqa: E402
from guidewire.anatomy.mesh import AnatomyError, signed_volume  # noqa: E402
from guidewire.anatomy.tests import scans  # noqa: E402
from guidewire.anatomy.tests.scans import Scan, write_metaimage, write_vti  # noqa: E402

SMALL = Scan(np.random.default_rng(3).integers(-900, 900, (5, 6, 7)).astype(float),
             scans.fork_scan((2, 2, 2)).to_lps)


@pytest.mark.parametrize("name", sorted(scans.WRITERS))
def test_voxels_lie_where_they_are_in_the_patient_in_every_format(tmp_path: Path, name: str) -> None:
    if name == "slices":
        pytest.importorskip("pydicom", reason="pydicom is not installed: apt-get install python3-pydicom")
    file = scans.WRITERS[name](tmp_path / name, SMALL)
    image = read_image(file, reading.kind_of(file))
    np.testing.assert_array_equal(image.values, SMALL.values)
    np.testing.assert_allclose(image.to_space, SMALL.to_lps, atol=1e-6)
    assert image.axes.is_known == (name != "scan.vti") and image.unit == ("" if name == "scan.vti" else "mm")


@pytest.mark.long("a seed beside the vessel, and all formats of one scan, are tried here too")
def test_a_seed_takes_the_vessel_and_not_the_bone_and_its_volume_is_that_of_the_fork() -> None:
    scan = scans.fork_scan((45, 48, 60), (0.83, 0.73, 1.2))
    image = read_of(scan)
    seed = np.array([0.0, 0.0, 15.0])
    taken = mesh_of_image(image, Taking(threshold=scans.INSIDE, seed=seed))
    largest = mesh_of_image(image, Taking(threshold=scans.INSIDE))
    at = np.argwhere(taken.inside) @ scan.to_lps[:3, :3].T + scan.to_lps[:3, 3]
    assert any("left out" in line for line in taken.left_out)
    near = [scans.in_capsule(at, *branch[:2], branch[2] + 0.7) for branch in scans.BRANCHES]
    assert np.any(near, axis=0).all() and not (taken.inside & largest.inside).any()
    fine = np.indices((90, 60, 300)).transpose(1, 2, 3, 0) * [0.3, 0.3, 0.25] + [-13.5, -6.0, -4.0]
    true = np.any([scans.in_capsule(fine, *branch) for branch in scans.BRANCHES], axis=0).sum() * 0.3 * 0.3 * 0.25
    assert abs(signed_volume(taken.mesh)) == pytest.approx(true, rel=0.04)
    box = mesh_of_image(image, Taking(threshold=scans.INSIDE, box=np.array([[-14.0, -5.0, 40.0], [5.0, 8.0, 3.0]])))
    inside = box.mesh.vertices
    assert inside[:, 2].max() < 41.2 and inside[:, 2].min() > 1.0 and inside[:, 0].max() < 5.9    # a voxel beyond


def read_of(scan: Scan):
    from guidewire.anatomy.images import Image
    from guidewire.anatomy.patient import Axes

    return Image(scan.values, scan.to_lps, Axes("LPS"))


COARSE = scans.fork_scan((30, 32, 30), (1.24, 1.1, 2.4))


@pytest.mark.parametrize("seed, expected", [
    ([0.0, 12.0, 15.0], "the voxel there has the value 40 and is not in the vessel; the nearest one that is lies"),
    ([0.0, 90.0, 15.0], "lies outside of the image, which goes from"),
])
def test_a_seed_beside_the_vessel_is_one_line(seed, expected) -> None:
    with pytest.raises(AnatomyError, match=expected):
        mesh_of_image(read_of(COARSE), Taking(threshold=scans.INSIDE, seed=np.array(seed)))


# What is done to a folder of slices, and what it ends in: the slices that are read, or one line.
def with_a_missing_slice(folder: Path):
    scans.write_dicom(folder, SMALL, slices=[0, 1, 2, 4, 5, 6])
    return r"1 slice is missing between IM0014 at .* and IM0028"


def with_two_spacings(folder: Path):
    scans.write_dicom(folder, SMALL, slices=[0, 2, 3, 4, 6])
    return "the spacing changes between"


def with_a_localiser(folder: Path):
    scans.write_dicom(folder, SMALL)
    turned = Scan(SMALL.values[:, :, :2], SMALL.to_lps[:, [1, 2, 0, 3]])
    scans.write_dicom(folder, turned, changed={"ImageType": ["ORIGINAL", "PRIMARY", "LOCALIZER"]}, first=500)
    return SMALL


def with_a_tilted_gantry(folder: Path):
    sheared = SMALL.to_lps.copy()
    sheared[:3, 2] += 0.3 * sheared[:3, 1]
    scans.write_dicom(folder, replace(SMALL, to_lps=sheared))
    return replace(SMALL, to_lps=sheared)


def of_lossless_jpeg(folder: Path):
    from pydicom import dcmread, dcmwrite
    from pydicom.encaps import encapsulate

    for file in scans.write_dicom(folder, SMALL).iterdir():
        data = dcmread(file)
        data.file_meta.TransferSyntaxUID = "1.2.840.10008.1.2.4.70"
        data.PixelData = encapsulate([b"\xff\xd8\xff\xd9"])
        data["PixelData"].is_undefined_length = True
        dcmwrite(file, data)
    return "its compressed voxels break off"


def of_two_series(folder: Path):
    scans.write_dicom(folder, SMALL)
    scans.write_dicom(folder / "b", SMALL, "1.2.4", changed={"SeriesDescription": "Gefäße, venös", "SeriesNumber": 5})
    return r"2 series .* choose one: --series 1: 'Becken arteriell', CT of 7 slices of 5 x 6, .*; --series 2: 'Gefäße"


def of_two_times(folder: Path):
    scans.write_dicom(folder, SMALL)
    scans.write_dicom(folder, replace(SMALL, values=SMALL.values + 1.0), slices=range(7), first=500)
    return "7 slices lie where another one does, such as .*: a series of several times"


def with_blank_numbers(folder: Path):
    scans.write_dicom(folder, SMALL, changed={"SOPInstanceUID": ""})
    scans.write_dicom(folder / "copy", SMALL, changed={"SOPInstanceUID": ""})
    return SMALL


def with_equal_numbers(folder: Path):
    scans.write_dicom(folder, SMALL, changed={"SOPInstanceUID": "1.2.3.4"})
    return SMALL


def of_jpeg_2000(folder: Path):
    return packed(folder, "JPEG2000Lossless")


def of_jpeg_ls(folder: Path):
    return packed(folder, "JPEGLSLossless")


def packed(folder: Path, syntax: str):
    gdcm = pytest.importorskip("gdcm", reason="gdcm is not installed: apt-get install python3-gdcm")
    for file in scans.write_dicom(folder, SMALL).iterdir():
        reader, change, writer = gdcm.ImageReader(), gdcm.ImageChangeTransferSyntax(), gdcm.ImageWriter()
        reader.SetFileName(str(file))
        assert reader.Read()
        change.SetTransferSyntax(gdcm.TransferSyntax(getattr(gdcm.TransferSyntax, syntax)))
        change.SetInput(reader.GetImage())
        assert change.Change()
        writer.SetFileName(str(file))
        writer.SetFile(reader.GetFile())
        writer.SetImage(change.GetOutput())
        assert writer.Write()
    return SMALL


def with_copies(folder: Path):
    scans.write_dicom(folder, SMALL)
    scans.write_dicom(folder / "copy", SMALL)
    (folder / "readme.txt").write_text("no slice")
    return SMALL


def without_places(folder: Path):
    scans.write_dicom(folder, SMALL, changed={"ImagePositionPatient": None})
    return "no DICOM slices here, but 7 files: it has no ImagePositionPatient"


def in_colours(folder: Path):
    scans.write_dicom(folder, SMALL, changed={"SamplesPerPixel": 3})
    return "7 files: 3 numbers a pixel, a picture in colours"


def of_many_frames(folder: Path):
    scans.write_dicom(folder, SMALL, slices=[0], changed={"NumberOfFrames": 40})
    return "1 file: 40 frames in one file: 3D Slicer opens it and saves it as .nrrd"


def of_a_segmentation(folder: Path):
    scans.write_dicom(folder, SMALL, slices=[0], changed={"SOPClassUID": "1.2.840.10008.5.1.4.1.1.66.4"})
    return "a DICOM segmentation: 3D Slicer opens it and saves it as .seg.nrrd"


def of_one_slice(folder: Path):
    scans.write_dicom(folder, SMALL, slices=[2])
    return "no series of 3 or more slices: --series 1"


def that_breaks_off(folder: Path):
    file = sorted(scans.write_dicom(folder, SMALL).iterdir())[-1]
    file.write_bytes(file.read_bytes()[:-20])
    return "IM0042: its voxels cannot be read"


def with_a_slice_beside(folder: Path):
    scans.write_dicom(folder, SMALL, slices=[0, 1, 2, 4, 5, 6])
    moved = SMALL.to_lps.copy()
    moved[:3, 3] += 3.0 * moved[:3, 0]
    scans.write_dicom(folder, replace(SMALL, to_lps=moved), slices=[3])
    return "IM0021 lies .* mm beside the line of the others"


def with_other_sizes_of_pixels(folder: Path):
    scans.write_dicom(folder, SMALL, changed={"PixelSpacing": ["0", "0.5"]})
    return "its PixelSpacing is not above 0"


def without_pixels(folder: Path):
    scans.write_dicom(folder, SMALL, changed={"Rows": 0})
    return "no DICOM slices here, but 7 files: 5 x 0 pixels"


def far_away(folder: Path):
    scans.write_dicom(folder, SMALL, changed={"ImagePositionPatient": ["1e300", "0", "0"]})
    return "its ImagePositionPatient is beyond"


def of_nothing(folder: Path):
    folder.mkdir()
    return "no DICOM slices here: a folder with the files of a series is needed"


def with_slopes_of_their_own(folder: Path):
    for k, slope in enumerate((1.0, 2.0, 0.5, 1.0, 4.0, 1.0, 1.0)):
        scans.write_dicom(folder, SMALL, slices=[k], changed={"RescaleSlope": str(slope), "RescaleIntercept": "-24"})
    return Scan((SMALL.values + 1024.0) * [1.0, 2.0, 0.5, 1.0, 4.0, 1.0, 1.0] - 24.0, SMALL.to_lps)


FOLDERS = [with_a_missing_slice, with_two_spacings, with_a_localiser, with_a_tilted_gantry, of_lossless_jpeg,
           with_blank_numbers, with_equal_numbers, of_jpeg_2000, of_jpeg_ls,
           of_two_series, of_two_times, with_copies, without_places, in_colours, of_many_frames, of_a_segmentation,
           of_one_slice, that_breaks_off, with_a_slice_beside, with_other_sizes_of_pixels, of_nothing, without_pixels,
           far_away,
           with_slopes_of_their_own]


@pytest.mark.few(12)
@pytest.mark.parametrize("make", FOLDERS, ids=lambda make: make.__name__)
def test_a_folder_of_slices_is_read_right_or_is_one_line(tmp_path: Path, make) -> None:
    pytest.importorskip("pydicom", reason="pydicom is not installed: apt-get install python3-pydicom")
    expected = make(tmp_path / "CT mit Ärger")
    if isinstance(expected, Scan):
        image = read_image(tmp_path / "CT mit Ärger", ".dcm")
        np.testing.assert_array_equal(image.values, expected.values)
        np.testing.assert_allclose(image.to_space, expected.to_lps, atol=1e-6)
        return
    with pytest.raises(AnatomyError, match=expected) as error:
        read_image(tmp_path / "CT mit Ärger", ".dcm")
    assert "\n" not in str(error.value) and str(error.value).startswith(str(tmp_path))


def test_a_series_is_chosen_by_number_or_name_and_by_one_of_its_files(tmp_path: Path) -> None:
    pytest.importorskip("pydicom", reason="pydicom is not installed: apt-get install python3-pydicom")
    of_two_series(tmp_path / "both")
    other = Scan(SMALL.values[::-1], SMALL.to_lps)
    scans.write_dicom(tmp_path / "both" / "b", other, "1.2.4", changed={"SeriesDescription": "Gefäße, venös",
                                                                        "SeriesNumber": 5})
    for series in ("2", "gefäße, venös"):
        np.testing.assert_array_equal(read_image(tmp_path / "both", ".dcm", series=series).values, other.values)
    file = tmp_path / "both" / "IM0007"
    assert reading.kind_of(file) == ".dcm"
    np.testing.assert_array_equal(read_image(file, ".dcm").values, SMALL.values)
    with pytest.raises(AnatomyError, match="--series 3: no such series; --series 1: 'Becken"):
        read_image(tmp_path / "both", ".dcm", series="3")
    with pytest.raises(AnatomyError, match="--series is of a folder of DICOM slices"):
        read_image(write_metaimage(tmp_path / "a.mha", SMALL), ".mha", series="1")


def changed(old: str, new: str):
    def write(file: Path) -> Path:
        write_metaimage(file, SMALL, packed=False)
        head, mark, data = file.read_bytes().partition(b"LOCAL\n")
        file.write_bytes((head + mark).replace(old.encode(), new.encode()) + data)
        return file

    return write


@pytest.mark.parametrize("write, expected", [
    (changed("DimSize = 5 6 7", "DimSize = 5 6 8"), "the file breaks off: 240 voxels need 480 bytes, there are 420"),
    (changed("DimSize = 5 6 7", "DimSize = 5 x 7"), "dimsize with '5 x 7'"),
    (changed("MET_SHORT", "MET_STRING"), "voxels of the type 'MET_STRING'"),
    (changed("LOCAL", "a.raw"), "its voxels are in another file, 'a.raw'"),
    (changed("CompressedData = False", "CompressedData = True"), "the packed voxels break off"),
    (changed("ElementSpacing = ", "ElementSpacing = x "), "elementspacing with 'x"),
    (changed("ElementType", "ElementNumberOfChannels = 3\nElementType"), "3 numbers a voxel"),
    (changed("ElementDataFile", "DataFile"), "not a MetaImage"),
    (changed("Offset = ", "Offset = 1e300 "), "offset with '1e300"),
])
def test_a_damaged_metaimage_is_one_line(tmp_path: Path, write, expected: str) -> None:
    with pytest.raises(AnatomyError, match=expected) as error:
        read_image(write(tmp_path / "a.mha"), ".mha")
    assert "\n" not in str(error.value)


def test_a_metaimage_is_read_as_vtk_reads_it_in_text_or_big_endian_numbers(tmp_path: Path) -> None:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkMetaImageReader

    file = write_metaimage(tmp_path / "a.mha", SMALL)
    reader = vtkMetaImageReader()
    reader.SetFileName(str(file))
    reader.Update()
    seen = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(SMALL.values.shape, order="F")
    np.testing.assert_array_equal(seen, read_image(file, ".mha").values)
    np.testing.assert_allclose(reader.GetOutput().GetSpacing(), read_image(file, ".mha").spacing)
    head, _, data = write_metaimage(file, SMALL, packed=False).read_bytes().partition(b"LOCAL\n")
    big = np.frombuffer(data, "<i2").astype(">i2").tobytes()
    text = " ".join(map(str, np.frombuffer(data, "<i2"))).encode()
    for old, new, voxels in ((b"OrderMSB = False", b"OrderMSB = True", big),
                             (b"BinaryData = True", b"BinaryData = False", text)):
        file.write_bytes(head.replace(old, new) + b"LOCAL\n" + voxels)
        np.testing.assert_array_equal(read_image(file, ".mha").values, SMALL.values)
    file.write_bytes(head.replace(b"ElementSpacing", b"Comment") + b"LOCAL\n" + data)
    assert "the file says no size of its voxels: 1 mm is taken" in read_image(file, ".mha").notes


@pytest.mark.parametrize("name", ["a.nhdr", "a.mhd"])
def test_voxels_beside_their_header_are_those_of_one_file(tmp_path: Path, name: str) -> None:
    file, kind = tmp_path / name, Path(name).suffix
    if kind == ".nhdr":
        head, _, data = scans.write_nrrd(file, SMALL).read_bytes().partition(b"\n\n")
        file.write_bytes(head + b"\ndata file: Gef\xc3\xa4\xc3\x9f.raw\nbyte skip: -1\n")
    else:
        head, _, data = write_metaimage(file, SMALL, packed=False).read_bytes().partition(b"LOCAL\n")
        file.write_bytes(b"HeaderSize = -1\n" + head + "Gefäß.raw\n".encode())
    with pytest.raises(AnatomyError, match="its voxels are in another file, 'Gefäß.raw', and there is none"):
        read_image(file, kind)
    (tmp_path / "Gefäß.raw").write_bytes(b"of another program" + data)
    image = read_image(file, kind)
    np.testing.assert_array_equal(image.values, SMALL.values)
    np.testing.assert_allclose(image.to_space, SMALL.to_lps, atol=1e-9)
    (tmp_path / "Gefäß.raw").write_bytes(b"of yet another one" + data)
    assert read_image(file, kind).sha256 != image.sha256


def test_values_of_cells_of_a_vti_lie_in_the_middle_of_the_cells(tmp_path: Path) -> None:
    def content(values: str) -> bytes:
        return (f'<VTKFile type="ImageData" version="0.1"><ImageData WholeExtent="1 3 0 1 0 1" Origin="10 20 30" '
                f'Spacing="2 3 4"><Piece Extent="1 3 0 1 0 1">{values}</Piece></ImageData></VTKFile>').encode()

    array = '<DataArray type="Int16" Name="{}" NumberOfComponents="{}" format="ascii">{}</DataArray>'
    file = tmp_path / "a.vti"
    file.write_bytes(content(f'<CellData>{array.format("a", 1, "7 9")}</CellData>'))
    image = read_image(file, ".vti")
    np.testing.assert_array_equal(image.values, [[[7]], [[9]]])
    np.testing.assert_allclose(image.place(np.zeros(3)), [13.0, 21.5, 32.0])
    for values, expected in (
            (f'<CellData>{array.format("a", 3, "1 2 3 4 5 6")}</CellData>', "3 numbers a voxel"),
            (f'<CellData>{array.format("a", 1, "7 9")}{array.format("b", 1, "7 9")}</CellData>', "the values a, b"),
            ("", "no values at its points or cells")):
        file.write_bytes(content(values))
        with pytest.raises(AnatomyError, match=expected):
            read_image(file, ".vti")
    whole = write_vti(file, SMALL).read_bytes()
    file.write_bytes(whole[:-40])
    with pytest.raises(AnatomyError, match="the file breaks off"):
        read_image(file, ".vti")


@pytest.mark.parametrize("name, way", [
    ("a.mdl", "the .vtp of the same name"), ("a.glb", "3D Slicer or ParaView"),
    ("a.mrb", ".seg.nrrd"),
    ("a.zip", "unpack it"), ("a.step", "CAD"), ("a.xyz", "the name has to end in one of .stl"),
])
def test_what_is_not_read_names_the_nearest_way(tmp_path: Path, name: str, way: str) -> None:
    (tmp_path / name).write_bytes(b"x")
    with pytest.raises(AnatomyError, match=way):
        reading.read(tmp_path / name)

"""Which voxels of a mask are taken: values, names of a table, segments of 3D Slicer."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy.images import Image, read_image  # noqa: E402
from guidewire.anatomy.labels import read_names, voxels_with  # noqa: E402
from guidewire.anatomy.masks import Taking, mesh_of_image  # noqa: E402
from guidewire.anatomy.mesh import AnatomyError  # noqa: E402
from guidewire.anatomy.voxels import Segment  # noqa: E402

VALUES = np.zeros((6, 6, 12), dtype=np.uint8)
VALUES[1:5, 1:5, 1:4], VALUES[1:5, 1:5, 4:8], VALUES[1:5, 1:5, 8:10] = 1, 2, 5
NAMES = (Segment("Aorta", 1.0), Segment("Arteria iliaca, links", 2.0), Segment("Gefäß", 5.0))
IMAGE = Image(VALUES, np.eye(4), segments=NAMES)


@pytest.mark.parametrize("labels, taken", [
    ("1", [1]), ("1,2", [1, 2]), ("5, 1", [1, 5]), ("gefäß", [5]), ("Aorta,Gefäß", [1, 5]),
    ("arteria iliaca, links", [2]), ("Aorta,2", [1, 2]),
])
def test_labels_are_taken_by_value_or_name(labels: str, taken: list[int]) -> None:
    inside, asked, others = voxels_with(IMAGE, labels, None)
    np.testing.assert_array_equal(inside, np.isin(VALUES, taken))
    assert asked == f"--label {labels}: "
    assert others == tuple(f"'{one.name}'" for one in NAMES if one.value not in taken)


def test_what_is_left_out_is_told_by_value_where_there_are_no_names() -> None:
    taken = mesh_of_image(Image(VALUES, np.eye(4)), Taking("1,2"))
    assert taken.left_out == ["labels 5"] and taken.inside.sum() == 16 * 7


@pytest.mark.parametrize("image, taking, expected", [
    (IMAGE, Taking(), r"4 values \(0, 1 'Aorta', 2 'Arteria iliaca, links', 5 'Gefäß'\): give --label"),
    (IMAGE, Taking("Vene"), "--label Vene: there is no such segment: there are 'Aorta' .label 1., 'Arteria"),
    (Image(VALUES, np.eye(4)), Taking("Aorta"), "names of labels come with --label-names"),
    (Image(VALUES, np.eye(4)), Taking(segments="Aorta"), "the file names no segments; --label takes values"),
    (Image(VALUES, np.eye(4), segments=(*NAMES, Segment("aorta", 7.0))), Taking("Aorta"), "2 segments have this name"),
])
def test_a_name_that_is_not_there_is_one_line(image, taking, expected) -> None:
    with pytest.raises(AnatomyError, match=expected) as error:
        mesh_of_image(image, taking)
    assert "\n" not in str(error.value)


def layered(file: Path) -> Path:
    """As 3D Slicer writes segments that overlap: two in layer 0, one in layer 1."""
    values = np.zeros((2, 6, 6, 12), dtype=np.uint8)
    values[0, 1:5, 1:5, 1:5], values[0, 1:5, 1:5, 6:8], values[1, 2:4, 2:4, 2:11] = 1, 2, 1
    head = ["NRRD0004", "type: unsigned char", "dimension: 4", "space: left-posterior-superior", "sizes: 2 6 6 12",
            "space directions: none (0.5,0,0) (0,0.6,0) (0,0,0.7)", "kinds: list domain domain domain",
            "encoding: raw", "space origin: (1,2,3)"]
    for k, (name, value, layer) in enumerate((("Aorta", 1, 0), ("Vene: groß", 2, 0), ("Gefäß", 1, 1))):
        head += [f"Segment{k}_Name:={name}", f"Segment{k}_LabelValue:={value}", f"Segment{k}_Layer:={layer}",
                 f"Segment{k}_ID:=Segment_{k}"]
    file.write_bytes("\n".join([*head, "", ""]).encode() + values.ravel(order="F").tobytes())
    return file


def test_segments_that_overlap_are_taken_by_name(tmp_path: Path) -> None:
    image = read_image(layered(tmp_path / "a.seg.nrrd"), ".nrrd")
    assert image.values.shape == (6, 6, 12, 2)
    assert [one.name for one in image.segments] == ["Aorta", "Vene: groß", "Gefäß"]
    np.testing.assert_allclose(image.place(np.array([1.0, 1.0, 1.0])), [1.5, 2.6, 3.7])
    for names, count in (("aorta", 64), ("Vene: groß", 32), ("Gefäß", 36), ("Aorta,Gefäß", 64 + 36 - 12)):
        assert voxels_with(image, None, names)[0].sum() == count
    taken = mesh_of_image(image, Taking(segments="Gefäß"))
    assert taken.left_out == ["labels 'Aorta', 'Vene: groß'"]
    for taking, expected in (
            (Taking(), r"2 layers of segments that overlap: --segment takes one or more of 'Aorta' \(layer 0, label 1"),
            (Taking("1"), "2 layers of segments that overlap"), (Taking(threshold=0.5), "this is a segmentation"),
            (Taking(segments="Aorta,x"), "--segment x: there is no such segment: there are 'Aorta' .layer 0")):
        with pytest.raises(AnatomyError, match=expected):
            mesh_of_image(image, taking)


@pytest.mark.parametrize("name, text, expected", [
    ("a.json", json.dumps({"aorta": 1, "iliac": 2}), [("aorta", 1.0), ("iliac", 2.0)]),
    ("a.json", json.dumps({"labels": {"0": "background", "3": "Gefäß"}}), [("background", 0.0), ("Gefäß", 3.0)]),
    ("a.csv", "LabelValue,Name,Color_R\n1,Aorta,255\n2,\"Iliaca, links\",0\n",
     [("Aorta", 1.0), ("Iliaca, links", 2.0)]),
    ("a.csv", "Label_name;Index\nAorta;7\n", [("Aorta", 7.0)]),
])
def test_names_come_from_a_table(tmp_path: Path, name: str, text: str, expected) -> None:
    (tmp_path / name).write_text(text, encoding="utf-8")
    assert [(one.name, one.value) for one in read_names(tmp_path / name)] == expected


@pytest.mark.parametrize("name, text, expected", [
    ("a.json", "[1, 2]", "not an object of names and values"), ("a.json", "{", "not an object"),
    ("a.json", "{}", "no names"),
    ("a.csv", "a,b\n1,2\n", "the headings value and name"), ("a.csv", "value,name\nx,Aorta\n", "a row is no value"),
    ("a.csv", "", "the headings value and name"), ("none.csv", None, "No such file"),
])
def test_a_table_without_names_is_one_line(tmp_path: Path, name: str, text: str | None, expected: str) -> None:
    if text is not None:
        (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(AnatomyError, match=expected):
        read_names(tmp_path / name)

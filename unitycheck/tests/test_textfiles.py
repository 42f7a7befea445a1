"""Encoding, line ends, tabs, headers."""

from __future__ import annotations

NUMBER = "Assets/Guidewire/Core/Number.cs"
WIRE = "Assets/Guidewire/Wire.mat"


def test_crlf(breakage) -> None:
    breakage(NUMBER, "Core\n", "Core\r\n", "text-crlf")


def test_tab(breakage) -> None:
    breakage(NUMBER, "    public", "\tpublic", "text-tab")


def test_wide_line(breakage) -> None:
    breakage(NUMBER, "    public", "    /* " + 110 * "-" + " */ public", "text-wide")


def test_last_line_end(breakage) -> None:
    breakage(NUMBER, "}\n}\n", "}\n}", "text-end")


def test_bom(sample) -> None:
    data = (sample.root / NUMBER).read_bytes()
    (sample.root / NUMBER).write_bytes(b"\xef\xbb\xbf" + data)
    assert sample.broken() == {(NUMBER, "text-bom")}


def test_latin_1(sample) -> None:
    data = (sample.root / NUMBER).read_bytes()
    (sample.root / NUMBER).write_bytes(data + b"// \xe9\n")
    assert sample.broken() == {(NUMBER, "text-utf8")}


def test_utf_8_passes(sample) -> None:
    sample.edit(NUMBER, "    {\n    }", "    {\n        // \u00e9 \u03c4\n    }")
    assert sample.broken() == set()


def test_yaml_header(breakage) -> None:
    breakage(WIRE, "%YAML 1.1", "%YAML 1.2", "yaml-header")


def test_attributes(breakage) -> None:
    breakage(".gitattributes", "*.meta text eol=lf\n", "*.meta text\n", "gitattributes")

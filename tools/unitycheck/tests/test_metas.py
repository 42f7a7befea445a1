"""Meta files: present, well formed, stable, right importer."""

from __future__ import annotations

import hashlib

from tools.unitycheck import metas
from tools.unitycheck.project import Project

NUMBER = "Assets/Guidewire/Core/Number.cs"


def test_written_guid_is_md5_of_the_path(sample) -> None:
    text = (sample.root / f"{NUMBER}.meta").read_text()
    assert f"guid: {hashlib.md5(f'guidewire/{NUMBER}'.encode()).hexdigest()}\n" in text
    assert text.startswith("fileFormatVersion: 2\n") and "MonoImporter:\n" in text


def test_write_missing_never_touches_existing(sample) -> None:
    before = (sample.root / f"{NUMBER}.meta").stat().st_mtime_ns
    assert metas.write_missing(Project(sample.root)) == []
    assert (sample.root / f"{NUMBER}.meta").stat().st_mtime_ns == before


def test_missing_for_file_and_folder(sample) -> None:
    (sample.root / f"{NUMBER}.meta").unlink()
    (sample.root / "Assets/Guidewire/Core.meta").unlink()
    assert sample.broken() == {(NUMBER, "meta-missing"), ("Assets/Guidewire/Core", "meta-missing")}


def test_orphan(sample) -> None:
    (sample.root / NUMBER).unlink()
    assert sample.broken() == {(f"{NUMBER}.meta", "meta-orphan")}


def test_hidden_names_need_none(sample) -> None:
    sample.write("Assets/Guidewire/.hidden", "x")
    sample.write("Assets/Guidewire/Samples~/A.cs", "namespace A;")
    assert sample.broken() == set()


def test_rename_with_its_meta_is_allowed_when_listed(sample) -> None:
    renamed = NUMBER.replace("Number", "Figure")
    (sample.root / NUMBER).rename(sample.root / renamed)
    (sample.root / f"{NUMBER}.meta").rename(sample.root / f"{renamed}.meta")
    assert sample.broken() == {(f"{renamed}.meta", "guid-changed")}
    sample.write(metas.KNOWN_GUIDS, f"# renamed\n{renamed} {metas.stable_guid(NUMBER)}\n")
    assert sample.broken() == set()


def test_script_without_importer_block_as_unity_6_writes_it(sample) -> None:
    sample.write(f"{NUMBER}.meta", f"fileFormatVersion: 2\nguid: {metas.stable_guid(NUMBER)}\n")
    assert sample.broken() == set()

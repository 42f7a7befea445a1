"""The scenes in the repository are what the writer writes, and it writes the same every time."""

from __future__ import annotations

from pathlib import Path

from tools.unitycheck import scenewriter
from tools.unitycheck.metas import stable_guid
from tools.unitycheck.scenetable import SCENES
from tools.unitycheck.unityyaml import parse

ROOT = Path(__file__).resolve().parents[3]


def test_repository_holds_what_is_written() -> None:
    for path, text in scenewriter.files().items():
        assert (ROOT / path).read_bytes() == text.encode("utf-8"), f"{path}: run tools.unitycheck --write-scenes"


def test_writing_twice_changes_nothing(tmp_path: Path) -> None:
    written = scenewriter.write(tmp_path)
    assert sorted(written) == sorted(scenewriter.files())
    assert scenewriter.write(tmp_path) == []


def test_fields_arrive() -> None:
    scene = next(scene for scene in SCENES if scene.overrides)
    documents = {document.file_id: document for document in parse(scenewriter.scene_text(scene))}
    assert documents[302].data["_overrides"] == list(scene.overrides)
    copy = f"Assets/Scenes/{Path(scene.parameters).name}"
    assert documents[302].data["_parameterAsset"]["guid"] == stable_guid(copy)
    assert documents[103].data["_target"] == {axis: f"{value:g}" for axis, value in zip("xyz", scene.target)}


def test_variants_of_users_find_the_prefabs_objects() -> None:
    prefab = parse((ROOT / "Assets/Guidewire/Prefabs/WireInVessel.prefab").read_text(encoding="utf-8"))
    assert [document.file_id for document in prefab] == [100, 101, 102, 103, 104, 105, 106]

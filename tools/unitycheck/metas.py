"""Meta files: one beside every asset, with a stable GUID and the importer that the extension calls for."""

from __future__ import annotations

import hashlib
import re
from functools import lru_cache
from pathlib import PurePosixPath
from typing import Iterator

from tools.unitycheck.project import Project
from tools.unitycheck.violation import Violation

KNOWN_GUIDS = "tools/unitycheck/known_guids.txt"
_TRAILER = "  userData: \n  assetBundleName: \n  assetBundleVariant: \n"
# The importers that Unity itself names for an extension. What is in no table is taken as Unity wrote it.
_IMPORTERS = {
    "DefaultImporter": ".unity .rsp", "TextScriptImporter": ".json .txt .md .csv .xml .bytes", "MonoImporter": ".cs",
    "AssemblyDefinitionImporter": ".asmdef", "AssemblyDefinitionReferenceImporter": ".asmref",
    "NativeFormatImporter": ".mat .asset", "PrefabImporter": ".prefab", "PluginImporter": ".dll .so .dylib",
    "TextureImporter": ".png .jpg .tga", "ShaderImporter": ".shader", "ModelImporter": ".fbx .obj",
}
_IMPORTER_OF = {suffix: name for name, suffixes in _IMPORTERS.items() for suffix in suffixes.split()}
# Of Unity's own assets and of nothing.
_RESERVED = re.compile(r"^0{16}[0-9a-f]0{15}$")


def importer(path: str, is_folder: bool) -> str | None:
    """Return the name of the importer that Unity uses for a path; None where the extension is in no table."""
    if is_folder:
        return "DefaultImporter"
    if PurePosixPath(path).name == "package.json":
        return "PackageManifestImporter"
    suffix = PurePosixPath(path).suffix
    return _IMPORTER_OF.get(suffix.lower()) if suffix else "DefaultImporter"


@lru_cache(maxsize=None)
def stable_guid(path: str) -> str:
    """Return the GUID given to a new asset: the same on every machine, and kept when the file is renamed."""
    return hashlib.md5(f"guidewire/{path}".encode("utf-8")).hexdigest()


def meta_text(path: str, is_folder: bool) -> str:
    """Return the whole .meta file of a new asset."""
    name = importer(path, is_folder) or "DefaultImporter"
    text = f"fileFormatVersion: 2\nguid: {stable_guid(path)}\n"
    if is_folder:
        text += "folderAsset: yes\n"
    text += f"{name}:\n  externalObjects: {{}}\n"
    if name == "MonoImporter":
        text += "  serializedVersion: 2\n  defaultReferences: []\n  executionOrder: 0\n  icon: {instanceID: 0}\n"
    if name == "NativeFormatImporter":
        text += f"  mainObjectFileID: {2100000 if path.endswith('.mat') else 11400000}\n"
    return text + _TRAILER


def _assets(project: Project) -> Iterator[tuple[str, bool]]:
    for path in project.asset_folders:
        yield path, True
    for path in project.asset_files:
        if not path.endswith(".meta"):
            yield path, False


def write_missing(project: Project) -> list[str]:
    """Write the .meta files that are missing and return their paths; existing ones are never touched."""
    written = []
    for path, is_folder in _assets(project):
        meta = f"{path}.meta"
        if not project.exists(meta):
            (project.root / meta).write_bytes(meta_text(path, is_folder).encode("utf-8"))
            written.append(meta)
    return written


def guids(project: Project) -> dict[str, str]:
    """Asset path by GUID, for everything that has a .meta."""

    def make(p: Project) -> dict[str, str]:
        found: dict[str, str] = {}
        for path, _ in _assets(p):
            text = p.text(f"{path}.meta") if p.exists(f"{path}.meta") else ""
            found |= {guid: path for guid in re.findall(r"^guid: (\S*)$", text, re.MULTILINE)}
        return found

    return project.derived("guids", make)


def check(project: Project) -> Iterator[Violation]:
    """Rules meta-missing, meta-orphan, meta-form, guid-form, guid-twice, guid-changed, meta-importer."""
    seen: dict[str, str] = {}
    known = {tuple(line.split()) for line in project.text(KNOWN_GUIDS).splitlines() if not line.startswith("#")}
    for path, is_folder in _assets(project):
        meta = f"{path}.meta"
        if not project.exists(meta):
            yield Violation(path, 0, "meta-missing", "no .meta beside it; run with --write-metas")
            continue
        text = project.text(meta)
        stated = re.match(r"fileFormatVersion: 2\nguid: (\S*)(?:\n|$)", text)
        if stated is None or text.count("\nguid:") > 1:
            yield Violation(meta, 1, "meta-form", "must start with 'fileFormatVersion: 2', then the only 'guid: '")
            continue
        guid = stated.group(1)
        if not re.match(r"^[0-9a-f]{32}$", guid) or _RESERVED.match(guid):
            yield Violation(meta, 2, "guid-form",
                            f"guid '{guid}' is not 32 lowercase hexadecimal digits, or is Unity's own")
            continue
        if guid in seen:
            yield Violation(meta, 2, "guid-twice", f"guid {guid} also belongs to {seen[guid]}")
        seen[guid] = path
        if guid != stable_guid(path) and (path, guid) not in known:
            yield Violation(meta, 2, "guid-changed", f"guid {guid} is not that of this path ({stable_guid(path)}); "
                            f"an asset that was renamed or made by Unity is listed in {KNOWN_GUIDS}")
        yield from _importer_rules(path, is_folder, text)
    for path in project.assets(".meta"):
        if not project.exists(path[:-len(".meta")]):
            yield Violation(path, 0, "meta-orphan", "the file or folder that it describes is gone")


def _importer_rules(path: str, is_folder: bool, text: str) -> Iterator[Violation]:
    meta = f"{path}.meta"
    if is_folder != ("\nfolderAsset: yes\n" in text):
        said = "a folder needs" if is_folder else "a file must not have"
        yield Violation(meta, 3, "meta-importer", f"{said} 'folderAsset: yes'")
    blocks = re.findall(r"^(\w+Importer):$", text, re.MULTILINE)
    expected = importer(path, is_folder)
    # Unity 6 writes new scripts' metas without any importer block.
    is_short = path.endswith(".cs") and not blocks
    if (expected is not None or len(blocks) != 1) and blocks != [expected] and not is_short:
        yield Violation(meta, 3, "meta-importer", f"importer {', '.join(blocks) or 'missing'}, expected {expected}")

"""Meta files: one beside every asset, with a stable GUID and the importer that the extension calls for."""

from __future__ import annotations

import hashlib
import re
from functools import lru_cache
from pathlib import PurePosixPath
from typing import Iterator

from tools.unitycheck.project import Project, at_home
from tools.unitycheck.violation import Violation

GUID = re.compile(r"^[0-9a-f]{32}$")
KNOWN_GUIDS = "tools/unitycheck/known_guids.txt"

_TRAILER = "  userData: \n  assetBundleName: \n  assetBundleVariant: \n"
# The importers that Unity itself names for an extension. What is in no table is taken as Unity wrote it.
_IMPORTERS = {
    "DefaultImporter": ".unity .rsp .csproj .sln .blend1",
    "TextScriptImporter": ".json .txt .md .csv .xml .html .htm .yaml .bytes .fnt",
    "MonoImporter": ".cs", "AssemblyDefinitionImporter": ".asmdef", "AssemblyDefinitionReferenceImporter": ".asmref",
    "NativeFormatImporter": ".mat .asset .anim .controller .overrideController .mask .playable .renderTexture "
                            ".cubemap .flare .guiskin .physicMaterial .physicsMaterial2D .terrainlayer .lighting "
                            ".mixer .shadervariants .preset .brush .giparams .spriteatlas",
    "PrefabImporter": ".prefab", "PluginImporter": ".dll .so .dylib .bundle .aar .jar .a",
    "TextureImporter": ".png .jpg .jpeg .tga .psd .bmp .tif .tiff .gif .exr .hdr .pict .iff .webp",
    "ShaderImporter": ".shader", "ComputeShaderImporter": ".compute",
    "ShaderIncludeImporter": ".hlsl .cginc .glslinc",
    "ModelImporter": ".fbx .obj .dae .3ds .dxf .blend .max .ma .mb",
    "AudioImporter": ".wav .mp3 .ogg .aif .aiff .flac .mod .it .s3m .xm", "TrueTypeFontImporter": ".ttf .otf .dfont",
    "VideoClipImporter": ".mp4 .mov .webm .avi .m4v", "SpriteAtlasImporter": ".spriteatlasv2",
    "ScriptedImporter": ".uxml .uss .tss .inputactions .shadergraph .shadersubgraph",
}
_IMPORTER_OF = {suffix: name for name, suffixes in _IMPORTERS.items() for suffix in suffixes.split()}
_RESERVED = {"0" * 32, "0000000000000000e000000000000000", "0000000000000000f000000000000000",
             "0000000000000000d000000000000000", "0000000000000000c000000000000000"}


def importer(path: str, is_folder: bool) -> str | None:
    """The name of the importer that Unity uses for a path; None where the extension is in no table."""
    if is_folder:
        return "DefaultImporter"
    if PurePosixPath(path).name == "package.json":
        return "PackageManifestImporter"
    suffix = PurePosixPath(path).suffix
    return _IMPORTER_OF.get(suffix, _IMPORTER_OF.get(suffix.lower())) if suffix else "DefaultImporter"


@lru_cache(maxsize=None)
def stable_guid(path: str) -> str:
    """The GUID given to a new asset: the same on every machine, and kept when the file is renamed."""
    return hashlib.md5(f"guidewire/{path}".encode("utf-8")).hexdigest()


def meta_text(path: str, is_folder: bool) -> str:
    """The whole .meta file of a new asset."""
    name = importer(path, is_folder) or "DefaultImporter"
    text = f"fileFormatVersion: 2\nguid: {stable_guid(at_home(path))}\n"
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


def guid_of(project: Project, path: str) -> str:
    """The GUID in the .meta beside a path, or an empty string."""
    meta = f"{path}.meta"
    if not project.exists(meta):
        return ""
    return _guid_in(project.text(meta))


@lru_cache(maxsize=None)
def _guid_in(text: str) -> str:
    found = re.search(r"^guid: (\S*)$", text, re.MULTILINE)
    return found.group(1) if found else ""


def guids(project: Project) -> dict[str, str]:
    """Asset path by GUID, for everything that has a .meta."""
    return project.derived("guids", lambda p: {guid_of(p, path): path for path, _ in _assets(p)})


def _known(project: Project) -> set[tuple[str, str]]:
    if not project.exists(KNOWN_GUIDS):
        return set()
    lines = (line.split() for line in project.text(KNOWN_GUIDS).splitlines() if not line.startswith("#"))
    return {(words[0], words[1]) for words in lines if len(words) == 2}


def check(project: Project) -> Iterator[Violation]:
    """Rules meta-missing, meta-orphan, meta-form, guid-form, guid-twice, guid-changed, meta-importer."""
    seen: dict[str, str] = {}
    known = _known(project)
    for path, is_folder in _assets(project):
        meta = f"{path}.meta"
        if not project.exists(meta):
            yield Violation(path, 0, "meta-missing", "no .meta beside it; run with --write-metas")
            continue
        text = project.text(meta)
        if not text.startswith("fileFormatVersion: 2\nguid: "):
            yield Violation(meta, 1, "meta-form", "must start with 'fileFormatVersion: 2', then 'guid: '")
            continue
        guid = guid_of(project, path)
        if text.count("\nguid:") > 1:
            yield Violation(meta, 3, "meta-form", "more than one 'guid:'")
        if guid in _RESERVED:
            yield Violation(meta, 2, "guid-form", f"guid '{guid}' is one of Unity's own")
            continue
        if not GUID.match(guid):
            yield Violation(meta, 2, "guid-form", f"guid '{guid}' is not 32 lowercase hexadecimal digits")
            continue
        if guid in seen:
            yield Violation(meta, 2, "guid-twice", f"guid {guid} also belongs to {seen[guid]}")
            yield Violation(f"{seen[guid]}.meta", 2, "guid-twice", f"guid {guid} also belongs to {path}")
        seen[guid] = path
        home = at_home(path)
        if guid != stable_guid(home) and (home, guid) not in known:
            yield Violation(meta, 2, "guid-changed", f"guid {guid} is not that of this path ({stable_guid(home)}); "
                            f"an asset that was renamed or made by Unity is listed in {KNOWN_GUIDS}")
        yield from _importer_rules(path, is_folder, text)
    for path in project.assets(".meta"):
        if not project.exists(path[:-len(".meta")]):
            yield Violation(path, 0, "meta-orphan", "the file or folder that it describes is gone")


@lru_cache(maxsize=None)
def _importer_rules(path: str, is_folder: bool, text: str) -> tuple[Violation, ...]:
    """Rule meta-importer: of most files every check of this process asks the same."""
    found = []
    meta = f"{path}.meta"
    lines = text.splitlines()
    if is_folder != ("folderAsset: yes" in lines):
        said = "a folder needs" if is_folder else "a file must not have"
        found.append(Violation(meta, 3, "meta-importer", f"{said} 'folderAsset: yes'"))
    blocks = [line[:-1] for line in lines if re.match(r"^\w+Importer:$", line)]
    expected = importer(path, is_folder)
    # Unity 6 writes new scripts' metas without any importer block.
    is_short = path.endswith(".cs") and not blocks
    if (expected is not None or len(blocks) != 1) and blocks != [expected] and not is_short:
        found.append(Violation(
            meta, 3, "meta-importer", f"importer {', '.join(blocks) or 'missing'}, expected {expected}"))
    return tuple(found)

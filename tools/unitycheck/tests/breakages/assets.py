"""Breakages of materials, packages, metas, settings, menus and command lines."""

from __future__ import annotations

from tools.unitycheck.tests.breakages import (
    GUIDEWIRE, HUD, LOOP, MANIFEST, SCENE, VECTOR, WIRE_VIEW, Breakage, append, both, insert, move, remove, replace,
    write,
)

WIRE = f"{GUIDEWIRE}/Runtime/Resources/Guidewire/Wire.mat"
VESSEL = f"{GUIDEWIRE}/Runtime/Resources/Guidewire/Vessel.mat"
CORE = f"{GUIDEWIRE}/Core/Guidewire.Core.asmdef"
BUILD = "ProjectSettings/EditorBuildSettings.asset"
EDITOR = "ProjectSettings/EditorSettings.asset"
VERSION = "ProjectSettings/ProjectVersion.txt"
LOCK = "Packages/packages-lock.json"
PLAYER = f"{GUIDEWIRE}/Editor/PlayerBuild.cs"
DRAWER = f"{GUIDEWIRE}/Editor/LoopInspector.cs"
ENTRY = f"{GUIDEWIRE}/Editor/BatchEntry.cs"
GUIDE = "docs/unity.md"
META = f"{VECTOR}.meta"


def edit(path: str, old: str, new: str, rule: str, named: str = "") -> Breakage:
    return Breakage(replace(path, old, new), named or path, rule)


def package(line: str, rule: str) -> Breakage:
    return edit(MANIFEST, r'"dependencies": \{\n', f'"dependencies": {{\n    {line},\n', rule)


def asset(path: str, importer: str) -> Breakage:
    """A new asset whose .meta names another importer than Unity's."""
    meta = f"fileFormatVersion: 2\nguid: 0123456789abcdef0123456789abcdef\n{importer}:\n  externalObjects: {{}}\n"
    return Breakage(both(write(path, ""), write(f"{path}.meta", meta)), f"{path}.meta", "meta-importer")


BREAKAGES = {
    # Materials
    "no shader": edit(WIRE, r"m_Shader: \{[^}]*\}", "m_Shader: {fileID: 0}", "material-shader"),
    "unknown built-in shader": edit(WIRE, r"m_Shader: \{fileID: 46", "m_Shader: {fileID: 4600", "material-shader"),
    "shader of an unknown guid": edit(WIRE, "guid: 0000000000000000f000000000000000, type: 0",
                                      "guid: 0123456789abcdef0123456789abcdef, type: 3", "guid-unknown"),
    "shader's type": edit(WIRE, "f000000000000000, type: 0", "f000000000000000, type: 3", "reference-type"),
    "unknown keyword": edit(VESSEL, "_ALPHAPREMULTIPLY_ON", "_ALPHA_PREMULTIPLY_ON", "material-keyword"),
    "keyword of another mode": edit(VESSEL, "_ALPHAPREMULTIPLY_ON", "_ALPHATEST_ON", "material-keyword"),
    "keyword missing": edit(VESSEL, r"m_ValidKeywords:\n  - _ALPHAPREMULTIPLY_ON", "m_ValidKeywords: []",
                            "material-keyword"),
    "keyword that is invalid": edit(VESSEL, r"m_InvalidKeywords: \[\]", "m_InvalidKeywords:\n  - _SHINY",
                                    "material-keyword"),
    "property misspelt": edit(WIRE, "_Glossiness", "_Glosiness", "material-property"),
    "colour misspelt": edit(WIRE, "_Color:", "_Colour:", "material-property"),
    "colour without alpha": edit(WIRE, r"b: 1, a: 1\}", "b: 1}", "material-property"),
    "word for a number": edit(WIRE, "_Metallic: 0", "_Metallic: none", "material-property"),
    "mode of another blending": edit(VESSEL, "_DstBlend: 10", "_DstBlend: 0", "material-mode"),
    "blending left to the default": edit(VESSEL, r"    - _DstBlend: 10\n", "", "material-mode"),
    "mode that is none": edit(VESSEL, "_Mode: 3", "_Mode: 7", "material-mode"),
    "depth written by what is translucent": edit(VESSEL, "_ZWrite: 0", "_ZWrite: 1", "material-mode"),
    "translucent before the opaque": edit(VESSEL, "m_CustomRenderQueue: 3000", "m_CustomRenderQueue: 2000",
                                          "material-mode"),
    "material's name": edit(WIRE, "m_Name: Wire", "m_Name: Wires", "material-name"),
    "no material in the file": edit(WIRE, "--- !u!21 &2100000\nMaterial:", "--- !u!28 &2100000\nTexture2D:",
                                    "material-shader"),
    "property set by a wrong name": Breakage(insert(WIRE_VIEW,
                                                    'private void Shine() { _coloured.SetFloat("_Shine", 1f); }'),
                                             WIRE_VIEW, "material-property"),
    "keyword enabled by a wrong name": Breakage(insert(
        WIRE_VIEW, 'private void Glow() { _coloured.EnableKeyword("_EMISSIVE"); }'), WIRE_VIEW, "material-keyword"),
    "shader that does not exist": Breakage(insert(WIRE_VIEW, 'private Shader S() { return Shader.Find("Standart"); }'),
                                           WIRE_VIEW, "shader-find"),
    "shader that players lack": Breakage(insert(WIRE_VIEW, 'private Shader S() { return Shader.Find("Unlit/Color"); }'),
                                         WIRE_VIEW, "shader-find"),
    # Packages
    "unknown module": package('"com.unity.modules.imgu": "1.0.0"', "package-unknown"),
    "module of another version": edit(MANIFEST, '"com.unity.modules.imgui": "1.0.0"',
                                      '"com.unity.modules.imgui": "2.0.0"',
                                      "package-version"),
    "unknown package": package('"com.unity.cinemachine": "3.0.0"', "package-unknown"),
    "version of a package": edit(MANIFEST, '"3.2.1"', '"3.0.2"', "package-version"),
    "version that is none": edit(MANIFEST, '"3.2.1"', '"latest"', "package-version"),
    "version that is a number": edit(MANIFEST, '"3.2.1"', "3", "package-version"),
    "package missing": edit(MANIFEST, r",\s*\"com.unity.test-framework\": \"1.5.1\"", "", "package-missing"),
    "local package that is not there": package('"com.example.own": "file:../packages/own"', "package-file"),
    "local archive that is not there": package('"com.example.own": "file:own.tgz"', "package-file"),
    "local package outside": package('"com.example.own": "file:/tmp/own"', "package-file"),
    "local package of another name": Breakage(
        lambda project: {MANIFEST: project.data(MANIFEST).replace(
            b'"dependencies": {', b'"dependencies": {\n    "com.example.own": "file:../own",', 1),
            "own/package.json": b'{"name": "com.example.other", "version": "1.0.0"}\n'}, "own/package.json",
        "package-file"),
    "manifest with a comment": edit(MANIFEST, r"^\{", "// packages\n{", "json"),
    "manifest without dependencies": Breakage(write(MANIFEST, "{}\n"), MANIFEST, "json"),
    "manifest that is a list": Breakage(write(MANIFEST, "[]\n"), MANIFEST, "json"),
    "manifest gone": Breakage(remove(MANIFEST), MANIFEST, "json"),
    "embedded package without a name": Breakage(write("Packages/own/package.json", "{}\n"), "Packages/own/package.json",
                                                "package-file"),
    "registry without scopes": edit(MANIFEST, r"^\{", '{\n  "scopedRegistries": [{"name": "a", "url": "b"}],', "json"),
    "testables that are a word": edit(MANIFEST, r"^\{", '{\n  "testables": "a",', "json"),
    "conflict in the manifest": edit(MANIFEST, r"^\{", "<<<<<<< HEAD\n{", "text-conflict"),
    "lock that is older": Breakage(write(LOCK, '{"dependencies": {"com.unity.nuget.newtonsoft-json": '
                                         '{"version": "3.0.2"}}}\n'), LOCK, "package-version"),
    "lock with an entry of text": Breakage(write(LOCK, '{"dependencies": {"a": "1.0.0"}}\n'), LOCK, "json"),
    "lock that is a list": Breakage(write(LOCK, "[]\n"), LOCK, "json"),
    # Metas
    "guid changed": edit(META, "^guid: .", "guid: 0", "guid-changed"),
    "guid of wrong form": edit(META, "^guid: .", "guid: X", "guid-form"),
    "guid in capitals": edit(META, r"^guid: \w+", "guid: " + 16 * "AB", "guid-form"),
    "guid of nothing": edit(META, r"^guid: \w+", "guid: " + 32 * "0", "guid-form"),
    "guid of Unity's own": edit(META, r"^guid: \w+", "guid: 0000000000000000f000000000000000", "guid-form"),
    "guid twice in a meta": edit(META, r"^(guid: \w+\n)", r"\1\1", "meta-form"),
    "twins": Breakage(lambda project: {META: project.data(META), f"{HUD}.meta": project.data(META)}, f"{HUD}.meta",
                      "guid-twice"),
    "twin of the script that a scene names": Breakage(lambda project: {META: project.data(f"{LOOP}.meta")}, META,
                                                      "guid-twice"),
    "conflict in a meta": edit(META, "^guid: ", "<<<<<<< HEAD\nguid: ", "text-conflict"),
    "meta empty": Breakage(write(META, ""), META, "meta-form"),
    "meta of another format": edit(META, "fileFormatVersion: 2", "fileFormatVersion: 3", "meta-form"),
    "meta missing": Breakage(remove(META), VECTOR, "meta-missing"),
    "folder's meta missing": Breakage(remove(f"{GUIDEWIRE}/Core.meta"), f"{GUIDEWIRE}/Core", "meta-missing"),
    "folder's meta for a file": edit(f"{GUIDEWIRE}/Core.meta", "folderAsset: yes\n", "", "meta-importer"),
    "meta left behind": Breakage(remove(VECTOR), META, "meta-orphan"),
    "wrong importer": edit(f"{CORE}.meta", "AssemblyDefinitionImporter", "DefaultImporter", "meta-importer"),
    "importer of a picture": asset(f"{GUIDEWIRE}/A.png", "DefaultImporter"),
    "importer of a library": asset(f"{GUIDEWIRE}/A.dll", "DefaultImporter"),
    "importer of a prefab": asset(f"{GUIDEWIRE}/A.prefab", "NativeFormatImporter"),
    "importer of a shader": asset(f"{GUIDEWIRE}/A.shader", "TextScriptImporter"),
    "importer of an assembly reference": asset(f"{GUIDEWIRE}/A.asmref", "AssemblyDefinitionImporter"),
    "file renamed": Breakage(move(VECTOR, VECTOR.replace("Vector3d", "Vector")),
                             f"{VECTOR.replace('Vector3d', 'Vector')}.meta", "guid-changed"),
    # Settings
    "editor's version": Breakage(write(VERSION, "m_EditorVersion: 6000\n"), VERSION, "editor-version"),
    "editor too old": Breakage(write(VERSION, "m_EditorVersion: 2022.3.62f2\n"), VERSION, "editor-version"),
    "editor's two versions": edit(VERSION, r"Revision: 6000.0.58f2", "Revision: 6000.0.59f2", "editor-version"),
    "binary serialization": edit(EDITOR, "m_SerializationMode: 2", "m_SerializationMode: 1", "editor-settings"),
    "metas hidden": edit("ProjectSettings/VersionControlSettings.asset", "Visible Meta Files", "Hidden Meta Files",
                         "editor-settings"),
    "settings header": edit(EDITOR, "%YAML 1.1", "YAML 1.1", "yaml-header"),
    "settings of another class": edit(EDITOR, "!u!159", "!u!160", "class-id"),
    "settings gone": Breakage(remove(EDITOR), EDITOR, "settings-missing"),
    "scene not in the build": edit(BUILD, "Transversal", "Transverse", "build-scenes"),
    "scene switched off": edit(BUILD, "enabled: 1", "enabled: 0", "build-scenes"),
    "scene of another guid": edit(BUILD, "guid: .{8}", "guid: 00000000", "build-scenes"),
    "input by the new system alone": Breakage(write(
        "ProjectSettings/ProjectSettings.asset", "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n--- !u!129 &1\n"
        "PlayerSettings:\n  activeInputHandler: 1\n"), "ProjectSettings/ProjectSettings.asset", "player-settings"),
    "symbols of .NET": Breakage(write(
        "ProjectSettings/ProjectSettings.asset", "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n--- !u!129 &1\n"
        "PlayerSettings:\n  scriptingDefineSymbols:\n    Standalone: NET8_0_OR_GREATER\n"),
        "ProjectSettings/ProjectSettings.asset", "player-settings"),
    "tag of a wrong form in the settings": Breakage(both(write(
        "ProjectSettings/TagManager.asset", "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n--- !u!78 &1\nTagManager:\n"
        "  tags:\n  - Wires\n"), replace(SCENE, "m_TagString: Untagged", "m_TagString: Wire")), SCENE, "scene-tag"),
    "attributes": edit(".gitattributes", r"^\*\.unity.*?\n", "", "gitattributes"),
    # Menus and command lines
    "menu without a menu": edit(PLAYER, "Guidewire/Build player for Linux", "Build player for Linux", "menu-item"),
    "menu entry twice": edit(PLAYER, "Build player for Windows", "Build player for Linux", "menu-item"),
    "menu entry not static": edit(PLAYER, "public static void Windows", "public void Windows", "menu-item"),
    "menu entry with a parameter": edit(PLAYER, r"void Windows\(\)", "void Windows(int a)", "menu-item"),
    "menu entry that returns": edit(PLAYER, r"static void Windows\(\)", "static int Windows()", "menu-item"),
    "menu check that returns nothing": edit(PLAYER, r'"Guidewire/Build player for Windows"',
                                            '"Guidewire/Build player for Windows", true', "menu-item"),
    "inspector without its attribute": edit(DRAWER, r"    \[CustomEditor\([^]]*\]\n", "", "editor-drawer"),
    "menu of the guide": edit(PLAYER, "Guidewire/Build player for (Linux.*)Guidewire/Build",
                              r"Wire/Build player for \1Wire/Build",
                              "guide", GUIDE),
    "marker of a run's arguments": edit(f"{GUIDEWIRE}/Runtime/Batch/BatchRun.cs", '"-guidewire"', '"-wire"', "guide",
                                        GUIDE),
    "batch method renamed": edit(ENTRY, r"void Run\(\)", "void Go()", "execute-method", GUIDE),
    "batch method not static": edit(ENTRY, r"public static void Run\(\)", "public void Run()", "execute-method", GUIDE),
    "batch method with a parameter": edit(ENTRY, r"void Run\(\)", "void Run(string[] a)", "execute-method", GUIDE),
    "batch method with an overload": Breakage(insert(ENTRY, "public static void Run(int a) { }"), GUIDE,
                                              "execute-method"),
    "batch class renamed": edit(ENTRY, "class BatchEntry", "class Batch", "execute-method",
                                "guidewire/runs/unity_runner.py"),
    "namespace of the editor renamed": edit(PLAYER, "namespace Guidewire.Editor", "namespace Guidewire.Editing",
                                            "execute-method", GUIDE),
    "command line of the guide": edit(GUIDE, "PlayerBuild.Linux", "PlayerBuild.Linus", "execute-method"),
    "player's path in the guide": edit(GUIDE, "Build/Linux/Guidewire.x86_64 -batch", "Build/Linux/Guidewire -batch",
                                       "guide"),
    "player's path in the code": edit(PLAYER, '"Build/Windows/Guidewire.exe"', '"Build/Windows/Wire.exe"', "guide",
                                      GUIDE),
    "scene of the guide": edit(GUIDE, "Scenes/Insertion.unity", "Scenes/Insert.unity", "guide"),
    "parameters of the guide": edit(GUIDE, "params/longitudinal.json", "params/long.json", "guide"),
    "test platform of the guide": edit(GUIDE, "-testPlatform EditMode", "-testPlatform EditorMode", "guide"),
    "test assembly of the guide": edit(GUIDE, "`Guidewire.Unity.PlayTests`", "`Guidewire.PlayTests`", "guide"),
    "method that the guide does not know": Breakage(append(GUIDE, "Unity -executeMethod Guidewire.Editor.Build.All\n"),
                                                    GUIDE, "execute-method"),
}

"""Assembly definitions: which file belongs to which assembly, who may reference whom, and the wall around Core."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass, field
from typing import Any, Iterator

from tools.unitycheck.metas import guids
from tools.unitycheck.packages import dependencies, parsed
from tools.unitycheck.project import Project
from tools.unitycheck.violation import Violation

# Folders whose files compile without the engine: Core and Io for every host, Tests/Core because .NET runs them too.
ENGINE_FREE = ("Assets/Guidewire/Core/", "Assets/Guidewire/Io/", "Assets/Guidewire/Tests/Core/")
NO_ENGINE_ASSEMBLIES = ("Guidewire.Core", "Guidewire.Io")
# Assemblies of packages: the package that brings each.
OUTSIDE = {"UnityEngine.TestRunner": "com.unity.test-framework", "UnityEditor.TestRunner": "com.unity.test-framework",
           "UnityEngine.UI": "com.unity.ugui", "UnityEditor.UI": "com.unity.ugui",
           "Unity.TextMeshPro": "com.unity.ugui", "Unity.InputSystem": "com.unity.inputsystem",
           "Unity.Mathematics": "com.unity.mathematics", "Unity.Burst": "com.unity.burst"}
TEST_RUNNERS = {"UnityEngine.TestRunner", "UnityEditor.TestRunner"}
# Libraries of packages: the package that brings each.
LIBRARIES = {"nunit.framework.dll": "com.unity.test-framework",
             "Newtonsoft.Json.dll": "com.unity.nuget.newtonsoft-json"}
KEYS = {"name": str, "rootNamespace": str, "references": list, "includePlatforms": list, "excludePlatforms": list,
        "allowUnsafeCode": bool, "overrideReferences": bool, "precompiledReferences": list, "autoReferenced": bool,
        "defineConstraints": list, "versionDefines": list, "noEngineReferences": bool, "optionalUnityReferences": list}
PLATFORMS = {"Editor", "Android", "iOS", "LinuxStandalone64", "macOSStandalone", "WindowsStandalone32",
             "WindowsStandalone64", "WebGL", "WSA", "PS4", "PS5", "XboxOne", "GameCoreXboxOne", "GameCoreScarlett",
             "Switch", "Switch2", "tvOS", "VisionOS", "EmbeddedLinux", "QNX", "LinuxHeadlessSimulation", "Stadia",
             "Lumin", "CloudRendering", "Kepler", "ReservedCFE"}
PLAYERS = {"LinuxStandalone64", "WindowsStandalone64"}  # what Editor/PlayerBuild.cs builds
# Symbols that Unity defines in this project's editor or players, apart from versionDefines.
_DEFINED = re.compile(r"^(UNITY_(EDITOR(_WIN|_OSX|_LINUX|_64)?|STANDALONE(_WIN|_OSX|_LINUX)?|INCLUDE_TESTS|64|"
                      r"ASSERTIONS|5_\d_OR_NEWER|5_3_OR_NEWER|(20(1[789]|2[0123])(_\d)?|6000_0)_OR_NEWER|6000_0_\d+|"
                      r"6000_0|6000)|ENABLE_(MONO|IL2CPP|LEGACY_INPUT_MANAGER|INPUT_SYSTEM|PROFILER|UNITYWEBREQUEST|"
                      r"BURST_AOT)|DEBUG|TRACE|DEVELOPMENT_BUILD|NET_STANDARD(_2_0|_2_1)?|NET_UNITY_4_8|NETSTANDARD"
                      r"(2_1|2_0)?(_OR_GREATER)?|CSHARP_7_(3_)?OR_NEWER|PLATFORM_\w+|ENABLE_VR)$")
_PLATFORM_ONLY = re.compile(r"^UNITY_(ANDROID|IOS|IPHONE|TVOS|WEBGL|WSA|PS4|PS5|XBOXONE|SWITCH|GAMECORE|VISIONOS|"
                            r"STANDALONE_OSX|EDITOR_OSX|SERVER)$|^6000_[1-9]")


@dataclass
class Asmdef:
    """One assembly definition. folders: its own and those of assembly references, ending in '/'; data: its JSON."""

    path: str
    data: dict[str, Any] = field(default_factory=dict)
    folders: list[str] = field(default_factory=list)

    @property
    def folder(self) -> str:
        return self.path.rpartition("/")[0] + "/"

    @property
    def name(self) -> str:
        return str(self.data.get("name", ""))

    def strings(self, key: str) -> list[str]:
        """The texts of a list, or nothing where it is no list."""
        value = self.data.get(key)
        return [item for item in value if isinstance(item, str)] if isinstance(value, list) else []

    @property
    def is_editor_only(self) -> bool:
        return self.strings("includePlatforms") == ["Editor"]

    @property
    def is_test(self) -> bool:
        return bool(TEST_RUNNERS & set(self.strings("references"))) or \
            "nunit.framework.dll" in self.strings("precompiledReferences")


def load(project: Project) -> tuple[list[Asmdef], list[Violation]]:
    """Every readable assembly definition, with the folders of its references, and what is wrong with the others."""
    found, problems = [], []
    for path in project.assets(".asmdef"):
        data, problem = parsed(project, path)
        if problem:
            problems.append(problem)
        elif not isinstance(data, dict) or not isinstance(data.get("name"), str) or not data["name"]:
            problems.append(Violation(path, 0, "asmdef-form", "needs an object with a string 'name'"))
        else:
            asmdef = Asmdef(path, data)
            asmdef.folders.append(asmdef.folder)
            found.append(asmdef)
    by_name = {asmdef.name: asmdef for asmdef in found}
    by_guid = _by_guid(project, found)
    for path in project.assets(".asmref"):
        data, problem = parsed(project, path)
        reference = data.get("reference") if isinstance(data, dict) else None
        if problem:
            problems.append(problem)
        elif not isinstance(reference, str) or (reference not in OUTSIDE
                                                and not _target(reference, by_name, by_guid)):
            problems.append(Violation(path, 0, "asmref", f"reference {reference!r} is no assembly of the project"))
        elif reference not in OUTSIDE:
            _target(reference, by_name, by_guid).folders.append(path.rpartition("/")[0] + "/")
    return found, problems


def assemblies(project: Project) -> list[Asmdef]:
    """The readable assembly definitions."""
    return project.derived("assemblies", load)[0]


def _by_guid(project: Project, asmdefs: list[Asmdef]) -> dict[str, Asmdef]:
    by_path = {asmdef.path: asmdef for asmdef in asmdefs}
    return {guid: by_path[path] for guid, path in guids(project).items() if path in by_path}


def _target(reference: str, by_name: dict[str, Asmdef], by_guid: dict[str, Asmdef]) -> Asmdef | None:
    return by_guid.get(reference[5:]) if reference.startswith("GUID:") else by_name.get(reference)


def targets(project: Project, asmdef: Asmdef) -> list[tuple[str, Asmdef | None]]:
    """Each reference as written, with the project's assembly that it means."""
    asmdefs = assemblies(project)
    by_name, by_guid = {item.name: item for item in asmdefs}, _by_guid(project, asmdefs)
    return [(reference, _target(reference, by_name, by_guid)) for reference in asmdef.strings("references")]


def owner(asmdefs: list[Asmdef], path: str) -> Asmdef | None:
    """The assembly that a source file belongs to: the nearest definition or reference above it."""
    best, depth = None, -1
    for asmdef in asmdefs:
        for folder in asmdef.folders:
            if path.startswith(folder) and len(folder) > depth:
                best, depth = asmdef, len(folder)
    return best


def check(project: Project) -> Iterator[Violation]:
    """Rules asmdef-* and asmref."""
    asmdefs, problems = project.derived("assemblies", load)
    yield from problems
    seen: dict[str, str] = {}
    folders = Counter(path.rpartition("/")[0] for path in project.assets(".asmdef", ".asmref"))
    for path in project.assets(".asmdef", ".asmref"):
        if folders[path.rpartition("/")[0]] > 1:
            yield Violation(path, 0, "asmdef-folder", "one assembly definition or reference a folder")
    for asmdef in asmdefs:
        yield from _form(asmdef, seen)
        yield from _lists(project, asmdef)
        yield from _constraints(asmdef)
        references = targets(project, asmdef)
        for reference, target in references:
            if target is None and reference not in OUTSIDE:
                yield Violation(asmdef.path, 0, "asmdef-reference", f"reference '{reference}' is no known assembly")
            elif target is asmdef:
                yield Violation(asmdef.path, 0, "asmdef-reference", f"reference '{reference}' is the assembly itself")
            elif target is None and OUTSIDE[reference] not in dependencies(project) and dependencies(project) \
                    and OUTSIDE[reference] != "com.unity.ugui" and OUTSIDE[reference] not in _optional(asmdef):
                yield Violation(asmdef.path, 0, "asmdef-reference", f"'{reference}' needs {OUTSIDE[reference]}")
        meant = [target.path if target else reference for reference, target in references]
        for twice in sorted({name for name in meant if meant.count(name) > 1}):
            yield Violation(asmdef.path, 0, "asmdef-reference", f"{twice} is referenced twice")
        yield from _arrows(asmdef, [target for _, target in references if target and target is not asmdef])
        if asmdef.is_test:
            yield from _test_form(asmdef)
    yield from _cycles(project, asmdefs)
    for path in project.assets(".cs"):
        if owner(asmdefs, path) is None:
            yield Violation(path, 0, "asmdef-outside", "stands in no assembly definition's folder")


def _optional(asmdef: Asmdef) -> set[str]:
    """Packages for which an assembly has a define: it compiles without them too."""
    defines = asmdef.data.get("versionDefines")
    return {str(entry.get("name")) for entry in defines if isinstance(entry, dict)} if isinstance(defines, list) else set()


def _form(asmdef: Asmdef, seen: dict[str, str]) -> Iterator[Violation]:
    for key, value in asmdef.data.items():
        if key not in KEYS:
            yield Violation(asmdef.path, 0, "asmdef-form", f"unknown key '{key}'")
        elif not isinstance(value, KEYS[key]):
            yield Violation(asmdef.path, 0, "asmdef-form", f"'{key}' must be a {KEYS[key].__name__}")
        elif isinstance(value, list) and key != "versionDefines" and not all(isinstance(item, str) for item in value):
            yield Violation(asmdef.path, 0, "asmdef-form", f"'{key}' must hold texts only")
    if asmdef.name in seen:
        yield Violation(asmdef.path, 0, "asmdef-name", f"name '{asmdef.name}' also in {seen[asmdef.name]}")
    seen[asmdef.name] = asmdef.path
    if asmdef.path != f"{asmdef.folder}{asmdef.name}.asmdef":
        yield Violation(asmdef.path, 0, "asmdef-name", f"the file must be called {asmdef.name}.asmdef")
    if asmdef.data.get("includePlatforms") and asmdef.data.get("excludePlatforms"):
        yield Violation(asmdef.path, 0, "asmdef-form", "includePlatforms and excludePlatforms are both set")
    if asmdef.name in NO_ENGINE_ASSEMBLIES and asmdef.data.get("noEngineReferences") is not True:
        yield Violation(asmdef.path, 0, "asmdef-engine", "noEngineReferences must be true")
    defines = asmdef.data.get("versionDefines")
    for entry in defines if isinstance(defines, list) else []:
        if not isinstance(entry, dict) or not all(isinstance(entry.get(key), str) and entry[key]
                                                  for key in ("name", "define")):
            yield Violation(asmdef.path, 0, "asmdef-form",
                            "an entry of versionDefines needs 'name', 'expression', 'define'")


def _lists(project: Project, asmdef: Asmdef) -> Iterator[Violation]:
    for key in ("includePlatforms", "excludePlatforms"):
        for name in asmdef.strings(key):
            if name not in PLATFORMS:
                yield Violation(asmdef.path, 0, "asmdef-platform", f"{key}: Unity has no platform '{name}'")
    included, excluded = set(asmdef.strings("includePlatforms")), set(asmdef.strings("excludePlatforms"))
    if (included and "Editor" not in included) or "Editor" in excluded:
        yield Violation(asmdef.path, 0, "asmdef-platform", "leaves out the editor, where Play and the tests run")
    needs_players = not asmdef.is_editor_only and not asmdef.is_test
    if needs_players and ((included and not PLAYERS <= included) or PLAYERS & excluded):
        yield Violation(asmdef.path, 0, "asmdef-platform", f"leaves out a player that is built: {sorted(PLAYERS)}")
    listed = asmdef.strings("precompiledReferences")
    if listed and asmdef.data.get("overrideReferences") is not True:
        yield Violation(asmdef.path, 0, "asmdef-precompiled",
                        "precompiledReferences count only with overrideReferences true")
    own = {path.rpartition("/")[2] for path in project.assets(".dll")}
    for name in listed:
        if name in LIBRARIES:
            if LIBRARIES[name] not in dependencies(project) and dependencies(project):
                yield Violation(asmdef.path, 0, "asmdef-precompiled", f"{name} needs {LIBRARIES[name]}")
        elif not name.endswith(".dll"):
            yield Violation(asmdef.path, 0, "asmdef-precompiled", f"'{name}' must be a file name that ends in .dll")
        elif name not in own:
            yield Violation(asmdef.path, 0, "asmdef-precompiled", f"no package and no folder has {name}")
        if listed.count(name) > 1 and listed.index(name) == len(listed) - 1 - listed[::-1].index(name) - (
                listed.count(name) - 1):
            yield Violation(asmdef.path, 0, "asmdef-precompiled", f"{name} is listed twice")


def _constraints(asmdef: Asmdef) -> Iterator[Violation]:
    defines = asmdef.data.get("versionDefines")
    own = {entry.get("define") for entry in defines if isinstance(entry, dict)} if isinstance(defines, list) else set()
    constraints = asmdef.strings("defineConstraints")
    for constraint in constraints:
        parts = [part.strip() for part in constraint.split("||")]
        if not all(re.match(r"^!?[A-Za-z_]\w*$", part) for part in parts):
            yield Violation(asmdef.path, 0, "asmdef-constraint",
                            f"'{constraint}' is not of the form SYMBOL, !SYMBOL or A || B")
        elif not any(_may_hold(part, own, asmdef.is_editor_only) for part in parts):
            yield Violation(asmdef.path, 0, "asmdef-constraint",
                            f"'{constraint}' never holds: the assembly would not be compiled")
        if f"!{constraint}" in constraints:
            yield Violation(asmdef.path, 0, "asmdef-constraint", f"'{constraint}' and its opposite never both hold")
    if "UNITY_INCLUDE_TESTS" in constraints and not asmdef.is_test:
        yield Violation(asmdef.path, 0, "asmdef-constraint", "UNITY_INCLUDE_TESTS keeps an assembly out of players")
    if "UNITY_EDITOR" in constraints and not asmdef.is_editor_only and not asmdef.is_test:
        yield Violation(asmdef.path, 0, "asmdef-constraint", "UNITY_EDITOR keeps an assembly out of players")


def _may_hold(part: str, own: set[Any], is_editor_only: bool) -> bool:
    symbol = part.lstrip("!")
    if part.startswith("!"):
        always = {"UNITY_5_3_OR_NEWER", "UNITY_6000_0_OR_NEWER", "UNITY_64", "CSHARP_7_3_OR_NEWER"} \
            | ({"UNITY_EDITOR", "UNITY_INCLUDE_TESTS"} if is_editor_only else set())
        return symbol not in always
    newer = re.match(r"^UNITY_6000_(\d+)_OR_NEWER$", symbol)
    if _PLATFORM_ONLY.match(symbol) and is_editor_only:
        return False
    return bool(_DEFINED.match(symbol) or _PLATFORM_ONLY.match(symbol)) or symbol in own or (newer is not None and
                                                                                         int(newer.group(1)[:4]) == 0)


def _test_form(asmdef: Asmdef) -> Iterator[Violation]:
    wanted = (("UNITY_INCLUDE_TESTS" in asmdef.strings("defineConstraints"),
               "defineConstraints needs UNITY_INCLUDE_TESTS"),
              (asmdef.data.get("overrideReferences") is True, "overrideReferences must be true"),
              ("nunit.framework.dll" in asmdef.strings("precompiledReferences"),
               "precompiledReferences needs nunit.framework.dll"),
              (TEST_RUNNERS <= set(asmdef.strings("references")), "references need both TestRunner assemblies"),
              (asmdef.data.get("autoReferenced") is False, "autoReferenced must be false"),
              (asmdef.is_editor_only or asmdef.strings("includePlatforms") or "/Play/" in asmdef.path,
               "includePlatforms must be Editor: outside a folder Play stand tests of the EditMode"))
    for holds, message in wanted:
        if not holds:
            yield Violation(asmdef.path, 0, "asmdef-test", message)


def _arrows(asmdef: Asmdef, references: list[Asmdef]) -> Iterator[Violation]:
    for target in references:
        if target.is_editor_only and not asmdef.is_editor_only:
            yield Violation(asmdef.path, 0, "asmdef-editor", f"references {target.name}, which only the editor has")
        if asmdef.data.get("noEngineReferences") and not target.data.get("noEngineReferences"):
            yield Violation(asmdef.path, 0, "asmdef-engine", f"is engine-free but references {target.name}")
        if target.is_test and not asmdef.is_test:
            yield Violation(asmdef.path, 0, "asmdef-test", f"references the test assembly {target.name}")


def _cycles(project: Project, asmdefs: list[Asmdef]) -> Iterator[Violation]:
    after = {asmdef.name: [target.name for _, target in targets(project, asmdef)
                           if target is not None and target is not asmdef] for asmdef in asmdefs}
    reported: set[frozenset[str]] = set()
    for asmdef in asmdefs:
        path = [asmdef.name]
        stack = [iter(after[asmdef.name])]
        done: set[str] = set()
        while stack:
            name = next(stack[-1], None)
            if name is None:
                stack.pop()
                done.add(path.pop())
            elif name == asmdef.name:
                if frozenset(path) not in reported:
                    reported.add(frozenset(path))
                    yield Violation(asmdef.path, 0, "asmdef-cycle", " -> ".join(path + [name]))
            elif name in after and name not in path and name not in done:
                path.append(name)
                stack.append(iter(after[name]))

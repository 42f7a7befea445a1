"""Assembly definitions: which file belongs to which assembly, who may reference whom, and the wall around Core."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Iterator

from tools.unitycheck.metas import guids
from tools.unitycheck.packages import dependencies, parsed
from tools.unitycheck.project import Project
from tools.unitycheck.violation import Violation

NO_ENGINE_ASSEMBLIES = ("Guidewire.Core", "Guidewire.Io")
# Assemblies of packages: the package that brings each.
OUTSIDE = {"UnityEngine.TestRunner": "com.unity.test-framework", "UnityEditor.TestRunner": "com.unity.test-framework",
           "Unity.InputSystem": "com.unity.inputsystem", "Unity.Mathematics": "com.unity.mathematics",
           "Unity.Burst": "com.unity.burst"}
TEST_RUNNERS = {"UnityEngine.TestRunner", "UnityEditor.TestRunner"}
# Libraries of packages: the package that brings each.
LIBRARIES = {"nunit.framework.dll": "com.unity.test-framework",
             "Newtonsoft.Json.dll": "com.unity.nuget.newtonsoft-json"}
_OWN_DEFINE = re.compile(r"\bGUIDEWIRE_\w+")  # a define of this project's own
_CONDITION = re.compile(r"^\s*#(?:el)?if.*$", re.MULTILINE)
KEYS = {"name": str, "rootNamespace": str, "references": list, "includePlatforms": list, "excludePlatforms": list,
        "allowUnsafeCode": bool, "overrideReferences": bool, "precompiledReferences": list, "autoReferenced": bool,
        "defineConstraints": list, "versionDefines": list, "noEngineReferences": bool}


@dataclass
class Asmdef:
    """One assembly definition; data: its JSON."""

    path: str
    data: dict[str, Any]

    @property
    def folder(self) -> str:
        return self.path.rpartition("/")[0] + "/"

    @property
    def name(self) -> str:
        return str(self.data.get("name", ""))

    def strings(self, key: str) -> list[str]:
        """Return the texts of a list, or nothing where it is no list."""
        value = self.data.get(key)
        return [item for item in value if isinstance(item, str)] if isinstance(value, list) else []

    @property
    def is_editor_only(self) -> bool:
        return self.strings("includePlatforms") == ["Editor"]

    @property
    def is_test(self) -> bool:
        return bool(TEST_RUNNERS & set(self.strings("references"))) or \
            "nunit.framework.dll" in self.strings("precompiledReferences")


def assemblies(project: Project) -> list[Asmdef]:
    """Return the readable assembly definitions."""
    return project.derived("assemblies", lambda p: [
        Asmdef(path, parsed(p, path)[0]) for path in p.assets(".asmdef") if not parsed(p, path)[1]])


def targets(project: Project, asmdef: Asmdef) -> list[tuple[str, Asmdef | None]]:
    """Return each reference as written, by name or GUID, with the project's assembly that it means."""
    known = {item.name: item for item in assemblies(project)}
    by_path = {item.path: item for item in assemblies(project)}
    known |= {f"GUID:{guid}": by_path[path] for guid, path in guids(project).items() if path in by_path}
    return [(reference, known.get(reference)) for reference in asmdef.strings("references")]


def owner(asmdefs: list[Asmdef], path: str) -> Asmdef | None:
    """Return the assembly that a source file belongs to: the nearest definition above it."""
    above = [asmdef for asmdef in asmdefs if path.startswith(asmdef.folder)]
    return max(above, key=lambda asmdef: len(asmdef.folder), default=None)


def check(project: Project) -> Iterator[Violation]:
    """Rules asmdef-* and nullable."""
    asmdefs = assemblies(project)
    names, folders = [asmdef.name for asmdef in asmdefs], [asmdef.folder for asmdef in asmdefs]
    yield from filter(None, (parsed(project, path)[1] for path in project.assets(".asmdef")))
    for asmdef in asmdefs:
        found = [*_form(asmdef), *_references(project, asmdef), *_libraries(project, asmdef)]
        if asmdef.path != f"{asmdef.folder}{asmdef.name}.asmdef" or names.count(asmdef.name) > 1:
            found.append(("name", f"'{asmdef.name}' must be the file's name, and no other's"))
        if folders.count(asmdef.folder) > 1:
            found.append(("folder", "one assembly definition a folder"))
        for rule, message in found:
            yield Violation(asmdef.path, 0, f"asmdef-{rule}", message)
        options = f"{asmdef.folder}csc.rsp"
        if not project.exists(options) or "-nullable:enable" not in project.text(options).split():
            yield Violation(options, 0, "nullable", "needs -nullable:enable, which the sources rely on")
    samples = [Asmdef(path, parsed(project, path)[0]) for path in project.samples(".asmdef")]
    used: dict[str, set[str]] = {asmdef.path: set(asmdef.strings("defineConstraints")) for asmdef in asmdefs + samples}
    for path in project.assets(".cs") + project.samples(".cs"):
        own = owner(asmdefs + samples, path)
        if own is None:
            yield Violation(path, 0, "asmdef-outside", "stands in no assembly definition's folder")
        else:
            used[own.path] |= set(_OWN_DEFINE.findall(" ".join(_CONDITION.findall(project.text(path)))))
    for asmdef in asmdefs + samples:
        made = {str(entry.get("define")) for entry in _version_defines(asmdef)}
        for define in sorted(made ^ {word for word in used[asmdef.path] if _OWN_DEFINE.fullmatch(word)}):
            yield Violation(asmdef.path, 0, "asmdef-define", f"{define}: made and asked for by nothing, or the "
                                                             "other way round")


def _version_defines(asmdef: Asmdef) -> list[dict[str, Any]]:
    defines = asmdef.data.get("versionDefines")
    return [entry for entry in defines if isinstance(entry, dict)] if isinstance(defines, list) else []


def _form(asmdef: Asmdef) -> Iterator[tuple[str, str]]:
    for key, value in asmdef.data.items():
        if key not in KEYS:
            yield "form", f"unknown key '{key}'"
        elif not isinstance(value, KEYS[key]) or (key != "versionDefines" and isinstance(value, list)
                                                  and len(asmdef.strings(key)) < len(value)):
            yield "form", f"'{key}' must be a {KEYS[key].__name__}, lists of texts"
    if asmdef.name in NO_ENGINE_ASSEMBLIES and asmdef.data.get("noEngineReferences") is not True:
        yield "engine", "noEngineReferences must be true"
    if asmdef.strings("includePlatforms") not in ([], ["Editor"]) or asmdef.data.get("excludePlatforms"):
        yield "platform", "is for the editor alone, or for all: what leaves out others is compiled for nobody here"
    if asmdef.strings("defineConstraints") != (["UNITY_INCLUDE_TESTS"] if asmdef.is_test else []):
        yield "constraint", "defineConstraints: UNITY_INCLUDE_TESTS in tests, nothing elsewhere"
    if asmdef.is_test:
        wanted = ((asmdef.data.get("overrideReferences") is True, "overrideReferences must be true"),
                  ("nunit.framework.dll" in asmdef.strings("precompiledReferences"),
                   "precompiledReferences needs nunit.framework.dll"),
                  (TEST_RUNNERS <= set(asmdef.strings("references")), "references need both TestRunner assemblies"),
                  (asmdef.data.get("autoReferenced") is False, "autoReferenced must be false"),
                  (asmdef.is_editor_only or "/Play/" in asmdef.path,
                   "includePlatforms must be Editor: outside a folder Play stand tests of the EditMode"))
        yield from (("test", message) for holds, message in wanted if not holds)


def _references(project: Project, asmdef: Asmdef) -> Iterator[tuple[str, str]]:
    references = targets(project, asmdef)
    # Packages for which an assembly has a define: it compiles without them too.
    optional = [entry.get("name") for entry in _version_defines(asmdef)]
    meant = [target.path if target else reference for reference, target in references]
    for reference, target in references:
        if target is None and reference not in OUTSIDE:
            yield "reference", f"reference '{reference}' is no known assembly"
        elif target is None and OUTSIDE[reference] not in [*dependencies(project), *optional]:
            yield "reference", f"'{reference}' needs {OUTSIDE[reference]}"
        if meant.count(target.path if target else reference) > 1:
            yield "reference", f"'{reference}' is referenced twice"
        if target is None:
            continue
        if target.is_editor_only and not asmdef.is_editor_only:
            yield "editor", f"references {target.name}, which only the editor has"
        if asmdef.data.get("noEngineReferences") and not target.data.get("noEngineReferences"):
            yield "engine", f"is engine-free but references {target.name}"
        if target.is_test and not asmdef.is_test:
            yield "test", f"references the test assembly {target.name}"
    reached, new = {asmdef.path}, [asmdef]
    while new:
        below = [target for item in new for _, target in targets(project, item) if target is not None]
        if asmdef in below:
            yield "cycle", "references itself, directly or through others"
            return
        new = [target for target in below if target.path not in reached]
        reached |= {target.path for target in new}


def _libraries(project: Project, asmdef: Asmdef) -> Iterator[tuple[str, str]]:
    listed = asmdef.strings("precompiledReferences")
    if listed and asmdef.data.get("overrideReferences") is not True:
        yield "precompiled", "precompiledReferences count only with overrideReferences true"
    for name in listed:
        if LIBRARIES.get(name) not in dependencies(project):
            yield "precompiled", f"no package of the manifest has {name}"

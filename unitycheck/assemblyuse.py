"""What sources use of other assemblies: every namespace and type must be referenced, every internal one befriended."""

from __future__ import annotations

import functools
from typing import Iterator

from unitycheck.asmdefs import Asmdef, assemblies, owner, targets
from unitycheck.behaviours import types
from unitycheck.csharp import tokens
from unitycheck.declarations import Declaration, usings
from unitycheck.packages import dependencies
from unitycheck.project import Project
from unitycheck.violation import Violation

# Namespaces of packages: (what an assembly has to reference, the package).
_PACKAGES = {
    "NUnit": ("nunit.framework.dll", "com.unity.test-framework"),
    "UnityEngine.TestTools": ("UnityEngine.TestRunner", "com.unity.test-framework"),
    "UnityEditor.TestTools": ("UnityEditor.TestRunner", "com.unity.test-framework"),
    "Newtonsoft": ("Newtonsoft.Json.dll", "com.unity.nuget.newtonsoft-json"),
    "UnityEngine.UI": ("UnityEngine.UI", "com.unity.ugui"), "TMPro": ("Unity.TextMeshPro", "com.unity.ugui"),
    "UnityEngine.InputSystem": ("Unity.InputSystem", "com.unity.inputsystem"),
    "Unity.Mathematics": ("Unity.Mathematics", "com.unity.mathematics"),
    "Unity.Burst": ("Unity.Burst", "com.unity.burst"),
}


def friends(project: Project, asmdef: Asmdef) -> dict[str, tuple[str, int]]:
    """The assemblies that may see an assembly's internals, with the file and line that says so."""
    found: dict[str, tuple[str, int]] = {}
    for path in project.derived("files that name friends", _naming_friends):
        if owner(assemblies(project), path) is asmdef:
            items = tokens(project.text(path))
            for i in range(len(items) - 2):
                if items[i].text in ("InternalsVisibleTo",
                                     "InternalsVisibleToAttribute") and items[i + 2].kind == "text":
                    found[items[i + 2].value] = (path, items[i].line)
    return found


def _naming_friends(project: Project) -> list[str]:
    return [path for path in project.assets(".cs") if "InternalsVisibleTo" in project.text(path)]


@functools.lru_cache(maxsize=4096)
def _bare_words(source: str) -> frozenset[str]:
    """Words that may name a type: no member of something."""
    items = tokens(source)
    return frozenset(token.text for i, token in enumerate(items)
                     if token.kind == "word" and (not i or items[i - 1].text not in (".", "?.")))


def check(project: Project) -> Iterator[Violation]:
    """Rules asmdef-needed, internals."""
    asmdefs = assemblies(project)
    home = {path: owner(asmdefs, path) for path in project.assets(".cs")}
    # Types at the top level, by namespace, then by name: the assemblies that declare them.
    declared: dict[str, dict[str, list[tuple[Asmdef, Declaration]]]] = {}
    for path, found in types(project).items():
        for declaration in found:
            if home[path] is not None and not declaration.outer:
                named = declared.setdefault(declaration.namespace, {})
                named.setdefault(declaration.name, []).append((home[path], declaration))
    inhabitants = {namespace: {where.name for places in named.values() for where, _ in places}
                   for namespace, named in declared.items()}
    seen = {asmdef.name: [asmdef] + [target for _, target in targets(project, asmdef) if target is not None]
            for asmdef in asmdefs}
    known = {asmdef.name: friends(project, asmdef) for asmdef in asmdefs}
    names = {asmdef.name for asmdef in asmdefs}
    for asmdef in asmdefs:
        for friend, (path, line) in known[asmdef.name].items():
            is_dotnet = project.exists(f"experiments/headless/{friend}") or not project.exists("experiments/headless")
            if friend not in names and not is_dotnet:
                yield Violation(path, line, "internals", f"there is no assembly '{friend}' to see the internals")
    for path, asmdef in home.items():
        if asmdef is None:
            continue
        reported: set[str] = set()
        for line, namespace in usings(project.text(path)):
            yield from _package(project, path, line, namespace, asmdef)
            homes = inhabitants.get(namespace, set())
            if homes and not homes & {where.name for where in seen[asmdef.name]}:
                reported |= {min(homes)}
        own = {declaration.namespace for declaration in types(project)[path]}
        open_to = {namespace for _, namespace in usings(project.text(path))} | {
            ".".join(namespace.split(".")[:depth]) for namespace in own
            for depth in range(1, namespace.count(".") + 2)}
        used = _bare_words(project.text(path))
        for namespace in sorted(open_to & declared.keys()):
            for name, places in declared[namespace].items():
                if name not in used or len(reported) > 3:
                    continue
                reached = [(where, declaration) for where, declaration in places if where in seen[asmdef.name]]
                if not reached:
                    reported.add(places[0][0].name)
                elif all(where is not asmdef and "public" not in declaration.modifiers
                         and asmdef.name not in known[where.name] for where, declaration in reached):
                    yield Violation(path, 0, "internals", f"{name} is internal to {reached[0][0].name}, which has no "
                                    f"InternalsVisibleTo(\"{asmdef.name}\")")
        for missing in sorted(reported):
            yield Violation(asmdef.path, 0, "asmdef-needed", f"{path} uses {missing}, which is not referenced")


def _package(project: Project, path: str, line: int, namespace: str, asmdef: Asmdef) -> Iterator[Violation]:
    for start, (needed, package) in _PACKAGES.items():
        if namespace != start and not namespace.startswith(f"{start}."):
            continue
        if needed.endswith(".dll"):
            is_seen = needed in asmdef.strings("precompiledReferences") if asmdef.data.get("overrideReferences") \
                else needed != "nunit.framework.dll"
        else:
            is_seen = needed in asmdef.strings("references")
        if not is_seen:
            yield Violation(asmdef.path, 0, "asmdef-needed", f"{path} uses {namespace}: reference {needed}")
        if dependencies(project) and package not in dependencies(project):
            yield Violation(path, line, "package-missing", f"{namespace} needs {package} in the manifest")

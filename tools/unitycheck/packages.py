"""Packages/manifest.json and its lock, against the versions that ship with the pinned editor."""

from __future__ import annotations

import posixpath
import re
from typing import Any, Iterator

from tools.unitycheck.project import Project, strict_json
from tools.unitycheck.violation import Violation

MANIFEST = "Packages/manifest.json"
LOCK = "Packages/packages-lock.json"

# Versions that go with editor 6000.0.58f2; built-in modules are all 1.0.0.
VERSIONS = {
    "com.unity.nuget.newtonsoft-json": "3.2.1",
    "com.unity.test-framework": "1.5.1",
    "com.unity.ext.nunit": "2.0.5",
    "com.unity.ugui": "2.0.0",
    "com.unity.inputsystem": "1.14.2",
    "com.unity.ide.visualstudio": "2.0.25",
    "com.unity.ide.rider": "3.0.36",
    "com.unity.burst": "1.8.24",
    "com.unity.mathematics": "1.3.2",
}
REQUIRED = ("com.unity.nuget.newtonsoft-json", "com.unity.test-framework")

# Class of the engine: the module without which it does not exist.
MODULE_OF = {
    "GUI": "imgui", "GUILayout": "imgui", "GUIStyle": "imgui", "OnGUI": "imgui",
    "Physics": "physics", "Collider": "physics", "MeshCollider": "physics", "BoxCollider": "physics",
    "SphereCollider": "physics", "Rigidbody": "physics", "CreatePrimitive": "physics", "OnCollisionEnter": "physics",
    "AudioListener": "audio", "AudioSource": "audio", "ParticleSystem": "particlesystem", "Animator": "animation",
    "JsonUtility": "jsonserialize", "ScreenCapture": "screencapture", "EncodeToPNG": "imageconversion",
    "ImageConversion": "imageconversion", "Canvas": "ui", "UnityWebRequest": "unitywebrequest",
}


# Built-in modules of 6000.x.
MODULES = {
    "accessibility", "adaptiveperformance", "ai", "amd", "androidjni", "animation", "assetbundle", "audio", "cloth",
    "clustering", "director", "hierarchycore", "imageconversion", "imgui", "jsonserialize", "nvidia", "particlesystem",
    "physics", "physics2d", "physicscore2d", "screencapture", "subsystems", "terrain", "terrainphysics", "tilemap",
    "ui", "uielements", "umbra", "unityanalytics", "unitywebrequest", "unitywebrequestassetbundle",
    "unitywebrequestaudio", "unitywebrequesttexture", "unitywebrequestwww", "vectorgraphics", "vehicles", "video", "vr",
    "virtualtexturing", "wind", "xr",
}
PINNED = (6000, 0, 58)
_VERSION = re.compile(r"^\d{1,6}\.\d{1,6}\.\d{1,6}(-[\w.-]+)?(\+[\w.-]+)?$")
_NAME = re.compile(r"^[a-z0-9-]+(\.[a-z0-9-]+){2,}$")
_EDITOR = re.compile(r"^m_EditorVersion: (\d{1,6})\.(\d{1,6})\.(\d{1,6})")


def parsed(project: Project, path: str) -> tuple[Any, Violation | None]:
    """The JSON of a file, or the violation that says why it is none."""
    if not project.is_file(path):
        return None, Violation(path, 0, "json", "the file is missing")
    try:
        return strict_json(project.text(path)), None
    except ValueError as error:
        return None, Violation(path, getattr(error, "lineno", 0), "json", f"not strict JSON: {error}")
    except RecursionError:
        return None, Violation(path, 0, "json", "not strict JSON: nested too deep")


def dependencies(project: Project) -> dict[str, str]:
    """The manifest's packages, empty if it cannot be read."""

    def make(p: Project) -> dict[str, str]:
        manifest, _ = parsed(p, MANIFEST)
        found = manifest.get("dependencies") if isinstance(manifest, dict) else None
        return found if isinstance(found, dict) else {}

    return project.derived("dependencies", make)


def is_newer_editor(project: Project) -> bool:
    """Whether the project was opened by a newer editor than the pinned one: it brings newer packages along."""
    path = "ProjectSettings/ProjectVersion.txt"
    found = _EDITOR.match(project.text(path)) if project.is_file(path) else None
    return found is not None and tuple(map(int, found.groups())) > PINNED


def _numbers(version: str) -> tuple[int, ...]:
    return tuple(int(part) for part in version.partition("-")[0].partition("+")[0].split("."))


def _version_rules(project: Project, path: str, name: str, version: Any) -> Iterator[Violation]:
    if not isinstance(version, str):
        yield Violation(path, 0, "package-version", f"{name}: the version must be a string")
    elif version.startswith("file:"):
        yield from _local(project, path, name, version[len("file:"):])
    elif name.startswith("com.unity.modules."):
        if name.rpartition(".")[2] not in MODULES:
            yield Violation(path, 0, "package-unknown", f"{name}: Unity has no such module")
        elif version != "1.0.0":
            yield Violation(path, 0, "package-version", f"{name} {version}: built-in modules are 1.0.0")
    elif not _VERSION.match(version):
        yield Violation(path, 0, "package-version", f"{name}: '{version}' is no version such as 1.2.3")
    elif name not in VERSIONS:
        yield Violation(path, 0, "package-unknown", f"{name} is not in the table of packages that were checked")
    elif is_newer_editor(project):
        if _numbers(version) < _numbers(VERSIONS[name]):
            yield Violation(path, 0, "package-version", f"{name} {version}: at least {VERSIONS[name]}")
    elif version != VERSIONS[name]:
        yield Violation(path, 0, "package-version", f"{name} {version}: the pinned editor has {VERSIONS[name]}")


def _local(project: Project, path: str, name: str, place: str) -> Iterator[Violation]:
    target = posixpath.normpath(posixpath.join("Packages", place))
    if target.startswith(("..", "/")) or re.match(r"^[A-Za-z]:", place):
        yield Violation(path, 0, "package-file", f"{name}: '{place}' is outside the repository")
    elif place.endswith((".tgz", ".tar.gz")):
        if not project.is_file(target):
            yield Violation(path, 0, "package-file", f"{name}: there is no file {target}")
    elif not project.is_file(f"{target}/package.json"):
        yield Violation(path, 0, "package-file", f"{name}: there is no {target}/package.json")
    else:
        yield from _package(project, f"{target}/package.json", name)


def _package(project: Project, path: str, name: str) -> Iterator[Violation]:
    data, problem = parsed(project, path)
    if problem:
        yield problem
    elif not isinstance(data, dict) or data.get("name") != name or not isinstance(data.get("version"), str) \
            or not _VERSION.match(data["version"]):
        yield Violation(path, 0, "package-file", f"needs an object with name '{name}' and a version such as 1.2.3")


def _own(project: Project, path: str) -> Iterator[Violation]:
    """A package of the project's own sources: what it depends on is what the project has, its samples are there."""
    data, problem = parsed(project, path)
    folder = path.rpartition("/")[0]
    if problem:
        yield problem
        return
    if not isinstance(data, dict) or not _NAME.match(str(data.get("name"))) or not _VERSION.match(str(data.get("version"))) \
            or not isinstance(data.get("displayName"), str) or not isinstance(data.get("description"), str):
        yield Violation(path, 0, "package-file", "needs an object with a name such as org.name.package, a version such as "
                        "1.2.3, a displayName and a description")
        return
    asked = dependencies(project)
    wanted = data.get("dependencies", {})
    for name, version in wanted.items() if isinstance(wanted, dict) else ():
        if asked.get(name) != version:
            yield Violation(path, 0, "package-version", f"{name} {version}: the project has {asked.get(name)}")
    for sample in data.get("samples", []):
        place = sample.get("path") if isinstance(sample, dict) else None
        if not isinstance(place, str) or not place.startswith("Samples~/") or not project.exists(f"{folder}/{place}"):
            yield Violation(path, 0, "package-file", f"there is no sample {place} below Samples~")
    for name in ("CHANGELOG.md", "Documentation~"):
        if not project.exists(f"{folder}/{name}"):
            yield Violation(path, 0, "package-file", f"there is no {name} beside it")


def check(project: Project) -> Iterator[Violation]:
    """Rules json, package-version, package-unknown, package-missing, package-file."""
    manifest, problem = parsed(project, MANIFEST)
    if problem:
        yield problem
        return
    if not isinstance(manifest, dict) or not isinstance(manifest.get("dependencies"), dict):
        yield Violation(MANIFEST, 0, "json", "needs an object 'dependencies'")
        return
    for name, version in manifest["dependencies"].items():
        yield from _version_rules(project, MANIFEST, name, version)
    for name in REQUIRED:
        if name not in manifest["dependencies"]:
            yield Violation(MANIFEST, 0, "package-missing", f"needs {name}")
    for key, kind in (("scopedRegistries", list), ("testables", list), ("enableLockFile", bool)):
        if not isinstance(manifest.get(key, kind()), kind):
            yield Violation(MANIFEST, 0, "json", f"'{key}' must be a {kind.__name__}")
    for registry in manifest["scopedRegistries"] if isinstance(manifest.get("scopedRegistries"), list) else []:
        if not isinstance(registry, dict) or not all(isinstance(registry.get(key), kind) for key, kind in
                                                     (("name", str), ("url", str), ("scopes", list))):
            yield Violation(MANIFEST, 0, "json", "an entry of scopedRegistries needs 'name', 'url' and 'scopes'")
    for path in project.assets("/package.json"):
        yield from _own(project, path)
    for path in project.embedded_packages():
        yield from _package(project, path, path.split("/")[1])
    if project.exists(LOCK):
        yield from _lock(project, manifest["dependencies"])


def _lock(project: Project, asked: dict[str, Any]) -> Iterator[Violation]:
    """The lock is Unity's to write; what it resolves may be newer than what is asked for, never older."""
    lock, problem = parsed(project, LOCK)
    if problem:
        yield problem
        return
    entries = lock.get("dependencies") if isinstance(lock, dict) else None
    if not isinstance(entries, dict) or not all(isinstance(entry, dict) and isinstance(entry.get("version"), str)
                                                for entry in entries.values()):
        yield Violation(LOCK, 0, "json", "needs an object 'dependencies' whose entries have a 'version'")
        return
    for name, entry in entries.items():
        version, least = entry["version"], asked.get(name, VERSIONS.get(name))
        if isinstance(least, str) and _VERSION.match(least) and _VERSION.match(version) \
                and _numbers(version) < _numbers(least):
            yield Violation(LOCK, 0, "package-version", f"{name} {version}: at least {least}")

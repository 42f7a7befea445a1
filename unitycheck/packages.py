"""Packages/manifest.json and its lock, against the versions that ship with the pinned editor."""

from __future__ import annotations

from typing import Any, Iterator

from unitycheck.project import Project, strict_json
from unitycheck.violation import Violation

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


def parsed(project: Project, path: str) -> tuple[Any, Violation | None]:
    """The JSON of a file, or the violation that says why it is none."""
    if not project.exists(path):
        return None, Violation(path, 0, "json", "the file is missing")
    try:
        return strict_json(project.text(path)), None
    except ValueError as error:
        return None, Violation(path, getattr(error, "lineno", 0), "json", f"not strict JSON: {error}")


def dependencies(project: Project) -> dict[str, str]:
    """The manifest's packages, empty if it cannot be read."""
    manifest, _ = parsed(project, MANIFEST)
    found = manifest.get("dependencies") if isinstance(manifest, dict) else None
    return found if isinstance(found, dict) else {}


def _version_rules(path: str, name: str, version: Any) -> Iterator[Violation]:
    if not isinstance(version, str):
        yield Violation(path, 0, "package-version", f"{name}: the version must be a string")
    elif name.startswith("com.unity.modules.") and version != "1.0.0":
        yield Violation(path, 0, "package-version", f"{name} {version}: built-in modules are 1.0.0")
    elif name in VERSIONS and version != VERSIONS[name]:
        yield Violation(path, 0, "package-version", f"{name} {version}: the pinned editor has {VERSIONS[name]}")
    elif not version.startswith("file:") and not name.startswith("com.unity.modules.") and name not in VERSIONS:
        yield Violation(path, 0, "package-unknown", f"{name} is not in the table of packages that were checked")


def check(project: Project) -> Iterator[Violation]:
    """Rules json, package-version, package-unknown, package-missing."""
    manifest, problem = parsed(project, MANIFEST)
    if problem:
        yield problem
        return
    if not isinstance(manifest, dict) or not isinstance(manifest.get("dependencies"), dict):
        yield Violation(MANIFEST, 0, "json", "needs an object 'dependencies'")
        return
    for name, version in manifest["dependencies"].items():
        yield from _version_rules(MANIFEST, name, version)
    for name in REQUIRED:
        if name not in manifest["dependencies"]:
            yield Violation(MANIFEST, 0, "package-missing", f"needs {name}")
    if project.exists(LOCK):
        lock, problem = parsed(project, LOCK)
        if problem:
            yield problem
            return
        for name, entry in lock.get("dependencies", {}).items():
            if name in VERSIONS:
                yield from _version_rules(LOCK, name, entry.get("version"))

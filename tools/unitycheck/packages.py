"""Packages/manifest.json against the versions that ship with the pinned editor, and this package's own description."""

from __future__ import annotations

import re
from typing import Any, Iterator

from tools.unitycheck.project import Project, strict_json
from tools.unitycheck.violation import Violation

MANIFEST = "Packages/manifest.json"
OWN = "Assets/Guidewire/package.json"
# Versions that go with editor 6000.0.58f2, which a newer one raises; built-in modules are all 1.0.0.
VERSIONS = {"com.unity.nuget.newtonsoft-json": "3.2.1", "com.unity.test-framework": "1.5.1", "com.unity.ugui": "2.0.0",
            "com.unity.inputsystem": "1.14.2", "com.unity.ide.visualstudio": "2.0.25", "com.unity.ide.rider": "3.0.36",
            "com.unity.burst": "1.8.24", "com.unity.mathematics": "1.3.2"}
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
ENGINE = ("Assets/Guidewire/Runtime/", "Assets/Guidewire/Editor/", "Assets/Scenes/")
_BESIDE = re.compile(r'//.*|"(\\.|[^"\\\n])*"')  # comments and texts
_VERSION = re.compile(r"^\d{1,6}\.\d{1,6}\.\d{1,6}(-[\w.-]+)?$")
_NAME = re.compile(r"^[a-z0-9-]+(\.[a-z0-9-]+){2,}$")


def parsed(project: Project, path: str) -> tuple[dict[str, Any], Violation | None]:
    """Return the JSON object of a file, or the violation that says why it is none."""
    if not project.exists(path):
        return {}, Violation(path, 0, "json", "the file is missing")
    try:
        data = strict_json(project.text(path))
    except (ValueError, RecursionError) as error:
        return {}, Violation(path, getattr(error, "lineno", 0), "json", f"not strict JSON: {error}")
    if not isinstance(data, dict):
        return {}, Violation(path, 0, "json", "must hold an object")
    return data, None


def dependencies(project: Project) -> dict[str, str]:
    """Return the manifest's packages, empty if it cannot be read."""
    found = parsed(project, MANIFEST)[0].get("dependencies")
    return found if isinstance(found, dict) else {}


def _numbers(version: str) -> tuple[int, ...]:
    return tuple(int(part) for part in version.partition("-")[0].split("."))


def check(project: Project) -> Iterator[Violation]:
    """Rules json, package-version, package-unknown, package-missing, package-file, module-missing."""
    problem = parsed(project, MANIFEST)[1]
    if problem:
        yield problem
    asked = dependencies(project)
    for name, version in asked.items():
        module = name.startswith("com.unity.modules.") and name.rpartition(".")[2] in MODULE_OF.values()
        least = "1.0.0" if module else VERSIONS.get(name)
        if least is None:
            yield Violation(MANIFEST, 0, "package-unknown", f"{name} is not in the table of packages that were checked")
        elif not isinstance(version, str) or not _VERSION.match(version) or _numbers(version) < _numbers(least) \
                or (module and version != least):
            yield Violation(MANIFEST, 0, "package-version", f"{name} {version}: the pinned editor has {least}")
    for name in REQUIRED:
        if name not in asked:
            yield Violation(MANIFEST, 0, "package-missing", f"needs {name}")
    yield from _own(project, asked)
    for path in project.assets(".cs"):
        if path.startswith(ENGINE):
            for word in sorted(set(re.findall(r"\w+", _BESIDE.sub("", project.text(path)))) & set(MODULE_OF)):
                module = f"com.unity.modules.{MODULE_OF[word]}"
                if module not in asked:
                    yield Violation(path, 0, "module-missing", f"{word} needs {module} in the manifest")


def _own(project: Project, asked: dict[str, str]) -> Iterator[Violation]:
    """The package of the project's own sources: what it depends on is what the project has, its samples are there."""
    data, problem = parsed(project, OWN)
    if problem:
        yield problem
        return
    if not _NAME.match(str(data.get("name"))) or not _VERSION.match(str(data.get("version"))):
        yield Violation(OWN, 0, "package-file", "needs a name such as org.name.package and a version such as 1.2.3")
    wanted, samples = data.get("dependencies"), data.get("samples")
    for name, version in wanted.items() if isinstance(wanted, dict) else ():
        if asked.get(name) != version:
            yield Violation(OWN, 0, "package-version", f"{name} {version}: the project has {asked.get(name)}")
    for sample in samples if isinstance(samples, list) else ():
        place = str(sample.get("path") if isinstance(sample, dict) else sample)
        if not place.startswith("Samples~/") or not project.exists(f"Assets/Guidewire/{place}"):
            yield Violation(OWN, 0, "package-file", f"there is no sample {place} below Samples~")

"""Which types of the project Unity attaches to objects, and which it stores as values."""

from __future__ import annotations

import functools
from typing import Iterator

from unitycheck.csharp import tokens
from unitycheck.declarations import Declaration, declarations
from unitycheck.project import Project

ROOTS = {"MonoBehaviour", "ScriptableObject"}
# Unity's own objects that a field may refer to. What stands in no table is taken as it is.
OBJECTS = {
    "Object", "GameObject", "Component", "Transform", "RectTransform", "Behaviour", "MonoBehaviour", "ScriptableObject",
    "Camera", "Light", "Material", "Mesh", "Texture", "Texture2D", "Texture3D", "RenderTexture", "Cubemap", "Shader",
    "ComputeShader", "Sprite", "TextAsset", "Font", "AudioClip", "AudioSource", "AudioListener", "Rigidbody",
    "Collider", "BoxCollider", "SphereCollider", "CapsuleCollider", "MeshCollider", "Renderer", "MeshRenderer",
    "MeshFilter", "LineRenderer", "SkinnedMeshRenderer", "Animator", "Animation", "AnimationClip", "ParticleSystem",
    "Canvas", "GUISkin", "PhysicsMaterial", "Skybox", "ReflectionProbe",
}


def types(project: Project) -> dict[str, list[Declaration]]:
    """The types of each C# file under Assets."""
    return project.derived("types", lambda p: {path: declarations(p.text(path)) for path in p.assets(".cs")})


def by_name(project: Project) -> dict[str, list[Declaration]]:
    """The types of the project by their bare name."""

    def make(p: Project) -> dict[str, list[Declaration]]:
        found: dict[str, list[Declaration]] = {}
        for declared in types(p).values():
            for declaration in declared:
                found.setdefault(declaration.name, []).append(declaration)
        return found

    return project.derived("types by name", make)


def descendants(project: Project, roots: set[str]) -> set[str]:
    """The names of the project's classes that derive from one of the roots, and the roots."""

    def make(p: Project) -> set[str]:
        known = set(roots)
        while True:
            more = {name for name, declared in by_name(p).items()
                    if any(set(declaration.bases) & known for declaration in declared)} - known
            if not more:
                return known
            known |= more

    return project.derived(f"descendants of {sorted(roots)}", make)


def behaviours(project: Project) -> dict[str, list[Declaration]]:
    """The MonoBehaviours and ScriptableObjects of each file."""
    def make(project: Project) -> dict[str, list[Declaration]]:
        known = descendants(project, ROOTS)
        return {path: [declaration for declaration in declared
                       if declaration.kind == "class" and not known.isdisjoint(declaration.bases)]
                for path, declared in types(project).items()}

    return project.derived("behaviours", make)


def chain(project: Project, declaration: Declaration) -> Iterator[Declaration]:
    """A type and those of its bases that are the project's, nearest first."""
    seen: set[str] = set()
    waiting = [declaration]
    while waiting:
        current = waiting.pop(0)
        if current.name not in seen:
            seen.add(current.name)
            yield current
            waiting += [base for name in current.bases for base in by_name(project).get(name, [])]


@functools.lru_cache(maxsize=4096)
def words(source: str) -> dict[str, int]:
    """How often each word, and each text in quotes, stands in a file."""
    found: dict[str, int] = {}
    for token in tokens(source):
        if token.kind in ("word", "text"):
            word = token.text if token.kind == "word" else token.value
            found[word] = found.get(word, 0) + 1
    return found

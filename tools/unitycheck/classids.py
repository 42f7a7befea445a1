"""Unity's numbers for the classes of its YAML files (manual: YAML Class ID reference). No table is complete: a number
and a name that are both unknown here are taken as Unity wrote them."""

from __future__ import annotations

from typing import Iterator

from tools.unitycheck.unityyaml import Document
from tools.unitycheck.violation import Violation

CLASSES = {
    1: "GameObject", 4: "Transform", 5: "TimeManager", 11: "AudioManager", 13: "InputManager", 19: "Physics2DSettings",
    20: "Camera", 21: "Material", 23: "MeshRenderer", 25: "Renderer", 28: "Texture2D", 29: "OcclusionCullingSettings",
    30: "GraphicsSettings", 33: "MeshFilter", 43: "Mesh", 45: "Skybox", 47: "QualitySettings", 48: "Shader",
    49: "TextAsset", 50: "Rigidbody2D", 54: "Rigidbody", 55: "PhysicsManager", 59: "HingeJoint", 64: "MeshCollider",
    65: "BoxCollider", 74: "AnimationClip", 78: "TagManager", 81: "AudioListener", 82: "AudioSource",
    84: "RenderTexture",
    91: "AnimatorController", 95: "Animator", 96: "TrailRenderer", 102: "TextMesh", 104: "RenderSettings", 108: "Light",
    111: "Animation", 114: "MonoBehaviour", 115: "MonoScript", 120: "LineRenderer", 124: "Behaviour", 126:
    "NavMeshProjectSettings", 128: "Font", 129: "PlayerSettings", 134: "PhysicMaterial", 135: "SphereCollider",
    136: "CapsuleCollider", 137: "SkinnedMeshRenderer", 143: "CharacterController", 149: "NetworkManager",
    157: "LightmapSettings", 159: "EditorSettings", 162: "EditorUserSettings", 167: "GUILayer", 192: "OcclusionArea",
    196: "NavMeshSettings", 198: "ParticleSystem", 199: "ParticleSystemRenderer", 205: "LODGroup",
    212: "SpriteRenderer", 215: "ReflectionProbe", 218: "Terrain", 220: "LightProbeGroup", 222: "CanvasRenderer",
    223: "Canvas", 224: "RectTransform", 225: "CanvasGroup", 236: "ClusterInputManager", 258: "LightProbes",
    310: "UnityConnectSettings", 331: "SpriteMask", 850595691: "LightingSettings", 1001: "PrefabInstance",
    1045: "EditorBuildSettings", 655991488: "MultiplayerManager", 387306366: "MemorySettings",
    890905787: "VersionControlSettings", 937362698: "VFXManager", 1386491679: "PresetManager", 1660057539: "SceneRoots",
}
_NUMBERS = {name: number for number, name in CLASSES.items()}


def check(path: str, document: Document) -> Iterator[Violation]:
    """Rule class-id: the number and the name of a document belong together."""
    number, name = document.class_id, document.type
    if CLASSES.get(number, name) != name:
        yield Violation(path, document.line, "class-id", f"class {number} is {CLASSES[number]}, not {name}")
    elif _NUMBERS.get(name, number) != number:
        yield Violation(path, document.line, "class-id", f"{name} is class {_NUMBERS[name]}, not {number}")
    elif path.endswith((".unity", ".mat")) and number not in CLASSES and not 0 < number < 1_000 \
            and not 1_000_000 < number < 2**31:
        yield Violation(path, document.line, "class-id", f"Unity has no class {number}")

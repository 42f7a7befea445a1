"""What Unity writes when it opens the project for the first time, in its own formats, and when a newer one does.

Class numbers, keys and line ends are those of public projects of 6000.0 to 6000.3; the values are this project's or
Unity's defaults.
"""

from __future__ import annotations

import json
import re
from typing import Any

from tools.unitycheck.project import Project

HEADER = "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n"
SETTINGS = "ProjectSettings"
SCENE = "Assets/Guidewire/Scenes/Insertion.unity"
_BUILTIN = "guid: 0000000000000000f000000000000000, type: 0"


def _document(class_id: int, name: str, body: str) -> bytes:
    return f"{HEADER}--- !u!{class_id} &1\n{name}:\n{body}".encode()


_SHADERS = "".join(f"  m_{name}:\n    m_Mode: 1\n    m_Shader: {{fileID: {number}, {_BUILTIN}}}\n" for name, number in (
    ("Deferred", 69), ("DeferredReflections", 74), ("ScreenSpaceShadows", 64), ("DepthNormals", 62),
    ("MotionVectors", 75), ("LightHalo", 105), ("LensFlare", 102)))
_ALWAYS = "".join(f"  - {{fileID: {number}, {_BUILTIN}}}\n" for number in (7, 15104, 15105, 15106, 10753, 10770))
_BLOCKS = "".join(f"    m_{name}: -1\n" for name in (
    "MainAllocatorBlockSize", "ThreadAllocatorBlockSize", "CacheBlockSize", "TypetreeBlockSize", "ProfilerBlockSize"))
_LAYERS = "".join(f"  - {name}\n" for name in ["Default", "TransparentFX", "Ignore Raycast", "", "Water",
                                               "UI"] + 26 * [""])
_AREAS = "".join(f"  - name: {name}\n    cost: {cost}\n" for name, cost in (("Walkable", 1), ("Not Walkable", 1),
                                                                          ("Jump", 2), ("", 1)))

FILES: dict[str, bytes] = {
    # The four classes that no hand writes, and the one that a hand may.
    f"{SETTINGS}/GraphicsSettings.asset": _document(
        30, "GraphicsSettings", f"  m_ObjectHideFlags: 0\n  serializedVersion: 16\n{_SHADERS}"
        f"  m_VideoShadersIncludeMode: 2\n  m_AlwaysIncludedShaders:\n{_ALWAYS}  m_PreloadedShaders: []\n"
        f"  m_SpritesDefaultMaterial: {{fileID: 10754, {_BUILTIN}}}\n  m_CustomRenderPipeline: {{fileID: 0}}\n"
        "  m_TransparencySortAxis: {x: 0, y: 0, z: 1}\n  m_RenderPipelineGlobalSettingsMap: {}\n"),
    f"{SETTINGS}/MemorySettings.asset": _document(
        387306366, "MemorySettings", "  m_ObjectHideFlags: 0\n  m_EditorMemorySettings:\n" + _BLOCKS
        + "  m_PlatformMemorySettings: {}\n"),
    f"{SETTINGS}/PresetManager.asset": _document(
        1386491679, "PresetManager", "  m_ObjectHideFlags: 0\n  serializedVersion: 2\n  m_DefaultPresets: {}\n"),
    f"{SETTINGS}/VFXManager.asset": _document(
        937362698, "VFXManager", "  m_ObjectHideFlags: 0\n  m_IndirectShader: {fileID: 0}\n"
        "  m_RenderPipeSettingsPath: \n  m_FixedTimeStep: 0.016666668\n  m_MaxDeltaTime: 0.05\n"),
    f"{SETTINGS}/TagManager.asset": _document(
        78, "TagManager", "  serializedVersion: 2\n  tags: []\n  layers:\n" + _LAYERS
        + "  m_SortingLayers:\n  - name: Default\n    uniqueID: 0\n    locked: 0\n"),
    # The others
    f"{SETTINGS}/AudioManager.asset": _document(11, "AudioManager", "  m_ObjectHideFlags: 0\n  m_Volume: 1\n"),
    f"{SETTINGS}/ClusterInputManager.asset": _document(236, "ClusterInputManager",
                                                       "  m_ObjectHideFlags: 0\n  m_Inputs: []\n"),
    f"{SETTINGS}/DynamicsManager.asset": _document(
        55, "PhysicsManager", "  m_ObjectHideFlags: 0\n  serializedVersion: 13\n  m_Gravity: {x: 0, y: -9.81, z: 0}\n"
        "  m_DefaultMaterial: {fileID: 0}\n"),
    f"{SETTINGS}/EditorSettings.asset": _document(
        159, "EditorSettings", "  m_ObjectHideFlags: 0\n  serializedVersion: 12\n  m_SerializationMode: 2\n"
        "  m_LineEndingsForNewScripts: 1\n  m_PrefabRegularEnvironment: {fileID: 0}\n"
        "  m_ProjectGenerationIncludedExtensions: txt;xml;fnt;cd;asmdef;rsp;asmref\n"
        "  m_ProjectGenerationRootNamespace: \n  m_SerializeInlineMappingsOnOneLine: 1\n  m_CacheServerEndpoint: \n"),
    f"{SETTINGS}/InputManager.asset": _document(
        13, "InputManager", "  m_ObjectHideFlags: 0\n  serializedVersion: 2\n  m_Axes:\n  - serializedVersion: 3\n"
        "    m_Name: Horizontal\n    descriptiveName: \n    negativeButton: left\n    positiveButton: right\n"
        "    gravity: 3\n    dead: 0.001\n    joyNum: 0\n  m_UsePhysicalKeys: 1\n"),
    f"{SETTINGS}/MultiplayerManager.asset": _document(
        655991488, "MultiplayerManager", "  m_ObjectHideFlags: 0\n  m_EnableMultiplayerRoles: 0\n"
        "  m_StrippingTypes: {}\n"),
    f"{SETTINGS}/NavMeshAreas.asset": _document(
        126, "NavMeshProjectSettings", f"  m_ObjectHideFlags: 0\n  serializedVersion: 2\n  areas:\n{_AREAS}"
        "  m_LastAgentTypeID: -887442657\n  m_Settings:\n  - serializedVersion: 3\n    agentTypeID: 0\n"
        "    debug:\n      m_Flags: 0\n  m_SettingNames:\n  - Humanoid\n"),
    f"{SETTINGS}/PackageManagerSettings.asset": _document(
        114, "MonoBehaviour", "  m_ObjectHideFlags: 53\n  m_GameObject: {fileID: 0}\n  m_Enabled: 1\n"
        "  m_Script: {fileID: 13964, guid: 0000000000000000e000000000000000, type: 0}\n  m_Name: \n"
        "  m_EditorClassIdentifier: \n  m_EnablePreReleasePackages: 0\n  m_Registries:\n  - m_Id: main\n    m_Name: \n"
        "    m_Url: https://packages.unity.com\n    m_Scopes: []\n    m_IsDefault: 1\n"
        "  m_UserSelectedRegistryName: \n  m_RegistryInfoDraft:\n    m_Modified: 0\n    m_ErrorMessage: \n"),
    f"{SETTINGS}/Physics2DSettings.asset": _document(
        19, "Physics2DSettings", "  m_ObjectHideFlags: 0\n  m_Gravity: {x: 0, y: -9.81}\n  m_JobOptions:\n"
        "    serializedVersion: 2\n    useMultithreading: 0\n"),
    f"{SETTINGS}/ProjectSettings.asset": _document(
        129, "PlayerSettings", "  m_ObjectHideFlags: 0\n  serializedVersion: 28\n"
        "  productGUID: 138753b7a00eaa643a0935a5090379a1\n  companyName: DefaultCompany\n  productName: guidewire\n"
        "  m_StackTraceTypes: 010000000100000001000000010000000100000001000000\n  vrSettings:\n    enable360Stereo: 0\n"
        "  apiCompatibilityLevelPerPlatform: {}\n  apiCompatibilityLevel: 6\n  activeInputHandler: 0\n"
        "  scriptingBackend: {}\n  scriptingDefineSymbols: {}\n  iPhoneSplashScreen: {fileID: 0}\n"
        "  m_BuildTargetIcons: []\n  metroTileBackgroundColor: {r: 0.13333334, g: 0.17254902, b: 0.21568628, a: 0}\n"),
    f"{SETTINGS}/QualitySettings.asset": _document(
        47, "QualitySettings", "  m_ObjectHideFlags: 0\n  serializedVersion: 5\n  m_CurrentQuality: 5\n"
        "  m_QualitySettings:\n  - serializedVersion: 4\n    name: Ultra\n    pixelLightCount: 4\n"
        "    customRenderPipeline: {fileID: 0}\n    excludedTargetPlatforms: []\n"
        "  m_TextureMipmapLimitGroupNames: []\n  m_PerPlatformDefaultQuality:\n    Standalone: 5\n    WebGL: 3\n"),
    f"{SETTINGS}/TimeManager.asset": _document(
        5, "TimeManager", "  m_ObjectHideFlags: 0\n  Fixed Timestep: 0.02\n  Maximum Allowed Timestep: 0.33333334\n"
        "  m_TimeScale: 1\n  Maximum Particle Timestep: 0.03\n"),
    f"{SETTINGS}/UnityConnectSettings.asset": _document(
        310, "UnityConnectSettings", "  m_ObjectHideFlags: 0\n  serializedVersion: 1\n  m_Enabled: 0\n"
        "  CrashReportingSettings:\n    serializedVersion: 2\n    m_EventUrl: https://perf-events.cloud.unity3d.com\n"),
    f"{SETTINGS}/VersionControlSettings.asset": _document(
        890905787, "VersionControlSettings", "  m_ObjectHideFlags: 0\n  m_Mode: Visible Meta Files\n"
        "  m_CollabEditorSettings:\n    inProgressEnabled: 1\n"),
    f"{SETTINGS}/XRSettings.asset": b'{\n    "m_SettingKeys": [\n        "VR Device Disabled"\n    ],\n'
                                    b'    "m_SettingValues": [\n        "False"\n    ]\n}',
    # No line end behind the last bracket
    f"{SETTINGS}/SceneTemplateSettings.json": json.dumps(
        {"templatePinStates": [], "dependencyTypeInfos": [
            {"userAdded": False, "type": "UnityEngine.AnimationClip", "defaultInstantiationMode": 0}],
         "defaultDependencyTypeInfo": {"userAdded": False, "type": "<default_scene_template_dependencies>",
                                       "defaultInstantiationMode": 1}, "newSceneOverride": 0}, indent=4).encode(),
}


def _entry(version: str, depth: int, source: str, **needs: str) -> dict[str, Any]:
    entry: dict[str, Any] = {"version": version, "depth": depth, "source": source,
                             "dependencies": {name.replace("_", "."): value for name, value in needs.items()}}
    return {**entry, "url": "https://packages.unity.com"} if source == "registry" else entry


def lock(project: Project, newer: bool = False) -> bytes:
    """The lock that goes with the manifest, of the pinned editor or of a newer one."""
    asked = json.loads(project.text("Packages/manifest.json"))["dependencies"]
    found = {name: _entry(version, 0, "builtin" if name.startswith("com.unity.modules.") else "registry")
             for name, version in asked.items()}
    found["com.unity.test-framework"] = _entry("1.6.0" if newer else "1.5.1", 0, "builtin", com_unity_ext_nunit="2.0.3")
    found["com.unity.ext.nunit"] = _entry("2.1.0" if newer else "2.0.5", 1, "builtin")
    found["com.unity.modules.hierarchycore"] = _entry("1.0.0", 1, "builtin")
    if newer:
        found["com.unity.ide.visualstudio"] = _entry("2.0.27", 0, "registry")
    return json.dumps({"dependencies": dict(sorted(found.items()))}, indent=2).encode()


def files(project: Project) -> dict[str, bytes]:
    """What the pinned editor adds and writes anew."""
    script = "Assets/Guidewire/Runtime/Views/Hud.cs"
    guid = project.text(f"{script}.meta").split("guid: ")[1][:32]
    return {**FILES, "Packages/packages-lock.json": lock(project),
            # Scripts' metas of 6000.0.42 and later: two lines, no end
            f"{script}.meta": f"fileFormatVersion: 2\nguid: {guid}".encode(), SCENE: scene(project)}


def scene(project: Project) -> bytes:
    """The insertion scene as Unity saves it: every stored field, names of classes, long texts over two lines."""
    text = project.text(SCENE)
    text = text.replace("  _overrides:\n", "  _parameterAsset: {fileID: 0}\n  _vessels: []\n  _overrides:\n", 1)
    text = text.replace("  _pace: 1\n", "  _logFolder: \n  _stepping: 0\n  _pace: 1\n  _stepsPerFrame: 100\n"
                        "  _frameBudget: 12\n", 1)
    text = text.replace("  _isSteered: 1\n", "  _isSteered: 1\n  _pushSpeed: 40\n  _turnSpeed: 180\n", 1)
    text = text.replace("  _colouring: 2\n", "  _ringsPerElement: 4\n  _sides: 12\n  _thickness: 1\n  _colouring: 2\n"
                        "  <ShowsSpheres>k__BackingField: 0\n  <ShowsDirectors>k__BackingField: 0\n", 1)
    text = text.replace("  _distance: 430\n", "  _distance: 430.5\n  _turnSpeed: 3e-1\n", 1)
    text = text.replace("  m_EditorClassIdentifier: \n", "  m_EditorClassIdentifier: Guidewire.Runtime::Guidewire."
                        "Runtime.OrbitCamera\n", 1)
    return text.replace("  m_Name: Light\n", "  m_Name: Light with a name so long that Unity goes on with it in the\n"
                        "    next line\n", 1).encode()


def newer(project: Project) -> dict[str, bytes]:
    """What a newer 6000.x changes besides: its version, the packages that ship with it."""
    manifest = project.text("Packages/manifest.json").replace('"com.unity.test-framework": "1.5.1"',
                                                              '"com.unity.test-framework": "1.6.0"')
    manifest = re.sub(r'"com.unity.ide.visualstudio": "[\d.]+"', '"com.unity.ide.visualstudio": "2.0.27"', manifest)
    return {**files(project), "Packages/manifest.json": manifest.encode(),
            "Packages/packages-lock.json": lock(project, newer=True),
            f"{SETTINGS}/TimeManager.asset": _document(
                5, "TimeManager", "  m_ObjectHideFlags: 0\n  serializedVersion: 2\n  Fixed Timestep:\n"
                "    m_Count: 2822400\n    m_Rate:\n      m_Denominator: 1\n      m_Numerator: 141120000\n"
                "  m_TimeScale: 1\n"),
            f"{SETTINGS}/ProjectVersion.txt": b"m_EditorVersion: 6000.3.2f1\n"
                                              b"m_EditorVersionWithRevision: 6000.3.2f1 (a9779f353c9b)\n",
            f"{SETTINGS}/SomeNewManager.asset": _document(2089858483, "SomeNewManager", "  m_ObjectHideFlags: 0\n")}

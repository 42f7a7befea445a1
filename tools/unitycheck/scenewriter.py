"""Writes the scenes with all that they name, twice, the package's prefab and materials, and the build's list of
scenes: the same bytes every time.

A scene of a package cannot be opened where it lies, and Unity sees nothing of a sample until it is copied into a
project. So this project has the scenes in a folder of its own, and the package has the same bytes with the same GUIDs
as a sample.

Everything that a scene can leave to the scripts is left to them: a scene holds a camera, a light and the components
with their fields. Meshes and everything that depends on the number of elements are made when it is played.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from tools.unitycheck.metas import meta_text, stable_guid
from tools.unitycheck.scenetable import SCENES, Scene
from tools.unitycheck.textfiles import HEADER

FOLDER = "Assets/Scenes"
SAMPLE = "Assets/Guidewire/Samples~/Scenes"
REPOSITORY = Path(__file__).resolve().parents[2]
MATERIALS = "Assets/Guidewire/Runtime/Resources/Guidewire"
PREFABS = "Assets/Guidewire/Prefabs"
BUILD = "ProjectSettings/EditorBuildSettings.asset"
ROOTS = 2**63 - 1
_NONE = {"fileID": 0}
_ZERO = {"x": 0, "y": 0, "z": 0}

# Class number, type name and keys of the four settings documents that every scene starts with.
_SETTINGS: tuple[tuple[int, str, dict[str, Any]], ...] = (
    (29, "OcclusionCullingSettings", {
        "m_ObjectHideFlags": 0, "serializedVersion": 2,
        "m_OcclusionBakeSettings": {"+": {"smallestOccluder": 5, "smallestHole": 0.25, "backfaceThreshold": 100}},
        "m_SceneGUID": "0" * 32, "m_OcclusionCullingData": _NONE}),
    (104, "RenderSettings", {
        "m_ObjectHideFlags": 0, "serializedVersion": 10, "m_Fog": 0, "m_FogColor": {"r": 0.5, "g": 0.5, "b": 0.5,
                                                                                    "a": 1},
        "m_FogMode": 3, "m_FogDensity": 0.01, "m_LinearFogStart": 0, "m_LinearFogEnd": 300,
        "m_AmbientSkyColor": {"r": 0.45, "g": 0.46, "b": 0.5, "a": 1},
        "m_AmbientEquatorColor": {"r": 0.4, "g": 0.4, "b": 0.42, "a": 1},
        "m_AmbientGroundColor": {"r": 0.3, "g": 0.3, "b": 0.3, "a": 1}, "m_AmbientIntensity": 1, "m_AmbientMode": 3,
        "m_SubtractiveShadowColor": {"r": 0.42, "g": 0.48, "b": 0.63, "a": 1}, "m_SkyboxMaterial": _NONE,
        "m_HaloStrength": 0.5, "m_FlareStrength": 1, "m_FlareFadeSpeed": 3, "m_HaloTexture": _NONE,
        "m_SpotCookie": {"fileID": 10001, "guid": "0000000000000000e000000000000000", "type": 0},
        "m_DefaultReflectionMode": 0, "m_DefaultReflectionResolution": 128, "m_ReflectionBounces": 1,
        "m_ReflectionIntensity": 1, "m_CustomReflection": _NONE, "m_Sun": _NONE, "m_UseRadianceAmbientProbe": 0}),
    (157, "LightmapSettings", {
        "m_ObjectHideFlags": 0, "serializedVersion": 12,
        "m_GISettings": {"+": {
            "serializedVersion": 2, "m_BounceScale": 1, "m_IndirectOutputScale": 1, "m_AlbedoBoost": 1,
            "m_EnvironmentLightingMode": 0, "m_EnableBakedLightmaps": 0, "m_EnableRealtimeLightmaps": 0}},
        "m_LightmapEditorSettings": {"+": {
            "serializedVersion": 12, "m_Resolution": 2, "m_BakeResolution": 40, "m_AtlasSize": 1024, "m_AO": 0,
            "m_AOMaxDistance": 1, "m_CompAOExponent": 1, "m_CompAOExponentDirect": 0, "m_ExtractAmbientOcclusion": 0,
            "m_Padding": 2, "m_LightmapParameters": _NONE, "m_LightmapsBakeMode": 1, "m_TextureCompression": 1,
            "m_ReflectionCompression": 2, "m_MixedBakeMode": 2, "m_BakeBackend": 1, "m_PVRSampling": 1,
            "m_PVRDirectSampleCount": 32, "m_PVRSampleCount": 512, "m_PVRBounces": 2,
            "m_PVREnvironmentSampleCount": 256, "m_PVREnvironmentReferencePointCount": 2048, "m_PVRFilteringMode": 1,
            "m_PVRDenoiserTypeDirect": 1, "m_PVRDenoiserTypeIndirect": 1, "m_PVRDenoiserTypeAO": 1,
            "m_PVRFilterTypeDirect": 0, "m_PVRFilterTypeIndirect": 0, "m_PVRFilterTypeAO": 0,
            "m_PVREnvironmentMIS": 1, "m_PVRCulling": 1, "m_PVRFilteringGaussRadiusDirect": 1,
            "m_PVRFilteringGaussRadiusIndirect": 5, "m_PVRFilteringGaussRadiusAO": 2,
            "m_PVRFilteringAtrousPositionSigmaDirect": 0.5, "m_PVRFilteringAtrousPositionSigmaIndirect": 2,
            "m_PVRFilteringAtrousPositionSigmaAO": 1, "m_ExportTrainingData": 0,
            "m_TrainingDataDestination": "TrainingData", "m_LightProbeSampleCountMultiplier": 4}},
        "m_LightingDataAsset": _NONE, "m_LightingSettings": _NONE}),
    (196, "NavMeshSettings", {
        "serializedVersion": 2, "m_ObjectHideFlags": 0,
        "m_BuildSettings": {"+": {
            "serializedVersion": 3, "agentTypeID": 0, "agentRadius": 0.5, "agentHeight": 2, "agentSlope": 45,
            "agentClimb": 0.4, "ledgeDropHeight": 0, "maxJumpAcrossDistance": 0, "minRegionArea": 2,
            "manualCellSize": 0, "cellSize": 0.16666667, "manualTileSize": 0, "tileSize": 256, "buildHeightMesh": 0,
            "maxJobWorkers": 0, "preserveTilesOutsideBounds": 0, "debug": {"+": {"m_Flags": 0}}}},
        "m_NavMeshData": _NONE}),
)

_CAMERA = {
    "serializedVersion": 2, "m_ClearFlags": 2, "m_BackGroundColor": {"r": 0.08, "g": 0.09, "b": 0.12, "a": 1},
    "m_projectionMatrixMode": 1, "m_GateFitMode": 2, "m_FocalLength": 50, "m_SensorSize": {"x": 36, "y": 24},
    "m_LensShift": {"x": 0, "y": 0},
    "m_NormalizedViewPortRect": {"+": {"serializedVersion": 2, "x": 0, "y": 0, "width": 1, "height": 1}},
    "near clip plane": 1, "far clip plane": 10000, "field of view": 45, "orthographic": 0, "orthographic size": 5,
    "m_Depth": -1, "m_CullingMask": {"+": {"serializedVersion": 2, "m_Bits": 4294967295}}, "m_RenderingPath": -1,
    "m_TargetTexture": _NONE, "m_TargetDisplay": 0, "m_TargetEye": 3, "m_HDR": 1, "m_AllowMSAA": 1,
    "m_AllowDynamicResolution": 0, "m_ForceIntoRT": 0, "m_OcclusionCulling": 1, "m_StereoConvergence": 10,
    "m_StereoSeparation": 0.022}

_LIGHT = {
    "serializedVersion": 11, "m_Type": 1, "m_Color": {"r": 1, "g": 1, "b": 1, "a": 1}, "m_Intensity": 1, "m_Range": 10,
    "m_SpotAngle": 30,
    "m_Shadows": {"+": {"m_Type": 0, "m_Resolution": -1, "m_CustomResolution": -1, "m_Strength": 1, "m_Bias": 0.05,
                        "m_NormalBias": 0.4, "m_NearPlane": 0.2}},
    "m_Cookie": _NONE, "m_DrawHalo": 0, "m_Flare": _NONE, "m_RenderMode": 0,
    "m_CullingMask": {"+": {"serializedVersion": 2, "m_Bits": 4294967295}}, "m_Lightmapping": 4,
    "m_LightShadowCasterMode": 0, "m_AreaSize": {"x": 1, "y": 1}, "m_BounceIntensity": 1, "m_ColorTemperature": 6570,
    "m_UseColorTemperature": 0, "m_ShadowRadius": 0, "m_ShadowAngle": 0}


def block(keys: dict[str, Any], indent: str = "  ") -> str:
    """Keys in Unity's YAML: a map under "+" becomes a block, any other map stays on its line."""
    text = ""
    for key, value in keys.items():
        if isinstance(value, dict) and "+" in value:
            text += f"{indent}{key}:\n" + block(value["+"], indent + "  ")
        elif isinstance(value, list):
            items = "".join(f"{indent}- {_item(item)}\n" for item in value)
            text += f"{indent}{key}:\n{items}" if items else f"{indent}{key}: []\n"
        else:
            text += f"{indent}{key}: {_inline(value)}\n"
    return text


def _item(value: Any) -> str:
    """Return an entry of a list; a pair is a key with its value."""
    return f"{value[0]}: {_inline(value[1])}" if isinstance(value, tuple) else _inline(value)


def _inline(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {_inline(item)}" for key, item in value.items()) + "}"
    if isinstance(value, bool):
        return str(int(value))
    is_whole = isinstance(value, float) and value.is_integer()
    return str(int(value)) if is_whole else str(value)


def document(class_id: int, file_id: int, name: str, keys: dict[str, Any]) -> str:
    """Return one object of a file."""
    return f"--- !u!{class_id} &{file_id}\n{name}:\n{block(keys)}"


def _component(game_object: int, keys: dict[str, Any], is_switchable: bool = True) -> dict[str, Any]:
    head: dict[str, Any] = {"m_ObjectHideFlags": 0, "m_CorrespondingSourceObject": _NONE, "m_PrefabInstance": _NONE,
                            "m_PrefabAsset": _NONE, "m_GameObject": {"fileID": game_object}}
    return {**head, **({"m_Enabled": 1} if is_switchable else {}), **keys}


def _game_object(file_id: int, name: str, components: list[int], tag: str) -> str:
    return document(1, file_id, "GameObject", {
        "m_ObjectHideFlags": 0, "m_CorrespondingSourceObject": _NONE, "m_PrefabInstance": _NONE, "m_PrefabAsset": _NONE,
        "serializedVersion": 6, "m_Component": [("component", {"fileID": number}) for number in components],
        "m_Layer": 0, "m_Name": name, "m_TagString": tag, "m_Icon": _NONE, "m_NavMeshLayer": 0,
        "m_StaticEditorFlags": 0, "m_IsActive": 1})


def _transform(file_id: int, game_object: int, rotation: dict[str, Any], position: dict[str, Any]) -> str:
    return document(4, file_id, "Transform", _component(game_object, {
        "serializedVersion": 2, "m_LocalRotation": rotation, "m_LocalPosition": position,
        "m_LocalScale": {"x": 1, "y": 1, "z": 1}, "m_ConstrainProportionsScale": 0, "m_Children": [],
        "m_Father": _NONE, "m_LocalEulerAnglesHint": _ZERO}, is_switchable=False))


def _script(file_id: int, game_object: int, path: str, fields: dict[str, Any]) -> str:
    guid = stable_guid(f"Assets/Guidewire/Runtime/{path}.cs")
    keys = {"m_EditorHideFlags": 0, "m_Script": {"fileID": 11500000, "guid": guid, "type": 3}, "m_Name": "",
            "m_EditorClassIdentifier": "", **fields}
    return document(114, file_id, "MonoBehaviour", _component(game_object, keys))


def _place(parameters: str) -> str:
    """Return where a scene has its copy of a parameter file, or of a mesh, which Unity shall take as a text."""
    name = parameters.rpartition("/")[2]
    return f"{FOLDER}/{name}" if name.endswith(".json") else f"{FOLDER}/{name}.txt"


def _text_asset(parameters: str) -> dict[str, Any]:
    """Return what refers to that copy; empty: nothing."""
    return {"fileID": 4900000, "guid": stable_guid(_place(parameters)), "type": 3} if parameters else _NONE


def scene_text(scene: Scene) -> str:
    """Return the whole .unity file of a scene."""
    upright = {"x": 0, "y": 0, "z": 0, "w": 1}
    loop, wire, contacts, hud, camera = ({"fileID": number} for number in (302, 402, 502, 304, 103))
    target = dict(zip("xyz", scene.target))
    parts = [document(class_id, number, name, keys)
             for number, (class_id, name, keys) in enumerate(_SETTINGS, start=1)]
    parts += [
        _game_object(100, "Main Camera", [101, 102, 103], "MainCamera"),
        _transform(101, 100, upright, {"x": 0, "y": 0, "z": -10}),
        document(20, 102, "Camera", _component(100, _CAMERA)),
        _script(103, 100, "Views/OrbitCamera", {
            "_loop": loop, "_target": target, "_distance": scene.distance, "_yaw": scene.yaw, "_pitch": scene.pitch}),
        _game_object(200, "Light", [201, 202], "Untagged"),
        _transform(201, 200, {"x": 0.408218, "y": -0.23457, "z": 0.109382, "w": 0.875426}, {"x": 0, "y": 300, "z": 0}),
        document(108, 202, "Light", _component(200, _LIGHT)),
        _game_object(300, "Simulation", [301, 302, 303, 304], "Untagged"),
        _transform(301, 300, upright, _ZERO),
        _script(302, 300, "Loop/SimulationLoop", {
            "_parameterFile": "", "_parameterAsset": _text_asset(scene.parameters), "_overrides": list(scene.overrides),
            "_alternativeAsset": _text_asset(scene.alternative), "_alternativeOverrides":
                list(scene.alternative_overrides),
            "_files": [_text_asset(path) for path in scene.meshes],
            "_pace": scene.pace, "_isSteered": scene.is_steered}),
        _script(303, 300, "Loop/KeyboardControl", {
            "_loop": loop, "_wire": wire, "_contacts": contacts, "_hud": hud, "_camera": camera}),
        _script(304, 300, "Views/Hud", {"_loop": loop, "_wire": wire}),
        _game_object(400, "Wire", [401, 402], "Untagged"),
        _transform(401, 400, upright, _ZERO),
        _script(402, 400, "Views/WireView", {
            "_loop": loop, "_material": _NONE, "_catheterMaterial": _NONE, "_colouring": scene.colouring}),
        _game_object(500, "Vessel", [501, 502, 503], "Untagged"),
        _transform(501, 500, upright, _ZERO),
        _script(502, 500, "Views/ContactView", {"_loop": loop, "_material": _NONE}),
        _script(503, 500, "Views/VesselView", {"_loop": loop, "_material": _NONE}),
        document(1660057539, ROOTS, "SceneRoots", {
            "m_ObjectHideFlags": 0, "m_Roots": [{"fileID": number} for number in (101, 201, 301, 401, 501)]}),
    ]
    return HEADER + "".join(parts)


def material_text(name: str, is_translucent: bool, colour: tuple[float, float, float, float]) -> str:
    """Return a material of Unity's Standard shader; the translucent variant is named so that players keep it."""
    floats = {"_Glossiness": 0.35, "_Metallic": 0.0, "_Mode": 3 if is_translucent else 0, "_SrcBlend": 1,
              "_DstBlend": 10 if is_translucent else 0, "_ZWrite": 0 if is_translucent else 1}
    keys = {
        "serializedVersion": 8, "m_ObjectHideFlags": 0, "m_CorrespondingSourceObject": _NONE, "m_PrefabInstance": _NONE,
        "m_PrefabAsset": _NONE, "m_Name": name,
        "m_Shader": {"fileID": 46, "guid": "0000000000000000f000000000000000", "type": 0}, "m_Parent": _NONE,
        "m_ModifiedSerializedProperties": 0, "m_ValidKeywords": ["_ALPHAPREMULTIPLY_ON"] if is_translucent else [],
        "m_InvalidKeywords": [], "m_LightmapFlags": 4, "m_EnableInstancingVariants": 0,
        "m_DoubleSidedGI": 0, "m_CustomRenderQueue": 3000 if is_translucent else -1,
        "stringTagMap": {"+": {"RenderType": "Transparent"}} if is_translucent else {}, "disabledShaderPasses": [],
        "m_LockedProperties": "",
        "m_SavedProperties": {"+": {
            "serializedVersion": 3, "m_TexEnvs": [], "m_Ints": [], "m_Floats": list(floats.items()),
            "m_Colors": [("_Color", dict(zip("rgba", colour)))]}},
        "m_BuildTextureStacks": []}
    return HEADER + document(21, 2100000, "Material", keys)


def prefab_text() -> str:
    """Return a wire in a vessel, a unit of it a millimetre of a scene of metres; views find their loop, input steers
    it."""
    upright = {"x": 0, "y": 0, "z": 0, "w": 1}
    text_asset = {"fileID": 4900000, "guid": stable_guid(f"{PREFABS}/WireInVessel.json"), "type": 3}
    transform = _transform(101, 100, upright, _ZERO).replace(
        "m_LocalScale: {x: 1, y: 1, z: 1}", "m_LocalScale: {x: 0.001, y: 0.001, z: 0.001}")
    return HEADER + "".join((
        _game_object(100, "Wire in a vessel", [101, 102, 103, 104, 105, 106], "Untagged"), transform,
        _script(102, 100, "Loop/SimulationLoop", {"_parameterAsset": text_asset, "_isSteered": True}),
        _script(103, 100, "Loop/KeyInput", {}), _script(104, 100, "Views/WireView", {}),
        _script(105, 100, "Views/VesselView", {}), _script(106, 100, "Views/ContactView", {})))


def files() -> dict[str, str]:
    """Return every file that this module writes, by repository path."""
    own = {f"{FOLDER}/{scene.name}.unity": scene_text(scene) for scene in SCENES}
    for named in {path for scene in SCENES for path in (scene.parameters, scene.alternative, *scene.meshes) if path}:
        own[_place(named)] = (REPOSITORY / named).read_text(encoding="utf-8")
    own |= {f"{path}.meta": meta_text(path, False) for path in list(own)}
    result = {**own, **{path.replace(FOLDER, SAMPLE, 1): text for path, text in own.items()}}
    result[f"{PREFABS}/WireInVessel.prefab"] = prefab_text()
    result[f"{MATERIALS}/Wire.mat"] = material_text("Wire", False, (1.0, 1.0, 1.0, 1.0))
    result[f"{MATERIALS}/Vessel.mat"] = material_text("Vessel", True, (0.85, 0.35, 0.3, 0.25))
    listed = [f"  - enabled: 1\n    path: {FOLDER}/{scene.name}.unity\n"
              f"    guid: {stable_guid(f'{FOLDER}/{scene.name}.unity')}\n" for scene in SCENES]
    result[BUILD] = (HEADER + "--- !u!1045 &1\nEditorBuildSettings:\n  m_ObjectHideFlags: 0\n  serializedVersion: 2\n"
                     "  m_Scenes:\n" + "".join(listed) + "  m_configObjects: {}\n")
    return result


def write(root: Path) -> list[str]:
    """Write every file whose bytes differ and return their paths."""
    written = []
    for path, text in files().items():
        target = root / path
        if not target.is_file() or target.read_bytes() != text.encode("utf-8"):
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(text.encode("utf-8"))
            written.append(path)
    return written

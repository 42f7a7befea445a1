"""Breakages of scenes: references, components, cameras, values, and the parameters that a scene names."""

from __future__ import annotations

from tools.unitycheck.tests.breakages import (
    GUIDEWIRE, LOOP, RUNTIME, SCENE, Breakage, both, move, remove, replace, write,
)

TRANSFORM_301 = r"(--- !u!4 &301\n.*?)"
VIEW_502 = r"(--- !u!114 &502\n.*?)"
LOOP_302 = r"(--- !u!114 &302\n.*?)"
KEYS_303 = r"(--- !u!114 &303\n.*?)"
MATERIAL = r"_material: \{fileID: 0\}"


def scene(old: str, new: str, rule: str) -> Breakage:
    return Breakage(replace(SCENE, old, new), SCENE, rule)


def parameters(text: str) -> Breakage:
    return Breakage(write("params/insertion.json", text), SCENE, "scene-parameters")


BREAKAGES = {
    # References
    "loop that is a Transform": scene(r"_loop: \{fileID: 302\}", "_loop: {fileID: 301}", "reference-class"),
    "loop that is a GameObject": scene(r"_loop: \{fileID: 302\}", "_loop: {fileID: 300}", "reference-class"),
    "loop that is another script": scene(r"_loop: \{fileID: 302\}", "_loop: {fileID: 304}", "reference-class"),
    "wire and contacts exchanged": scene(r"_wire: \{fileID: 402\}\n  _contacts: \{fileID: 502\}",
                                         "_wire: {fileID: 502}\n  _contacts: {fileID: 402}", "reference-class"),
    "camera that is Unity's, not ours": scene(r"_camera: \{fileID: 103\}", "_camera: {fileID: 102}", "reference-class"),
    "material that is a script": scene(MATERIAL,
                                       "_material: {fileID: 11500000, guid: 6d4a4dc862553179a68f75fd04d3751d, type: 3}",
                                       "reference-class"),
    "material that is a built-in mesh": scene(
        MATERIAL,
        "_material: {fileID: 10202, guid: 0000000000000000e000000000000000, type: 0}", "reference-class"),
    "material that is a camera": scene(MATERIAL, "_material: {fileID: 102}", "reference-class"),
    "loop unset": scene(KEYS_303 + r"_loop: \{fileID: 302\}", r"\1_loop: {fileID: 0}", "reference-unset"),
    "loop left out": scene(KEYS_303 + r"  _loop: \{fileID: 302\}\n", r"\1", "reference-unset"),
    "contacts unset": scene(r"_contacts: \{[^}]*\}", "_contacts: {fileID: 0}", "reference-unset"),
    "hud left out": scene(r"  _hud: \{fileID: 304\}\n", "", "reference-unset"),
    "reference that is a number": scene(r"_wire: \{fileID: 402\}", "_wire: 402", "field-value"),
    "reference to nothing there": scene(r"_hud: \{fileID: 304\}", "_hud: {fileID: 3040}", "reference-local"),
    "material's guid unknown": scene(MATERIAL, "_material: {fileID: 2100000, guid: 0123456789abcdef0123456789abcdef, "
                                     "type: 2}", "guid-unknown"),
    "material's file ID": Breakage(lambda project: {SCENE: project.data(SCENE).replace(
        b"_material: {fileID: 0}", b"_material: {fileID: 2100001, guid: "
        + _guid(project, "Resources/Guidewire/Wire.mat", "") + b", type: 2}")}, SCENE, "reference-fileid"),
    # Scripts
    "script swapped for one of the same fields": scene(
        VIEW_502 + r"guid: \w+", r"\1guid: 4b6ca4a4e1b5b9d5b4c9b4c9b4c9b4c9", "guid-unknown"),
    "contact view swapped for the vessel's": Breakage(
        lambda project: {SCENE: project.data(SCENE).replace(
            _guid(project, "Views/ContactView"), _guid(project, "Views/VesselView"))}, SCENE, "scene-needs"),
    "keyboard swapped for the HUD": Breakage(
        lambda project: {SCENE: project.data(SCENE).replace(
            _guid(project, "Loop/KeyboardControl"), _guid(project, "Views/Hud"))}, SCENE, "field-unknown"),
    "script of a class that is none": Breakage(
        lambda project: {SCENE: project.data(SCENE).replace(
            _guid(project, "Loop/SimulationLoop"), _guid(project, "Views/TubeMesh"))}, SCENE, "scene-script"),
    "script that is a material": Breakage(
        lambda project: {SCENE: project.data(SCENE).replace(
            _guid(project, "Views/Hud"), _guid(project, "Resources/Guidewire/Wire.mat", ""))}, SCENE, "scene-script"),
    "loop twice in a scene": Breakage(
        lambda project: {SCENE: project.data(SCENE).replace(
            _guid(project, "Views/Hud"), _guid(project, "Loop/SimulationLoop"))}, SCENE, "scene-needs"),
    # Components and objects
    "loop switched off": scene(LOOP_302 + "m_Enabled: 1", r"\1m_Enabled: 0", "scene-needs"),
    "vessel's object switched off": scene(r"(--- !u!1 &500\n.*?)m_IsActive: 1", r"\1m_IsActive: 0", "scene-needs"),
    "object that builds leave out": scene(r"(--- !u!1 &400\n.*?)m_TagString: Untagged", r"\1m_TagString: EditorOnly",
                                          "scene-needs"),
    "wire's father switched off": Breakage(
        lambda project: {SCENE: _under(project.data(SCENE).decode()).encode()}, SCENE, "scene-needs"),
    "component gone": scene(r"  - component: \{fileID: 304\}\n(.*)--- !u!114 &304\n.*?(?=--- )", r"\1", "scene-needs"),
    "two Transforms": scene(r"(  - component: \{fileID: 401\}\n)", r"\1  - component: {fileID: 501}\n",
                            "scene-transform"),
    "no Transform": scene(r"  - component: \{fileID: 501\}\n", "", "scene-transform"),
    "Transform second": scene(r"  - component: \{fileID: 401\}\n  - component: \{fileID: 402\}",
                              "  - component: {fileID: 402}\n  - component: {fileID: 401}", "scene-transform"),
    "its own father": scene(TRANSFORM_301 + r"m_Father: \{fileID: 0\}", r"\1m_Father: {fileID: 301}", "scene-parent"),
    "fathers in a circle": scene(
        TRANSFORM_301 + r"m_Father: \{fileID: 0\}(.*?--- !u!4 &401\n.*?)m_Father: \{fileID: 0\}",
        r"\1m_Father: {fileID: 401}\2m_Father: {fileID: 301}", "scene-parent"),
    "child that does not know": scene(TRANSFORM_301 + r"m_Children: \[\]", r"\1m_Children:\n  - {fileID: 401}",
                                      "scene-parent"),
    "child that is no Transform": scene(TRANSFORM_301 + r"m_Children: \[\]", r"\1m_Children:\n  - {fileID: 302}",
                                        "scene-parent"),
    "father that does not know": scene(TRANSFORM_301 + r"m_Father: \{fileID: 0\}", r"\1m_Father: {fileID: 401}",
                                       "scene-parent"),
    "component of two objects": scene(r"(  - component: \{fileID: 402\}\n)", r"\1  - component: {fileID: 502}\n",
                                      "scene-component"),
    "component listed twice": scene(r"(  - component: \{fileID: 402\}\n)", r"\1  - component: {fileID: 402}\n",
                                    "scene-component"),
    "component listed that is not there": scene(r"(  - component: \{fileID: 402\}\n)",
                                                r"\1  - component: {fileID: 403}\n", "reference-local"),
    "scale of 0": scene(r"(--- !u!4 &401\n.*?)m_LocalScale: \{x: 1", r"\1m_LocalScale: {x: 0", "scene-place"),
    "position that is no number": scene(r"m_LocalPosition: \{x: 0, y: 300", "m_LocalPosition: {x: nan, y: 300",
                                        "scene-place"),
    "rotation of length 0": scene(TRANSFORM_301 + r"w: 1\}", r"\1w: 0}", "scene-place"),
    "root listed twice": scene(r"(  - \{fileID: 401\}\n)", r"\1\1", "scene-roots"),
    "root of another number": scene(r"&9223372036854775807", "&9223372036854775806", "scene-roots"),
    "object without its switch": scene(r"(--- !u!1 &400\n.*?)  m_IsActive: 1\n", r"\1", "scene-key"),
    "transform without a scale": scene(TRANSFORM_301 + r"  m_LocalScale: \{x: 1, y: 1, z: 1\}\n", r"\1", "scene-key"),
    "component without its switch": scene(LOOP_302 + r"  m_Enabled: 1\n", r"\1", "scene-key"),
    "camera without a far plane": scene("  far clip plane: 10000\n", "", "scene-key"),
    # Cameras
    "no camera": scene(r"  - component: \{fileID: 102\}\n(.*)--- !u!20 &102\n.*?(?=--- )", r"\1", "scene-camera"),
    "camera switched off": scene(r"(--- !u!20 &102\n.*?)m_Enabled: 1", r"\1m_Enabled: 0", "scene-camera"),
    "camera's object switched off": scene(r"(--- !u!1 &100\n.*?)m_IsActive: 1", r"\1m_IsActive: 0", "scene-camera"),
    "near plane behind the far one": scene("near clip plane: 1", "near clip plane: 20000", "scene-camera"),
    "field of view of 0": scene("field of view: 45", "field of view: 0", "scene-camera"),
    "camera that sees no layer": scene(r"(--- !u!20 &102\n.*?)m_Bits: 4294967295", r"\1m_Bits: 0", "scene-camera"),
    "camera without a screen": scene("width: 1", "width: 0", "scene-camera"),
    "camera on the second display": scene("m_TargetDisplay: 0", "m_TargetDisplay: 1", "scene-camera"),
    "camera apart from its orbit": scene(r"  - component: \{fileID: 102\}\n(.*?  - component: \{fileID: 202\}\n)",
                                         r"\1  - component: {fileID: 102}\n", "scene-component"),
    "light switched off": scene(r"(--- !u!108 &202\n.*?)m_Enabled: 1", r"\1m_Enabled: 0", "scene-light"),
    "light of no intensity": scene("m_Intensity: 1", "m_Intensity: 0", "scene-light"),
    "camera's clear flags": scene("m_ClearFlags: 2", "m_ClearFlags: 7", "field-value"),
    "light of no type": scene(r"(--- !u!108 &202\n.*?)m_Type: 1", r"\1m_Type: 9", "field-value"),
    "component switched to 2": scene(r"(--- !u!20 &102\n.*?)m_Enabled: 1", r"\1m_Enabled: 2", "field-value"),
    # Values
    "enum beyond its values": scene("_colouring: 2", "_colouring: 4", "field-value"),
    "enum below its values": scene("_colouring: 2", "_colouring: -1", "field-value"),
    "enum by its name": scene("_colouring: 2", "_colouring: Bending", "field-value"),
    "number out of its Range": scene("_pace: 1", "_pace: 11", "field-value"),
    "angle out of its Range": scene("_pitch: 15", "_pitch: 95", "field-value"),
    "bool of 2": scene("_isSteered: 1", "_isSteered: 2", "field-value"),
    "number with a comma": scene("_distance: 430", "_distance: 430,5", "field-value"),
    "vector without z": scene(r"_target: \{x: 0, y: 45, z: -20\}", "_target: {x: 0, y: 45}", "field-value"),
    "vector of words": scene(r"_target: \{x: 0, y", "_target: {x: left, y", "field-value"),
    "text where a list is": scene(r"_overrides:\n(  - [^\n]*\n)+", "_overrides: drive=hold\n", "field-value"),
    "unknown tag": scene("m_TagString: MainCamera", "m_TagString: MainCamer", "scene-tag"),
    "layer without a name": scene("m_Layer: 0", "m_Layer: 9", "scene-layer"),
    "layer beyond 31": scene("m_Layer: 0", "m_Layer: 32", "scene-layer"),
    "live parameter misspelt": scene("  _isSteered: 1\n", "  _isSteered: 1\n  _live:\n    timestep: 0.01\n",
                                     "field-unknown"),
    # Form
    "key twice": scene("  _pace: 1\n", "  _pace: 1\n  _pace: 1\n", "yaml-form"),
    "comment": scene("  _pace: 1\n", "  # _pace: 1\n", "yaml-form"),
    "tab before a key": scene("^  _pace: 1\n", "\t_pace: 1\n", "text-tab"),
    "conflict in a scene": scene("  _pace: 1\n", "<<<<<<< HEAD\n  _pace: 1\n=======\n  _pace: 2\n>>>>>>> x\n",
                                 "text-conflict"),
    "known class under another number": scene("^--- !u!20 &102", "--- !u!21 &102", "class-id"),
    # Parameters
    "parameter file not there": scene("params/insertion.json", "params/insertions.json", "scene-parameters"),
    "parameter file absolute": scene("params/insertion.json", "/params/insertion.json", "scene-parameters"),
    "parameter file by a backslash": scene("params/insertion.json", r"params\\\\insertion.json", "scene-parameters"),
    "parameter file empty": scene("_parameterFile: params/insertion.json", "_parameterFile: ", "scene-parameters"),
    "parameter file that is no JSON": scene("params/insertion.json", "params/meshes/arch.obj", "scene-parameters"),
    "override without a value": scene("- drive=hold", "- drive", "scene-parameters"),
    "override of an unknown key": scene("- drive=hold", "- drives=hold", "scene-parameters"),
    "comma in the parameter file": parameters('{"timeStep": 0.01,}\n'),
    "list in the parameter file": parameters("[]\n"),
    "key twice in the parameter file": parameters('{"timeStep": 0.01, "timeStep": 0.02}\n'),
    "unknown key in the parameter file": parameters('{"timeSteps": 0.01}\n'),
    "parameter file gone": Breakage(remove("params/insertion.json"), SCENE, "scene-parameters"),
    "scene renamed, the build not": Breakage(move(SCENE, SCENE.replace("Insertion", "Insert")),
                                             "ProjectSettings/EditorBuildSettings.asset", "build-scenes"),
    "behaviour without its base": Breakage(replace(LOOP, "SimulationLoop : MonoBehaviour", "SimulationLoop"), SCENE,
                                           "scene-script"),
    "base that is stored as an asset": Breakage(replace(LOOP, "SimulationLoop : MonoBehaviour",
                                                        "SimulationLoop : ScriptableObject"), SCENE, "scene-script"),
    "enum shorter than a scene's value": Breakage(
        replace(f"{RUNTIME}/Views/Colouring.cs", r"Bending,.*Twist,", "Twist = 7,"), SCENE, "field-value"),
    "type of a field changed": Breakage(replace(f"{RUNTIME}/Loop/KeyboardControl.cs", "SimulationLoop _loop",
                                                "WireView _loop"), SCENE, "reference-class"),
    "scene and its .meta gone": Breakage(both(remove(SCENE), remove(f"{SCENE}.meta")),
                                         "ProjectSettings/EditorBuildSettings.asset", "build-scenes"),
    "scene's guid changed": Breakage(replace(f"{SCENE}.meta", "guid: .", "guid: 0"),
                                     "ProjectSettings/EditorBuildSettings.asset", "build-scenes"),
}
# What only the reader itself can find: asked where the console program has been built.
READ = {
    "override out of range": scene("- drive=hold", "- timeStep=0", "scene-parameters"),
    "override of an unknown choice": scene("- drive=hold", "- drive=holds", "scene-parameters"),
    "value out of range": parameters('{"timeStep": -1}\n'),
    "mesh not there": parameters('{"vessel": {"shape": "mesh", "file": "meshes/arc.obj"}}\n'),
    "mesh that is none": Breakage(write("params/meshes/arch.obj", "v 0 0\n"), SCENE, "scene-parameters"),
    "vessel of an unknown shape": parameters('{"vessel": {"shape": "mash"}}\n'),
}


def _guid(project: object, script: str, ending: str = ".cs") -> bytes:
    meta = f"{RUNTIME}/{script}{ending}.meta".replace(f"{RUNTIME}/../", f"{GUIDEWIRE}/")
    return project.text(meta).split("guid: ")[1].split("\n")[0].encode()  # type: ignore[attr-defined]


def _under(text: str) -> str:
    """The wire's Transform under the light's, whose object is switched off."""
    light, wire = "--- !u!4 &201\n", "--- !u!4 &401\n"
    before, _, after = text.partition(light)
    after = after.replace("m_Children: []", "m_Children:\n  - {fileID: 401}", 1)
    text = before + light + after
    before, _, after = text.partition(wire)
    after = after.replace("m_Father: {fileID: 0}", "m_Father: {fileID: 201}", 1)
    text = (before + wire + after).replace("  - {fileID: 401}\n  - {fileID: 501}", "  - {fileID: 501}")
    before, _, after = text.partition("--- !u!1 &200\n")
    return before + "--- !u!1 &200\n" + after.replace("m_IsActive: 1", "m_IsActive: 0", 1)

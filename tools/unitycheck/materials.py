"""Materials and shaders: names that exist, and keywords and blending that say the same."""

from __future__ import annotations

import re
from typing import Any, Iterator

from tools.unitycheck.project import Project
from tools.unitycheck.sources import table
from tools.unitycheck.unityyaml import FormError, parse
from tools.unitycheck.violation import Violation

BUILTIN = "0000000000000000f000000000000000"
# Unity's own shaders by number; 45 and 46 are the two variants of Standard.
STANDARD = {"45", "46"}
SHADERS = STANDARD | {"1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "30", "31", "32", "33", "34", "35", "36", "47",
                      "10101", "10510", "10512", "10703", "10720", "10721", "10750", "10751", "10752", "10753", "10755",
                      "10757", "10760", "10770", "10782", "10783", "200", "203", "210", "211"}
NAMES = {"Standard", "Standard (Specular setup)", "Sprites/Default", "Sprites/Diffuse", "UI/Default", "Unlit/Color",
         "Unlit/Texture", "Unlit/Transparent", "Unlit/Transparent Cutout", "Skybox/Procedural", "Skybox/6 Sided",
         "Skybox/Cubemap", "Particles/Standard Unlit", "Particles/Standard Surface", "Hidden/Internal-Colored",
         "Legacy Shaders/Diffuse", "Legacy Shaders/Transparent/Diffuse", "Mobile/Diffuse", "GUI/Text Shader"}
# Shaders that every player contains, and Standard, which the project's materials bring in.
IN_PLAYERS = {"Standard", "Sprites/Default", "UI/Default", "Legacy Shaders/Diffuse", "GUI/Text Shader"}
FLOATS = {"_AlphaToMask", "_BlendOp", "_BumpScale", "_Cull", "_Cutoff", "_DetailNormalMapScale", "_DstBlend",
          "_GlossMapScale", "_Glossiness", "_GlossyReflections", "_Metallic", "_Mode", "_OcclusionStrength",
          "_Parallax", "_SmoothnessTextureChannel", "_SpecularHighlights", "_SrcBlend", "_UVSec", "_ZWrite"}
COLOURS = {"_Color", "_EmissionColor", "_SpecColor"}
TEXTURES = {"_BumpMap", "_DetailAlbedoMap", "_DetailMask", "_DetailNormalMap", "_EmissionMap", "_MainTex",
            "_MetallicGlossMap", "_OcclusionMap", "_ParallaxMap", "_SpecGlossMap"}
KEYWORDS = {"_ALPHABLEND_ON", "_ALPHAPREMULTIPLY_ON", "_ALPHATEST_ON", "_DETAIL_MULX2", "_EMISSION",
            "_GLOSSYREFLECTIONS_OFF", "_METALLICGLOSSMAP", "_NORMALMAP", "_PARALLAXMAP", "_SPECGLOSSMAP",
            "_SPECULARHIGHLIGHTS_OFF", "_SMOOTHNESS_TEXTURE_ALBEDO_CHANNEL_A"}
# Standard's rendering mode: keyword, source and destination factor, whether it writes depth, first render queue.
MODES = {0: ("", 1, 0, 1, 2000), 1: ("_ALPHATEST_ON", 1, 0, 1, 2450), 2: ("_ALPHABLEND_ON", 5, 10, 0, 3000),
         3: ("_ALPHAPREMULTIPLY_ON", 1, 10, 0, 3000)}
# What the lit shaders of URP and HDRP name otherwise, for code that serves all three pipelines.
LIT_FLOATS = {"_Surface", "_SurfaceType", "_AlphaDstBlend"}
LIT_COLOURS = {"_BaseColor"}
LIT_TEXTURES = {"_BaseMap", "_BaseColorMap"}
_ALPHA = {"_ALPHATEST_ON", "_ALPHABLEND_ON", "_ALPHAPREMULTIPLY_ON"}
_FLOATS, _COLOURS, _TEXTURES = FLOATS | LIT_FLOATS, COLOURS | LIT_COLOURS, TEXTURES | LIT_TEXTURES
_KEYWORDS = KEYWORDS | {"_SURFACE_TYPE_TRANSPARENT"}
_CALLS = {"SetFloat": _FLOATS, "GetFloat": _FLOATS, "SetColor": _COLOURS, "GetColor": _COLOURS,
          "SetTexture": _TEXTURES, "SetInt": _FLOATS, "SetInteger": _FLOATS,
          "HasProperty": _FLOATS | _COLOURS | _TEXTURES, "PropertyToID": _FLOATS | _COLOURS | _TEXTURES,
          "EnableKeyword": _KEYWORDS, "DisableKeyword": _KEYWORDS, "IsKeywordEnabled": _KEYWORDS}


def check(project: Project) -> Iterator[Violation]:
    """Rules material-shader, material-keyword, material-property, material-mode, material-name, shader-find."""
    for path in project.assets(".mat"):
        try:
            found = parse(project.text(path))
        except FormError:
            continue  # the scenes' rules say so
        material = next((document for document in found if document.class_id == 21), None)
        if material is None:
            yield Violation(path, 0, "material-shader", "holds no Material")
        else:
            yield from _material(path, material.line, material.data)
    own = {name for path in project.assets(".shader")
           for name in re.findall(r'^\s*Shader\s+"([^"]+)"', project.text(path), re.MULTILINE)}
    yield from _calls(project, own)


def _material(path: str, line: int, data: dict[str, Any]) -> Iterator[Violation]:
    stem = path.rpartition("/")[2][:-len(".mat")]
    if data.get("m_Name") != stem:
        yield Violation(path, line, "material-name", f"m_Name must be {stem}, as the file is called")
    shader = data.get("m_Shader")
    number, guid = (str(shader.get(key, "")) for key in ("fileID", "guid")) if isinstance(shader, dict) else ("", "")
    if number in ("", "0") or not guid:
        yield Violation(path, line, "material-shader", "has no shader: it would be drawn in magenta")
    elif guid == BUILTIN and number not in SHADERS:
        yield Violation(path, line, "material-shader", f"Unity has no built-in shader {number}")
    elif guid == BUILTIN and number in STANDARD:
        yield from _standard(path, line, data)


def _pairs(saved: Any, key: str) -> dict[str, Any]:
    listed = saved.get(key) if isinstance(saved, dict) else None
    return {name: value for item in listed if isinstance(item, dict)
            for name, value in item.items()} if isinstance(listed, list) else {}


def _standard(path: str, line: int, data: dict[str, Any]) -> Iterator[Violation]:
    saved = data.get("m_SavedProperties")
    for key, known in (("m_Floats", FLOATS), ("m_Colors", COLOURS), ("m_TexEnvs", TEXTURES), ("m_Ints", set())):
        for name in _pairs(saved, key):
            if name not in known:
                yield Violation(path, line, "material-property", f"Standard has no '{name}' among {key}")
    listed = data.get("m_ValidKeywords")
    keywords = {item for item in listed if isinstance(item, str)} if isinstance(listed, list) else set()
    invalid = data.get("m_InvalidKeywords")
    for keyword in sorted(keywords - KEYWORDS) + [str(item) for item in invalid or [] if isinstance(invalid, list)]:
        yield Violation(path, line, "material-keyword", f"Standard has no keyword '{keyword}'")
    floats = {}
    for name, value in _pairs(saved, "m_Floats").items():
        try:
            floats[name] = float(value)
        except (TypeError, ValueError):
            yield Violation(path, line, "material-property", f"{name} must be a number, not '{value}'")
    for name, value in _pairs(saved, "m_Colors").items():
        if not isinstance(value, dict) or set(value) != {"r", "g", "b", "a"}:
            yield Violation(path, line, "material-property", f"{name} must be a colour {{r, g, b, a}}")
    mode = floats.get("_Mode", 0.0)
    if mode not in MODES:
        yield Violation(path, line, "material-mode", f"_Mode {mode:g} is none of {sorted(MODES)}")
        return
    keyword, source, target, writes, queue = MODES[int(mode)]
    if keywords & _ALPHA != ({keyword} if keyword else set()):
        yield Violation(path, line, "material-keyword",
                        f"_Mode {mode:g} goes with {keyword or 'no alpha keyword'}, not {sorted(keywords & _ALPHA)}")
    for name, expected, usual in (("_SrcBlend", source, 1), ("_DstBlend", target, 0), ("_ZWrite", writes, 1)):
        if floats.get(name, usual) != expected:
            yield Violation(path, line, "material-mode", f"_Mode {mode:g} goes with {name} {expected}")
    asked = str(data.get("m_CustomRenderQueue", "-1"))
    if not re.match(r"^-?\d{1,5}$",
                    asked) or (int(asked) < 3000) != (queue < 3000) and (int(asked) != -1 or queue >= 3000):
        yield Violation(path, line, "material-mode", f"_Mode {mode:g} is drawn from queue {queue} on, not {asked}")


def _calls(project: Project, own: set[str]) -> Iterator[Violation]:
    for call in table(project, "calls"):
        path, line, name, text = call["path"], call["line"], call["name"], call["text"]
        if name == "Find" and call["owner"] == "Shader":
            if text not in NAMES | own:
                yield Violation(path, line, "shader-find", f"there is no shader '{text}'")
            elif text not in IN_PLAYERS | own and "/Editor/" not in path and "/Tests/" not in path:
                yield Violation(path, line, "shader-find", f"players do not contain the shader '{text}'")
        elif name in _CALLS and call["owner"] and not own and text not in _CALLS[name]:
            rule = "material-keyword" if "Keyword" in name else "material-property"
            yield Violation(path, line, rule, f"{name}: Standard has no '{text}'")

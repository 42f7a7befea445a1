"""The trial runs of a scene: finer runs as its reference, cheaper settings, and runs without a part of the model.

With a material all settings solve the same equations, so any method may be taken, and the finest steps and elements
are the reference. With pbd the settings are part of the model: m iterations with the stiffnesses k act as m f
iterations with k/f do, and come the nearer to a limit the larger f is. That limit is the reference; a setting with
other n or dt counts by how far it is from it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from guidewire.figures.wording import number

Values = Mapping[str, Any]

_SCHEMES = ("esdirk3", "esdirk4", "trbdf2", "implicitEuler")
_BETWEEN_WALLS = ("implicitEuler",)
_ELEMENTS = (0.25, 0.5, 1.0, 2.0)
_STEPS = (0.25, 0.5, 1.0, 2.0, 4.0, 8.0)
_ITERATIONS = (1.0, 0.5, 0.25, 0.125)
_FEWEST_STEPS = 5
_FEWEST_ELEMENTS = 4
_STIFFNESSES = ("stretchStiffness", "bendStiffness", "collisionStiffness")
_LARGEST = {"stretchStiffness": 1.5, "collisionStiffness": 1.0}  # of a pbd stiffness that a trial takes


@dataclass(frozen=True)
class Trial:
    """A run of the scene with some values changed.

    Attributes
    ----------
    name : what is changed, for people.
    changed : values that override the scene's.
    """

    name: str
    changed: Values


def has_walls(scene: Values) -> bool:
    """Whether a scene has a vessel or obstacles."""
    return bool(scene.get("vessel") or scene.get("obstacles"))


def has_law(scene: Values) -> bool:
    """Whether the wire's core gives way or yields."""
    return scene.get("material", "linear") not in ("linear", "polymer") or any(
        scene.get(key) is not None for key in ("plateau", "yieldStress"))


def references(scene: Values) -> tuple[Trial, Trial, Trial]:
    """The reference of a scene of these effective values, and runs half and three quarters as fine that say what it is
    worth."""
    if scene["solver"] == "pbd":
        return tuple(Trial(f"reference, m times {f} and stiffness over {f}", _softened(scene, float(f)))
                     for f in (8, 4, 6))
    scheme, parts = ("implicitEuler", (16.0, 8.0, 12.0)) if has_walls(scene) \
        else ("esdirk4", (4.0, 2.0, 3.0))
    made = []
    for fraction, part in zip((1.0, 0.5, 0.75), parts):
        finer = _with_elements(scene, lambda n: int(fraction * 2 * max(16, n))) if _may_change_elements(scene) else {}
        changed = {**_direct(scheme), **finer, **_stepped(scene, 1.0 / part)}
        changed |= {"fibres": min(16, int(8 * fraction) + 1)} if has_law(scene) else {}
        made.append(Trial("reference, " + _settings({**scene, **changed}), changed))
    return tuple(made)


def finer(scene: Values, elements: bool) -> list[Trial]:
    """Half the time step of a scene and, if asked for, twice its elements; without what its steps or start do not
    allow."""
    found = [("half the time step", _stepped(scene, 0.5)), ("twice the elements",
                                                            _fewer(scene, 2.0) if elements else None)]
    return [Trial(name, changed) for name, changed in found if changed]


def candidates(scene: Values) -> list[Trial]:
    """Settings that may be cheaper than the file's, the file's among them, no two alike."""
    tried = [Trial("as the file has it", {}), *(_of_pbd(scene) if scene["solver"] == "pbd" else _of_material(scene))]
    found: dict[tuple, Trial] = {}
    for trial in tried:
        effective = {**scene, **trial.changed}
        found.setdefault(tuple(sorted((key, repr(effective.get(key))) for key in _VARIED)), trial)
    return list(found.values())


_DELAY = "relaxationTime"
_FRICTION = {"frictionCoefficient": 0.0, "lumenFriction": 0.0}    # stated: else an instrument's own takes its place
_SOFTNESS = dict.fromkeys(("wallStiffness", "softLimit", "tipLength", _DELAY, "modulus", "wallThickness", "lumenRadius",
                           "surroundingModulus", "regions"))
_SHEAR = ("shearFactor", "shearStiffness")
_TWIST = ("shearModulus", "shearStiffness", "torsionalStiffness")
_VARIED = ("solver", "integrator", "numberRodElements", "catheters", "timeStep", "constraintSolverSteps", "substeps",
           "elementContact", "fibres", *_STIFFNESSES)


def parts(scene: Values) -> list[Trial]:
    """The model's parts that the scene has, each left out or halved."""
    of_wire = " of the wire" if scene.get("catheters") else ""
    found = [
        ("rod elements n, halved", _fewer(scene, 0.5)), ("time step, doubled", _stepped(scene, 2.0)),
        ("iterations m, halved", _over(scene, "constraintSolverSteps", 0.5)),
        ("substeps, halved", _over(scene, "substeps", 0.5)),
        ("gravity, left out", _without(scene, "gravity", [0.0, 0.0, 0.0])),
        ("friction, left out", _with_members(scene, _FRICTION)),
        ("walls that give way, as rigid ones", _with_members(scene, _SOFTNESS, ("vessel", "obstacles"))),
        ("delay of walls that give way, left out", _with_members(scene, {_DELAY: 0.0})),
        ("twist by the drive, left out", _without(scene, "twistPerStep", 0.0)),
        (f"local element size{of_wire}, left out", _even(scene)),
        ("catheters, left out", {"catheters": []} if scene.get("catheters") else None),
    ]
    if scene["solver"] == "pbd":
        found += [
            ("bend-twist, left out", _without(scene, "bendStiffness", 0.0)),
            ("bend-twist, halved", _over(scene, "bendStiffness", 0.5)),
            ("damping, left out", _without(scene, "damping", 0.0)),
            ("contact by elements, left out",
             _without(scene, "elementContact", "none") if has_walls(scene) else None),
        ]
    else:
        found += [
            (f"twist and shear stiffness{of_wire}, halved",
             {"shearModulus": 0.5 * scene["shearModulus"], **_in_sections(scene, _TWIST, 0.5)}),
            (f"shear{of_wire}, left out",
             {"shearFactor": 100.0 * scene["shearFactor"], **_in_sections(scene, _SHEAR, 100.0)}),
            ("drag, left out", _without(scene, "massDamping", 0.0)),
            ("material damping, left out", _without(scene, "materialDamping", 0.0)),
            ("law of the core, left out", {"material": "linear", "plateau": None, "yieldStress": None}
             if has_law(scene) else None),
            ("rings of fibres, doubled", {"fibres": min(16, 2 * (scene["fibres"] or 4))} if has_law(scene) else None),
            ("fourth-order clamp, left out", _without(scene, "clampRule", "halfElement")),
        ]
        if scene["solver"] == "direct":
            found.append(("consistent mass, left out", _without(scene, "massRule", "lumped")))
    return [Trial(name, changed) for name, changed in found if changed]


def work(effective: Values, summary: Values) -> float:
    """What a run costs by its counts, in iterations of one element; the same on every machine, and only roughly in
    proportion to its time."""
    steps = summary["steps"]
    n = effective["numberRodElements"] + sum(one["elements"] for one in effective.get("catheters") or ())
    solver = summary.get("solver") or {}
    if effective["solver"] == "direct":
        solved = solver["factorisations"] + 0.5 * solver["keptSolutions"] + 3.0 * (solver.get("wallIterations") or 0)
        return 20.0 * n * solved
    iterations = effective.get("constraintSolverSteps", 1) * effective.get("substeps", 1)
    contact = 1.25 if has_walls(effective) and effective.get("elementContact") != "none" else 1.0
    return steps * n * iterations * contact * {"pbd": 1.0, "xpbd": 3.0, "explicit": 2.0}[effective["solver"]]


def _of_pbd(scene: Values) -> Iterator[Trial]:
    contacts = ("barycentric", "none") if has_walls(scene) and scene["elementContact"] != "none" else (None,)
    for fraction in _ITERATIONS:
        for softened in (True, False):
            for elements in (1.0, 0.5):
                for factor in (1.0, 2.0):
                    for contact in contacts:
                        stepped = _stepped(scene, factor)
                        fewer = _fewer(scene, elements) if elements != 1.0 else {}
                        if stepped is None or fewer is None:
                            continue
                        iterated = _softened(scene, fraction) if softened \
                            else _over(scene, "constraintSolverSteps", fraction)
                        touched = {} if contact in (None, scene["elementContact"]) else {"elementContact": contact}
                        changed = {**fewer, **stepped, **(iterated or {}), **touched}
                        yield Trial(_settings({**scene, **changed}), changed)


def _of_material(scene: Values) -> Iterator[Trial]:
    schemes = _BETWEEN_WALLS if has_walls(scene) else _SCHEMES
    for scheme in schemes:
        for fraction in _ELEMENTS if _may_change_elements(scene) else (1.0,):
            for factor in _STEPS:
                fewer, stepped = _fewer(scene, fraction) if fraction != 1.0 else {}, _stepped(scene, factor)
                if fewer is not None and stepped is not None:
                    changed = {**_direct(scheme), **fewer, **stepped}
                    yield Trial(_settings({**scene, **changed}), changed)
    for rings in (4, 5, 6, 8) if has_law(scene) else ():
        yield Trial(_settings({**scene, "fibres": rings}), {"fibres": rings})
    for factor in (0.5, 0.25):
        changed = _over(scene, "substeps", factor)
        if scene["solver"] in ("xpbd", "explicit") and changed:
            yield Trial(_settings({**scene, **changed}), changed)


def _settings(effective: Values) -> str:
    """Words for what a trial varies."""
    words = [effective["solver"]]
    if effective["solver"] == "direct":
        words.append(effective["integrator"])
    words.append(f"n = {effective['numberRodElements']}")
    words += [f"of the catheter {one['elements']}" for one in effective.get("catheters") or ()]
    if has_law(effective) and effective["fibres"] > 0:
        words.append(f"{effective['fibres']} rings of fibres")
    words += [f"dt = {number(1e3 * effective['timeStep'], 3)} ms"]
    if effective["solver"] in ("pbd", "xpbd"):
        words.append(f"m = {effective['constraintSolverSteps']}")
    if effective["solver"] == "pbd":
        words.append(f"k_A = {effective['stretchStiffness']:g}, k_B = {effective['bendStiffness']:g}, "
                     f"k_C = {effective['collisionStiffness']:g}")
        words += ["spheres alone touch"] * (effective["elementContact"] == "none" and has_walls(effective))
    if effective["solver"] in ("xpbd", "explicit"):
        words.append(f"substeps = {effective['substeps']}")
    return ", ".join(words)


def _direct(scheme: str) -> dict[str, Any]:
    return {"solver": "direct", "integrator": scheme}


def _may_change_elements(scene: Values) -> bool:
    """Whether all elements of each instrument are alike and none stands in a start file."""
    return not scene.get("startFile") and not scene.get("start") and not any(
        "numberRodElements" in section for one in (scene, *(scene.get("catheters") or ()))
        for section in one.get("wireSections") or ())


def _with_elements(scene: Values, change: Callable[[int], int]) -> dict[str, Any]:
    """Other numbers of elements for the wire and for each catheter."""
    changed: dict[str, Any] = {"numberRodElements": change(int(scene["numberRodElements"]))}
    if scene.get("catheters"):
        changed["catheters"] = [{**one, "elements": change(int(one["elements"]))} for one in scene["catheters"]]
    return changed


def _fewer(scene: Values, fraction: float) -> dict[str, Any] | None:
    if not _may_change_elements(scene):
        return None
    changed = _with_elements(scene, lambda n: round(fraction * n))
    counts = (changed["numberRodElements"], *(one["elements"] for one in changed.get("catheters", ())))
    return changed if min(counts) >= _FEWEST_ELEMENTS else None


def _stepped(scene: Values, factor: float) -> dict[str, Any] | None:
    """The same motion with steps that are so many times as long; None where its duration has no such steps."""
    steps = scene["maxSimulationSteps"] / factor
    if steps < _FEWEST_STEPS or abs(steps - round(steps)) > 1e-9 or factor == 1.0:
        return {} if factor == 1.0 else None
    changed: dict[str, Any] = {"timeStep": scene["timeStep"] * factor, "maxSimulationSteps": round(steps)}
    changed |= {key: scene[key] * factor for key in ("displacementPerStep", "twistPerStep") if scene.get(key)}
    if scene.get("damping"):
        changed["damping"] = 1.0 - (1.0 - scene["damping"]) ** factor
    return changed


def _softened(scene: Values, fraction: float) -> dict[str, Any]:
    """A fraction of the iterations, with stiffnesses that are as many times as large."""
    m = max(1, round(fraction * scene["constraintSolverSteps"]))
    factor = scene["constraintSolverSteps"] / m
    largest = {**_LARGEST, "bendStiffness": 0.5 * scene["guidewireLength"] / scene["numberRodElements"]}
    return {"constraintSolverSteps": m,
            **{key: min(scene[key] * factor, max(scene[key], largest[key])) for key in _STIFFNESSES}}


def _over(scene: Values, key: str, fraction: float) -> dict[str, Any] | None:
    value = scene.get(key)
    if not value or value == 1:
        return None
    return {key: max(1, round(fraction * value)) if isinstance(value, int) else fraction * value}


def _without(scene: Values, key: str, neutral: Any) -> dict[str, Any] | None:
    return {key: neutral} if key in scene and scene[key] != neutral else None


def _with_members(scene: Values, neutral: Values, holders: Sequence[str] = ("vessel", "obstacles", "catheters")
                  ) -> dict[str, Any] | None:
    """Walls and catheters whose members have their neutral values, or, of None, are not there; None where none of them
    has another value."""
    def plain(part: Values) -> dict[str, Any]:
        made = {**part, **{key: neutral[key] for key in part if key in neutral}}
        return {key: value for key, value in made.items() if key not in neutral or value is not None}

    changed: dict[str, Any] = {}
    for key in holders:
        held = scene.get(key) or []
        if any(one.get(member) for one in ([held] if isinstance(held, dict) else held) for member in neutral):
            changed[key] = plain(held) if isinstance(held, dict) else [plain(one) for one in held]
    return changed or None


def _in_sections(scene: Values, members: Sequence[str], factor: float) -> dict[str, Any]:
    """Sections whose own values of these members are so many times as large; nothing where none has any."""
    sections = scene.get("wireSections") or []
    if not any(member in one for one in sections for member in members):
        return {}
    return {"wireSections": [{**one, **{key: factor * one[key] for key in members if key in one}} for one in sections]}


def _even(scene: Values) -> dict[str, Any] | None:
    """Sections without elements of their own."""
    sections = scene.get("wireSections") or []
    if not any("numberRodElements" in one for one in sections):
        return None
    kept = [{key: value for key, value in one.items() if key != "numberRodElements"} for one in sections]
    return {"wireSections": [one for one in kept if set(one) - {"from", "to"}]}


def sample_times(scene: Values, count: int) -> list[float]:
    """Times at which answers are compared, s, from 0 to the scene's end."""
    end = scene["timeStep"] * scene["maxSimulationSteps"]
    return [end * k / (count - 1) for k in range(count)]


def log_every(effective: Values, count: int) -> int:
    """Every how many steps a run is logged so that about `count` entries are left."""
    return max(1, math.ceil(effective["maxSimulationSteps"] / count))

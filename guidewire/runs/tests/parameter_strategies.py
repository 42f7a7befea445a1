"""Strategies for random parameter files: values that the keys of the table allow, and whole scenes of them.

What a key's words and borders are is read from the runner's own table; here stand the sizes that scenes have, which
also bound what a run costs: few elements, few steps, few iterations.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from guidewire.runs.key_table import Key

FULL = os.environ.get("GUIDEWIRE_ALL") == "1"
SOLVERS = ("pbd", "xpbd", "direct", "explicit")
# What a run without them would answer another question than the file asks.
REFUSED_IN_FILES = ("tipMoment", "tipFollowerForce", "damping", "materialDamping", "vessel", "obstacles", "pointLoads",
                    "proximalMotionFile", "distalMotionFile", "instrument", "loadTables")
LOAD_TABLE = Path(__file__).with_name("load_table.csv")
DRIVE_TABLE = Path(__file__).with_name("drive_table.csv")
ARCH = Path(__file__).resolve().parents[3] / "params" / "meshes" / "arch.obj"
DEFAULTS = {"guidewireLength": 300.0, "guidewireOffset": -120.0, "startRadius": 10.0}  # mm
whole = st.integers


def examples(count: int) -> settings:
    """Settings for a quarter as many examples, seeded, or four times as many and unseeded."""
    return settings(
        max_examples=4 * count if FULL else -(-count // 4), derandomize=not FULL, deadline=None, database=None,
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture,
                               HealthCheck.data_too_large],
    )


def log_uniform(low: float, high: float) -> st.SearchStrategy[float]:
    """Within what a double holds."""
    least, most = (math.log10(min(max(bound, 1e-300), 1e300)) for bound in (low, high))
    return st.floats(least, most).map(lambda exponent: 10.0**exponent)


def vectors(component: st.SearchStrategy) -> st.SearchStrategy:
    """Both ways to write three numbers."""
    three = st.tuples(component, component, component)
    return st.one_of(three.map(list), three.map(lambda v: dict(zip("xyz", v))))


def around(size: float) -> st.SearchStrategy:
    """Three numbers of either sign, up to a size that itself varies by a factor of 1e4."""
    return vectors(st.tuples(log_uniform(1e-4 * size, size), st.floats(-1.0, 1.0)).map(math.prod))


not_zero = st.lists(st.floats(-1.0, 1.0), min_size=3, max_size=3).filter(lambda v: np.linalg.norm(v) > 1e-3)
angles = vectors(st.floats(-360.0, 360.0))


def length_of(scene: Mapping[str, Any], name: str) -> float:
    """A length of a scene, units. Where it is not named it is in mm; a wire without material knows no other unit."""
    units = 1.0 if scene["solver"] == "pbd" else 1e-3 / scene.get("metresPerUnit", 1e-3)
    return scene.get(name, DEFAULTS[name] * units)


@st.composite
def wire_sections(draw, scene: Mapping[str, Any]) -> list[dict]:
    length = length_of(scene, "guidewireLength")
    own = {"youngsModulus": log_uniform(1e6, 1e12), "shearModulus": log_uniform(1e6, 1e12),
           "density": log_uniform(100.0, 3e4), "wireRadius": log_uniform(1e-5, 2e-3), "restCurvature": around(100.0),
           "innerRadius": st.floats(0.0, 0.9e-5), "coreDiameter": log_uniform(1e-6, 2e-5),
           "shearFactor": st.floats(0.3, 1.0),
           "axialStiffness": log_uniform(1.0, 1e6), "shearStiffness": log_uniform(1.0, 1e6),
           "bendingStiffness1": log_uniform(1e-7, 1e-2), "bendingStiffness2": log_uniform(1e-7, 1e-2),
           "torsionalStiffness": log_uniform(1e-7, 1e-2), "massPerLength": log_uniform(1e-5, 0.1),
           "rotaryInertia": log_uniform(1e-12, 1e-7), "attenuation": log_uniform(0.1, 10.0)}
    sections = []
    for _ in range(draw(whole(0, 3))):
        start, part = draw(st.floats(0.0, 1.0)), draw(log_uniform(1e-3, 1.5))
        chosen = draw(st.sets(st.sampled_from(sorted(own))))
        sections.append({"from": start * length, "to": (start + part) * length,
                         **{key: draw(own[key]) for key in sorted(chosen)}})
    return sections


@st.composite
def inner_radii(draw, scene: Mapping[str, Any]) -> float:
    """Less than the wire's radius and those of its sections."""
    radii = [scene.get("wireRadius", 5e-4), *(s.get("wireRadius", 1.0) for s in scene.get("wireSections") or [])]
    return draw(st.floats(0.0, 0.99)) * min(radii)


def core_diameters(scene: Mapping[str, Any]) -> st.SearchStrategy:
    """None, or up to twice the wire's radius and those of its sections."""
    radii = [scene.get("wireRadius", 5e-4), *(s.get("wireRadius", 1.0) for s in scene.get("wireSections") or [])]
    return st.one_of(st.none(), st.floats(0.01, 1.0).map(lambda part: part * 2.0 * min(radii)))


def materials(scene: Mapping[str, Any]) -> st.SearchStrategy:
    """Laws of a core, where the rest of the scene allows one."""
    is_free = scene.get("bendLaw", "rotationVector") != "darboux" and not any(
        key.startswith("bendingStiffness") for section in scene.get("wireSections") or [] for key in section)
    return st.sampled_from(["linear", "nitinol", "steel", "platinum"] if is_free else ["linear"])


def stiffness_of(key: str) -> Callable[[Mapping[str, Any]], st.SearchStrategy]:
    """Stiffness or mass of the whole wire, as moduli and densities make them, or none."""
    def fitted(scene: Mapping[str, Any]) -> st.SearchStrategy:
        radius, inner = scene.get("wireRadius", 5e-4), scene.get("innerRadius", 0.0)
        area = math.pi * (radius * radius - inner * inner)    # without end where ** would overflow
        second = 0.25 * area * (radius * radius + inner * inner)
        shape, least, most = {"massPerLength": (area, 100.0, 3e4), "axialStiffness": (area, 1e6, 1e12)}.get(
            key, (second, 1e6, 1e12))
        if math.isnan(shape):    # of radii whose squares overflow
            return st.none()
        return st.one_of(st.none(), log_uniform(least * shape, most * shape))
    return fitted


@st.composite
def load_tables(draw, scene: Mapping[str, Any]) -> dict | None:
    loads = draw(st.sets(st.sampled_from(["gravity", "tipForce", "distributedForce", "axialForce", "tipMoment",
                                                  "tipFollowerForce"])))
    return {load: str(LOAD_TABLE) for load in sorted(loads)} or None


@st.composite
def start_files(draw, scene: Mapping[str, Any]) -> dict:
    """What a file to start from holds: a straight wire with noise, turned about itself."""
    n = int(scene.get("numberRodElements", 30))
    length = length_of(scene, "guidewireLength")
    rng = np.random.default_rng(draw(whole(0, 2**32 - 1)))
    noise = draw(log_uniform(1e-6, 0.3)) * length / n
    along = draw(not_zero.map(lambda v: v / np.linalg.norm(v)))
    positions = np.outer(np.linspace(0.0, length, n + 1), along) + noise * rng.standard_normal((n + 1, 3))
    turns = [Rotation.align_vectors([side], [[0.0, 0.0, 1.0]])[0] for side in np.diff(positions, axis=0)]
    about = Rotation.from_euler("z", rng.uniform(-np.pi, np.pi, (n, 1)))
    start = {"positions": positions.tolist(), "orientations": (Rotation.concatenate(turns) * about).as_quat().tolist()}
    if draw(st.booleans()):
        start["velocities"] = rng.standard_normal((n + 1, 3)).tolist()
        start["angularVelocities"] = rng.standard_normal((n, 3)).tolist()
    return start


@st.composite
def vessels(draw, scene: Mapping[str, Any]) -> dict | None:
    length, offset = length_of(scene, "guidewireLength"), length_of(scene, "guidewireOffset")
    reach = draw(st.floats(1.0, 5.0)) * (scene.get("sphereRadius", 5.0) + scene.get("collisionMargin", 0.0)) + 20.0
    shape = draw(st.sampled_from([None, "plane", "tube", "mesh"]))
    if shape == "plane":
        normal = draw(not_zero)
        return {"shape": shape, "point": (-reach * np.array(normal) / np.linalg.norm(normal)).tolist(),
                "normal": normal}
    if shape == "tube":
        heights = [offset - 2.0 * reach, offset + 0.5 * length, offset + length + 2.0 * reach]
        return {"shape": shape, "knots": [[0.0, draw(st.floats(-0.3, 0.3)) * reach, z] for z in heights],
                "radius": draw(st.sampled_from([reach, [reach, 2.0 * reach, reach]])),
                "openStart": draw(st.booleans()), "openEnd": draw(st.booleans())}
    return shape and {"shape": shape, "file": str(ARCH), "openRims": {"entrance": [0, 0, -320]}}


@st.composite
def obstacles(draw, scene: Mapping[str, Any]) -> list[dict] | None:
    aside = scene.get("sphereRadius", 5.0) + scene.get("collisionMargin", 0.0) + 15.0
    kinds = {
        "sphere": lambda at: {"centre": at, "radius": draw(st.floats(0.1, 10.0))},
        "capsule": lambda at: {"from": at, "to": [at[0], at[1] + 5.0, at[2]], "radius": draw(st.floats(0.1, 10.0))},
        "box": lambda at: {"centre": at, "halfSize": [1.0, 2.0, draw(st.floats(0.1, 5.0))], "rotation": [0, 30, 0]},
        "hull": lambda at: {"points": [at, [at[0], at[1] + 3.0, at[2]], [at[0], at[1], at[2] + 3.0]], "radius": 1.0},
    }
    chosen = draw(st.one_of(st.none(), st.lists(st.sampled_from(sorted(kinds)), max_size=3)))
    return chosen and [{"shape": kind, **kinds[kind]([aside, 0.0, draw(st.floats(-150.0, 150.0))])}
                       for kind in chosen]


@st.composite
def point_loads(draw, scene: Mapping[str, Any]) -> list[dict] | None:
    length = length_of(scene, "guidewireLength")
    places = draw(st.one_of(st.none(), st.lists(st.floats(0.0, 1.0), max_size=3)))
    return places and [{"at": place * length, "force": draw(vectors(st.floats(-0.1, 0.1)))} for place in places]


# Values that a key allows. A wider campaign widens these, and nothing else.
VALUES: dict[str, st.SearchStrategy] = {
    "timeStep": log_uniform(1e-5, 1.0), "maxSimulationSteps": whole(0, 60), "constraintSolverSteps": whole(0, 40),
    "timeStepError": st.one_of(st.just(0), log_uniform(1e-4, 1e-1)), "substeps": whole(1, 20),
    "solverTolerance": log_uniform(1e-12, 1e-2), "maxNewtonIterations": whole(1, 60),
    "damping": st.floats(0.0, 1.0), "deltaThreshold": st.one_of(st.just(0), log_uniform(1e-6, 1.0)),
    "steadyStateHold": whole(1, 80),
    "guidewireLength": log_uniform(1.0, 1e4), "numberRodElements": st.one_of(whole(1, 20), whole(1, 20).map(float)),
    "guidewireOffset": st.floats(-1e3, 1e3), "rodElementLength": log_uniform(0.1, 1e3),
    "metresPerUnit": log_uniform(1e-4, 1e-2), "startRadius": log_uniform(0.1, 100.0),
    "startTurns": st.floats(-5.0, 5.0), "distalRotation": st.floats(-30.0, 30.0),
    "distalDisplacement": st.floats(-20.0, 20.0), "distalRampTime": st.one_of(st.just(0), log_uniform(1e-6, 1.0)),
    "axialForce": st.floats(-1.0, 1.0), "distributedForce": around(1.0), "gravity": around(20.0),
    "tipForce": around(1.0), "tipFollowerForce": around(1.0),
    "tipForceReleaseTime": st.one_of(st.just(0), log_uniform(1e-6, 1.0)), "tipMoment": around(1e-2),
    "position": vectors(st.floats(-20.0, 20.0)), "scale": vectors(st.sampled_from([0.5, 1.0, 2.0])),
    "rotation": angles,
    "displacement": st.floats(-30.0, 30.0), "displacementDirection": not_zero,
    "displacementPerStep": st.floats(-1.0, 1.0), "twistPerStep": st.floats(-0.3, 0.3), "externalForce": around(1.0),
    "insertionSpeed": st.floats(-0.05, 0.05), "rotationSpeed": st.floats(-5.0, 5.0),
    "hubForceLimit": st.one_of(st.sampled_from([0, None, "hand"]), log_uniform(1e-3, 10.0)),
    "slipSpeed": st.one_of(st.just(0), log_uniform(1e-3, 10.0)),
    "totalMass": log_uniform(1e-4, 100.0), "stretchStiffness": st.floats(0.0, 3.0),
    "bendStiffness": log_uniform(1e-3, 100.0),
    "instrument": st.just(""),  # their runs are those of test_instruments.py
    "youngsModulus": log_uniform(1e6, 1e12), "shearModulus": log_uniform(1e6, 1e12),
    "density": log_uniform(100.0, 3e4), "wireRadius": log_uniform(1e-5, 2e-3), "restCurvature": around(100.0),
    "shearFactor": st.floats(0.3, 1.0), "massDamping": st.one_of(st.just(0), log_uniform(1e-3, 1e4)),
    "materialDamping": st.one_of(st.just(0), log_uniform(1e-7, 1.0)),
    "sphereRadius": log_uniform(0.01, 20.0), "collisionMargin": st.floats(0.0, 5.0),
    "collisionStiffness": st.floats(0.0, 1.0),
    "contactDistance": st.one_of(st.just(0), log_uniform(1e-6, 1e-2)),
    "elasticSlip": log_uniform(1e-8, 1e-5), "selfFriction": st.just(0),  # else implicitEuler alone
    "contactStiffness": st.one_of(st.just(0), log_uniform(1.0, 1e8)),
    "driveFile": st.sampled_from(["", str(DRIVE_TABLE)]), "patientAxes": st.sampled_from(["", "LPS", "RAS+30"]),
    "patientOrigin": st.sampled_from([None, [1.0, -2.0, 30.0]]),
    "proximalMotionFile": st.just(""), "distalMotionFile": st.just(""),  # need ends that go with them
    "logEvery": whole(1, 20), "logFilePath": st.sampled_from(["", "elsewhere", "Gefäß 1"]),
}
# Those that have to fit the rest of the scene.
FITTED: dict[str, Callable[[Mapping[str, Any]], st.SearchStrategy]] = {
    "wireSections": wire_sections, "innerRadius": inner_radii, "coreDiameter": core_diameters,
    **{key: stiffness_of(key) for key in ("bendingStiffness", "torsionalStiffness", "axialStiffness", "massPerLength")},
    "material": materials, "plateau": lambda scene: st.none(), "yieldStress": lambda scene: st.none(),
    "hardening": lambda scene: st.one_of(st.none(), log_uniform(1e6, 1e10)),
    "fibres": lambda scene: st.sampled_from([0, 3, 4, 6]), "shaped": lambda scene: st.none(),
    "loadTables": load_tables, "startFile": start_files, "start": lambda scene: st.just(None),
    "duration": lambda scene: st.just(None),  # takes the place of maxSimulationSteps
    "pointLoads": point_loads, "catheters": lambda scene: st.just(None),  # go with few other keys
    # needs a vessel that the wire starts in
    "vessel": vessels, "obstacles": obstacles, "sheath": lambda scene: st.just(None),
    "inlet": lambda scene: st.just(None), "target": lambda scene: st.just(None),  # need the file of an anatomy
}
# An explicit step is stable below some 1e-7 s.
SMALL_STEPS = {"timeStep": log_uniform(1e-9, 1e-6)}


def allowed(key: Key) -> st.SearchStrategy | None:
    """Values that a key allows whatever the rest of the scene is; None where there is no strategy."""
    if key.name == "logFormat":
        return st.just("json")  # what the campaigns read
    if key.kind == "word":
        return st.sampled_from(key.words)
    return st.booleans() if key.kind == "switch" else VALUES.get(key.name)


def extreme(key: Key, size: float) -> st.SearchStrategy | None:
    """As `allowed`, but where size costs nothing numbers from 1/size to size."""
    anything = st.one_of(st.floats(-size, size), log_uniform(1.0 / size, size))
    if key.name == "initialState":
        return st.just("straight")  # a rest shape takes its ends' way in parts, without limit to their number
    if key.name in ("distalRotation", "twistPerStep"):
        return allowed(key)  # turns are wound up in parts too: they cost time
    if key.kind == "vector":
        return vectors(anything).filter(lambda v: not key.needs_length or any(_numbers(v)))
    if key.kind == "number" and math.isinf(key.high):
        low = min(key.low, 0.0) if key.low_is_allowed else 1.0 / size
        return anything.filter(lambda x: low <= x)
    return allowed(key)


def _numbers(vector: Sequence | Mapping) -> Sequence[float]:
    return list(vector.values()) if isinstance(vector, Mapping) else vector


@st.composite
def scenes(draw, table: Mapping[str, Key], solver: str, integrators: Sequence[str],
           values: Callable[[Key], st.SearchStrategy | None] = allowed, **fixed: Any) -> dict:
    """A scene that a method takes: some of its keys, values that each allows and that go together, and those fixed."""
    own = [name for name, key in table.items() if solver in key.solvers and name != "solver"]
    small = SMALL_STEPS if solver == "explicit" and values is allowed else {}
    chosen = sorted(draw(st.sets(st.sampled_from(own), max_size=14)) | small.keys() - fixed.keys())
    scene = {name: draw(small[name] if name in small else values(table[name])) for name in chosen if name not in FITTED}
    # Without these most runs would be long, or over before they can come to rest.
    scene.setdefault("maxSimulationSteps", 200 if solver == "pbd" else 60)
    if "steadyStateHold" in own:
        scene.setdefault("steadyStateHold", 10)
    scene.setdefault("deltaThreshold", draw(log_uniform(1e-4, 0.1)))
    if "constraintSolverSteps" in own:
        scene.setdefault("constraintSolverSteps", 20)
    scene.update({"solver": solver, **fixed})
    if "integrator" in scene:
        scene["integrator"] = draw(st.sampled_from(integrators))
    for name in FITTED:
        if name in chosen:
            scene[name] = draw(FITTED[name](scene))
    if scene.get("vessel") and draw(st.booleans()):
        for name in ("position", "scale", "rotation"):  # so that the wire starts inside
            scene.pop(name, None)
    return reconcile(scene)


@st.composite
def round_wires(draw, length: float) -> dict:
    """Stiffness and rest shape of a wire or catheter that bends alike in both directions."""
    sections = [{"from": start * length, "to": (start + part) * length, "restCurvature": draw(around(30.0))}
                for start, part in draw(st.lists(st.tuples(st.floats(0.0, 1.0), st.floats(0.05, 1.5)), max_size=2))]
    return {"youngsModulus": draw(log_uniform(1e8, 1e11)), "shearModulus": draw(log_uniform(1e8, 1e11)),
            "density": draw(log_uniform(500.0, 1e4)), "restCurvature": draw(around(30.0)), "wireSections": sections}


@st.composite
def coaxial_scenes(draw, integrators: Sequence[str]) -> dict:
    """A wire in a catheter that fit one another, with hubs that do not cross."""
    length, radius = draw(st.floats(50.0, 400.0)), draw(log_uniform(1e-4, 5e-4))
    lumen = radius * draw(st.floats(1.05, 2.0))
    outer, elements = draw(st.floats(0.2, 1.2)) * length, draw(whole(2, 20))
    start = draw(st.floats(0.0, 0.95)) * (length - outer / elements)
    step, steps = draw(log_uniform(1e-4, 1e-2)), draw(whole(1, 30))
    speed = draw(st.floats(-0.05, 0.05))
    scene = {
        "solver": "direct", "guidewireLength": length, "guidewireOffset": -start,
        "numberRodElements": draw(whole(2, 20)), "wireRadius": radius, **draw(round_wires(length)),
        "proximalEnd": "clamped", "drive": "displace",
        "insertionSpeed": min(draw(st.floats(-0.05, 0.05)), speed + 0.9e-3 * start / (step * steps)),
        "rotationSpeed": draw(st.floats(-5.0, 5.0)), "massDamping": draw(st.floats(0.0, 50.0)), "timeStep": step,
        "maxSimulationSteps": steps, "deltaThreshold": 0.0, "gravity": draw(around(20.0)),
        "logHub": draw(st.booleans()), "logOrientations": draw(st.booleans()),
        "integrator": draw(st.sampled_from(integrators)),
        "catheters": [{"start": start, "length": outer, "elements": elements, "lumenRadius": lumen,
                       "wireRadius": lumen * draw(st.floats(1.05, 2.0)), **draw(round_wires(outer)),
                       "insertionSpeed": speed, "rotationSpeed": draw(st.floats(-5.0, 5.0)),
                       "lumenFriction": draw(st.floats(0.0, 0.5))}],
    }
    if draw(st.booleans()):
        scene |= {"integrator": "implicitEuler", "vessel": {
            "shape": "tube", "knots": [[0.0, 0.0, -2.0 * length], [0.0, 0.0, 2.0 * length]],
            "radius": draw(st.floats(5.0, 20.0)), "openStart": True, "openEnd": True}}
        scene["catheters"][0] |= {"frictionCoefficient": draw(st.floats(0.0, 0.3)),
                                  "hubForceLimit": draw(st.one_of(st.just(0.0), log_uniform(1e-2, 10.0)))}
    elif draw(st.booleans()):
        scene["initialState"] = "equilibrium"
    return scene


def _reconcile_hub(scene: dict) -> None:
    """Leaves one of the groups of keys that say how the hub of a wire with a material moves."""
    if scene.get("driveFile"):
        for name in ("insertionSpeed", "rotationSpeed"):
            scene.pop(name, None)
    if scene.get("insertionSpeed") or scene.get("driveFile"):
        scene.pop("displacementPerStep", None)
        scene.pop("SteadyState", None)
        scene["drive"] = "displace" if scene.get("drive") == "displace" else "push"
    if scene.get("rotationSpeed") or scene.get("driveFile"):
        scene.pop("twistPerStep", None)
    if not scene.get("vessel") and not scene.get("obstacles"):
        scene.pop("hubForceLimit", None)


def reconcile(scene: dict) -> dict:
    """Changes what does not go together in a scene; `CONFLICTS` in the tests holds what is refused."""
    if scene.get("initialState") == "equilibrium":
        scene = {name: value for name, value in scene.items() if name not in ("vessel", "obstacles")}
    solver = scene["solver"]
    for older, newer in (("VerletIntegration", "integrator"), ("SteadyState", "drive")):
        if newer in scene:
            scene.pop(older, None)
    if solver != "direct":
        if scene.get("distalEnd") == "sliding":
            scene["distalEnd"] = "clamped"
        if abs(scene.get("distalRotation", 0.0)) > 1.0 and not scene.get("distalRampTime"):
            scene["distalRampTime"] = 0.01
    if scene.get("distalEnd") == "held":
        scene.pop("distalRotation", None)
    if solver == "pbd":
        if scene.get("distalEnd") == "held":
            scene["distalEnd"] = "clamped"
        if scene.get("proximalEnd") == "free" or scene.get("drive") == "force":
            scene["proximalEnd"] = "held"
        return scene
    for stiffness, modulus in (("bendingStiffness", "youngsModulus"), ("torsionalStiffness", "shearModulus"),
                               ("axialStiffness", "youngsModulus"), ("massPerLength", "density")):
        if modulus in scene:
            scene.pop(stiffness, None)
    if scene.get("integrator") in ("bdf2", "implicitEuler"):
        scene.pop("timeStepError", None)
    if solver == "xpbd" and scene.get("bendLaw") == "darboux":
        del scene["bendLaw"]
    _reconcile_hub(scene)
    if scene.get("twistPerStep") or scene.get("rotationSpeed") or scene.get("driveFile"):
        scene["proximalEnd"] = "clamped"
        if scene.get("drive") == "force":
            del scene["drive"]
    if scene.get("drive") == "force":
        scene["proximalEnd"] = "free"
    moves = scene.get("drive") in ("displace", "push") or scene.get("SteadyState") is False
    if scene.get("proximalEnd") == "free" and moves:
        del scene["proximalEnd"]
    limit = 0.99 * length_of(scene, "guidewireLength") / (2.0 * math.pi * length_of(scene, "startRadius"))
    if scene.get("startShape") == "helix":
        scene["startTurns"] = max(-limit, min(limit, scene.get("startTurns", 1.0)))
    is_clamped = scene.get("proximalEnd") == "clamped"
    is_held = scene.get("distalEnd") in ("clamped", "sliding") or (
        scene.get("distalEnd") == "held" and scene.get("proximalEnd", "held") == "held")
    if scene.get("initialState") == "equilibrium" and not is_clamped and not is_held:
        scene["distalEnd"] = "clamped"
    return scene

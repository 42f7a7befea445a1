"""What advice leaves out is left out: its runs are those of a scene that never had the part."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from guidewire.advice import trials
from guidewire.logs.hub import read_hub
from guidewire.logs.logs import read_log
from guidewire.runs.runner import Request, Runner

FRICTION = 0.3
# Pushed along a floor that gives way, past a round obstacle; no wall states a friction.
SCENE = {
    "solver": "direct", "instrument": "own", "guidewireLength": 100.0, "numberRodElements": 10, "massDamping": 20.0,
    "materialDamping": 1e-4, "gravity": [0.0, -9.81, 0.0], "proximalEnd": "clamped", "drive": "displace",
    "insertionSpeed": 0.1, "rotationSpeed": 0.0, "timeStep": 0.02, "deltaThreshold": 0.0, "guidewireOffset": -101.0,
    "maxSimulationSteps": 16, "logHub": True, "logFormat": "npz",
    "vessel": {"shape": "plane", "point": [0, -0.5, 0], "normal": [0, 0.94, -0.34], "wallStiffness": 1e6,
               "relaxationTime": 0.05},
    "obstacles": [{"shape": "sphere", "centre": [0, 6, -20], "radius": 5}],
}
COAXIAL = {
    **{key: value for key, value in SCENE.items() if key not in ("vessel", "materialDamping")},
    "vessel": {"shape": "plane", "point": [0, -0.5, 0], "normal": [0, 0.94, -0.34]},
    "catheters": [{"start": 35.0, "length": 60.0, "elements": 6, "insertionSpeed": 0.1, "wireRadius": 0.0009,
                   "lumenRadius": 0.0006, "youngsModulus": 1e8, "lumenFriction": 0.2, "frictionCoefficient": 0.1}],
}
INSTRUMENT = {
    "title": "Own", "kind": "guidewire", "diameter": "0.035 in", "length": "150 cm",
    "bendingStiffness": "0.0001841 N m2", "torsionalRatio": "0.77", "density": "6.45 g/cm3",
    "distalSections": [{"length": "3 cm", "profile": "uniform", "bendingStiffness": "2.386e-05 N m2"}],
}


def stated(value: object) -> object:
    """Each text of an instrument as its file has it, with basis and source."""
    if isinstance(value, list):
        return [stated(one) for one in value]
    if isinstance(value, dict):
        return {key: one if key == "profile" else stated(one) for key, one in value.items()}
    return {"value": value, "basis": "assumed", "source": "a test"}


def write_instrument(folder: Path, friction: float) -> None:
    (folder / "instruments").mkdir(parents=True, exist_ok=True)
    (folder / "instruments" / "own.json").write_text(json.dumps({
        **{key: value if key in ("title", "kind") else stated(value) for key, value in INSTRUMENT.items()},
        "friction": {**stated(str(friction)), "coating": "PTFE"},
        "tip": {"shape": "straight", "basis": "assumed", "source": "a test", "bends": []}}), encoding="utf-8")


def made(live: Runner, folder: Path, scene: dict, name: str, changed: dict | None = None) -> Path:
    file = folder / "scene.json"
    file.write_text(json.dumps(scene), encoding="utf-8")
    answer = live.run(Request(name, file, folder / name, dict(changed or {})))
    assert answer.outcome == "finished", answer.message
    return folder / name


def told(folder: Path) -> tuple[np.ndarray, np.ndarray]:
    """Places of all nodes and forces of the hub over time."""
    return read_log(folder, spheres="all").positions, read_hub(folder).force


def without(scene: dict, *keys: str) -> dict:
    """A scene that does not have these keys, nor these members of its walls and catheters."""
    def plain(one: dict) -> dict:
        return {key: value for key, value in one.items() if key not in keys}

    held = {key: plain(value) if isinstance(value, dict) else [plain(one) for one in value]
            for key, value in scene.items() if key in ("vessel", "obstacles", "catheters")}
    return plain({**scene, **held})


NEVER_HAD = {
    "friction": lambda scene: without(scene, "frictionCoefficient", "lumenFriction"),
    "gravity": lambda scene: without(scene, "gravity"),
    "drag": lambda scene: without(scene, "massDamping"),
    "material damping": lambda scene: without(scene, "materialDamping"),
    "walls that give way, as rigid ones": lambda scene: without(scene, "wallStiffness", "relaxationTime"),
    "delay of walls that give way": lambda scene: without(scene, "relaxationTime"),
    "catheters": lambda scene: without(scene, "catheters"),
}


@pytest.mark.parametrize("scene", [SCENE, COAXIAL], ids=["wire", "coaxial"])
def test_what_is_left_out_is_not_there(live, tmp_path, scene):
    """The instrument's own friction counts where a wall states none, so a file without the word still has it."""
    rough, smooth = tmp_path / "rough", tmp_path / "smooth"
    write_instrument(rough, FRICTION)
    write_instrument(smooth, 0.0)
    as_it_is = made(live, rough, scene, "as-it-is")
    effective = json.loads((as_it_is / "parameters.json").read_text(encoding="utf-8"))
    assert effective["vessel"]["frictionCoefficient"] == FRICTION
    parts = {trial.name.removesuffix(", left out"): trial.changed for trial in trials.parts(effective)}
    places, force = told(as_it_is)
    compared = NEVER_HAD.keys() & parts.keys()
    assert {"friction", "gravity", "drag"} < compared and ("catheters" in scene) == ("catheters" in compared)
    for name in sorted(compared):
        left_out = told(made(live, rough, scene, name, parts[name]))
        never = made(live, smooth if name == "friction" else rough, NEVER_HAD[name](scene), name)
        for one, other in zip(left_out, told(never)):
            assert np.array_equal(one, other), name
        assert np.max(np.abs(left_out[1] - force)) > 1e-4 * np.max(np.abs(force)), name


def test_shear_and_twist_of_sections_go_with_those_of_the_shaft(live, tmp_path):
    """An instrument's sections state their own: a factor of the shaft alone would leave the tip as it is."""
    write_instrument(tmp_path, FRICTION)
    effective = json.loads((made(live, tmp_path, SCENE, "as-it-is") / "parameters.json").read_text(encoding="utf-8"))
    for name, members, factor in (("shear, left out", ("shearStiffness",), 100.0),
                                  ("twist and shear stiffness, halved", ("shearStiffness", "torsionalStiffness"), 0.5)):
        changed = next(trial.changed for trial in trials.parts(effective) if trial.name == name)
        after = json.loads((made(live, tmp_path, SCENE, name, changed) / "parameters.json").read_text("utf-8"))
        for before, section in zip(effective["wireSections"], after["wireSections"]):
            for key, value in before.items():
                expected = factor * value if key in members else value
                assert section[key] == pytest.approx(expected, rel=1e-12), key
        of_shaft = "shearFactor" if name.startswith("shear") else "shearModulus"
        assert after[of_shaft] == pytest.approx(factor * effective[of_shaft], rel=1e-12)

"""What each scene shows, as a table: which parameters, which changes to them, where the camera stands."""

from __future__ import annotations

from dataclasses import dataclass

# A wire that is steered by hand goes on until it is stopped: no displacement at the start, no end.
ENDLESS = ("deltaThreshold=0", "maxSimulationSteps=1000000000")
STEERED = ("drive=hold", "displacement=0", *ENDLESS)


@dataclass(frozen=True)
class Scene:
    """One scene. target: point in the middle of the picture, units; distance: of the camera from it, units; yaw, pitch:
    degrees; pace: in-game seconds a second; colouring: 0 plain, 1 stretch, 2 bending, 3 twist; meshes: files that the
    parameters name."""

    name: str
    parameters: str
    overrides: tuple[str, ...] = ()
    alternative: str = ""
    alternative_overrides: tuple[str, ...] = ()
    meshes: tuple[str, ...] = ()
    is_steered: bool = False
    target: tuple[float, float, float] = (0.0, 0.0, 30.0)
    distance: float = 420.0
    yaw: float = -90.0
    pitch: float = 15.0
    pace: float = 1.0
    colouring: int = 0


SCENES = (
    Scene("Insertion", "params/insertion.json", STEERED, "params/insertion-accurate.json",
          ("insertionSpeed=0", *ENDLESS), meshes=("params/meshes/arch.obj",), is_steered=True,
          target=(0.0, 45.0, -20.0), distance=430.0, colouring=2),
    Scene("Longitudinal", "params/longitudinal.json", pace=0.2, colouring=1),
    Scene("Transversal", "params/transversal.json", pace=0.2, colouring=2),
    Scene("CollisionWall", "params/collision-wall.json", target=(0.0, 0.0, -90.0), distance=380.0, pace=0.5,
          colouring=2),
)

"""Outcomes of methods over two parameters, each run by its class: held, inaccurate, penetrating, or lost, and how."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from guidewire.figures.style import captioned, letter, new_figure, styled
from guidewire.figures.wording import number, percent
from guidewire.logs.logs import LogError, read_log
from guidewire.logs.runs import Run, read_runs
from guidewire.studies.maps import MAPS, RADIUS

STUDIES = tuple(study.name for study in MAPS)
INACCURATE = 0.1  # of the displacement of the reference's tip
_PENETRATING = 0.2  # of the radius
_FEW = 8  # values of an axis that are named one by one
_DOUBTFUL = "not converged"
BENT = "bent"
LOST_TURN = "lost a turn"
_CLASSES = {  # marker and colour
    "converged": ("o", "C0"), "finished": ("o", "C0"), _DOUBTFUL: ("D", "C4"), "inaccurate": ("^", "C1"),
    "penetrating": ("v", "C1"), "passed a wall": ("P", "C3"), "diverged": ("x", "C3"), "failed": ("s", "C3"),
    BENT: (">", "C2"), LOST_TURN: ("*", "C3"),
}
SOME = (BENT, LOST_TURN)  # of some maps only
JOINT_LIMIT = 3.08  # rad, from which the sense of a joint's rotation is ambiguous
LARGEST_JOINT = 7.0 / 6.0  # compliance of the softest joint of a fourth-order clamp over that of an inner one


_DRAG_LIMIT = 0.19375  # a h at which `drag_error` is INACCURATE


def drag_of_a_step(run: Run) -> float:
    """a h, of a drag -a M v and a step, or substep, of h."""
    return run.number("massDamping") * run.number("timeStep") / run.parameters.get("substeps", 1)


def drag_error(drag: float) -> float:
    """a h/(1 - exp(-a h)) - 1: by how much a wire falls too fast whose speed is damped between substeps.

    From step to step the speed goes as v -> (v + g h) exp(-a h): it comes to g h e/(1 - e), e = exp(-a h), and the way
    of a substep is taken with v + g h = g h/(1 - e) instead of g/a.
    """
    return drag / -math.expm1(-drag) - 1.0


@dataclass(frozen=True)
class Cell:
    """One run of a map.

    Attributes
    ----------
    x, y : where it stands.
    kind : its class.
    error : distance of its tip from the reference's at the end, over its displacement; not a number where it was
        lost or has no reference.
    """

    x: float | str
    y: float | str
    kind: str
    error: float


@dataclass(frozen=True)
class View:
    """How a study is drawn.

    Attributes
    ----------
    study, title : str
    x, y : where a run stands.
    labels : of the axes.
    reference : from a run to the key of the one that it is measured against.
    lines : upright lines, and what they are.
    log_x : whether x is drawn on a logarithmic axis.
    error : a run's error, in place of the distance from a reference.
    kind : class of a run with this error, in place of `kind_of`.
    """

    study: str
    title: str
    x: Callable[[Run], float | str]
    y: Callable[[Run], float | str]
    labels: tuple[str, str]
    reference: Callable[[Run], str] | None = None
    lines: tuple[tuple[float, str], ...] = ()
    log_x: bool = True
    error: Callable[[Run], float] | None = None
    kind: Callable[[Run, float], str] | None = None


def _variant(part: int) -> Callable[[Run], str]:
    return lambda run: run.variant.split(",")[part]


VIEWS = (
    View("map-push", "pbd: push in a bend", lambda run: run.number("displacementPerStep") / RADIUS,
          lambda run: run.variant, ("displacement per step over the radius (1)", "what touches a wall (-)"),
          lambda _: "barycentric,push-1", ((1.0, "radius"),)),
    View("map-slender", "pbd: long elements in a bend",
          lambda run: run.number("guidewireLength") / run.number("numberRodElements") / RADIUS, lambda run: run.variant,
          ("element length over the radius (1)", "what touches a wall (-)"),
          lambda _: "barycentric,numberRodElements=40"),
    View("map-gap", "direct: fall onto a plane", lambda run: 1e3 * run.number("timeStep"),
          lambda run: 1e6 * run.number("contactDistance"), ("time step (ms)", "contact distance (µm)"),
          lambda _: "step-1,contactDistance=1e-07"),
    View("map-joints", "direct: rotation of a joint", lambda run: float(run.variant.split(",")[1]), _variant(0),
          ("rotation of an inner joint (rad)", "law, and what rotates (-)"), None,
          ((JOINT_LIMIT / LARGEST_JOINT, "joint's limit"), (1.0 / LARGEST_JOINT, "darboux")), log_x=False),
    View("map-heavy-tip", "heavy tip", lambda run: float(run.variant.split("ratio-")[1]), _variant(0),
          ("density of the tip over the wire's (1)", "method (-)"),
          lambda run: f"direct,ratio-{run.variant.split('ratio-')[1]}"),
    View("map-xpbd", "xpbd under its own weight", lambda run: run.number("substeps"),
          lambda run: run.number("constraintSolverSteps"), ("substeps of 1 ms (1)", "iterations m (1)"),
          lambda _: "xpbd,substeps=800,constraintSolverSteps=30"),
    View("map-drag", "strong drag", lambda run: drag_of_a_step(run), lambda run: run.variant,
          ("drag times the step, or substep (1)", "method (-)"),
          lambda run: f"direct,massDamping={run.values['massDamping']!r}", ((_DRAG_LIMIT, "10 % off"),)),
)


def read_map(view: View, folder: Path) -> list[Cell]:
    """Return the runs of one map.

    Raises
    ------
    LogError : a run is missing or left no log.
    """
    runs = read_runs(folder)
    tips = {} if view.reference is None else {key: _tip(run) for key, run in runs.items()}
    cells = []
    for key, run in runs.items():
        error = np.nan
        if run.outcome in ("diverged", "failed"):
            pass
        elif view.error is not None:
            error = view.error(run)
        elif view.reference is not None:
            other = view.reference(run)
            if other not in tips:
                raise LogError(f"{folder}: has no run {other}")
            start, end = tips[other]
            error = float(np.linalg.norm(tips[key][1] - end) / np.linalg.norm(end - start))
        cells.append(Cell(view.x(run), view.y(run), (view.kind or kind_of)(run, error), error))
    return cells


def kind_of(run: Run, error: float) -> str:
    """Class of a run with this error; the worst that can be said of it."""
    if run.outcome in ("diverged", "failed"):
        return run.outcome
    if run.measured("passages") > 0:
        return "passed a wall"
    if run.measured("maxPenetration") > _PENETRATING * run.parameters.get("sphereRadius", np.inf):
        return "penetrating"
    if error > INACCURATE:
        return "inaccurate"
    swept = (run.summary.get("solver") or {}).get("stepsNotConverged")
    return _DOUBTFUL if swept else run.outcome


def _tip(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Return the last sphere at the start and at the end, units."""
    log = read_log(run.folder)
    return log.positions[0, 0], log.final_positions[-1]


@styled
def draw_maps(folders: Mapping[str, Path]) -> tuple[Figure, str]:
    """Return one panel a map."""
    found = {view.study: read_map(view, folders[view.study]) for view in VIEWS}
    figure = new_figure(15.0, 6.6)
    panels = figure.subplots(2, 4).ravel()
    for name, axes, view in zip("abcdefg", panels, VIEWS):
        letter(axes, name, view.title)
        draw_map(axes, view, found[view.study])
    draw_classes(panels[7])
    return captioned(figure, _caption(found))


def draw_classes(axes: Axes, more: Sequence[str] = ()) -> None:
    """What the markers are, `more` beside those of every map."""
    axes.axis("off")
    for kind, (marker, colour) in _CLASSES.items():
        if kind != "converged" and (kind not in SOME or kind in more):
            axes.plot([], [], marker, color=colour, fillstyle="none",
                      label="converged or finished" if kind == "finished" else kind)
    axes.legend(loc="center", fontsize=8)


def draw_map(axes: Axes, view: View, cells: Sequence[Cell]) -> None:
    """Draw one panel."""
    names = list(dict.fromkeys(cell.y for cell in cells)) if isinstance(cells[0].y, str) else None
    for cell in cells:
        marker, colour = _CLASSES[cell.kind]
        axes.plot(cell.x, cell.y if names is None else names.index(cell.y), marker, color=colour, fillstyle="none")
    if view.log_x:
        axes.set_xscale("log")
    if names is None:
        axes.set_yscale("log")
        lines = sorted({cell.y for cell in cells})
        if len(lines) <= _FEW:
            axes.set_yticks(lines, [f"{y:g}" for y in lines])
            axes.set_yticks([], minor=True)
    else:
        axes.set_yticks(range(len(names)), names)
        axes.margins(y=0.3)
    for x, text in view.lines:
        axes.axvline(x, color="0.3", linestyle="--", linewidth=0.8)
        axes.annotate(text, (x, 0.01), xycoords=("data", "axes fraction"), rotation=90, fontsize=6, ha="right")
    axes.set(xlabel=view.labels[0], ylabel=view.labels[1])


def kinds_of(cells: Sequence[Cell], y: float | str | None = None) -> str:
    """Return how many of each class, in words."""
    own = [cell.kind for cell in cells if y is None or cell.y == y]
    return ", ".join(f"{own.count(kind)} {kind}" for kind in dict.fromkeys(own))


def _held(cells: Sequence[Cell], y: str) -> str:
    """Return the largest x that holds and the smallest that does not, of one line."""
    held = [cell.x for cell in cells if cell.y == y and cell.kind in ("converged", "finished")]
    lost = [cell.x for cell in cells if cell.y == y and cell.kind in ("diverged", "failed")]
    return f"{max(held):g} holds, {min(lost):g} does not" if lost else f"{max(held):g} holds"


def _caption(found: Mapping[str, Sequence[Cell]]) -> str:
    push, slender, gap, joints, heavy, swept, drag = (found[view.study] for view in VIEWS)
    substeps = {m: min((cell.x for cell in swept if cell.y == m and cell.kind != "diverged"), default=np.nan)
                for m in sorted({cell.y for cell in swept})}
    worst = {name: max((cell.error for cell in heavy if cell.y == name), default=np.nan)
             for name in dict.fromkeys(cell.y for cell in heavy)}
    off = max(abs(cell.error / drag_error(cell.x) - 1.0) for cell in drag
              if cell.y != "direct" and cell.x > _DRAG_LIMIT)
    return (
        "Figure maps. Where methods hold and where they fail. Inaccurate: the tip is off by more than "
        f"{percent(INACCURATE)} of the displacement of the reference's tip; penetrating: deeper than "
        f"{percent(_PENETRATING)} of the radius. (a) The same push of 100 units in a bent lumen in fewer, longer "
        f"steps, against the shortest: barycentric {kinds_of(push, 'barycentric')}; thesis {kinds_of(push, 'thesis')}; "
        f"none {kinds_of(push, 'none')}. No step is too long for the walls, because its displacement is made in parts "
        "of at most a radius, each with continuous collision detection; beyond a radius the wire has too few steps in "
        "which to follow. The thesis's rule lets the wire in at any step. (b) Elements of up to five radii in the same "
        f"bend, against the shortest: barycentric {kinds_of(slender, 'barycentric')}; thesis "
        f"{kinds_of(slender, 'thesis')}; none {kinds_of(slender, 'none')}. No length passes the wall except with the "
        "thesis's rule; all are off, because the stiffness of pbd depends on n. (c) A wire that falls onto a plane, by "
        f"contact distance and step: {kinds_of(gap)}; no limit is found, barriers keep the wire inside whatever the "
        "step. (d) Rest shapes of six elements under a couple at the tip (rotationVector: "
        f"{_held(joints, 'rotationVector')}; darboux: {_held(joints, 'darboux')}) and twisted between clamps (twist: "
        f"{_held(joints, 'twist')}). Dashed: the softest joint, beside the clamp, turns by 7/6 of an inner one; it "
        f"reaches its limit of {JOINT_LIMIT:g} rad when those are at {number(JOINT_LIMIT / LARGEST_JOINT, 3)}, and K "
        "sin, the darboux law, has no balance when they are beyond 6/7: both come before π and 1. (e) The last 15 mm "
        "of a wire under its own weight made heavier, against direct at the same ratio: worst distance "
        + ", ".join(f"{name} {percent(error)}" for name, error in worst.items() if name != "direct")
        + f"; {kinds_of(heavy)}. (f) xpbd holds from "
        + ", ".join(f"{k:g} substeps with m = {m:g}" for m, k in substeps.items())
        + f"; {kinds_of(swept)}. There is no limit in closed form: the error that iterations leave is taken by the "
          "next substep as motion, and more iterations leave less. (g) A drag a over steps, or substeps, of h, "
          "against direct: "
        f"{kinds_of(drag)}. xpbd and explicit damp the speed between substeps: a wire that falls is too fast by "
        f"a h/(1 - exp(-a h)) - 1, within {percent(off)} of what is found, which is 10 % at a h = "
        f"{number(_DRAG_LIMIT, 2)} (dashed). direct takes the drag with the step and has no limit."
    )

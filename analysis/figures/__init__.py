"""The figures by their numbers: what each needs and how it is drawn."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from matplotlib.figure import Figure

from analysis.comparisons import read_comparison, read_reference
from analysis.figures import default_run, maps, perturbations, stability, wire_maps
from analysis.figures.contact_rule import draw_contact_rule, read_rests
from analysis.figures.control import draw_drives, draw_twist, read_drives, read_twists
from analysis.figures.gain import draw_gain
from analysis.figures.scenes import draw_scenes
from analysis.figures.sweeps import VIEWS, draw_sweep
from analysis.gain import read_gain
from analysis.tables import read_table

Drawn = tuple[Figure, str]


@dataclass(frozen=True)
class FigureSpec:
    """One figure.

    Attributes
    ----------
    id : its number, such as "4.5".
    title : what it shows, in a few words.
    studies : names of the studies whose runs it is drawn from.
    draw : from a mapping of study name to study folder to the figure and its caption. Raises
        guidewire.logs.logs.LogError where a file cannot be read or no run lasts as long as its reference, and
        guidewire.logs.relaxation.RelaxationError where nothing relaxes.
    beside : further files of the picture's folder, by name: each writes, from the same mapping, the file at a path.
    gates : from the same mapping to one line for each number that is beyond its gate.
    """

    id: str
    title: str
    studies: tuple[str, ...]
    draw: Callable[[Mapping[str, Path]], Drawn]
    beside: Mapping[str, Callable[[Mapping[str, Path], Path], None]] = field(default_factory=dict)
    gates: Callable[[Mapping[str, Path]], list[str]] = lambda _: []


def _default_spec(number: str, title: str, draw: Callable[[default_run.RunTable], Drawn], **options) -> FigureSpec:
    return FigureSpec(number, title, ("default",),
                      lambda studies: draw(default_run.read_default_run(studies["default"], **options)))


def _study_spec(number: str, title: str, study: str) -> FigureSpec:
    view = VIEWS[number]
    return FigureSpec(number, title, (study,), lambda studies: draw_sweep(view, read_table(studies[study], view.key)))


def _perturbation_spec(number: str, scene: str, study: str, title: str) -> FigureSpec:
    reference, name, view = f"{scene}-reference", f"{scene}-{study}", perturbations.VIEWS[number]
    return FigureSpec(number, title, (reference, name), lambda studies: perturbations.draw_perturbation(
        view, read_comparison(studies[name], studies[reference], view.key, view.proportional)))


def _gain_spec(study: str, number: str, title: str, scene: str) -> FigureSpec:
    return FigureSpec(number, title, (study,),
                      lambda studies: draw_gain(number, scene, read_gain(studies[study], count_again=5)))


def _rows_spec(number: str, title: str, study: str, read: Callable, draw: Callable) -> FigureSpec:
    return FigureSpec(number, title, (study,), lambda studies: draw(read(studies[study])))


FIGURES: dict[str, FigureSpec] = {
    spec.id: spec
    for spec in (
        _default_spec("4.1", "time evolution of the last sphere", default_run.draw_time_evolution),
        _default_spec(
            "4.2", "displacement of all spheres over time", default_run.draw_heat_map, spheres="all",
            most_entries=default_run.MOST_COLUMNS,
        ),
        _default_spec("4.3", "fit of the relaxation time", default_run.draw_relaxation),
        _default_spec("4.4", "displacement error of each sphere", default_run.draw_final_error, spheres="all"),
        _study_spec("4.5", "convergence against the constraint solver steps", "constraint-solver-steps"),
        _study_spec("4.6", "convergence against the number of rod elements", "rod-elements"),
        _study_spec("4.7", "convergence against the displacement", "displacement"),
        _study_spec("4.8", "convergence against the time step size", "time-step"),
        _study_spec("4.9", "convergence against the total mass", "total-mass"),
        _rows_spec("4.10", "reference run of the transversal displacement", "transversal-reference", read_reference,
                   perturbations.draw_reference),
        _perturbation_spec("4.11", "transversal", "solver-steps", "transversal against the constraint solver steps"),
        _perturbation_spec("4.12", "transversal", "time-step", "transversal against the time step size"),
        _perturbation_spec("4.13", "transversal", "rod-elements", "transversal against the number of rod elements"),
        _perturbation_spec("4.14", "transversal", "total-mass", "transversal against the total mass"),
        _perturbation_spec("4.14b", "transversal", "displacement", "transversal against the displacement"),
        _perturbation_spec("4.15", "collision", "solver-steps", "collision against the constraint solver steps"),
        _perturbation_spec("4.16", "collision", "time-step", "collision against the time step size"),
        _perturbation_spec("4.17", "collision", "rod-elements", "collision against the number of rod elements"),
        _perturbation_spec("4.18", "collision", "total-mass", "collision against the total mass"),
        FigureSpec("scenes", "the wall and the vessel", ("wall-gain", "vessel-gain"), lambda studies: draw_scenes(
            read_gain(studies["wall-gain"]), read_gain(studies["vessel-gain"]))),
        _gain_spec("wall-gain", "gain-wall", "long elements at a wall: error, cost, passages",
                   "Push against a wall, the wire's first two thirds between two plates"),
        _gain_spec("vessel-gain", "gain-vessel", "long elements in a vessel: error, cost, passages",
                   "Insertion into an arch with a branch, until the wire buckles"),
        _rows_spec("contact-rule", "the published contact rule compared with the lever rule", "contact-rule",
                   read_rests,
                   draw_contact_rule),
        _rows_spec("pulling", "what moves the first sphere in a bend", "drives", read_drives, draw_drives),
        _rows_spec("twist", "tip angle against base angle", "twist", read_twists, draw_twist),
        FigureSpec("stability", "where methods fail", stability.STUDIES, stability.draw_stability, {},
                   stability.failed_gates),
        FigureSpec("maps", "outcomes over two parameters", maps.STUDIES, maps.draw_maps),
        FigureSpec("maps-wire", "outcomes of twist, pushes between walls and damping", wire_maps.STUDIES,
                   wire_maps.draw_wire_maps),
    )
}

"""The figures by their numbers: what each needs and how it is drawn."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
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
    id : str
        Its number, such as "4.5".
    title : str
        What it shows, in a few words.
    studies : tuple of str
        Names of the studies whose runs it is drawn from.
    draw : callable
        From a mapping of study name to study folder to the figure and its caption. Raises analysis.logs.LogError
        where a file cannot be read or no run lasts as long as its reference, and analysis.relaxation.RelaxationError
        where nothing relaxes.
    beside : mapping of str to callable
        Further files of the picture's folder, by name: each writes, from the same mapping, the file at a path.
    gates : callable
        From the same mapping to one line for each number that is beyond its gate.
    """

    id: str
    title: str
    studies: tuple[str, ...]
    draw: Callable[[Mapping[str, Path]], Drawn]
    beside: Mapping[str, Callable[[Mapping[str, Path], Path], None]] = field(default_factory=dict)
    gates: Callable[[Mapping[str, Path]], list[str]] = lambda _: []


def _draw_default(draw: Callable[[default_run.RunTable], Drawn], options: dict, studies: Mapping[str, Path]) -> Drawn:
    return draw(default_run.read_default_run(studies["default"], **options))


def _draw_study(number: str, study: str, studies: Mapping[str, Path]) -> Drawn:
    view = VIEWS[number]
    return draw_sweep(view, read_table(studies[study], view.key))


def _default_spec(number: str, title: str, draw: Callable[[default_run.RunTable], Drawn], **options) -> FigureSpec:
    return FigureSpec(number, title, ("default",), partial(_draw_default, draw, options))


def _study_spec(number: str, title: str, study: str) -> FigureSpec:
    return FigureSpec(number, title, (study,), partial(_draw_study, number, study))


def _draw_reference(study: str, studies: Mapping[str, Path]) -> Drawn:
    return perturbations.draw_reference(read_reference(studies[study]))


def _draw_perturbation(number: str, study: str, reference: str, studies: Mapping[str, Path]) -> Drawn:
    view = perturbations.VIEWS[number]
    table = read_comparison(studies[study], studies[reference], view.key, view.proportional)
    return perturbations.draw_perturbation(view, table)


def _perturbation_spec(number: str, scene: str, study: str, title: str) -> FigureSpec:
    reference, name = f"{scene}-reference", f"{scene}-{study}"
    return FigureSpec(number, title, (reference, name), partial(_draw_perturbation, number, name, reference))


def _draw_gain(name: str, study: str, scene: str, studies: Mapping[str, Path]) -> Drawn:
    return draw_gain(name, scene, read_gain(studies[study], count_again=5))


def _draw_scenes(studies: Mapping[str, Path]) -> Drawn:
    return draw_scenes(read_gain(studies["wall-gain"]), read_gain(studies["vessel-gain"]))


def _draw_rows(draw: Callable, read: Callable, study: str, studies: Mapping[str, Path]) -> Drawn:
    return draw(read(studies[study]))


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
        FigureSpec("4.10", "reference run of the transversal displacement", ("transversal-reference",),
                   partial(_draw_reference, "transversal-reference")),
        _perturbation_spec("4.11", "transversal", "solver-steps", "transversal against the constraint solver steps"),
        _perturbation_spec("4.12", "transversal", "time-step", "transversal against the time step size"),
        _perturbation_spec("4.13", "transversal", "rod-elements", "transversal against the number of rod elements"),
        _perturbation_spec("4.14", "transversal", "total-mass", "transversal against the total mass"),
        _perturbation_spec("4.14b", "transversal", "displacement", "transversal against the displacement"),
        _perturbation_spec("4.15", "collision", "solver-steps", "collision against the constraint solver steps"),
        _perturbation_spec("4.16", "collision", "time-step", "collision against the time step size"),
        _perturbation_spec("4.17", "collision", "rod-elements", "collision against the number of rod elements"),
        _perturbation_spec("4.18", "collision", "total-mass", "collision against the total mass"),
        FigureSpec("scenes", "the wall and the vessel", ("wall-gain", "vessel-gain"), _draw_scenes),
        FigureSpec("gain-wall", "long elements at a wall: error, cost, passages", ("wall-gain",), partial(
            _draw_gain, "gain-wall", "wall-gain",
            "Push against a wall, the wire's first two thirds between two plates")),
        FigureSpec("gain-vessel", "long elements in a vessel: error, cost, passages", ("vessel-gain",), partial(
            _draw_gain, "gain-vessel", "vessel-gain", "Insertion into an arch with a branch, until the wire buckles")),
        FigureSpec("contact-rule", "the published contact rule compared with the lever rule", ("contact-rule",),
                   partial(_draw_rows, draw_contact_rule, read_rests, "contact-rule")),
        FigureSpec("pulling", "what moves the first sphere in a bend", ("drives",),
                   partial(_draw_rows, draw_drives, read_drives, "drives")),
        FigureSpec("twist", "tip angle against base angle", ("twist",),
                   partial(_draw_rows, draw_twist, read_twists, "twist")),
        FigureSpec("stability", "where methods fail", stability.STUDIES, stability.draw_stability, {},
                   stability.failed_gates),
        FigureSpec("maps", "outcomes over two parameters", maps.STUDIES, maps.draw_maps),
        FigureSpec("maps-wire", "outcomes of twist, pushes between walls and damping", wire_maps.STUDIES,
                   wire_maps.draw_wire_maps),
    )
}

"""Costs of other programs published for a problem of the chart, drawn without an error if none was stated."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Published:
    """A rate that a paper states.

    Attributes
    ----------
    problem : name of the problem that is nearest to what it was measured on.
    label : what computed it, in a few characters.
    steps : shortest and longest wall time between two answers to a loop, s.
    source : authors, year, title and number.
    says : what was computed, and what is not said.
    """

    problem: str
    label: str
    steps: tuple[float, float]
    source: str
    says: str


PUBLISHED = (
    Published(
        "insertion", "2 x 512 elements, GPU", (1e-3, 2e-3),
        "P. Korzeniowski, N. Hald, F. Bello (2025): Massively-Parallel Implementation of Inextensible Elastic "
        "Rods Using Inter-block GPU Synchronization, arXiv:2509.04277, abstract",
        "a catheter and a guidewire of 512 Cosserat elements each in a cardiovascular scene, simulated in real time at "
        "0.5 to 1 kHz by a program that makes several time steps in one launch on a graphics processor; another "
        "vessel, other wires and another machine, and no error is stated there",
    ),
)

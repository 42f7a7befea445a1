"""`figures measured`: loops with the elastica found, and poses with what was predicted."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from analysis.measured import wires
from analysis.measured.wires import COUNTED, PEERS, WIRES, Wire
from guidewire.figures.style import add_caption, letter, new_figure, styled
from guidewire.identification import Identified


@dataclass(frozen=True)
class Pose:
    """One pose: mean distances of the prediction and of the authors' simulations, mm, and the points to draw."""

    wire: str
    number: int
    miss: float
    peers: Mapping[str, float]
    length: float
    measured: np.ndarray
    predicted: np.ndarray


@dataclass(frozen=True)
class Found:
    """Everything: fits of the loops and of the twists by wire, and the poses."""

    loops: Mapping[str, tuple[Identified, ...]]
    twists: Mapping[str, Identified]
    poses: tuple[Pose, ...]

    def bending(self, wire: str) -> np.ndarray:
        """Return EI of each digitisation, N m2."""
        return np.array([fit["bendingStiffness"].value for fit in self.loops[wire]])

    def mean_miss(self, wire: str) -> float:
        """Over the poses that count, mm."""
        return float(np.mean([pose.miss for pose in self.poses if pose.wire == wire and pose.number in COUNTED]))

    def peers(self, wire: str) -> dict[str, float]:
        """Return the authors' two simulations, over the same poses, mm."""
        return {name: float(np.mean([pose.peers[name] for pose in self.poses
                                     if pose.wire == wire and pose.number in COUNTED])) for name in PEERS}


@cache
def find() -> Found:
    """Identify the wires and predict the poses: some 700 runs."""
    loops = {wire.name: tuple(wires.fit_loop(wire, k) for k in range(5)) for wire in WIRES}
    twists, poses = {}, []
    for wire in WIRES[:2]:
        fits = loops[wire.name]
        bending = float(np.mean([fit["bendingStiffness"].value for fit in fits]))
        angles = [start + np.mean([fit[f"start.{end}Frame.z"].value for fit in fits])
                  for start, end in ((0.2, "proximal"), (-0.2, "distal"))]
        twists[wire.name] = wires.fit_twist(wire, bending, (angles[0], angles[1]))
        poses += [_pose(wire, k, bending, twists[wire.name]["torsionalStiffness"].value) for k in range(4)]
    return Found(loops, twists, tuple(poses))


def _pose(wire: Wire, number: int, bending: float, torsion: float) -> Pose:
    nodes = wires.predict(wire, number, bending, torsion)
    off, measured, _ = wires.miss(wire, number, nodes)
    peers = {name: 1e3 * wires.miss(wire, number, wires.peer_of(wire, number, name))[0] for name in PEERS}
    return Pose(wire.name, number, 1e3 * off, peers, wires.measured_length(wire, number), measured, nodes)


@styled
def draw(found: Found) -> tuple[Figure, str]:
    """Return a row of loops and, for each wire of the poses, a row of these; and the caption."""
    figure = new_figure(13.0, 11.5)
    rows = figure.subplots(3, 4)
    rows[0, 3].set_axis_off()
    for k, (wire, axes) in enumerate(zip(WIRES, rows[0])):
        fit = found.loops[wire.name][0].residuals[0]
        axes.plot(*(1e-3 * fit.curves[0]).T, "C0-", label="computed")
        axes.plot(*(1e-3 * fit.points[0]).T, "k.", markersize=3, label="photograph")
        axes.set_aspect("equal", adjustable="datalim")
        axes.invert_yaxis()
        axes.set(xlabel="x (m)", ylabel="y (m)")
        letter(axes, "abc"[k], f"{wire.name}: EI = {1e5 * np.mean(found.bending(wire.name)):.3g}e-5 N m²")
    for pose in found.poses:
        row = 1 + [wire.name for wire in WIRES].index(pose.wire)
        axes = rows[row, pose.number]
        across = np.sort(np.argsort(np.ptp(pose.predicted, axis=0))[-2:])
        axes.plot(*pose.predicted[:, across].T, "C0-", label="predicted")
        axes.plot(*pose.measured[:, across].T, "ko", fillstyle="none", markersize=4, label="camera")
        axes.set_aspect("equal", adjustable="datalim")
        axes.set(xlabel=f"{'xyz'[across[0]]} (m)", ylabel=f"{'xyz'[across[1]]} (m)")
        counted = "" if pose.number in COUNTED else "*"
        letter(axes, "defghijk"[4 * (row - 1) + pose.number], f"{pose.wire} {pose.number}: {pose.miss:.1f} mm{counted}")
    told = [f"{name} {found.mean_miss(name):.1f} mm (the authors' rods {found.peers(name)['adapt']:.1f}, "
            f"MuJoCo's cable {found.peers(name)['native']:.1f})" for name in ("white", "black")]
    caption = ("Loops of 1.5 m with the wire found, and poses of 0.4 m with the wire predicted from them. Mean "
               f"distance over poses 0 to 2: {', '.join(told)}.")
    caption += " * comes near contact with itself, not counted."
    add_caption(figure, caption)
    return figure, caption


def as_markdown(found: Found) -> str:
    """Return the tables of docs/measured.md."""
    lines = ["| wire | EI of five digitisations, 1e-5 N m² | mean | spread | standard error | RMS, mm |",
             "|---|---|---|---|---|---|"]
    for name, fits in found.loops.items():
        bending = found.bending(name)
        errors = [fit["bendingStiffness"].error / fit["bendingStiffness"].value for fit in fits]
        lines.append(f"| {name} | {', '.join(f'{1e5 * value:.3g}' for value in bending)} | "
                     f"{1e5 * np.mean(bending):.3g} | {100 * np.std(bending, ddof=1) / np.mean(bending):.1f} % | "
                     f"{100 * np.mean(errors):.1f} % | {np.mean([fit.rms[0] for fit in fits]):.1f} |")
    lines += ["", "| wire | GJ, 1e-5 N m² | standard error |", "|---|---|---|"]
    for name, fit in found.twists.items():
        one = fit["torsionalStiffness"]
        lines.append(f"| {name} | {1e5 * one.value:.3g} | {100 * one.error / one.value:.1f} % |")
    lines += ["", "| pose | predicted, mm | " + " | ".join(f"{text}, mm" for text in PEERS.values())
              + " | camera's length of 400 mm, mm |", "|---|---|---|---|---|"]
    for pose in found.poses:
        counted = "" if pose.number in COUNTED else " (not counted)"
        lines.append(f"| {pose.wire} {pose.number}{counted} | {pose.miss:.2f} | "
                     + " | ".join(f"{pose.peers[name]:.2f}" for name in PEERS) + f" | {1e3 * pose.length:.0f} |")
    for name in found.twists:
        lines.append(f"| {name}, mean of 0 to 2 | {found.mean_miss(name):.2f} | "
                     + " | ".join(f"{value:.2f}" for value in found.peers(name).values()) + " | |")
    return "\n".join(lines) + "\n"


def write_table(path: Path) -> None:
    """The tables, into a file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(as_markdown(find()), encoding="utf-8")

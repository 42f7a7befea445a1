"""A run's wire and catheters as curves over time, along their true path through the catheters' tips."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from guidewire.export.frame import Frame
from guidewire.logs.paths import lengths_of, through_tips
from guidewire.viewer.recording import Recording


@dataclass(frozen=True)
class Curve:
    """One instrument at k moments.

    Attributes
    ----------
    name : of its files.
    title : for people.
    points : of each moment ndarray (n, 3), in the frame of the export; n differs where a wire bends at a tip.
    radii : of each moment (n,), in its unit.
    arrays : by name, of each moment (n,) or (n, 3).
    """

    name: str
    title: str
    points: list[np.ndarray]
    radii: list[np.ndarray]
    arrays: Mapping[str, list[np.ndarray]] = field(default_factory=dict)


def curves_of(recording: Recording, described: Mapping[str, Any], frame: Frame) -> list[Curve]:
    """Return the wire first. Arrays: Radius (mm), Curvature (1/m), and where the log has them ContactForce (N) and
    InSheath (1 or 0).

    described : as of `Session.describe`.
    """
    channels = {channel.name: channel.values for channel in recording.channels}
    count = len(described["instruments"])
    nodes = [channels["positions" + (str(k) if k else "")] for k in range(count)]
    nodes = [values.reshape(len(values), -1, 3) for values in nodes]
    curves = []
    for k, instrument in enumerate(described["instruments"]):
        radii = frame.scale * _at_nodes(np.array(instrument["radii"]))
        arrays: dict[str, np.ndarray] = {"Radius": np.broadcast_to(radii, nodes[k].shape[:2])}
        if k == 0:
            arrays["Curvature"] = channels["curvature"]
            if "inBody" in channels:
                out = np.arange(nodes[0].shape[1] - 1, -1, -1) < channels["inBody"]
                arrays["InSheath"] = 1.0 - out
        force = "contactForces" + (str(k) if k else "")
        if force in channels:
            arrays["ContactForce"] = frame.vectors(channels[force].reshape(*nodes[k].shape[:2], 3))
        # The wire is in all catheters; of these the outermost is first.
        around = nodes[1:] if k == 0 else nodes[1:k]
        name = "wire" if k == 0 else f"catheter-{k}"
        curves.append(_through(name, str(instrument["title"]), nodes[k], around, arrays, frame))
    return curves


def _through(name: str, title: str, nodes: np.ndarray, around: Sequence[np.ndarray], arrays: Mapping[str, np.ndarray],
             frame: Frame) -> Curve:
    lengths = lengths_of(nodes)
    points, rows = [], {key: [] for key in arrays}
    for moment, own in enumerate(nodes):
        path, of_pieces = through_tips(own, [catheter[moment] for catheter in around], lengths)
        points.append(frame.points(path))
        for key, values in arrays.items():
            rows[key].append(_with_tips(values[moment], of_pieces))
    return Curve(name, title, points, rows["Radius"], rows)


def _with_tips(values: np.ndarray, of_pieces: np.ndarray) -> np.ndarray:
    """Values of nodes, with the mean of both ends of an element where it is cut."""
    at = np.flatnonzero(np.diff(of_pieces) == 0) + 1    # of the path; a node before it is of the element's
    for place in at:
        values = np.insert(values, place, 0.5 * (values[place - 1] + values[min(place, len(values) - 1)]), axis=0)
    return values


def _at_nodes(of_elements: np.ndarray) -> np.ndarray:
    """Return (n+1,): means of the elements (n,) beside each node."""
    padded = np.pad(of_elements, 1, mode="edge")
    return 0.5 * (padded[:-1] + padded[1:])

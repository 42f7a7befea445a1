"""The modes that the runner prints are drawn, one panel each."""

from __future__ import annotations

import json
import subprocess

import numpy as np
import pytest

from analysis.figures.modes import draw_modes

_WIRE = {"solver": "direct", "metresPerUnit": 1.0, "guidewireLength": 0.3, "numberRodElements": 40,
         "guidewireOffset": 0.0, "proximalEnd": "clamped"}


def test_the_figure_has_a_panel_a_mode():
    positions = np.zeros((5, 3))
    positions[:, 2] = np.arange(5)
    shapes = np.ones((4, 5, 3))
    figure = draw_modes([1.0, 2.0, 3.0, 4.5], positions, shapes)
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["1: 1 Hz", "2: 2 Hz", "3: 3 Hz", "4: 4.5 Hz"]


def test_the_runner_prints_the_beams_frequencies(runner_command, tmp_path):
    file = tmp_path / "wire.json"
    file.write_text(json.dumps(_WIRE))
    done = subprocess.run([*runner_command, "--modes", str(file), "4"], capture_output=True, text=True, check=True)
    modes = json.loads(done.stdout)
    radius, young, density = 0.5e-3, 60e9, 6450.0
    unit = 0.5 * radius * (young / density) ** 0.5 / 0.3**2 / (2.0 * np.pi)  # sqrt(EI/(rho A))/L^2
    roots = np.array([1.8751040687, 1.8751040687, 4.6940911330, 4.6940911330])
    assert modes["frequencies"] == pytest.approx(roots**2 * unit, rel=1e-3)
    assert np.shape(modes["shapes"]) == (4, 41, 3)


def test_gains_are_refused(runner_command, tmp_path):
    file = tmp_path / "wire.json"
    file.write_text("{}")
    done = subprocess.run([*runner_command, "--modes", str(file), "4"], capture_output=True, text=True)
    assert done.returncode == 2 and "solver" in done.stderr and done.stderr.count("\n") == 1

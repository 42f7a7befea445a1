"""The modes that the runner prints are drawn, one panel each."""

from __future__ import annotations

import json
import subprocess

import numpy as np
import pytest

from guidewire.figures.modes import draw_modes

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


@pytest.mark.parametrize("changes, said", [
    ({"vessel": {"shape": "plane", "point": [0, -1, 0], "normal": [0, 1, 0]}}, "vessel needs to be null"),
    ({"obstacles": [{"shape": "sphere", "centre": [9, 0, 0], "radius": 1}]}, "obstacles needs to be null"),
    ({"proximalEnd": "free"}, 'proximalEnd or distalEnd needs to be "clamped"'),
])
@pytest.mark.few(1)
def test_what_has_no_modes_is_refused_by_a_key_that_stands_in_the_file(runner_command, tmp_path, changes, said):
    file = tmp_path / "wire.json"
    file.write_text(json.dumps({**_WIRE, **changes}))
    done = subprocess.run([*runner_command, "--modes", str(file), "4"], capture_output=True, text=True)
    assert done.returncode == 2 and said in done.stderr and "initialState" not in done.stderr
    assert done.stderr.startswith(f"guidewire: {file}: ") and done.stderr.count("\n") == 1

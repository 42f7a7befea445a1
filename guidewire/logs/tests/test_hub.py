"""Logs with what is read off at the hub are read whole and drawn."""

from __future__ import annotations

import numpy as np
import pytest

from analysis.tests.chain import write_log
from guidewire.figures.hub import draw_hub
from guidewire.logs.hub import read_hub
from guidewire.logs.logs import LogError

ENTRIES = 5


def _write(folder, with_hub=True):
    hubs = [{"hub": {"insertion": 1e-3 * k, "turn": 0.2 * k, "force": 0.5, "torque": -1e-3 * k, "twist": -0.1 * k,
                     "tipDirection": {"x": 0.0, "y": 0.6, "z": 0.8}, "largestCurvature": 20.0}} for k in range(ENTRIES)]
    write_log(folder, [[(0.0, 1.0 * i, 2.0 * k) for i in range(11)] for k in range(ENTRIES)], 0.1,
              hubs if with_hub else ())


def test_every_entry_is_read_and_drawn(tmp_path):
    _write(tmp_path)
    log = read_hub(tmp_path)
    assert log.insertion == pytest.approx(1e-3 * np.arange(ENTRIES))
    assert log.tip[3] == pytest.approx([0.0, 10.0, 6.0])  # the last sphere by number, not by its name's letters
    assert log.tip_direction.shape == (ENTRIES, 3)
    figure = draw_hub(log)
    assert len(figure.axes) == 6 and all(line.get_xdata().size == ENTRIES for a in figure.axes for line in a.lines)
    turned = figure.axes[1].lines
    assert turned[0].get_ydata()[-1] == pytest.approx(np.degrees(0.8))
    assert turned[1].get_ydata()[-1] == pytest.approx(np.degrees(0.4))
    assert "force at the hub (N)" in {axes.get_ylabel() for axes in figure.axes}


def test_a_log_that_says_nothing_of_the_hub_is_refused(tmp_path):
    _write(tmp_path, with_hub=False)
    with pytest.raises(LogError, match="logHub"):
        read_hub(tmp_path)

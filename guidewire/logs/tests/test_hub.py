"""Logs with what is read off at the hub are read whole and drawn."""

from __future__ import annotations

import numpy as np
import pytest

from analysis.tests.chain import write_log
from guidewire.figures.hub import draw_hub, draw_hubs
from guidewire.logs.hub import read_hub, read_hub_curve
from guidewire.logs.logs import LogError

ENTRIES = 5


def _write(folder, with_hub=True, force=0.5, entries=ENTRIES):
    hubs = [{"hub": {"insertion": 1e-3 * k, "turn": 0.2 * k, "force": force, "torque": -1e-3 * k, "twist": -0.1 * k,
                     "tipDirection": {"x": 0.0, "y": 0.6, "z": 0.8}, "largestCurvature": 20.0}} for k in range(entries)]
    write_log(folder, [[(0.0, 1.0 * i, 2.0 * k) for i in range(11)] for k in range(entries)], 0.1,
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


def test_runs_are_drawn_together_with_the_band_of_their_checks(tmp_path):
    for folder, force in (("one", 0.5), ("one/check/half", 0.7), ("one/check/twice", 0.4), ("other", 1.0)):
        (tmp_path / folder).mkdir(parents=True)
        _write(tmp_path / folder, force=force)
        (tmp_path / folder / "summary.json").write_text("{}")
    curves = [read_hub_curve(tmp_path / name) for name in ("one", "other")]
    assert curves[0].band("force") == pytest.approx(np.array([[0.4] * ENTRIES, [0.7] * ENTRIES]))
    assert curves[1].others == ()
    figure = draw_hubs(curves, "insertion")
    force = figure.axes[0]
    assert [line.get_label() for line in force.lines if len(line.get_xdata()) > 1] == ["one", "other"]
    assert force.lines[0].get_xdata() == pytest.approx(np.arange(ENTRIES))    # mm
    assert len(force.collections) == 1    # the band
    assert any("in the first step" in text.get_text() for text in figure.texts)


def test_the_runs_of_a_study_are_one_band(tmp_path):
    (tmp_path / "runs.csv").write_text("")
    with pytest.raises(LogError, match="--logs"):
        read_hub_curve(tmp_path)
    for folder, force, entries in (("a", 0.5, ENTRIES), ("b", 0.7, ENTRIES), ("c", 0.9, 3)):
        (tmp_path / folder).mkdir()
        _write(tmp_path / folder, force=force, entries=entries)
        (tmp_path / folder / "summary.json").write_text("{}")
    band = read_hub_curve(tmp_path).band("force")
    assert band[:, 2] == pytest.approx([0.5, 0.9]) and band[:, 3] == pytest.approx([0.5, 0.7]), "the third has ended"

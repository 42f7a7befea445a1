"""Instruments by name: their bench tests give back what their files state, and each runs through a vessel.

By default a seeded fraction of the instruments; GUIDEWIRE_ALL=1 takes all of them.
"""

from __future__ import annotations

import json
import math
import random

import numpy as np
import pytest

from guidewire.benches import benches, bent_tube, elastica
from guidewire.benches.figure import draw_instrument
from guidewire.benches.library import FOLDER, files, read_stated
from guidewire.benches.wire import Wire, wire_of
from guidewire.commands import instruments, sheet
from guidewire.logs.logs import LogError, read_entries, read_log
from guidewire.prepare import ROOT, PreparationError
from guidewire.runs.runner import Request, Runner
from guidewire.runs.tests.parameter_strategies import FULL

NAMES = sorted(files())
STIFFEST = "lunderquist-extra-stiff-0.035"
BASES = {"measured", "derived", "assumed"}


def some(count, *always):
    """Some instruments, always the same ones, or all of them."""
    if FULL:
        return NAMES
    return [*always, *random.Random(30).sample([name for name in NAMES if name not in always], count)]


@pytest.fixture(scope="module")
def bench(runner_command, tmp_path_factory):
    with instruments.opened(runner_command) as bench:
        yield bench


def linear_wire(m, steps=80):
    """A wire whose EI falls linearly, EI0 (1 - m x) with x from -1 to 1 over a span, in short uniform pieces."""
    span, stiffness, radius = 53.34e-3, 1e-3, 0.4445e-3
    edges = np.linspace(0.0, 1.4 * span, steps + 1)
    middle = 0.5 * (edges[1:] + edges[:-1])
    values = stiffness * np.maximum(1.0 + m * (0.7 * span - middle) / (0.5 * span), 0.5 * (1.0 - m))  # beyond: loose
    sections = [{"from": 1e3 * a, "to": 1e3 * b, "bendingStiffness1": ei, "bendingStiffness2": ei,
                 "torsionalStiffness": ei, "restCurvature": [0.0, 0.0, 0.0]}
                for a, b, ei in zip(edges, edges[1:], values)]
    parameters = {"guidewireLength": 1.4e3 * span, "wireRadius": radius, "innerRadius": 0.0, "shearFactor": 0.9,
                  "bendingStiffness": stiffness, "torsionalStiffness": stiffness, "density": 7900.0,
                  "wireSections": sections}
    return wire_of(parameters), 0.2 * span, stiffness


def taper_factor(m: float) -> float:
    """Compliance of a beam with EI = EI0 (1 + m x) under a force in its middle, over that of EI0; x from -1 to 1.

    (3/2) times the integral of (1 - |x|)^2/(1 + m x): 1 + m^2/10 for small m.
    """
    x, weights = np.polynomial.legendre.leggauss(40)
    x, weights = 0.5 * (x + 1.0), 0.5 * weights
    return float(1.5 * np.sum(weights * (1.0 - x) ** 2 * (1.0 / (1.0 + m * x) + 1.0 / (1.0 - m * x))))


def test_every_number_has_a_basis_and_a_source():
    for file in files().values():
        stated = read_stated(file)
        assert {"diameter", "length", "torsionalRatio", "density", "friction", "tip"} <= {item.what for item in stated}
        for item in stated:
            assert item.value and item.basis in BASES and len(item.source) > 9, (file.name, item)


@pytest.mark.parametrize("name", some(3, "catheter-guide-6f"))
def test_bench_tests_give_back_stiffness_and_tip_load_within_1_percent(bench, name):
    wire = bench.wire(name)
    lines = list(bench.stiffness(wire))
    assert {line.test.split(",")[0].split(" at")[0] for line in lines} == {
        "three-point bending", "torque test", "tip load"}
    for line in lines:
        assert abs(line.error) <= 0.01, line
    assert lines[0].expected == pytest.approx(wire.bending[0], rel=1e-9)


def test_a_taper_changes_the_compliance_by_1_plus_m_squared_over_10(bench):
    uniform, start, stiffness = linear_wire(0.0)
    straight = benches.read_three_point(bench.make(benches.three_point(uniform, start))).stiffness
    assert straight == pytest.approx(stiffness, rel=2e-3)
    for m in (0.3, 0.6, 0.9) if FULL else (0.6,):
        wire, start, _ = linear_wire(m)
        ratio = straight / benches.read_three_point(bench.make(benches.three_point(wire, start))).stiffness
        assert ratio == pytest.approx(taper_factor(m), rel=3e-3)
        # The next terms of the series are m^4/35 + m^6/84 + ..., at most m^4/35/(1 - m^2).
        assert 0.0 <= taper_factor(m) - (1.0 + m**2 / 10.0) <= m**4 / 35.0 / (1.0 - m**2)


def test_the_boundary_value_problem_has_the_cantilevers_stiffness_where_it_is_small():
    wire, _, stiffness = linear_wire(0.0, steps=4)
    gauge, deflection = 0.05, 1e-5
    shear = 2.0 * 0.9 * stiffness / wire.radius**2
    expected = deflection / (gauge**3 / (3.0 * stiffness) + gauge / shear)
    assert elastica.load_at(wire, gauge, deflection) == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("name", some(1, STIFFEST))
def test_every_instrument_runs_through_the_vessel_without_a_passage(live, tmp_path, name):
    steps = 240 if FULL else 60
    answer = live.run(Request(name, ROOT / "params" / "sheath.json", tmp_path / "run",
                              {"instrument": name, "maxSimulationSteps": steps}))
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert (answer.exit_code, summary["outcome"], summary["passages"]) == (0, "finished", 0)
    # The two stiffest fold their soft tip at the fork.
    assert all("would have kinked" in warning for warning in summary["warnings"])
    assert summary["reliable"] == (not summary["warnings"])
    # 20 mm/s for 0.05 s a step: the hub has been where the drive wanted it, and the tip has moved on in the vessel.
    assert summary["hub"]["insertion"] == pytest.approx(1e-3 * steps, abs=1e-4)
    assert summary["hub"]["lengthInBody"] > 0.9e-3 * steps


def test_a_straight_tip_follows_the_hub_exactly_without_friction_and_lags_by_the_walls_couple(bench, tmp_path):
    wire = bench.wire(STIFFEST)
    drive = tmp_path / "drive.csv"
    bent_tube.write_drive(drive)
    linear = bent_tube.read_tube(bench.make({**bent_tube.bent_tube(wire, drive, 0.0), "material": "linear"}))
    assert linear.response == pytest.approx(1.0, abs=1e-4) and linear.passages == 0
    smooth = bench.tube(wire, 0.0)    # its core yields in the bend, and resists to be turned there
    assert 0.99 < smooth.response < linear.response and smooth.passages == 0
    folder = bench.make({**bent_tube.bent_tube(wire, drive, None), "material": "linear"})
    rough = bent_tube.read_tube(folder)
    *_, (_, entry) = read_entries(folder)
    forces = np.array([[force[axis] for axis in "xyz"] for force in entry["contact"]["sphere"].values()])
    friction = 0.075
    normal = np.linalg.norm(forces, axis=1).sum() / math.hypot(1.0, friction)
    assert rough.hub.torque[-1] == pytest.approx(friction * wire.radius * normal, rel=0.02)
    assert rough.force > 1.1 * linear.force and rough.response < linear.response and rough.passages == 0
    figure = draw_instrument(STIFFEST, wire, rough, smooth)
    assert [axes.get_xlabel() for axes in figure.axes] == [
        "$z$ (mm)", "distance from the tip (mm)", "insertion (mm)", "turn of the hub (degrees)"]
    assert [len(axes.lines) for axes in figure.axes] == [1, 2, 2, 2]


@pytest.mark.parametrize("changes", [{"outcome": "diverged"}, {"outcome": "failed"}, {"reliable": False}])
def test_a_bench_that_does_not_end_well_gives_no_figure(bench, changes):
    wire = bench.wire("workhorse-0.014")
    folder = bench.make(benches.tip_load(wire, 0.02, 1e-3))
    assert benches.read_tip(folder).shape == (2,)
    summary = folder / "summary.json"
    summary.write_text(json.dumps({**json.loads(summary.read_text()), **changes}))
    with pytest.raises(LogError, match="the bench test is"):
        benches.read_tip(folder)


def test_an_unknown_name_is_one_line_with_the_nearest(bench):
    with pytest.raises(PreparationError, match='did you mean "amplatz-stiff-0.035"') as error:
        bench.wire("amplatz-stif-0.035")
    assert "\n" not in str(error.value)


def test_the_table_has_a_line_for_each_instrument(bench):
    lines = instruments.table(bench)
    assert [line.split()[0] for line in lines[1:-1]] == NAMES
    assert len(NAMES) >= 16 and isinstance(bench.wire(NAMES[0]), Wire)


def test_a_data_sheet_makes_an_instrument_whose_tip_buckles_at_its_load(runner_command, tmp_path, monkeypatch, capsys):
    """The last 10 mm, clamped at one end, under a thrust P at the other: a small force across is amplified by
    tan(u)/u - 1 over u^2/3 with u = pi/2 sqrt(P/P_cr), whatever EI is (Timoshenko, Theory of Elastic Stability)."""
    monkeypatch.chdir(tmp_path)
    with instruments.opened(runner_command) as bench:
        sheet.write(bench.wire, "mine", "bentson-0.035", [("tipLoad", "2"), ("tipLength", "3cm")])
        wire = bench.wire("mine")
        (line,) = sheet.derived_lines(tmp_path / FOLDER / "mine.json", wire)
        assert "7.95e-07 N m2" in line and "from 5.38e-07 to 1.1e-06" in line and "9.72e-08" in line
        tip = {"solver": "direct", "proximalEnd": "clamped", "guidewireLength": 10.0, "numberRodElements": 40,
               "bendingStiffness": float(wire.bending[-1]), "torsionalStiffness": 1e-6, "wireRadius": wire.radius,
               "density": 7900.0, "initialState": "equilibrium", "maxSimulationSteps": 0}
        across, load = 1e-7, 2 * 9.80665e-3

        def deflection(part):
            folder = bench.make({**tip, "tipForce": [0.0, across, -part * load]})
            return read_log(folder).positions[-1, 0, 1]

        u = 0.5 * math.pi * math.sqrt(0.8)
        assert deflection(0.8) / deflection(0.0) == pytest.approx((math.tan(u) / u - 1.0) / (u * u / 3.0), rel=0.01)
        before = set(files())
        for members, said in (([("tipLoad", "two")], "such as \"2 g\""),
                              ([("tipload", "2")], "unknown member 'tipload'")):
            with pytest.raises(PreparationError, match=said):
                sheet.write(bench.wire, "other", "bentson-0.035", members)
        with pytest.raises(PreparationError, match="is there already"):
            sheet.write(bench.wire, "mine", "bentson-0.035", [])
        assert set(files()) == before
    # By its name with a parameter file of another folder, too.
    (tmp_path / "scenes").mkdir()
    (tmp_path / "scenes" / "scene.json").write_text('{"solver": "direct", "instrument": "mine"}')
    runner = Runner(runner_command, tmp_path)
    answer = runner.run(Request("a", tmp_path / "scenes" / "scene.json", tmp_path / "out", {"maxSimulationSteps": 0}))
    runner.close()
    assert answer.exit_code == 0, answer.message


def test_a_data_sheet_replaces_the_stiffness_of_the_shaft(runner_command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with instruments.opened(runner_command) as bench:
        sheet.write(bench.wire, "core", "amplatz-0.035", [("coreDiameter", "0.50 mm"), ("coreModulus", "60 GPa")])
        core = bench.wire("core")
        assert core.bending[0] == pytest.approx(60e9 * math.pi * 0.5e-3**4 / 64.0)
        sheet.write(bench.wire, "rail", "core", [("supportForce", "1.20 N"), ("supportForce.span", "50 mm"),
                                            ("supportForce.deflection", "5.0mm"), ("material", "linear")])
        rail = bench.wire("rail")
        assert rail.bending[0] == pytest.approx(1.2 * 0.05**3 / (48.0 * 0.005))
        assert rail.bending[-1] == core.bending[-1] == bench.wire("amplatz-0.035").bending[-1]
        (line,) = sheet.derived_lines(tmp_path / FOLDER / "rail.json", rail)
        low, high = (float(line.partition(word)[2].split()[0]) for word in ("from", " to"))
        assert low == pytest.approx(0.000625 * (1 - 0.005 / 1.2) * 0.99**3 / 1.01, rel=1e-2)
        assert high == pytest.approx(0.000625 * (1 + 0.005 / 1.2) * 1.01**3 / 0.99, rel=1e-2)

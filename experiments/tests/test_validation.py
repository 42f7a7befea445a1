"""The fast checks of the material rod, on the real runner; and how checks are driven."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from analysis.validation.check import Case, Check, Finding, Result, replay
from analysis.validation.report import FAST, Report, as_csv, as_markdown
from experiments import checking


@pytest.fixture(scope="module")
def fast_report(tmp_path_factory: pytest.TempPathFactory, runner_command: list[str]) -> Report:
    done = checking.run_checks(
        "validation", FAST, runner_command, tmp_path_factory.mktemp("validation"), 2, lambda *_: None
    )
    assert done.failures == []
    return Report({check: replay(check, done.folder) for check in FAST})


@pytest.mark.parametrize("check", FAST, ids=lambda check: check.id)
def test_direct_solver_keeps_its_gates(fast_report: Report, check: Check) -> None:
    results = fast_report.findings[check].results
    assert any(result.gate is not None for result in results) or all(result.reason for result in results)
    assert [result for result in results if result.passed is False] == []


def test_report_has_a_line_for_every_result(fast_report: Report) -> None:
    lines = as_csv(fast_report).splitlines()
    assert len(lines) == 1 + len(fast_report.results)
    text = as_markdown(fast_report)
    passed, failed, shown, silent = fast_report.counts
    assert failed == 0 and f"{passed} lines passed, 0 failed, {shown} have no gate" in text
    reasons = [result.reason for _, result in fast_report.results if result.reason]
    assert len(reasons) == silent and all(f": {reason} |" in text for reason in reasons)
    assert all(f"![{check.title}]" in text for check in FAST)


def _adaptive():
    """Asks for a second run whose number of elements follows from the first."""
    runs = yield [Case("first", {"numberRodElements": 4})]
    n = int(runs["first"].number("numberRodElements"))
    runs = yield [Case("second", {"numberRodElements": 2 * n}, repeats=2)]
    value = runs["second"].number("numberRodElements")
    return Finding((Result("elements", "direct", value, 8.0, abs(value - 8.0), 0.0),), lambda figure: None, "")


def test_later_cases_follow_from_earlier_runs(tmp_path: Path, runner_command: list[str]) -> None:
    check = Check("adaptive", "Test", "adaptive", _adaptive)
    asked = []
    done = checking.run_checks("v", [check], runner_command, tmp_path, 1, lambda *_: asked.append(1))
    assert len(asked) == 4 and done.failures == []
    assert replay(check, done.folder).results[0].passed


def _wrong():
    yield [Case("wrong", {"numberRodElements": -1})]
    raise AssertionError("goes on after a run without a result")


def test_check_whose_run_has_no_result_is_dropped_and_told(tmp_path: Path, runner_command: list[str]) -> None:
    done = checking.run_checks("v", [Check("wrong", "Test", "wrong", _wrong)], runner_command, tmp_path, 1,
                               lambda *_: None)
    (failure,) = done.failures
    assert failure.exit_code == 2 and "numberRodElements" in failure.message


def test_error_that_is_no_number_does_not_pass() -> None:
    assert Result("", "", math.nan, 1.0, math.nan, 0.1).passed is False
    assert Result("", "", 1.0, 1.0, 0.0, None).passed is None

"""The sum of all tests is what the runners wrote, and a runner that did not run is a failure."""

import os
import subprocess
import sys

import pytest

from experiments import testing
from experiments.testing import Count, Suite, read_junit, read_last_line, read_trx, run_suite


@pytest.fixture(autouse=True)
def results_in_a_folder_of_their_own(tmp_path, monkeypatch):
    monkeypatch.setattr(testing, "RESULTS", tmp_path)


def writing(text, code=0):
    """A suite whose runner writes the text into report.txt and ends with the code."""
    script = f"import sys, pathlib; pathlib.Path(sys.argv[1]).write_text({text!r}); sys.exit({code})"
    return Suite("a suite", [sys.executable, "-c", script, str(testing.RESULTS / "report.txt")], "report.txt",
                 read_last_line)


@pytest.mark.parametrize("text, code, expected", [
    ("3 passed, 0 failed", 0, Count(3, 0)),
    ("noise\n3 passed, 1 failed, 2 skipped\n", 1, Count(3, 1, 2)),
    ("3 passed, 0 failed", 1, Count(3, 1)),
    ("0 passed, 0 failed", 0, Count(0, 1)),
    ("0 passed, 0 failed, 4 skipped", 0, Count(0, 1, 4)),
    ("3 passed, 0 failed\nthen it crashed", 0, Count(0, 1)),
    ("", 0, Count(0, 1)),
])
def test_a_suite_counts_what_its_report_says_and_fails_without_one(text, code, expected, capsys):
    assert run_suite(writing(text, code), os.environ, 60) == expected


def test_a_report_of_an_earlier_time_does_not_count(capsys):
    (testing.RESULTS / "report.txt").write_text("3 passed, 0 failed")
    suite = Suite("a suite", [sys.executable, "-c", "pass"], "report.txt", read_last_line)
    assert run_suite(suite, os.environ, 60) == Count(0, 1)


def test_a_suite_that_hangs_is_stopped_and_fails(capsys):
    suite = Suite("a suite", [sys.executable, "-c", "import time; time.sleep(60)"], "report.txt", read_last_line)
    assert run_suite(suite, os.environ, 0.5) == Count(0, 1)
    assert "stopped after" in capsys.readouterr().out


def test_junit_counts_agree_with_a_real_pytest(tmp_path):
    (tmp_path / "test_four.py").write_text(
        "import pytest\n"
        "def test_passes(): pass\n"
        "def test_fails(): assert False\n"
        "@pytest.mark.skip(reason='to see it counted')\ndef test_skipped(): pass\n"
        "def test_errs(nothing): pass\n"
    )
    subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--junitxml=junit.xml", "."],
                   cwd=tmp_path, stdout=subprocess.DEVNULL, check=False)
    assert read_junit(tmp_path / "junit.xml") == Count(1, 2, 1)


def test_trx_counts_whatever_did_not_pass_as_failed(tmp_path):
    (tmp_path / "a.trx").write_text(
        '<TestRun xmlns="urn:x"><ResultSummary><Counters total="9" executed="7" passed="4" failed="2" error="0"'
        ' timeout="1" aborted="0" inconclusive="0" notExecuted="2" /></ResultSummary></TestRun>'
    )
    assert read_trx(tmp_path / "a.trx") == Count(4, 3, 2)


def test_a_trx_without_counters_is_no_result(tmp_path):
    (tmp_path / "a.trx").write_text("<TestRun/>")
    with pytest.raises(ValueError):
        read_trx(tmp_path / "a.trx")

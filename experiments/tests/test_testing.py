"""The sum of all tests is what the runners wrote, and a runner that did not run is a failure."""

import os
import subprocess
import sys

import pytest

from experiments import testing
from experiments.testing import Count, Suite, check_unity_files, read_junit, read_trx, run_suite


@pytest.fixture(autouse=True)
def results_in_a_folder_of_their_own(tmp_path, monkeypatch):
    monkeypatch.setattr(testing, "RESULTS", tmp_path)


def junit(tests, failures=0, skipped=0):
    return f'<testsuites><testsuite tests="{tests}" failures="{failures}" errors="0" skipped="{skipped}"/></testsuites>'


def running(script, *arguments):
    return Suite("a suite", [sys.executable, "-c", script, *arguments], "report.xml", read_junit)


def writing(text, code=0):
    """A suite whose runner writes the text into its report and ends with the code."""
    script = f"import sys, pathlib; pathlib.Path(sys.argv[1]).write_text({text!r}); sys.exit({code})"
    return running(script, str(testing.RESULTS / "report.xml"))


@pytest.mark.parametrize("text, code, expected", [
    (junit(3), 0, Count(3, 0)),
    (junit(6, 1, 2), 1, Count(3, 1, 2)),
    (junit(3), 1, Count(3, 1)),
    (junit(0), 0, Count(0, 1)),
    (junit(4, 0, 4), 0, Count(0, 1, 4)),
    (junit(3)[:-5], 0, Count(0, 1)),
    ("", 0, Count(0, 1)),
])
def test_a_suite_counts_what_its_report_says_and_fails_without_one(text, code, expected, capsys):
    assert run_suite(writing(text, code), os.environ, 60) == expected


def test_a_report_of_an_earlier_time_does_not_count(capsys):
    (testing.RESULTS / "report.xml").write_text(junit(3))
    assert run_suite(running("pass"), os.environ, 60) == Count(0, 1)


def test_a_suite_that_hangs_is_stopped_and_fails(capsys):
    assert run_suite(running("import time; time.sleep(60)"), os.environ, 0.5) == Count(0, 1)
    assert "stopped after" in capsys.readouterr().out


def test_a_unity_check_that_breaks_off_is_a_failure(tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "unitycheck", None)
    assert check_unity_files(tmp_path).failed == 1
    assert "it broke off" in capsys.readouterr().out


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

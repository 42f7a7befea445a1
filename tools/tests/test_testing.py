"""The sum of all tests is what the runners wrote, and a runner that did not run is a failure."""

import argparse
import subprocess
import sys
import threading

import pytest

from guidewire.prepare import PreparationError
from tools import testing
from tools.testing import PYTEST, Count, read_trx, run


@pytest.fixture(autouse=True)
def results_in_a_folder_of_their_own(tmp_path, monkeypatch):
    monkeypatch.setattr(testing, "RESULTS", tmp_path / "results")
    for name in (testing.READY, testing.FULL_CAMPAIGNS, testing.DAY):    # `test` sets its own
        monkeypatch.delenv(name, raising=False)
    testing.RESULTS.mkdir()


@pytest.fixture
def file(tmp_path):
    """A file of tests that passes, fails, skips and errs once each."""
    file = tmp_path / "test_four.py"
    file.write_text("import pytest\n"
                    "def test_passes(): pass\n"
                    "def test_fails(): assert False, 'the words of a failure'\n"
                    "@pytest.mark.skip(reason='to see it counted')\ndef test_skipped(): pass\n"
                    "def test_errs(nothing): pass\n")
    return file


@pytest.mark.parametrize("words, expected, said", [
    ([], Count(1, 2, 1), "the words of a failure"),
    (["-n", "2", "--dist", "loadfile"], Count(1, 2, 1), "the words of a failure"),
    (["-k", "passes"], Count(1), ""),
    (["-k", "nothing"], Count(0, 1), "it reports no test"),
    (["-k", "skipped"], Count(0, 1, 1), "it reports no test"),
    (["--no-such-option"], Count(0, 1), "it left no result"),
])
@pytest.mark.few(3)
def test_counts_are_those_of_a_real_pytest(file, capsys, words, expected, said):
    assert run("some", [*PYTEST, str(file), *words], 60.0) == expected
    assert said in capsys.readouterr().out


def test_a_runner_that_hangs_or_is_stopped_is_a_failure(file, capsys):
    file.write_text("import time\ndef test_of_a_minute(): time.sleep(60)\n")
    assert run("hangs", [*PYTEST, str(file)], 2.0) == Count(0, 1)
    stop = threading.Event()
    stop.set()
    assert run("stopped", [*PYTEST, str(file)], 60.0, stop) == Count(0, 1)


def test_a_part_that_needs_the_runner_does_not_wait_for_a_build_that_nobody_makes(file, monkeypatch, capsys):
    monkeypatch.setattr(testing, "ROOT", file.parent)
    file.write_text("import os\ndef test_waits(): assert 'GUIDEWIRE_READY' not in os.environ\n")
    assert testing.test(argparse.Namespace(all=False, what=[str(file)])) == 0
    assert "1 passed, 0 failed" in capsys.readouterr().out


def test_a_runner_that_fails_after_its_tests_is_a_failure(file, capsys):
    file.write_text("import atexit, os\natexit.register(os._exit, 5)\ndef test_passes(): pass\n")
    assert run("ends", [*PYTEST, str(file)], 60.0) == Count(1, 1)
    assert "it ended with exit code 5" in capsys.readouterr().out


@pytest.mark.parametrize("counters, expected", [
    ('<Counters total="9" executed="7" passed="4" failed="2" error="0" timeout="1" notExecuted="2" />', Count(4, 3, 2)),
    ("", None),
])
def test_a_trx_counts_whatever_did_not_pass_as_failed(tmp_path, counters, expected):
    (tmp_path / "a.trx").write_text(f'<TestRun xmlns="urn:x"><ResultSummary>{counters}</ResultSummary></TestRun>')
    if expected is None:
        with pytest.raises(ValueError):
            read_trx(tmp_path / "a.trx")
    else:
        assert read_trx(tmp_path / "a.trx") == expected


def all_tests(monkeypatch, file, build, dotnet):
    """The exit code of `test`, with a build and a `dotnet test` of these and a file in place of all in Python."""
    monkeypatch.setattr(testing, "PYTHON", [str(file)])
    monkeypatch.setattr(testing.building, "build_tested", build)
    monkeypatch.setattr(testing.building, "build_native", lambda tell: None)
    monkeypatch.setattr(testing.building, "dotnet", lambda: (dotnet, ""))
    return testing.test(argparse.Namespace(all=False, what=[]))


@pytest.mark.parametrize("passed, last, code", [(True, "4 passed, 0 failed", 0), (False, "3 passed, 1 failed", 1)])
@pytest.mark.few(1)
def test_the_last_line_is_the_sum(monkeypatch, tmp_path, file, capsys, passed, last, code):
    file.write_text(f"def test_one(): assert {passed}\n")
    dotnet = tmp_path / "dotnet"
    dotnet.write_text('#!/bin/sh\n[ "$1" = test ] || exit 0\nfor word; do case $word in trx*) name=${word#*=};; '
                      'esac; done\n'
                      "echo '<T xmlns=\"x\"><Counters total=\"1\" executed=\"1\" passed=\"1\"/></T>' > "
                      f"{testing.RESULTS}/$name\n")
    dotnet.chmod(0o755)
    assert all_tests(monkeypatch, file, lambda tell: None, str(dotnet)) == code
    assert capsys.readouterr().out.splitlines()[-1] == last


def test_a_build_that_fails_ends_everything(monkeypatch, file, capsys):
    def build(tell):
        raise PreparationError("Rod.cs(1,1): error CS1002")

    file.write_text("import time\ndef test_of_a_minute(): time.sleep(60)\n")
    assert all_tests(monkeypatch, file, build, "true") == 1
    said = capsys.readouterr().out
    assert "error CS1002" in said and said.splitlines()[-1] == "0 passed, 2 failed"


def test_every_folder_with_tests_in_python_is_tested():
    listed = subprocess.run(["git", "ls-files", "*/test_*.py"], cwd=testing.ROOT, capture_output=True, text=True,
                            check=True)
    assert {path.split("/")[0] for path in listed.stdout.split()} <= set(testing.PYTHON)
    assert sys.executable in PYTEST

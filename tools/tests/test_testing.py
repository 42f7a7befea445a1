"""The sum of all tests is what the runners wrote, and a runner that did not run is a failure."""

import os
import re
import subprocess
import sys

import pytest

from tools import testing
from tools.testing import Count, Suite, read_junit, read_trx, run_suites, suites

BUILD = {"Runner": [sys.executable, "-c", ""], "Tests": [sys.executable, "-c", ""]}


@pytest.fixture(autouse=True)
def results_in_a_folder_of_their_own(tmp_path, monkeypatch):
    monkeypatch.setattr(testing, "RESULTS", tmp_path)


def run(*given, build=BUILD, seconds=60.0, places=2):
    return run_suites(build, given, os.environ, seconds, places)


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
    assert run(writing(text, code)) == expected


def test_a_report_of_an_earlier_time_does_not_count(capsys):
    (testing.RESULTS / "report.xml").write_text(junit(3))
    assert run(running("pass")) == Count(0, 1)


def test_a_suite_that_hangs_is_stopped_and_fails(capsys):
    assert run(running("import time; time.sleep(60)"), seconds=0.5) == Count(0, 1)
    assert "stopped after" in capsys.readouterr().out


def test_a_test_that_hangs_is_named_with_the_line_where_it_stands(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(testing, "_STUCK_SECONDS", 0.2)
    file = tmp_path / "test_stuck.py"
    file.write_text("import time\ndef test_of_a_minute():\n    time.sleep(60)\n")
    assert run(testing._pytest_suite("stuck", [str(file)], needs=""), seconds=3.0) == Count(0, 1)
    assert re.search(r'test_stuck.py", line 3 in test_of_a_minute', capsys.readouterr().out)


def noting(name, seconds=0.0, text=junit(1), **more):
    """A suite that notes when it began and ended, and lasts for a while between."""
    script = (
        "import sys, time; note = open(sys.argv[1], 'a'); print(sys.argv[2], 'begins', file=note, flush=True)\n"
        "time.sleep(float(sys.argv[3])); print(sys.argv[2], 'ends', file=note, flush=True)\n"
        "open(sys.argv[4], 'w').write(sys.argv[5]); print('the words of', sys.argv[2])"
    )
    command = [sys.executable, "-c", script, str(testing.RESULTS / "notes"), name, str(seconds),
               str(testing.RESULTS / name), text]
    return Suite(name, command, name, read_junit, **more)


def notes():
    return (testing.RESULTS / "notes").read_text().splitlines()


@pytest.mark.timed
def test_suites_run_side_by_side_and_their_counts_add_up(capsys):
    assert run(noting("a", 1.0), noting("b", 1.0), noting("c")) == Count(3, 0)
    assert {line.split()[1] for line in notes()[:2]} == {"begins"}
    run(noting("d", 0.2), noting("e", 0.2), places=1)
    assert notes()[6:] == ["d begins", "d ends", "e begins", "e ends"]


def test_a_suite_that_runs_alone_runs_last_with_nothing_beside_it(capsys):
    assert run(noting("alone", alone=True), noting("a", 0.5), noting("b", 0.1)) == Count(3, 0)
    assert notes()[4:] == ["alone begins", "alone ends"]


@pytest.mark.timed
def test_what_needs_the_build_waits_for_it_and_the_rest_does_not(capsys):
    build = {"Runner": noting("runner", 0.7).command, "Tests": noting("tests", 0.7).command}
    assert run(noting("a"), noting("b", needs=""), noting("c", needs="Runner"), build=build) == Count(3, 0)
    assert notes().index("b ends") < notes().index("runner ends") < notes().index("c begins")
    assert notes().index("c ends") < notes().index("tests ends") < notes().index("a begins")


def test_after_a_build_that_fails_each_suite_that_needs_it_counts_as_failed(capsys):
    build = {"Runner": BUILD["Runner"], "Tests": [sys.executable, "-c", "print('error CS1002'); raise SystemExit(1)"]}
    assert run(noting("a"), noting("b", needs="Runner"), noting("c", alone=True), build=build) == Count(1, 3)
    said = capsys.readouterr().out
    assert "build Tests: FAILED" in said and "error CS1002" in said and "a: not run" in said
    assert notes() == ["b begins", "b ends"]


def test_output_of_suites_side_by_side_does_not_mix(capsys):
    run(noting("a", 0.1, junit(1, 1)), noting("b", 0.1, junit(2, 1)))
    lines = capsys.readouterr().out.splitlines()
    for name in "ab":
        at = next(i for i, line in enumerate(lines) if line.startswith(f"{name}: "))
        assert lines[at + 1].endswith(f"{name}.log") and lines[at + 2:at + 4] == [f"the words of {name}", "---"]


def test_time_on_a_processor_is_that_of_the_suite_and_what_it_started(capsys):
    burn = "import time\nwhile time.process_time() < 0.55: pass"
    script = f"import subprocess, sys; subprocess.run([sys.executable, '-c', {burn!r}])"
    run(running(script))
    assert "processor 1 s" in capsys.readouterr().out


def test_the_build_that_unity_compiles_makes_tests_of_its_differences_and_every_other_suite_all():
    assert [suite.name for suite in suites("dotnet", False) if "--filter" in suite.command] \
        == list(testing.BY_TARGET) == ["Guidewire.Core.Tests, netstandard2.1"]
    assert not [suite.name for suite in suites("dotnet", True) if "--filter" in suite.command]


def test_every_python_test_file_is_in_one_suite_and_those_that_are_timed_in_the_last_too():
    python = [suite.command for suite in suites("dotnet", False) if "pytest" in suite.command]
    everything = [path for folder in testing.TESTED for path in (testing.ROOT / folder).rglob("test_*.py")]
    *commands, timed = [{path for path in everything if _takes(command, path)} for command in python]
    assert sorted(path for files in commands for path in files) == sorted(everything)
    assert timed == {path for path in everything if "pytest.mark.timed" in path.read_text(encoding="utf-8")} > set()


def _takes(command, path):
    """Whether a suite names this file or a folder around it, and leaves out none that is nearer."""
    def nearest(start):
        named = [testing.ROOT / word[len(start):] for word in command if word.startswith(start)]
        return max((len(str(place)) for place in named if place in (path, *path.parents)), default=0)

    return nearest("") > nearest("--ignore=")


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

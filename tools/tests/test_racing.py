"""Repeated tests: which files, what is printed, and that no busy program is left."""

from __future__ import annotations

import subprocess
import sys

import pytest

from tools import racing


def test_files_that_start_processes_are_found_and_others_not():
    found = racing.racing_files(["guidewire/runs", "tools", "guidewire/runs/tests/test_runner.py"])
    assert {"guidewire/runs/tests/test_runner.py", "tools/tests/test_testing.py"} <= set(found)
    assert "tools/tests/test_seeds.py" not in found and len(set(found)) == len(found)


def test_busy_programs_end_with_the_tests(monkeypatch):
    started = []

    class Noted(subprocess.Popen):
        def __init__(self, *words, **options):
            super().__init__(*words, **options)
            started.append(self)

    monkeypatch.setattr(racing.subprocess, "Popen", Noted)
    with pytest.raises(KeyboardInterrupt), racing.busy(2):
        assert len(started) == 2 and all(one.poll() is None for one in started)
        raise KeyboardInterrupt
    assert all(one.poll() is not None for one in started)


def test_a_repetition_that_fails_is_named_and_makes_the_exit_code(monkeypatch, tmp_path, capsys):
    (tmp_path / "test_luck.py").write_text(
        "import subprocess\nfrom pathlib import Path\n\n\ndef test_second_time():\n"
        f"    done = Path({str(tmp_path / 'done')!r})\n    was_there = done.exists()\n    done.touch()\n"
        "    assert not was_there, 'by luck'\n")
    monkeypatch.setattr(racing, "PYTEST", [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"])
    monkeypatch.setattr(racing, "ROOT", tmp_path)
    assert racing.main([str(tmp_path), "--times", "2", "--load", "0"]) == 1
    said = capsys.readouterr().out
    assert "1 of 2: 1 passed, 0 failed" in said and "2 of 2: 0 passed, 1 failed" in said and "by luck" in said
    assert said.endswith("1 files of tests that start processes: 1 of 2 repetitions failed\n")

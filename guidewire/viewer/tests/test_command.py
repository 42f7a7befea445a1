"""guidewire.py view: what cannot be shown, and what is not installed, is told in one line."""

import subprocess

import pytest

from guidewire.commands import commands
from guidewire.prepare import PreparationError
from guidewire.viewer import parts
from guidewire.viewer.command import view


@pytest.mark.parametrize("words, said", [
    (["nowhere.json"], "nowhere.json"), (["a", "b"], "one parameter file, or the folders"),
    (["--html", "a.html", "scene.json"], "--html"),
    (["--html", "a.txt", "."], "a page's name ends with .html"), (["."], "parameters.json"),
    (["--html", "/proc/no/a.html", "."], "/proc/no"),
])
def test_what_cannot_be_shown_is_one_line(tmp_path, monkeypatch, words, said):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.json").write_text("{}")
    monkeypatch.setattr("guidewire.viewer.command.three", lambda tell: {})
    with pytest.raises(PreparationError) as refused:
        arguments = commands.parse(["view", *words])
        arguments.action(arguments)
    assert said in str(refused.value) and "\n" not in str(refused.value)


def test_a_log_of_one_sphere_is_one_line(runner_command, tmp_path, monkeypatch):
    monkeypatch.setattr("guidewire.viewer.command.three", lambda tell: {})
    subprocess.run([*runner_command, "-out", str(tmp_path), "-logSpheres", "last", "-maxSimulationSteps", "1"],
                   check=True, capture_output=True)
    with pytest.raises(PreparationError, match="logSpheres"):
        view([tmp_path], tmp_path / "a.html", None, False, lambda: runner_command)


def test_without_npm_one_line_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setattr(parts, "CACHE", tmp_path / "cache")
    monkeypatch.setattr(parts.shutil, "which", lambda name: None)
    with pytest.raises(PreparationError, match="three@.*there is no npm: install Node.js") as refused:
        parts.three(print)
    assert "\n" not in str(refused.value) and not (tmp_path / "cache").exists()
    monkeypatch.setattr(parts.shutil, "which", lambda name: "/bin/false")
    with pytest.raises(PreparationError, match="npm could not install three@"):
        parts.three(lambda line: None)

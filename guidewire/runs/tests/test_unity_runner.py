"""Unity in place of the headless runner: which program, its arguments, when its run counts."""

from __future__ import annotations

import json
import stat
import sys
from contextlib import closing
from pathlib import Path

import pytest

from guidewire.commands import commands, making
from guidewire.prepare import PreparationError
from guidewire.runs import runner, unity_runner

FAKE = Path(__file__).with_name("fake_unity.py")
PARAMETERS = Path(__file__).resolve().parents[3] / "params" / "default.json"


def program(folder: Path, name: str) -> Path:
    """A fake Unity of this name, started by the Python that runs the tests."""
    path = folder / name
    path.write_text(f'#!/bin/sh\nexec "{sys.executable}" "{FAKE}" "$@"\n', encoding="utf-8")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path


@pytest.fixture
def player(tmp_path: Path) -> unity_runner.Unity:
    return unity_runner.find(str(program(tmp_path, "Guidewire.x86_64")), seconds=10.0)


def run(unity: unity_runner.Unity, tmp_path: Path, wish: int, **more: object) -> dict[str, object]:
    request = {"id": "a", "parameters": str(PARAMETERS), "set": {"displacement": wish}, "out": str(tmp_path / "run"),
               **more}
    return unity_runner.answer(unity, json.dumps(request))


def test_editor_is_given_its_project_and_method(tmp_path: Path) -> None:
    editor = unity_runner.find(str(program(tmp_path, "Unity")))
    command = editor.command(tmp_path / "log", ["-out", "x"])
    assert editor.is_editor
    assert command[command.index("-executeMethod") + 1] == unity_runner.ENTRY
    assert command[command.index("-projectPath") + 1] == str(unity_runner.ROOT)
    assert command[-3:] == ["-guidewire", "-out", "x"]
    assert "-quit" not in command and "-nographics" in command


def test_player_is_given_neither(player: unity_runner.Unity, tmp_path: Path) -> None:
    command = player.command(tmp_path / "log", [])
    assert not player.is_editor
    assert "-executeMethod" not in command and "-projectPath" not in command


def test_entry_exists() -> None:
    source = (unity_runner.ROOT / "Assets/Guidewire/Editor/PlayerBuild.cs").read_text(encoding="utf-8")
    assert "namespace Guidewire.Editor" in source and "static class BatchEntry" in source
    assert "public static void Run()" in source


def test_nothing_found_says_where_it_looked(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.delenv(unity_runner.VARIABLE, raising=False)
    monkeypatch.setattr(unity_runner, "ROOT", tmp_path)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(PreparationError, match="--unity, GUIDEWIRE_UNITY, Build/Linux") as problem:
        unity_runner.find(None)
    assert "\n" not in str(problem.value)


def test_environment_names_a_program_that_is_none(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv(unity_runner.VARIABLE, str(tmp_path / "nothing"))
    with pytest.raises(PreparationError, match="GUIDEWIRE_UNITY .*nothing: no program"):
        unity_runner.find(None)


def test_finished(player: unity_runner.Unity, tmp_path: Path) -> None:
    reply = run(player, tmp_path, 0)
    assert (reply["exitCode"], reply["outcome"]) == (0, "finished")
    assert (tmp_path / "run" / "unity.log").is_file()


def test_diverged(player: unity_runner.Unity, tmp_path: Path) -> None:
    reply = run(player, tmp_path, 4)
    assert (reply["exitCode"], reply["outcome"]) == (4, "diverged")


def test_refused_parameters_are_reported_in_their_own_line(player: unity_runner.Unity, tmp_path: Path) -> None:
    reply = run(player, tmp_path, 2)
    assert (reply["exitCode"], reply["outcome"]) == (2, None)
    assert "displacement = x is not allowed" in str(reply["message"])


@pytest.mark.parametrize("wish", [5, 6, 8])
def test_exit_code_alone_is_not_believed(player: unity_runner.Unity, tmp_path: Path, wish: int) -> None:
    reply = run(player, tmp_path, wish)
    assert (reply["exitCode"], reply["outcome"]) == (70, None)
    assert "unity.log" in str(reply["message"])


def test_summary_of_an_earlier_run_does_not_count(player: unity_runner.Unity, tmp_path: Path) -> None:
    assert run(player, tmp_path, 0)["exitCode"] == 0
    assert run(player, tmp_path, 5)["exitCode"] == 70


def test_hanging_unity_is_ended(tmp_path: Path) -> None:
    hanging = unity_runner.Unity(program(tmp_path, "Guidewire.x86_64"), False, seconds=0.5)
    reply = run(hanging, tmp_path, 7)
    assert reply["exitCode"] == 70 and "did not end within 0.5 s" in str(reply["message"])


def test_address_is_of_parameters_and_program(player: unity_runner.Unity, tmp_path: Path) -> None:
    first, same, other = (run(player, tmp_path, wish, check=True) for wish in (0, 0, 1))
    assert first == same and first["exitCode"] == 0 and len(str(first["address"])) == 32
    assert other["address"] != first["address"] and other["version"] == first["version"]
    assert not (tmp_path / "run").exists()


def test_request_that_cannot_be_read(player: unity_runner.Unity) -> None:
    assert unity_runner.answer(player, "{")["exitCode"] == 2
    assert unity_runner.answer(player, '{"id": "a"}')["id"] == "a"


def test_takes_the_headless_runners_place(player: unity_runner.Unity, tmp_path: Path) -> None:
    with closing(runner.Runner(unity_runner.adapter(player))) as place:
        requests = [runner.Request(f"r{k}", PARAMETERS, tmp_path / f"r{k}", {"displacement": k}) for k in (0, 4, 5)]
        replies = [place.run(request) for request in requests]
    assert [(reply.exit_code, reply.outcome) for reply in replies] == [(0, "finished"), (4, "diverged"), (70, None)]


def test_one_run(player: unity_runner.Unity, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["--unity", str(player.path), "-parameters", str(PARAMETERS), "-out", str(tmp_path / "run")]
    assert unity_runner.main(arguments) == 0
    assert "finished" in capsys.readouterr().out
    assert unity_runner.main([*arguments, "-displacement", "2"]) == 2
    assert capsys.readouterr().err.startswith("guidewire: ")


def test_one_editor_makes_one_run_at_a_time(tmp_path: Path) -> None:
    arguments = commands.parse(["sweep", "default", "--runner", "unity", "--unity", str(program(tmp_path, "Unity")),
                                "--jobs", "4"])
    command = making.runner_of(arguments)
    assert arguments.jobs == 1
    assert command[-1].endswith("Unity")


def test_a_run_that_unity_says_is_already_there_stands_in(player: unity_runner.Unity, tmp_path: Path) -> None:
    assert run(player, tmp_path, 9)["outcome"] is None, "there is none"
    assert run(player, tmp_path, 0)["outcome"] == "finished"
    ending = unity_runner.make_run(player, ["-out", str(tmp_path / "run"), "-displacement", "9"], tmp_path / "run")
    assert (ending.code, ending.outcome) == (0, "finished")
    assert ending.message.startswith("already there: ")


def test_a_study_replaces_what_it_does_not_reuse_and_a_single_run_only_where_it_is_forced_to(
    player: unity_runner.Unity, tmp_path: Path
) -> None:
    out = tmp_path / "run"
    run(player, tmp_path, 0)
    assert "-force" in (out / "unity.log").read_text().split()
    unity_runner._one_run(player, ["-out", str(out), "-displacement", "0"])
    assert "-force" not in (out / "unity.log").read_text().split()

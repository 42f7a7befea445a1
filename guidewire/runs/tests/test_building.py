"""A program is built when something that it was made from, or it itself, has changed, and at no other time."""

from __future__ import annotations

import json
import os
import re
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from guidewire.prepare import PreparationError
from guidewire.runs import building

PROJECT = building.RUNNER
FAKE = Path(__file__).with_name("fake_dotnet.py")
PROGRAMS = (building.BENCHMARKS, *building.TESTED)


class Workshop:
    """A small repository, and a fake dotnet on the PATH that notes what it is told to build."""

    def __init__(self, root: Path, bench: Path) -> None:
        self.root, self.bench, self.told = root, bench, []
        self.core = self.put("Assets/Guidewire/Core/Rod.cs", "class Rod { int a; }\n")
        self.put("Assets/Guidewire/Io/Log.cs", "class Log { }\n")
        for project in PROGRAMS:
            self.put(f"headless/{project}/{project}.csproj", "<Project/>\n")
        for name in ("Directory.Build.props", "Directory.Packages.props", "Tests.slnf"):
            self.put(f"headless/{name}", "<Project/>\n")
        self.output = root / "headless" / PROJECT / "bin/Release/net10.0" / f"{PROJECT}.dll"
        self.install(bench, "10.0.401 [/usr/share/dotnet/sdk]\n")

    def install(self, bench: Path, sdks: str) -> None:
        bench.mkdir(exist_ok=True)
        (bench / "sdks").write_text(sdks)
        program = bench / "dotnet"
        program.write_text(
            f'#!/bin/sh\n[ "$1" = --list-sdks ] && exec cat "{bench}/sdks"\n'
            f'exec "{sys.executable}" -S "{FAKE}" "{self.bench}" "$@"\n'
        )
        program.chmod(0o755)

    def put(self, path: str, text: str) -> Path:
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return file

    def build(self) -> list[str]:
        return building.build(PROJECT, self.told.append)

    def builds(self) -> list[str]:
        """The arguments of each build that began."""
        journal = self.bench / "journal"
        return journal.read_text().splitlines() if journal.exists() else []


@pytest.fixture
def shop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Workshop:
    shop = Workshop(tmp_path / "repository", tmp_path / "bench")
    monkeypatch.setattr(building, "ROOT", shop.root)
    monkeypatch.setattr(building, "HEADLESS", shop.root / "headless")
    monkeypatch.setenv("PATH", f"{shop.bench}{os.pathsep}{os.environ['PATH']}")
    return shop


def test_what_was_built_is_not_built_again_and_nothing_is_said(shop: Workshop) -> None:
    command = shop.build()
    assert command == [str(shop.bench / "dotnet"), str(shop.output)]
    assert (len(shop.builds()), shop.told) == (1, [f"building {PROJECT}"])
    assert shop.build() == command
    assert (len(shop.builds()), shop.told) == (1, [f"building {PROJECT}"])


def replace_by_text_of_same_size_and_time(shop: Workshop) -> None:
    before = shop.core.stat()
    shop.core.write_text(shop.core.read_text().replace("a", "b"))
    os.utime(shop.core, ns=(before.st_atime_ns, before.st_mtime_ns))
    assert (shop.core.stat().st_size, shop.core.stat().st_mtime_ns) == (before.st_size, before.st_mtime_ns)


CHANGES = {
    "content": replace_by_text_of_same_size_and_time,
    "added": lambda shop: shop.put("Assets/Guidewire/Core/Numbers/Vector.cs", "struct Vector { }"),
    "removed": lambda shop: shop.core.unlink(),
    "renamed": lambda shop: shop.core.rename(shop.core.with_name("Wire.cs")),
    "moved": lambda shop: shop.core.rename(shop.root / "Assets/Guidewire/Io/Rod.cs"),
    "project": lambda shop: shop.put(f"headless/{PROJECT}/{PROJECT}.csproj", "<Project />\n"),
    "props": lambda shop: shop.put("headless/Directory.Build.props", "<Project />\n"),
    "packages": lambda shop: shop.put("headless/Directory.Packages.props", "<Project />\n"),
    "targets above": lambda shop: shop.put("Directory.Build.targets", "<Project/>\n"),
    "code style above": lambda shop: shop.put(".editorconfig", "root = true\n"),
    "global.json above": lambda shop: shop.put("global.json", "{}"),
    "SDK added": lambda shop: shop.install(shop.bench, "10.0.401 [/usr/share/dotnet/sdk]\n11.0.100 [/opt/sdk]\n"),
    "SDK replaced": lambda shop: shop.install(shop.bench, "10.0.402 [/usr/share/dotnet/sdk]\n"),
    "program missing": lambda shop: shop.output.unlink(),
    "program cut short": lambda shop: os.truncate(shop.output, 5),
    "program of another builder": lambda shop: shop.output.write_text(shop.output.read_text()),
    "all output removed": lambda shop: shop.output.rename(shop.root / "elsewhere"),
}


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.few(6)
def test_a_change_is_built_once(shop: Workshop, change: str) -> None:
    shop.build()
    CHANGES[change](shop)
    shop.build()
    assert len(shop.builds()) == 2
    assert shop.output.read_text() == "".join(p.read_text() for p in sorted((shop.root / "Assets").rglob("*.cs")))
    shop.build()
    assert len(shop.builds()) == 2


def test_a_dotnet_elsewhere_builds_again(shop: Workshop, monkeypatch: pytest.MonkeyPatch) -> None:
    shop.build()
    other = shop.bench.with_name("other")
    shop.install(other, (shop.bench / "sdks").read_text())
    monkeypatch.setenv("PATH", f"{other}{os.pathsep}{os.environ['PATH']}")
    assert shop.build()[0] == str(other / "dotnet")
    assert len(shop.builds()) == 2


@pytest.mark.parametrize("path", ["headless/Guidewire.Cli/obj/x.cs", "results/x.json", "README.md"])
def test_what_no_build_reads_builds_nothing(shop: Workshop, path: str) -> None:
    shop.build()
    shop.put(path, "text")
    os.utime(shop.core)    # written anew with the same content, as by a change of branch and back
    shop.build()
    assert len(shop.builds()) == 1


def test_msbuild_builds_upon_what_is_there_only_where_it_can_see_the_change(shop: Workshop) -> None:
    shop.build()
    assert "--no-incremental" not in shop.builds()[-1]    # there was nothing to build upon
    shop.core.write_text("class Rod { long later; }\n")
    shop.build()
    assert "--no-incremental" not in shop.builds()[-1]
    shop.core.write_text("class Rod { long earlier; }\n")
    os.utime(shop.core, (1e9, 1e9))
    shop.build()
    assert "--no-incremental" in shop.builds()[-1]
    assert len(shop.builds()) == 3


def test_a_build_of_many_counts_for_each_of_its_programs(shop: Workshop) -> None:
    building.build_tested(shop.told.append)
    shop.build()
    building.build(building.DOTNET_TESTS[1], shop.told.append)
    building.build_tested(shop.told.append)
    assert len(shop.builds()) == 1


def test_programs_built_one_by_one_do_not_hide_a_change_from_each_other(shop: Workshop) -> None:
    shop.build()
    shop.core.write_text("class Rod { long b; }\n")
    building.build(building.BENCHMARKS, shop.told.append)
    shop.build()
    assert len(shop.builds()) == 3


def test_a_build_that_fails_is_one_line_and_is_tried_again(shop: Workshop) -> None:
    (shop.bench / "fail").write_text("Rod.cs(1,1): error CS1002: ; expected")
    for _ in range(2):
        with pytest.raises(PreparationError, match="does not build: Rod.cs.*error CS1002.*log: ") as caught:
            shop.build()
        assert "\n" not in str(caught.value)
    (shop.bench / "fail").unlink()
    shop.build()
    assert len(shop.builds()) == 3


def test_an_edit_during_a_build_is_built_next(shop: Workshop) -> None:
    (shop.bench / "meanwhile").write_text(f"{shop.core}")
    shop.build()
    shop.build()
    assert len(shop.builds()) == 2 and "meanwhile" in shop.output.read_text()
    shop.build()
    assert len(shop.builds()) == 2


def test_a_build_that_was_killed_is_made_anew(shop: Workshop) -> None:
    shop.build()
    shop.core.write_text("class Rod { long b; }\n")
    (shop.bench / "die").touch()
    with pytest.raises(PreparationError, match="ended with -9"):
        shop.build()
    (shop.bench / "die").unlink()
    shop.build()
    assert "--no-incremental" in shop.builds()[-1]
    assert len(shop.builds()) == 3 and "long b" in shop.output.read_text()


def test_of_builds_at_once_one_builds_and_the_others_wait_and_use_it(shop: Workshop) -> None:
    with ThreadPoolExecutor() as threads:
        commands = list(threads.map(lambda _: shop.build(), range(4)))
    assert commands == [commands[0]] * 4
    assert shop.told.count(f"building {PROJECT}") == 1
    assert set(shop.told) <= {f"building {PROJECT}", "waiting for another build to finish"}
    assert len(shop.builds()) == 1


def test_every_program_of_the_solution_has_a_stamp() -> None:
    solution = (building.HEADLESS / "Guidewire.sln").read_text(encoding="utf-8-sig")
    projects = re.findall(r'= "([^"]+)", "[^"]+\.csproj"', solution)
    texts = {name: (building.HEADLESS / name / f"{name}.csproj").read_text(encoding="utf-8") for name in projects}
    programs = {name for name, text in texts.items() if "<OutputType>Exe" in text or "Microsoft.NET.Test.Sdk" in text}
    assert programs == set(PROGRAMS)


def test_what_tests_need_is_what_the_file_names() -> None:
    filtered = json.loads((building.HEADLESS / "Tests.slnf").read_text(encoding="utf-8"))["solution"]
    assert tuple(path.split("\\")[0] for path in filtered["projects"]) == building.TESTED


def test_a_missing_dotnet_is_one_clear_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    with pytest.raises(PreparationError, match="the .NET SDK is missing: install the .NET SDK 10.0") as caught:
        building.build(PROJECT, print)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("listed, said", [("8.0.100 [/usr/lib]", "only 8.x"), ("", "no SDK")])
def test_an_old_dotnet_is_one_clear_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, listed: str, said: str
) -> None:
    program = tmp_path / "dotnet"
    program.write_text(f"#!/bin/sh\necho '{listed}'\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(PreparationError, match=said):
        building.dotnet()

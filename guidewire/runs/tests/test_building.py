"""A program is built when something that it was made from, or it itself, has changed, and at no other time."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from guidewire.prepare import ROOT, PreparationError
from guidewire.runs import building

PROJECT = building.RUNNER
FAKE = Path(__file__).with_name("fake_dotnet.py")
PATIENCE = 60.0
PROGRAMS = (building.BENCHMARKS, *(name for names in building.PARTS.values() for name in names))
DRIVER = (
    "import sys; from pathlib import Path; from guidewire.runs import building\n"
    "building.ROOT = Path(sys.argv[1]); building.HEADLESS = building.ROOT / 'headless'\n"
    "print(*building.build(sys.argv[2], lambda line: print(line, flush=True)))"
)


class Workshop:
    """A small repository, and a fake dotnet on the PATH that notes what it is told to build."""

    def __init__(self, root: Path, bench: Path) -> None:
        self.root, self.bench, self.told = root, bench, []
        self.core = self.put("Assets/Guidewire/Core/Rod.cs", "class Rod { int a; }\n")
        self.put("Assets/Guidewire/Io/Log.cs", "class Log { }\n")
        for project in PROGRAMS:
            self.put(f"headless/{project}/{project}.csproj", "<Project/>\n")
        for name in ("Directory.Build.props", "Directory.Packages.props", *(f"{part}.slnf" for part in building.PARTS)):
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

    def start(self) -> subprocess.Popen[str]:
        """The same in a process of its own."""
        return subprocess.Popen([sys.executable, "-c", DRIVER, str(self.root), PROJECT], cwd=ROOT,
                                stdout=subprocess.PIPE, text=True, start_new_session=True)

    def journal(self) -> list[str]:
        journal = self.bench / "journal"
        return journal.read_text().splitlines() if journal.exists() else []

    def builds(self) -> list[str]:
        """The arguments of each build that began."""
        return [line for line in self.journal() if line != "done"]

    def wait_for(self, there: Callable[[], bool]) -> None:
        end = time.monotonic() + PATIENCE
        while not there():
            assert time.monotonic() < end
            time.sleep(0.01)


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
    shop.core.unlink()
    shop.build()
    assert "--no-incremental" in shop.builds()[-1]
    assert len(shop.builds()) == 4


def test_a_build_of_a_part_counts_for_each_of_its_programs(shop: Workshop) -> None:
    building.build_part("Runner", shop.told.append)
    shop.build()
    building.build(building.CHECKER, shop.told.append)
    building.build_part("Runner", shop.told.append)
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


@pytest.mark.parametrize("taken_back", [False, True])
def test_an_edit_during_a_build_is_built_next(shop: Workshop, taken_back: bool) -> None:
    before = shop.core.read_text()
    (shop.bench / "hold").touch()
    process = shop.start()
    shop.wait_for(shop.output.exists)
    shop.core.write_text("class Rod { long b; }\n")
    (shop.bench / "hold").unlink()
    process.communicate(timeout=PATIENCE)
    assert "long b" in shop.output.read_text()
    if taken_back:
        shop.core.write_text(before)
    shop.build()
    assert len(shop.builds()) == 2
    assert ("long b" in shop.output.read_text()) != taken_back


def processes_of(shop: Workshop) -> list[int]:
    """Every process that has this repository's folder in its command line."""
    found = []
    for entry in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if str(shop.root).encode() in entry.read_bytes():
                found.append(int(entry.parent.name))
        except OSError:
            continue
    return found


@pytest.mark.skipif(not Path("/proc/self/cmdline").exists(), reason="no /proc to find the processes in")
def test_a_build_killed_with_all_its_processes_leaves_no_lock_and_is_made_anew(shop: Workshop) -> None:
    shop.build()
    whole = shop.output.read_text()
    shop.core.write_text("class Rod { long b; }\n")
    (shop.bench / "hold").touch()
    process = shop.start()
    shop.wait_for(lambda: len(shop.builds()) == 2 and shop.output.read_text() != whole)
    for number in processes_of(shop):
        os.kill(number, signal.SIGKILL)
    process.communicate(timeout=PATIENCE)
    shop.wait_for(lambda: not processes_of(shop))    # the lock goes with the last of them, which is nobody's child
    (shop.bench / "hold").unlink()
    assert shop.journal()[-1] != "done"
    shop.build()
    assert shop.told == [f"building {PROJECT}"] * 2
    assert shop.journal()[-1] == "done" and "--no-incremental" in shop.builds()[-1]
    assert len(shop.builds()) == 3 and "long b" in shop.output.read_text()


def test_a_compiler_that_outlives_who_started_it_is_waited_for(shop: Workshop) -> None:
    (shop.bench / "hold").touch()
    first = shop.start()
    shop.wait_for(shop.output.exists)
    first.kill()
    first.communicate(timeout=PATIENCE)
    second = shop.start()
    assert "waiting" in second.stdout.readline()
    assert len(shop.builds()) == 1
    (shop.bench / "hold").unlink()
    second.communicate(timeout=PATIENCE)
    assert second.returncode == 0
    assert [line == "done" for line in shop.journal()] == [False, True, False, True]
    assert "--no-incremental" in shop.builds()[-1]


def test_of_two_at_once_one_builds_and_the_other_waits_and_uses_it(shop: Workshop) -> None:
    (shop.bench / "hold").touch()
    both = [shop.start(), shop.start()]
    said = [process.stdout.readline() for process in both]
    assert sorted(said) == [f"building {PROJECT}\n", "waiting for another build to finish\n"]
    (shop.bench / "hold").unlink()
    rest = [process.communicate(timeout=PATIENCE)[0] for process in both]
    assert [process.returncode for process in both] == [0, 0]
    assert rest == [f"{shop.bench / 'dotnet'} {shop.output}\n"] * 2
    assert len(shop.builds()) == 1


def test_every_program_of_the_solution_has_a_stamp() -> None:
    solution = (building.HEADLESS / "Guidewire.sln").read_text(encoding="utf-8-sig")
    projects = re.findall(r'= "([^"]+)", "[^"]+\.csproj"', solution)
    texts = {name: (building.HEADLESS / name / f"{name}.csproj").read_text(encoding="utf-8") for name in projects}
    programs = {name for name, text in texts.items() if "<OutputType>Exe" in text or "Microsoft.NET.Test.Sdk" in text}
    assert programs == set(PROGRAMS)


@pytest.mark.parametrize("part", building.PARTS)
def test_a_part_of_the_solution_is_what_its_file_names(part: str) -> None:
    filtered = json.loads((building.HEADLESS / f"{part}.slnf").read_text(encoding="utf-8"))["solution"]
    assert tuple(path.split("\\")[0] for path in filtered["projects"]) == building.PARTS[part]


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

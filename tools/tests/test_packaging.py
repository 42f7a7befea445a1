"""The wheel: what it holds, how imports are rewritten, what it says of itself; and where the native library is there, the
package laid out as pip lays it out, run from another folder without the repository and without .NET."""

import ast
import base64
import csv
import email
import hashlib
import io
import json
import os
import re
import shutil
import signal
import struct
import subprocess
import sys
import zipfile
from pathlib import Path
from urllib.request import urlopen

import numpy as np
import pytest

from guidewire.installed import LIBRARY, NATIVE, RUNNER, has_avx2, version
from guidewire.prepare import EXTRAS, ROOT
from guidewire.runs import building
from guidewire.sessions.session import Session
from guidewire.viewer import parts
from tools.packaging import contents, nuget, programs, wheel
from tools.packaging.elf import needed_glibc

FULL = bool(os.environ.get("GUIDEWIRE_ALL"))
SCENE = {"numberRodElements": 8, "maxSimulationSteps": 30, "deltaThreshold": 0, "constraintSolverSteps": 10}


@pytest.fixture(scope="module")
def sources():
    return {place: path.read_text(encoding="utf-8") for place, path in contents.files().items()}


@pytest.fixture(scope="module")
def project():
    if wheel.tomllib is None:
        pytest.skip("pyproject.toml is read with Python 3.11")
    return wheel.read_project()


@pytest.mark.long("4 s; an installed package is imported in another test")
def test_every_import_of_the_package_is_of_a_module_in_it(sources):
    for place, text in sources.items():
        if place.endswith(".py"):
            for node in ast.walk(ast.parse(text)):
                module = node.module or "" if isinstance(node, ast.ImportFrom) else ""
                path = module.removeprefix("guidewire.").replace(".", "/")
                assert module.partition(".")[0] != "guidewire" or module == "guidewire" \
                    or f"{path}.py" in sources or f"{path}/__init__.py" in sources, f"{place}: {module}"


def test_the_package_holds_what_is_needed_and_nothing_else(sources):
    held = set(sources)
    assert {"__init__.py", "__main__.py", "py.typed", "docs/parameters.md", "params/default.json", "params/meshes/arch.obj",
            "params/sheath.csv", "instruments/amplatz-0.035.json", "viewer/page/index.html", "viewer/page/main.js",
            "figures/guidewire.mplstyle", "studies/builtin.py", "sessions/session.py"} <= held
    assert {Path(place).suffix for place in held} == {
        ".py", ".typed", ".md", ".json", ".obj", ".csv", ".html", ".js", ".css", ".mplstyle"}
    for place in held:
        assert not {"tests", "headless", "unitycheck"} & set(Path(place).parts), place


def test_everything_public_has_a_docstring(sources):
    """Of the modules that scripts import from."""
    for place in ("__init__.py", "sessions/session.py", "library.py", "logs/runs.py", "logs/logs.py"):
        tree = ast.parse(sources[place])
        public = [node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and node.name[0] != "_"]
        public += [method for node in public for method in node.body if isinstance(method, ast.FunctionDef)]
        for node in [tree, *public]:
            if not getattr(node, "name", "").startswith("_"):
                assert ast.get_docstring(node), f"{place}: {getattr(node, 'name', 'module')}"


def test_names_for_type_checkers_are_those_that_are_lent(sources):
    tree = ast.parse(sources["__init__.py"])
    typed = next(node for node in tree.body if isinstance(node, ast.If))
    named = {(alias.asname, node.module) for node in typed.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    import guidewire

    assert {name for name, _ in named} == set(guidewire.__all__)
    assert {name: module for name, module in named if module != "guidewire"} == guidewire._LENT
    for name in guidewire.__all__:
        assert getattr(guidewire, name) is not None


def test_metadata_says_what_installers_ask_for(project):
    message = email.message_from_string(wheel.metadata(project))
    assert (message["Name"], message["Version"]) == ("guidewire", version())
    assert (message["License-Expression"], message["License-File"]) == ("MIT", "LICENSE")
    assert message["Requires-Python"] == ">=3.9" and "\n" not in message["Summary"]
    needed = message.get_all("Requires-Dist")
    assert [text for text in needed if "extra" not in text] == ["numpy>=1.22"]
    extras = set(message.get_all("Provides-Extra"))
    assert extras == set(EXTRAS) == {match[1] for text in needed if (match := re.search(r'extra == "(\w+)"', text))}
    assert message.get_payload().startswith("# ")
    assert all(text.count(" :: ") >= 1 for text in message.get_all("Classifier"))


def test_the_command_is_a_function_of_the_package(project, sources):
    module, _, function = project["scripts"]["guidewire"].partition(":")
    assert module == "guidewire.__main__"
    names = {node.name for node in ast.parse(sources["__main__.py"]).body if isinstance(node, ast.FunctionDef)}
    assert function in names


def test_a_wheel_has_its_record_and_is_the_same_every_time(tmp_path, project):
    members = {"guidewire/__init__.py": b"", f"guidewire/native/{RUNNER}": b"\x7fELF"}
    for name in ("one.whl", "two.whl"):
        wheel.write(tmp_path / name, members, wheel.information(project, "py3-none-any"), "guidewire-1.0.0")
    assert (tmp_path / "one.whl").read_bytes() == (tmp_path / "two.whl").read_bytes()
    with zipfile.ZipFile(tmp_path / "one.whl") as archive:
        record = {row[0]: row[1:] for row in csv.reader(io.StringIO(archive.read("guidewire-1.0.0.dist-info/RECORD").decode()))}
        assert set(record) == set(archive.namelist())
        for place, (digest, size) in record.items():
            if place.endswith("/RECORD"):
                assert (digest, size) == ("", "")
                continue
            data = archive.read(place)
            expected = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            assert (digest, size) == (f"sha256={expected}", str(len(data)))
        modes = {info.filename: info.external_attr >> 16 & 0o777 for info in archive.infolist()}
    assert modes[f"guidewire/native/{RUNNER}"] == 0o755 and modes["guidewire/__init__.py"] == 0o644


def test_the_newest_glibc_is_read_off_a_program():
    objdump = shutil.which("objdump") or pytest.skip("there is no objdump to compare with")
    for program in map(Path, ("/usr/bin/python3", sys.executable, "/bin/sh", shutil.which("ls"))):
        shown = subprocess.run([objdump, "-T", program.resolve()], capture_output=True, text=True, check=True).stdout
        versions = [tuple(map(int, match)) for match in re.findall(r"\bGLIBC_(\d+)\.(\d+)", shown)]
        assert needed_glibc(program.resolve()) == max(versions)


@pytest.mark.parametrize("data", [b"", b"#!/bin/sh\n", b"\x7fELF\x01\x01" + bytes(80),
                                  b"\x7fELF\x02\x01" + bytes(34) + struct.pack("<Q", 0) + bytes(20)])
def test_a_file_without_versions_of_glibc_is_refused(tmp_path, data):
    (tmp_path / "file").write_bytes(data)
    with pytest.raises(ValueError, match="file: (no ELF|names no)"):
        needed_glibc(tmp_path / "file")


def test_the_tag_is_of_the_newest_one_needed():
    shell = Path("/bin/sh").resolve()
    major, minor = max(needed_glibc(shell), needed_glibc(Path(sys.executable).resolve()))
    assert wheel.tag([shell, Path(sys.executable).resolve()]) == f"py3-none-manylinux_{major}_{minor}_x86_64"


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """A folder of packages with ours in it, as pip would lay it out; of the two libraries the repository's alone."""
    library = building.build_native(print) if FULL else building.native_library()
    if library is None:
        pytest.skip("the native library is not built: 'guidewire.py native'")
    compiler = shutil.which("gcc") or pytest.skip("there is no gcc to build the runner with")
    folder = tmp_path_factory.mktemp("site")
    for place, path in contents.files().items():
        _place(folder, place).write_bytes(path.read_bytes())
    for name in LIBRARY.values():
        _place(folder, f"{programs.FOLDER}/{name}").symlink_to(library)
    runner = _place(folder, f"{programs.FOLDER}/{RUNNER}")
    subprocess.run([compiler, "-O1", "-Wall", "-Wextra", "-Werror", "-o", runner,
                    building.HEADLESS / building.NATIVE / "runner.c", "-ldl"], check=True)
    information = folder / f"guidewire-{version()}.dist-info" / "METADATA"
    information.parent.mkdir()
    information.write_text(f"Metadata-Version: 2.1\nName: guidewire\nVersion: {version()}\n", encoding="utf-8")
    return folder


def _place(folder, place):
    path = folder / contents.place_of(place)
    path.parent.mkdir(parents=True, exist_ok=True)
    return path


def outside(site, cwd, *words):
    """Run Python with the package, without dotnet on the PATH and without this repository in sight."""
    environment = {"PYTHONPATH": str(site), "PATH": "/nowhere", "HOME": str(cwd), "MPLBACKEND": "Agg"}
    return subprocess.run([sys.executable, *map(str, words)], cwd=cwd, env=environment, capture_output=True, text=True)


def test_the_folder_of_programs_is_the_one_that_the_package_looks_in():
    assert NATIVE.name == programs.FOLDER


def test_a_run_of_the_package_is_the_repositorys(site, tmp_path, runner_command):
    (tmp_path / "scene.json").write_text(json.dumps(SCENE))
    done = outside(site, tmp_path, "-m", "guidewire", "run", "scene.json", "--out", "there")
    assert (done.returncode, done.stderr) == (0, "") or "warning" in done.stderr, done.stderr
    subprocess.run([*runner_command, "-parameters", tmp_path / "scene.json", "-out", tmp_path / "here"], check=True,
                   capture_output=True)
    there, here = ([re.sub(r'"elapsedMilliseconds":[^,}]*', "", (tmp_path / name / "positions.json").read_text())
                    for name in ("there", "here")])
    assert there == here


def test_a_session_of_the_package_has_the_repositorys_bits(site, tmp_path):
    """1,000 steps, with an instrument that is found in the package, by the library and by the runner."""
    code = ("import sys, numpy\nfrom guidewire import Session\n"
            "for native in (True, False):\n"
            "    with Session(native=native, numberRodElements=8, constraintSolverSteps=10) as session:\n"
            "        for k in range(10):\n"
            "            state = session.step(push=0.5, turn=0.02, steps=100)\n"
            "        print(state.positions.tobytes().hex())\n"
            "    with Session(native=native, instrument='amplatz-0.035', solver='direct') as session:\n"
            "        print(session.parameters['guidewireLength'])\n")
    done = outside(site, tmp_path, "-c", code)
    assert done.returncode == 0, done.stderr
    with Session(native=False, numberRodElements=8, constraintSolverSteps=10) as session:
        for _ in range(10):
            state = session.step(push=0.5, turn=0.02, steps=100)
    lines = done.stdout.split()
    assert lines == [state.positions.tobytes().hex(), lines[1]] * 2 and float(lines[1]) > 0


def test_a_study_of_the_package_is_made(site, tmp_path):
    pytest.importorskip("distributed")
    (tmp_path / "scene.json").write_text(json.dumps(SCENE))
    (tmp_path / "study.json").write_text(json.dumps(
        {"study": "short", "scene": "scene.json", "axes": {"constraintSolverSteps": [5, 10]}, "repeats": 0}))
    code = ("from guidewire import sweep\nruns = sweep('study.json', jobs=1)\n"
            "print(sorted((run.value('constraintSolverSteps'), run.outcome) for run in runs.values()))\n")
    done = outside(site, tmp_path, "-c", code)
    assert done.stdout.strip() == "[(5, 'finished'), (10, 'finished')]", done.stderr


def test_a_view_of_the_package_is_answered(site, tmp_path):
    pytest.importorskip("aiohttp")
    if not (parts.CACHE / "node_modules" / "three").is_dir():
        pytest.skip("three is not in .npm: 'guidewire.py view' installs it")
    for place, path in contents.page(print).items():
        if not (site / contents.place_of(place)).exists():
            _place(site, place).symlink_to(path)
    environment = {"PYTHONPATH": str(site), "PATH": "/nowhere", "HOME": str(tmp_path)}
    command = [sys.executable, "-m", "guidewire", "view", site / "guidewire" / "params" / "insertion.json"]
    with subprocess.Popen(command, cwd=tmp_path, env=environment, stdout=subprocess.PIPE, text=True) as process:
        try:
            address = process.stdout.readline().split()[1]
            assert b"<html" in urlopen(address).read()
            assert urlopen(f"{address}three.module.js").read(2) == b"/*"
        finally:
            process.send_signal(signal.SIGINT)
        assert process.wait(20) == 0


def test_what_only_the_repository_has_is_refused_in_one_line(site, tmp_path):
    for words in (["demo"], ["figures"], ["test"], ["native"], ["package"], ["bench"], ["unity-check"],
                  ["run", site / "guidewire" / "params" / "default.json", "--runner", "unity"]):
        done = outside(site, tmp_path, "-m", "guidewire", *words)
        assert (done.returncode, done.stdout) == (2, "")
        assert re.fullmatch(r"guidewire: \S.* needs the repository: this is the installed package\n", done.stderr)
    assert list(tmp_path.iterdir()) == []


def test_a_missing_extra_is_named(site, tmp_path):
    code = ("import sys\nsys.modules['distributed'] = sys.modules['vtkmodules'] = None\nimport importlib.util\n"
            "find = importlib.util.find_spec\n"
            "importlib.util.find_spec = lambda name, *more: None if name in ('distributed', 'vtkmodules') else find(name)\n"
            "from guidewire.__main__ import main\nsys.exit(main())\n")
    for words, name, extra in ((["sweep", "default"], "distributed", "sweep"), (["anatomy", "x.stl"], "vtkmodules", "anatomy")):
        done = outside(site, tmp_path, "-c", code, *words)
        assert done.returncode == 2
        assert done.stderr == (f"guidewire: this needs the Python packages {name}: 'pip install \"guidewire[{extra}]\"' "
                               "installs them\n")


def test_scenes_are_copied_and_never_over_others(site, tmp_path):
    done = outside(site, tmp_path, "-m", "guidewire", "scenes", "--copy", ".")
    assert (done.returncode, done.stdout) == (0, "scenes: params\n"), done.stderr
    copied = {path.relative_to(tmp_path): path.read_bytes() for path in (tmp_path / "params").rglob("*") if path.is_file()}
    assert copied == {path.relative_to(ROOT): path.read_bytes() for path in (ROOT / "params").rglob("*") if path.is_file()}
    done = outside(site, tmp_path, "-m", "guidewire", "scenes", "--copy", ".")
    assert done.returncode == 2 and re.fullmatch(r"guidewire: params/\S+ is there already: give another folder\n", done.stderr)


def test_an_older_processor_gets_the_older_library(monkeypatch):
    from guidewire import installed

    for newer in (True, False):
        monkeypatch.setattr(installed, "has_avx2", lambda newer=newer: newer)
        assert installed.library().name == LIBRARY[newer]
    assert has_avx2() == ("avx2" in Path("/proc/cpuinfo").read_text())


@pytest.mark.skipif(not FULL, reason="a minute: the wheel and the NuGet packages are built with all tests alone")
def test_the_wheel_is_built_and_installed(tmp_path):
    (file,) = [wheel.build(tmp_path, print)]
    assert file.stat().st_size < wheel.MOST
    assert re.fullmatch(rf"guidewire-{re.escape(version())}-py3-none-manylinux_2_\d+_x86_64\.whl", file.name)
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv"], check=True)
    python = tmp_path / "venv" / "bin" / "python"
    subprocess.run([python, "-m", "pip", "install", "-q", "--no-index", "--no-deps", file], check=True)
    (tmp_path / "scene.json").write_text(json.dumps(SCENE))
    done = subprocess.run([tmp_path / "venv" / "bin" / "guidewire", "run", "scene.json"], cwd=tmp_path,
                          env={"PATH": "/nowhere"}, capture_output=True, text=True)
    assert done.returncode == 0 and "finished" in done.stdout, done.stderr
    ends = []
    for newer in (True, False):  # both libraries, by path
        code = (f"from guidewire.experiments import installed\ninstalled.has_avx2 = lambda: {newer}\n"
                "from guidewire import Session\nwith Session(native=True, numberRodElements=8) as session:\n"
                "    print(session.step(push=5.0, steps=50).positions.tobytes().hex())\n")
        ends.append(subprocess.run([python, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True).stdout)
    assert ends[0] == ends[1]


CONSOLE = re.search(r"```csharp\n(.*?)```", (ROOT / "docs" / "packages.md").read_text(encoding="utf-8"), re.S)[1]


def test_the_shown_console_program_is_short():
    assert len(CONSOLE.splitlines()) <= 15


@pytest.mark.skipif(not FULL, reason="half a minute: the NuGet packages are packed with all tests alone")
def test_a_console_program_is_built_against_the_nuget_packages(tmp_path):
    source = tmp_path / "source"
    files = nuget.build(source, print)
    for file in files:
        with zipfile.ZipFile(file) as archive:
            name = file.name.removesuffix(f".{version()}.nupkg")
            for target in ("netstandard2.1", "net10.0"):
                assert {f"lib/{target}/{name}.dll", f"lib/{target}/{name}.xml"} <= set(archive.namelist())
            nuspec = archive.read(f"{name}.nuspec").decode()
            assert f"<version>{version()}</version>" in nuspec and '<license type="expression">MIT</license>' in nuspec
    dotnet = building.dotnet()[0]
    project = tmp_path / "console"
    project.mkdir()
    (project / "Program.cs").write_text(CONSOLE, encoding="utf-8")
    (project / "console.csproj").write_text(
        '<Project Sdk="Microsoft.NET.Sdk"><PropertyGroup><OutputType>Exe</OutputType><TargetFramework>net10.0'
        f'</TargetFramework></PropertyGroup><ItemGroup><PackageReference Include="Guidewire.Io" Version="{version()}" />'
        "</ItemGroup></Project>\n", encoding="utf-8")
    packages = tmp_path / "packages"  # of its own: that of the user would keep an older file of this version
    known = Path(os.environ.get("NUGET_PACKAGES", Path.home() / ".nuget" / "packages"))
    (project / "nuget.config").write_text(
        f'<configuration><packageSources><clear /><add key="ours" value="{source}" /></packageSources>'
        f'<fallbackPackageFolders><add key="known" value="{known}" /></fallbackPackageFolders></configuration>\n',
        encoding="utf-8")
    done = subprocess.run([dotnet, "run", "--project", project], env={**os.environ, "NUGET_PACKAGES": str(packages)},
                          capture_output=True, text=True)
    assert done.returncode == 0 and re.fullmatch(r"running: tip at \S+ \S+ \S+\n", done.stdout.lower()), done.stdout + done.stderr
    with Session(native=False, hand=True, solver="direct", proximalEnd="clamped") as session:
        for _ in range(100):
            state = session.step(push=0.5, turn=0.01)
    np.testing.assert_allclose([float(text) for text in done.stdout.split()[3:]], state.positions[-1], atol=6e-4)

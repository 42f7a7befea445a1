"""The wheel: what it holds; and where the native library is there, the package laid out as pip lays it out, run from
another folder without the repository and without .NET."""

import ast
import json
import os
import re
import shutil
import signal
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
from tools import package

FULL = bool(os.environ.get("GUIDEWIRE_ALL"))
SCENE = {"numberRodElements": 8, "maxSimulationSteps": 30, "deltaThreshold": 0, "constraintSolverSteps": 10}
SOURCES = """import sys, setuptools
from distutils.core import run_setup
from setuptools.command.build_py import build_py
command = build_py(run_setup("setup.py", stop_after="config"))
command.build_lib = sys.argv[1]
command.ensure_finalized()
command.run()
"""


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """A folder of packages with ours in it, as pip would lay it out; of the two libraries the repository's alone."""
    pytest.importorskip("setuptools")
    library = building.build_native(print) if FULL else building.native_library()
    if library is None:
        pytest.skip("the native library is not built: 'guidewire.py native'")
    if not (parts.CACHE / "node_modules" / "three").is_dir():
        pytest.skip("three is not in .npm: 'guidewire.py view' installs it")
    compiler = shutil.which("gcc") or pytest.skip("there is no gcc to build the runner with")
    folder = tmp_path_factory.mktemp("site")
    subprocess.run([sys.executable, "-c", SOURCES, folder], cwd=ROOT, check=True, capture_output=True)
    package.add_data(folder / "guidewire")
    programs = folder / "guidewire" / NATIVE.name
    programs.mkdir()
    for name in LIBRARY.values():
        (programs / name).symlink_to(library)
    subprocess.run([compiler, "-O1", "-Wall", "-Wextra", "-Werror", "-o", programs / RUNNER,
                    building.HEADLESS / building.NATIVE / "runner.c", "-ldl"], check=True)
    information = folder / f"guidewire-{version()}.dist-info" / "METADATA"
    information.parent.mkdir()
    information.write_text(f"Metadata-Version: 2.1\nName: guidewire\nVersion: {version()}\n", encoding="utf-8")
    return folder


def test_the_package_holds_what_is_needed_and_nothing_else(site):
    held = {path.relative_to(site / "guidewire").as_posix() for path in (site / "guidewire").rglob("*")
            if path.is_file()}
    listed = subprocess.run(["git", "ls-files", "guidewire", "params", "instruments"], cwd=ROOT, text=True, check=True,
                            capture_output=True).stdout.split()
    ours = {path.removeprefix("guidewire/") for path in listed if "/tests/" not in path}
    programs = {f"{NATIVE.name}/{name}" for name in (RUNNER, *LIBRARY.values())}
    three = {f"viewer/page/three/{name}" for name in (*parts.three(print), "LICENSE")}
    assert held == ours | programs | three | {"docs/parameters.md"}


def test_everything_public_has_a_docstring():
    """Of the modules that scripts import from."""
    for place in ("__init__.py", "sessions/session.py", "library.py", "logs/runs.py", "logs/logs.py"):
        tree = ast.parse((ROOT / "guidewire" / place).read_text(encoding="utf-8"))
        public = [node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))
                  and node.name[0] != "_"]
        public += [method for node in public for method in node.body if isinstance(method, ast.FunctionDef)]
        for node in [tree, *public]:
            if not getattr(node, "name", "").startswith("_"):
                assert ast.get_docstring(node), f"{place}: {getattr(node, 'name', 'module')}"


def test_names_for_type_checkers_are_those_that_are_lent():
    tree = ast.parse((ROOT / "guidewire" / "__init__.py").read_text(encoding="utf-8"))
    typed = next(node for node in tree.body if isinstance(node, ast.If))
    named = {(alias.asname, node.module) for node in typed.body if isinstance(node, ast.ImportFrom)
             for alias in node.names}
    import guidewire

    assert {name for name, _ in named} == set(guidewire.__all__)
    assert {name: module for name, module in named if module != "guidewire"} == guidewire._LENT
    for name in guidewire.__all__:
        assert getattr(guidewire, name) is not None


def outside(site, cwd, *words):
    """Run Python with the package, without dotnet on the PATH and without this repository in sight."""
    environment = {"PYTHONPATH": str(site), "PATH": "/nowhere", "HOME": str(cwd), "MPLBACKEND": "Agg"}
    return subprocess.run([sys.executable, *map(str, words)], cwd=cwd, env=environment, capture_output=True, text=True)


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
            "importlib.util.find_spec = lambda name, *more: None if name in ('distributed', 'vtkmodules') else "
            "find(name)\nfrom guidewire.__main__ import main\nsys.exit(main())\n")
    for words, name, extra in ((["sweep", "default"], "distributed", "sweep"),
                               (["anatomy", "x.stl"], "vtkmodules", "anatomy")):
        done = outside(site, tmp_path, "-c", code, *words)
        assert done.returncode == 2
        assert done.stderr == (f"guidewire: this needs the Python packages {name}: 'pip install "
                               f"\"guidewire[{extra}]\"' "
                               "installs them\n")


def test_scenes_are_copied_and_never_over_others(site, tmp_path):
    done = outside(site, tmp_path, "-m", "guidewire", "scenes", "--copy", ".")
    assert (done.returncode, done.stdout) == (0, "scenes: params\n"), done.stderr
    copied = {path.relative_to(tmp_path): path.read_bytes() for path in (tmp_path / "params").rglob("*")
              if path.is_file()}
    assert copied == {path.relative_to(ROOT): path.read_bytes() for path in (ROOT / "params").rglob("*")
                      if path.is_file()}
    done = outside(site, tmp_path, "-m", "guidewire", "scenes", "--copy", ".")
    assert done.returncode == 2 and re.fullmatch(r"guidewire: params/\S+ is there already: give another folder\n",
                                                 done.stderr)


def test_an_older_processor_gets_the_older_library(monkeypatch):
    from guidewire import installed

    for newer in (True, False):
        monkeypatch.setattr(installed, "has_avx2", lambda newer=newer: newer)
        assert installed.library().name == LIBRARY[newer]


@pytest.mark.skipif(sys.platform != "linux" or shutil.which("gcc") is None, reason="needs gcc on Linux")
def test_the_processor_is_what_the_compiler_takes_it_for(tmp_path):
    (tmp_path / "asks.c").write_text('int main(void) { return __builtin_cpu_supports("x86-64-v3") ? 0 : 1; }')
    subprocess.run(["gcc", "asks.c", "-o", "asks"], cwd=tmp_path, check=True)
    assert has_avx2() == (subprocess.run([tmp_path / "asks"], check=False).returncode == 0)


@pytest.mark.long("a minute: the wheel is built; the test's other claims hold without")
def test_the_wheel_is_built_and_installed(tmp_path):
    (file,) = package._wheel(tmp_path)
    assert file.stat().st_size < 40e6
    assert re.fullmatch(rf"guidewire-{re.escape(version())}-py3-none-manylinux_2_\d+_x86_64\.whl", file.name)
    with zipfile.ZipFile(file) as archive:
        metadata = archive.read(f"guidewire-{version()}.dist-info/METADATA").decode()
        notices = {f"guidewire-{version()}.dist-info/{name}" for name in ("LICENSE", "THIRD-PARTY-NOTICES.md")}
        assert notices <= set(archive.namelist())
    assert set(re.findall(r"^Provides-Extra: (.*)$", metadata, re.M)) == set(EXTRAS)
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv"], check=True)
    python = tmp_path / "venv" / "bin" / "python"
    subprocess.run([python, "-m", "pip", "install", "-q", "--no-index", "--no-deps", file], check=True)
    (tmp_path / "scene.json").write_text(json.dumps(SCENE))
    done = subprocess.run([tmp_path / "venv" / "bin" / "guidewire", "run", "scene.json"], cwd=tmp_path,
                          env={"PATH": "/nowhere"}, capture_output=True, text=True)
    assert done.returncode == 0 and "finished" in done.stdout, done.stderr
    ends = []
    for newer in (True, False):  # both libraries, by path
        code = (f"from guidewire import installed\ninstalled.has_avx2 = lambda: {newer}\n"
                "from guidewire import Session\nwith Session(native=True, numberRodElements=8) as session:\n"
                "    print(session.step(push=5.0, steps=50).positions.tobytes().hex())\n")
        ends.append(subprocess.run([python, "-c", code], cwd=tmp_path, capture_output=True, text=True,
                                   check=True).stdout)
    assert ends[0] == ends[1]


@pytest.mark.long("some seconds, and it needs setuptools; the commands are those of the clone")
def test_an_editable_installation_has_the_same_commands(tmp_path):
    pytest.importorskip("setuptools")
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv"], check=True)
    programs = tmp_path / "venv" / "bin"
    subprocess.run([programs / "python", "-m", "pip", "install", "-q", "--no-deps", "--no-build-isolation", "-e",
                    ROOT], check=True)
    helps = [subprocess.run([*command, "--help"], cwd=cwd, capture_output=True, text=True, check=True).stdout
             for command, cwd in (([programs / "guidewire"], tmp_path), ([sys.executable, "-m", "guidewire"], ROOT),
                                  ([sys.executable, ROOT / "guidewire.py"], tmp_path))]
    assert helps == [helps[0]] * 3
    code = "import analysis.command, guidewire; print(guidewire.__file__)"
    done = subprocess.run([programs / "python", "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert Path(done.stdout.strip()) == ROOT / "guidewire" / "__init__.py"


CONSOLE = re.search(r"```csharp\n(.*?)```", (ROOT / "docs" / "packages.md").read_text(encoding="utf-8"), re.S)[1]


def test_the_shown_console_program_is_short():
    assert len(CONSOLE.splitlines()) <= 15


@pytest.mark.long("half a minute: the NuGet packages are packed; the test of sessions has the same numbers")
def test_a_console_program_is_built_against_the_nuget_packages(tmp_path):
    source = tmp_path / "source"
    files = package._nuget(source)
    for file in files:
        with zipfile.ZipFile(file) as archive:
            name = file.name.removesuffix(f".{version()}.nupkg")
            for target in ("netstandard2.1", "net10.0"):
                assert {f"lib/{target}/{name}.dll", f"lib/{target}/{name}.xml"} <= set(archive.namelist())
            assert {"packages.md", "THIRD-PARTY-NOTICES.md"} <= set(archive.namelist())
            nuspec = archive.read(f"{name}.nuspec").decode()
            assert f"<version>{version()}</version>" in nuspec and '<license type="expression">MIT</license>' in nuspec
    dotnet = building.dotnet()[0]
    project = tmp_path / "console"
    project.mkdir()
    (project / "Program.cs").write_text(CONSOLE, encoding="utf-8")
    (project / "console.csproj").write_text(
        '<Project Sdk="Microsoft.NET.Sdk"><PropertyGroup><OutputType>Exe</OutputType><TargetFramework>net10.0'
        '</TargetFramework></PropertyGroup><ItemGroup><PackageReference Include="Guidewire.Io" '
        f'Version="{version()}" />'
        "</ItemGroup></Project>\n", encoding="utf-8")
    packages = tmp_path / "packages"  # of its own: that of the user would keep an older file of this version
    known = Path(os.environ.get("NUGET_PACKAGES", Path.home() / ".nuget" / "packages"))
    (project / "nuget.config").write_text(
        f'<configuration><packageSources><clear /><add key="ours" value="{source}" /></packageSources>'
        f'<fallbackPackageFolders><add key="known" value="{known}" /></fallbackPackageFolders></configuration>\n',
        encoding="utf-8")
    done = subprocess.run([dotnet, "run", "--project", project], env={**os.environ, "NUGET_PACKAGES": str(packages)},
                          capture_output=True, text=True)
    assert done.returncode == 0 and re.fullmatch(r"running: tip at \S+ \S+ \S+\n",
                                                 done.stdout.lower()), done.stdout + done.stderr
    with Session(native=False, hand=True, solver="direct", proximalEnd="clamped") as session:
        for _ in range(100):
            state = session.step(push=0.5, turn=0.01)
    np.testing.assert_allclose([float(text) for text in done.stdout.split()[3:]], state.positions[-1], atol=6e-4)


@pytest.mark.long("1 min: a publish; the native library of every test is stripped with Core and Io kept whole")
def test_stripped_as_a_player_of_unity_every_parameter_file_runs(tmp_path):
    project = tmp_path / "stripped.csproj"
    project.write_text(
        '<Project Sdk="Microsoft.NET.Sdk"><PropertyGroup><OutputType>Exe</OutputType><TargetFramework>net10.0'
        "</TargetFramework><RuntimeIdentifier>linux-x64</RuntimeIdentifier><LangVersion>9.0</LangVersion>"
        "<Nullable>enable</Nullable><PublishTrimmed>true</PublishTrimmed><TrimMode>full</TrimMode>"
        "<InvariantGlobalization>true"
        "</InvariantGlobalization><NoWarn>IL2026;IL2075;IL2104</NoWarn><AssemblyName>Guidewire.Cli</AssemblyName>"
        f'</PropertyGroup><ItemGroup><Compile Include="{building.HEADLESS}/Guidewire.Cli/*.cs" />'
        f'<ProjectReference Include="{building.HEADLESS}/Guidewire.Io/Guidewire.Io.csproj" /></ItemGroup></Project>\n',
        encoding="utf-8")
    subprocess.run([building.dotnet()[0], "publish", project, "-c", "Release", "-o", tmp_path / "out"], check=True,
                   capture_output=True)
    for name in ("Guidewire.Core", "Guidewire.Io"):
        whole = building.HEADLESS / name / "bin" / "Release" / "net10.0" / f"{name}.dll"
        assert (tmp_path / "out" / whole.name).stat().st_size < whole.stat().st_size, "it was stripped"
    files = sorted((ROOT / "params").glob("*.json"))
    assert len(files) > 15
    for file in files:
        done = subprocess.run([tmp_path / "out" / "Guidewire.Cli", "-parameters", file, "-maxSimulationSteps", "3",
                               "-out", tmp_path / "runs" / file.stem], cwd=ROOT, capture_output=True, text=True)
        assert done.returncode == 0, f"{file.name}: {done.stdout}{done.stderr}"

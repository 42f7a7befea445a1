"""What README.md and the pages of docs show is there and works, and what they say of files and keys is the runner's."""

import csv
import dataclasses
import importlib.util
import json
import re
import shlex
import subprocess
import sys

import numpy as np
import pytest

from guidewire.commands.arguments import value_of
from guidewire.commands.commands import parse
from guidewire.prepare import ROOT
from guidewire.quantities import CATHETER, WIRE, catheter_name, to_markdown
from guidewire.runs.runner import Checked, Request
from guidewire.sessions.session import State
from guidewire.studies.study_file import KEYS
from guidewire.studies.table import Axis, Grid, Study
from guidewire.sweeps.sweep import Means, sweep

PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
RUNS = (ROOT / "docs" / "runs.md").read_text(encoding="utf-8")
_FOLDERS = "Assets|analysis|docs|experiments|guidewire|headless|instruments|params|tools"
_PLACEHOLDERS = {"T": "1", "STUDY": "default", "FILE": "params/default.json", "N": "2", "...": ""}


def blocks(text, language):
    """Fenced blocks of a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def commands(text):
    """Command lines of guidewire.py, in blocks and in running text, with [...] written out and comments left out."""
    in_blocks = [re.split(r"\s{2,}|\s#", line)[0] for block in blocks(text, "") for line in block.splitlines()]
    in_blocks = [re.sub(r"^guidewire (?=[a-z])", "python3 guidewire.py ", line) for line in in_blocks]    # of the wheel
    in_text = [" ".join(line.split()) for line in re.findall(r"(?<!`)`([^`]+)`(?!`)", text)]
    for line in (*in_blocks, *in_text):
        if line.startswith("python3 guidewire.py "):
            written_out = re.sub(r"(?<![=\w])\[([^\]]*)\]", r"\1", line).replace("...", " ")
            yield [_PLACEHOLDERS.get(word, word) for word in shlex.split(written_out)[2:]]


def section(text, heading):
    """What stands below a heading, up to the next one of its level or above."""
    level = heading.split(" ")[0]
    below = text.split(f"\n{heading}\n", 1)[1]
    return re.split(rf"\n#{{1,{len(level)}}} ", below)[0]


def table_keys(text):
    """Keys in the first column of the tables."""
    first = re.findall(r"^\| ((?:`[\w.]+`(?:, )?)+) \|", text, re.MULTILINE)
    return [key for cell in first for key in re.findall(r"`([\w.]+)`", cell)]


def slug(heading):
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


def run(live, folder, parameters, **changes):
    """A run of a parameter file or an object of parameters; its folder."""
    if isinstance(parameters, dict):
        folder.mkdir(exist_ok=True)
        (folder / "parameters-given.json").write_text(json.dumps(parameters), encoding="utf-8")
        parameters = folder / "parameters-given.json"
    answer = live.run(Request("shown", parameters, folder, changes))
    assert answer.exit_code == 0, answer.message
    return folder


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_file_that_a_page_shows_is_there(page):
    text = page.read_text(encoding="utf-8")
    shown = [page.parent / path for path in re.findall(r"\]\((?!http|#)([^)#]+)[^)]*\)", text)]
    shown += [ROOT / path for path in re.findall(rf"(?<![\w/$.-])((?:{_FOLDERS})/[\w./-]*\w)", text)]
    assert shown
    for path in shown:
        assert path.exists() or re.fullmatch(r"[a-z]+-v\d", path.name), path    # what gymnasium.make takes is no file


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_heading_that_a_page_points_to_is_there(page):
    for path, anchor in re.findall(r"\]\((?!http)([^)#]*)#([^)]+)\)", page.read_text(encoding="utf-8")):
        target = page.parent / path if path else page
        headings = re.findall(r"^#+ (.*)$", target.read_text(encoding="utf-8"), re.MULTILINE)
        assert anchor in [slug(heading) for heading in headings], f"{page.name}: {path}#{anchor}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_command_that_a_page_shows_can_be_typed(page):
    for words in commands(page.read_text(encoding="utf-8")):
        try:
            parse(words)
        except SystemExit as end:
            assert end.code == 0, f"{page.name}: {words}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_run_that_a_page_shows_of_a_scene_of_ours_can_be_made(page, live):
    for words in commands(page.read_text(encoding="utf-8")):
        if words[0] == "run" and (ROOT / words[1]).is_file():
            arguments = parse(words)
            changes = {key: value_of(text) for key, text in arguments.overrides}
            checked = live.check(Request("shown", ROOT / arguments.file, None, changes))
            assert isinstance(checked, Checked), f"{page.name}: {words}: {checked.message}"


def test_every_module_that_a_page_runs_is_there_and_every_script_compiles():
    modules = set()
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        modules |= set(re.findall(r"python3 -m ([a-z][\w.]*)", text))
        for block in blocks(text, "python"):
            compile(block, page.name, "exec")
    assert "experiments.campaigns.push_campaign" in modules and len(modules) > 5
    assert [name for name in modules if importlib.util.find_spec(name) is None] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_parameter_file_that_a_page_shows_can_be_run(page, live, tmp_path):
    for k, block in enumerate(blocks(page.read_text(encoding="utf-8"), "json")):
        content = json.loads(block)
        if "kind" in content:  # an instrument, beside a parameter file that names it
            own = tmp_path / str(k) / "instruments" / "own.json"
            own.parent.mkdir(parents=True)
            own.write_text(block, encoding="utf-8")
            content = {"solver": "direct", "instrument": "own"}
        run(live, tmp_path / str(k), content, maxSimulationSteps=0)


@pytest.mark.long("scripts of the README and of the tutorial run; what is imported here has tests of its own")
def test_every_python_that_the_page_of_python_shows_runs(live, tmp_path):
    page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    (tmp_path / "params").symlink_to(ROOT / "params")
    run(live, tmp_path / "results" / "insertion", ROOT / "params" / "insertion.json", maxSimulationSteps=20)
    shown = blocks(page, "python")
    for k, block in enumerate(shown):
        (tmp_path / f"{k}.py").write_text(block, encoding="utf-8")
    # One process for all, each script with names of its own; a line ends what it printed.
    (tmp_path / "all.py").write_text(f"""import runpy
for k in range({len(shown)}):
    runpy.run_path(f"{{k}}.py", run_name="__main__")
    print("--- the end")
""", encoding="utf-8")
    done = subprocess.run([sys.executable, str(ROOT / "guidewire.py"), "python", "all.py"], cwd=tmp_path,
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0 and not done.stderr, done.stderr
    printed = done.stdout.split("--- the end\n")
    assert len(printed) == len(shown) + 1 and all(printed[:-1])


def test_every_attribute_of_a_state_is_explained_and_no_other():
    page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    explained = table_keys(page.split("\n| of a state ")[1].split("\n\n")[0])
    assert sorted(explained) == sorted(field.name for field in dataclasses.fields(State))


def test_every_key_of_a_sessions_answers_is_explained(runner_command):
    requests = [{"session": "open", "set": {"solver": "direct", "proximalEnd": "clamped"}}, {"session": "step"},
                {"session": "save"}]
    done = subprocess.run([*runner_command, "-lines"], input="".join(json.dumps(r) + "\n" for r in requests),
                          capture_output=True, text=True, check=True)
    documented = section(RUNS, "## A run step by step")
    for line in done.stdout.splitlines():
        answer = json.loads(line)
        assert answer["exitCode"] == 0, answer["message"]
        for key in {*answer} - {"out", "reused"}:
            assert f"`{key}`" in documented, key


def test_the_table_of_keys_is_the_runners_own(runner_command):
    keys = subprocess.run([*runner_command, "--keys"], capture_output=True, text=True, check=True).stdout
    text = (ROOT / "docs" / "parameters.md").read_text(encoding="utf-8")
    block = re.search(r"<!-- keys -->\n(.*)<!-- /keys -->", text, re.DOTALL)
    assert block.group(1) == keys, "put the output of the runner's --keys between the two marks of docs/parameters.md"


def test_the_table_of_quantities_is_the_runners_own(runner_command):
    table = subprocess.run([*runner_command, "--quantities"], capture_output=True, text=True, check=True).stdout
    copy = (ROOT / "guidewire" / "quantities.json").read_text(encoding="utf-8")
    assert copy == table, "copy what --quantities prints"
    text = (ROOT / "docs" / "quantities.md").read_text(encoding="utf-8")
    block = re.search(r"<!-- quantities -->\n(.*)\n<!-- /quantities -->", text, re.DOTALL)
    assert block.group(1) == to_markdown(), "put guidewire.quantities.to_markdown() between the marks"


def test_the_table_of_warnings_is_the_runners_own(runner_command):
    warnings = subprocess.run([*runner_command, "--warnings"], capture_output=True, text=True, check=True).stdout
    block = re.search(r"<!-- warnings -->\n(.*)<!-- /warnings -->", RUNS, re.DOTALL)
    assert block.group(1) == warnings, "put the output of the runner's --warnings between the two marks of docs/runs.md"


def explained_of_a_summary():
    """Keys of summary.json that the page of runs explains, and of its hub the table of quantities."""
    hub = [row.summary for row in WIRE if row.group == "hub" and row.summary]
    return [*table_keys(section(RUNS, "## summary.json")), *hub]


@pytest.mark.parametrize("parameters, nested", [
    ("params/collision-wall.json", {"versions"}), ("params/cantilever.json", {"solver", "versions", "hub", "extremes"}),
])
def test_every_key_of_a_summary_is_explained(live, tmp_path, parameters, nested):
    summary = json.loads((run(live, tmp_path, ROOT / parameters, maxSimulationSteps=1)
                          / "summary.json").read_text())
    assert {key for key, value in summary.items() if isinstance(value, dict)} == nested
    explained = explained_of_a_summary()
    assert set(summary) <= set(explained)
    for key in nested:
        assert set(summary[key]) <= set(explained)
    assert len(explained) == len(set(explained))


def test_every_explained_key_of_a_summary_is_one(live, tmp_path):
    summary = json.loads((run(live, tmp_path, ROOT / "params/cantilever.json", maxSimulationSteps=1)
                          / "summary.json").read_text())
    coaxial = json.loads((run(live, tmp_path / "coaxial", ROOT / "params/catheter.json", maxSimulationSteps=2)
                          / "summary.json").read_text())
    explained = explained_of_a_summary()
    assert set(explained) == {*summary, *summary["solver"], *summary["versions"], *summary["hub"], *summary["extremes"],
                              *coaxial, *coaxial["hubs"][0]}
    for hub in coaxial["hubs"]:
        assert hub["gone"] + hub["shortfall"] == pytest.approx(hub["asked"], abs=1e-9)


_SHEATHED = {
    "solver": "direct", "proximalEnd": "clamped", "guidewireOffset": -280, "maxSimulationSteps": 1, "drive": "displace",
    "sheath": {}, "vessel": {"shape": "tube", "knots": [[0, 0, -50], [0, 0, 90]], "radius": 5},
}


def test_every_key_of_a_log_is_explained(live, tmp_path):
    folder = run(live, tmp_path, ROOT / "params/insertion.json", maxSimulationSteps=1, logOrientations=True,
                 logContacts=True)
    entry = json.loads((folder / "positions.json").read_text())["1"]
    hub = run(live, tmp_path / "hub", {**_SHEATHED, "logHub": True, "logContacts": True})
    entry |= json.loads((hub / "positions.json").read_text())["0"]
    documented = {row.key for row in WIRE if not row.group} | {row.group for row in WIRE} | {"catheters"}
    assert set(entry) <= documented
    for group in ("contact", "hub"):
        assert {*entry[group]} <= {row.key for row in WIRE if row.group == group}


def test_every_array_of_a_log_is_explained(live, tmp_path):
    documented = ({row.name for row in WIRE if row.switch != "never"}
                  | {catheter_name(row.name, 0) for row in CATHETER if row.switch != "never"})
    found = set()
    soft = {"logContacts": True, "vessel.wallStiffness": 1e5}
    moving = {"vessel.motion": {"period": 1, "rigid": {"translation": [0, 0, 1]}}}
    giving = {"vessel.beam": {"bendingStiffness": 1e-3, "axialStiffness": 50, "foundation": 1e3}}
    scenes = (("sheath", {**soft, **moving}), ("cantilever", {"logStrains": True, "material": "nitinol"}),
              ("catheter", {"logHub": True, **soft, **giving}))
    for k, (scene, changes) in enumerate(scenes):
        folder = run(live, tmp_path / str(k), ROOT / f"params/{scene}.json", maxSimulationSteps=1,
                     logFormat="npz", logOrientations=True, **changes)
        with np.load(folder / "positions.npz") as log:
            found |= set(log.files)
    assert found == documented


def test_every_key_of_a_studys_table_is_explained(fake, tmp_path):
    study = Study("small", "a small study", "params/default.json", Grid((Axis("sleep", (0.01,)),)))
    sweep([(study, tmp_path)], tmp_path / "runs", Means(fake.command))
    table = json.loads((tmp_path / "small" / "study.json").read_text())
    explained = section(RUNS, "## Folders of studies")
    assert {*table, *table["runs"][0]} == set(table_keys(section(explained, "### study.json")))
    with open(tmp_path / "small" / "runs.csv", newline="") as file:
        columns = set(next(csv.reader(file)))
    summary = set(explained_of_a_summary())
    assert columns - {*study.grid.axes[0].keys} - summary <= set(table_keys(section(explained, "### runs.csv")))


def test_every_key_of_a_study_file_is_explained():
    assert set(table_keys(section(RUNS, "## A study of your own"))) >= set(KEYS)


def test_the_lines_that_are_shown_are_those_of_the_runner(runner_command, tmp_path):
    (block,) = blocks(RUNS, "jsonl")
    lines = block.splitlines()
    place = json.dumps(str(tmp_path / "lines"))
    asked, shown = ("".join(line + "\n" for line in part).replace('"results/lines"', place)
                    for part in (lines[::2], lines[1::2]))
    answered = subprocess.run([*runner_command, "-lines"], input=asked, capture_output=True, text=True, cwd=ROOT)
    assert answered.returncode == 0 and answered.stdout == shown


_ENDINGS = {
    "converged": {"solver": "direct", "proximalEnd": "clamped", "initialState": "equilibrium", "maxSimulationSteps": 0},
    "finished": {"maxSimulationSteps": 1},
    "diverged": {"solver": "explicit", "proximalEnd": "clamped", "gravity": [0, -9.81, 0]},  # one substep a step
    "failed": {"solver": "direct", "proximalEnd": "clamped", "initialState": "equilibrium", "maxNewtonIterations": 1,
               "tipForce": [0, 100, 0]},
}


def test_outcomes_have_the_exit_codes_that_are_shown(runner_command, tmp_path):
    shown = dict(re.findall(r"^\| `(\w+)` \| (\d+) \|", section(RUNS, "## How a run ends"), re.MULTILINE))
    requests = [{"id": word, "set": changes, "out": str(tmp_path / word)} for word, changes in _ENDINGS.items()]
    answered = subprocess.run([*runner_command, "-lines"], input="".join(json.dumps(r) + "\n" for r in requests),
                              capture_output=True, text=True, check=True)
    answers = [json.loads(line) for line in answered.stdout.splitlines()]
    assert [(a["id"], a["outcome"]) for a in answers] == [(word, word) for word in _ENDINGS]
    interrupted = {"interrupted": "130"}  # test_endings.py
    assert {a["outcome"]: str(a["exitCode"]) for a in answers} | interrupted == shown


def test_every_file_of_the_thesis_equations_names_its_equation():
    page = (ROOT / "docs" / "design.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (.+?) \| .+? \| (`.+`) \|$", section(page, "## Equations of the thesis"), re.MULTILINE)
    assert len(rows) > 10
    for equation, files in rows:
        for name in re.findall("`([^`]+)`", files):
            file = ROOT / name if name.endswith(".py") else ROOT / "Assets" / "Guidewire" / "Core" / name
            text = file.read_text(encoding="utf-8")
            numbers = re.findall(r"\d+(?:\.\d+)+", equation) or ["Kugelstadt and Schoemer 2016, eqs. 3"]
            assert any(number in text for number in numbers), (equation, name)

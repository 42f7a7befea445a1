"""Inside Core and inside the Python package no folder uses what lies above it; analysers find nothing to say."""

import ast
import re
import subprocess

import pytest

from guidewire.prepare import ROOT
from guidewire.runs.building import HEADLESS, dotnet

CORE = ROOT / "Assets" / "Guidewire" / "Core"
# From the bottom up; folders within these are part of them, but each method is a folder of its own.
LAYERS = ("Numbers", "Warnings", "Geometry", "Contrast", "Imaging", "Parameters", "Rod", "Scene", "Contact",
          "Material", "Methods",
          "Methods/*", ".")
_NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"', re.DOTALL)
_TYPE = re.compile(r"^    (?:\w+ )*(?:class|struct|interface|enum|delegate \w+) (\w+)", re.MULTILINE)
_MEMBER = re.compile(r"^        (?:\w+[?\]\[]* )+(\w+)(?= \{| =|;|\()", re.MULTILINE)


def folder(path):
    parts = path.relative_to(CORE).parts[:-1]
    return "/".join(parts[:2]) if parts[:1] == ("Methods",) else parts[0] if parts else "."


def layer(name):
    return LAYERS.index("Methods/*" if name.startswith("Methods/") else name)


def test_arrows_between_folders_go_down_and_no_method_knows_another():
    texts = {path: _NOT_CODE.sub("", path.read_text(encoding="utf-8")) for path in CORE.rglob("*.cs")}
    home = {name: path for path, text in texts.items() for name in _TYPE.findall(text)}
    assert len(home) > 200
    wrong = []
    for path, text in texts.items():
        own = set(_MEMBER.findall(text))  # a member may have the name of a type, such as Scene
        for name in set(re.findall(r"\b[A-Z]\w+", text)) - own:
            below, above = folder(home.get(name, path)), folder(path)
            if below != above and layer(below) >= layer(above):
                wrong.append(f"{path.relative_to(CORE)} uses {name} of {below}")
    assert sorted(wrong) == []


@pytest.mark.long("1 min; the compiler's own warnings are errors in every build")
def test_the_analysers_find_nothing_in_any_project():
    program, _ = dotnet()
    done = subprocess.run([program, "build", "-c", "Debug", "--nologo", "-v", "quiet", str(HEADLESS / "Guidewire.sln"),
                           "-p:UseSharedCompilation=true"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, "\n".join(line for line in done.stdout.splitlines() if "error" in line)[:4000]


# From the bottom up. A line's packages and modules may use those of lines before it, and what stands in the same line
# only within itself.
PYTHON = (("prepare",), ("installed", "json_text", "quantities"), ("studies",), ("logs", "runs"),
          ("figures", "anatomy", "sessions"),
          ("sweeps", "identification"), ("benches", "advice", "navigation", "rod_suite"), ("library", "viewer"),
          ("env", "export"), ("commands",),
          ("__init__", "__main__"))
_LAYER = {name: k for k, names in enumerate(PYTHON) for name in names}


def imports_of(path):
    """The modules that a Python file imports while it runs, not those for type checkers alone."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    typed = {inner for node in ast.walk(tree) if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test)
             for inner in ast.walk(node)}
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node not in typed:
            yield from ([f"{node.module}.{alias.name}" for alias in node.names] if node.module == "guidewire"
                        else [node.module or ""])
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


def test_arrows_of_the_python_package_go_down_and_none_leaves_it():
    wrong = []
    for path in sorted((ROOT / "guidewire").rglob("*.py")):
        place = path.relative_to(ROOT / "guidewire").parts
        if "tests" in place:
            continue
        above = place[0].removesuffix(".py")
        for module in imports_of(path):
            first, _, rest = module.partition(".")
            below = rest.partition(".")[0] if first == "guidewire" else ""
            if first in ("analysis", "experiments", "tools") or \
                    below and below != above and _LAYER[below] >= _LAYER[above]:
                wrong.append(f"{'/'.join(place)} imports {module}")
    assert wrong == []

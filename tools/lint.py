"""`lint`: rules of Python by ruff, warnings of the C# compiler, eslint's recommended rules for the page."""

from __future__ import annotations

import argparse
import importlib.util
import shutil
import subprocess
import sys

from guidewire.prepare import ROOT, PreparationError, require_packages
from guidewire.runs import building
from guidewire.viewer import parts

# Without ruff: its rules of pyproject.toml, as flake8 names them. A fixture has the name of its argument.
_FLAKE8 = ("--max-line-length=120", "--select=E4,E501,E7,E9,F,W2,W3,W6", "--ignore=E741",
           "--per-file-ignores=guidewire/__init__.py:F401 */tests/*:F402,F811")
_ESLINT = """import js from "@eslint/js";
import globals from "globals";
export default [js.configs.recommended, {languageOptions: {globals: {...globals.browser, ...globals.worker}}}];
"""


def lint(_: argparse.Namespace) -> int:
    """Print what each finds, and a line for each; the exit code is 1 where one found something."""
    sources = subprocess.run(["git", "ls-files", "*.py"], cwd=ROOT, stdout=subprocess.PIPE, text=True,
                             check=True).stdout.split()
    ruff = [shutil.which("ruff")] if shutil.which("ruff") else [sys.executable, "-m", "ruff"]
    if shutil.which("ruff") or importlib.util.find_spec("ruff"):
        found = [_run("ruff", [*ruff, "check", "."])]
    else:
        require_packages(("flake8",))
        found = [_run("flake8", [sys.executable, "-m", "flake8", *_FLAKE8, *sources])]
    found.append(_run("C# compiler", [building.dotnet()[0], "build", str(building.HEADLESS / "Guidewire.sln"), "-c",
                                      "Release", "-v", "q", "-nologo"]))
    try:
        modules = parts.require("lintDependencies", print)
    except PreparationError as error:
        print(f"eslint: not run: {error}")
        return 1
    config = modules.parent / "eslint.config.mjs"
    config.write_text(_ESLINT, encoding="utf-8")
    found.append(_run("eslint", ["node", str(modules / "eslint" / "bin" / "eslint.js"), "--config", str(config),
                                 "guidewire/viewer/page"]))
    return 0 if all(found) else 1


def _run(name: str, command: list[str]) -> bool:
    done = subprocess.run(command, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, check=False)
    print(done.stdout, end="")
    print(f"{name}: {'nothing found' if done.returncode == 0 else 'see above'}", flush=True)
    return done.returncode == 0

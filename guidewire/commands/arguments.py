"""Types of command-line arguments, and their error messages."""

from __future__ import annotations

import argparse
import difflib
import json
import math
import re
import shutil
import textwrap
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

RUNNER_WORDS = ("parameters", "out", "force", "repeat", "lines", "logFile")  # the runner's own arguments, like -KEY

_CHOICE = re.compile(r"argument \S+: invalid choice: '([^']+)' \(choose from (.+)\)")


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one line, without argparse's usage lines before it."""

    def error(self, message: str) -> None:
        wrong = _CHOICE.match(message)
        if wrong is not None:
            near = difflib.get_close_matches(wrong[1], re.findall(r"'([^']+)'", wrong[2]), n=1)
            if near:
                message = f"there is no '{wrong[1]}': did you mean '{near[0]}'?"
        self.exit(2, f"guidewire: {message} ('{self.prog} --help' lists what is allowed)\n")


class Commands:
    """The commands and their parsers.

    Parameters
    ----------
    prog, version : name of the program, and what --version prints.
    groups : the names of all commands, by task.
    hidden : names that --help leaves out.
    """

    def __init__(self, prog: str, version: str, groups: Mapping[str, Sequence[str]], hidden: Sequence[str]) -> None:
        self._parser = Parser(prog=prog, formatter_class=argparse.RawDescriptionHelpFormatter,
                              usage=f"{prog} COMMAND ...")
        self._parser.add_argument("--version", action="version", version=version)
        self._parsers = self._parser.add_subparsers(metavar="COMMAND", required=True, parser_class=Parser,
                                                    dest="command", help=argparse.SUPPRESS, prog=prog)
        self._groups, self._hidden = groups, hidden
        self._lines: dict[str, str] = {}

    def add_parser(self, name: str, help: str) -> argparse.ArgumentParser:
        """Return a command's parser; `help` is its line in the list, and stands above its own help."""
        self._lines[name] = help
        return self._parsers.add_parser(name, description=help)

    def parse(self, argv: Sequence[str]) -> argparse.Namespace:
        """Read the command line."""
        width = shutil.get_terminal_size().columns - 2
        lists = []
        for task, names in self._groups.items():
            shown = [name for name in names if name not in self._hidden]
            lists += [f"\n{task}:"] * bool(shown)
            for name in shown:
                lists += textwrap.wrap(self._lines[name], width, initial_indent=f"  {name:<12}",
                                       subsequent_indent=" " * 14)
        self._parser.description = "\n".join(["Simulates guidewires in blood vessels as Cosserat rods.", *lists])
        self._parser.epilog = f"'{self._parser.prog} COMMAND --help' explains a command."
        return self._parser.parse_args(argv)


def assignment(text: str) -> tuple[str, str]:
    """KEY=VALUE as key and text."""
    key, equals, value = text.partition("=")
    if not key or not equals:
        raise argparse.ArgumentTypeError(f"'{text}' is not KEY=VALUE")
    if key in RUNNER_WORDS:
        raise argparse.ArgumentTypeError(f"'{key}' is no parameter")
    return key, value


def value_of(text: str) -> Any:
    """Return the value of KEY=VALUE: a number, true, false, a list or an object as JSON has them, anything else as
    text."""
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        return text


def path(text: str) -> Path:
    """Return a folder or file."""
    if not text.strip():
        raise argparse.ArgumentTypeError("an empty name is no folder")
    return Path(text)


def positive(text: str) -> int:
    """Return a whole number from 1."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is not a whole number above 0")
    return int(text)


def is_list_of_ends(text: str) -> bool:
    """Return whether a word is of numbers of ends, from 1, with commas between them."""
    return all(word.isdecimal() and int(word) > 0 for word in text.split(","))


def ends(text: str) -> str:
    """Numbers of ends, such as 1,3, or all."""
    if text != "all" and not is_list_of_ends(text):
        raise argparse.ArgumentTypeError(f"'{text}' is not numbers of ends such as 1,3")
    return text


def finite(text: str) -> float:
    """Read a number."""
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise argparse.ArgumentTypeError(f"'{text}' is not a number")
    return number


def _numbers(text: str, count: int, what: str) -> tuple[float, ...]:
    words = text.split(",")
    if len(words) != count:
        raise argparse.ArgumentTypeError(f"'{text}' is not {what}")
    return tuple(map(finite, words))


def seed(text: str) -> int | tuple[float, ...]:
    """Return a whole number from 1, or a point such as 1,2,3."""
    return _numbers(text, 3, "a point X,Y,Z") if "," in text else positive(text)


def box(text: str) -> tuple[float, ...]:
    """Return two corners, such as 0,0,0,10,20,30."""
    return _numbers(text, 6, "two corners X,Y,Z,X,Y,Z")


def above_zero(text: str) -> float:
    """Return a number above 0."""
    number = finite(text)
    if number <= 0.0:
        raise argparse.ArgumentTypeError(f"'{text}' is not a number above 0")
    return number


def error_part(text: str) -> float:
    """Return a relative error: 5% or 0.05. More than 1 without a percent sign is hardly meant."""
    if text.endswith("%"):
        return 0.01 * above_zero(text[:-1])
    number = above_zero(text)
    if number > 1.0:
        raise argparse.ArgumentTypeError(f"'{text}' is {100.0 * number:g} %: write {text}% for {0.01 * number:g}, or "
                                         f"{100.0 * number:g}% if that is meant")
    return number

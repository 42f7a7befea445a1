"""An instrument from its data sheet: a file of the current folder, made of another one, and what its numbers give.

The program that simulates it turns the numbers of a data sheet into stiffness (docs/instruments.md). Here stands how
far such a number is known.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from guidewire.benches.library import FOLDER, check_name, files
from guidewire.benches.wire import Wire
from guidewire.prepare import PreparationError
from guidewire.runs.whole_files import write_whole

_SHAFT = ("bendingStiffness", "flexuralModulus", "supportForce", "coreModulus")  # one of them is given
_GRAM = "tipLoad"  # the member whose number may stand alone
_FREE, _FREE_ERROR = 10.0, 0.5  # mm, of the tip in the test of its load
_HELD = 8.18  # pi^2 EI/(0.699 l)^2 of a tip that cannot slide, over pi^2 EI/(2 l)^2


def write(simulate: Callable[[str], object], name: str | None, like: str | None,
          members: Sequence[tuple[str, str]]) -> None:
    """Write the file of an instrument that is like another one but for some members of its data sheet.

    Raises PreparationError, one line, where it cannot be made, or is there already; nothing is written then.

    Parameters
    ----------
    simulate : raises PreparationError where an instrument of a name cannot be simulated.
    """
    if name is None or like is None:
        raise PreparationError("--like OTHER and --set MEMBER=VALUE make an instrument: 'instrument NAME --like OTHER "
                               "--set tipLoad=2'")
    check_name(like)
    file = Path(FOLDER) / f"{name}.json"
    if not re.fullmatch(r"[\w.-]+", name) or name in files():
        raise PreparationError(f"{file}: is there already: choose another name" if name in files() else
                               f"'{name}' is no name of an instrument: letters, digits, '-', '_' and '.' make one")
    content = json.loads(files()[like].read_text(encoding="utf-8-sig"))
    content["title"] = name
    for member, text in members:
        _set(content, member, text)
    file.parent.mkdir(exist_ok=True)
    write_whole(file, json.dumps(content, indent=2, ensure_ascii=False) + "\n")
    try:
        simulate(name)
    except PreparationError:
        file.unlink()
        raise
    print(f"instrument: {file}")


def _set(content: dict[str, Any], member: str, text: str) -> None:
    """Put a number of a data sheet in place of what it replaces."""
    number, unit = re.fullmatch(r"\s*([-+.\deE]*\d)?\s*(.*?)\s*", text).groups()
    value = f"{number} {unit or ('g' if member == _GRAM else '')}".strip() if number else text
    stated = {"value": value, "basis": "measured", "source": "data sheet"}
    if member.startswith("supportForce."):
        support = content.setdefault("supportForce", {"basis": "measured", "source": "data sheet"})
        support[member.partition(".")[2]] = value
        member = "supportForce"
    elif member == "supportForce":
        content[member] = {**content.get(member, {}), **stated}
    elif member in ("tipLoad", "tipLength"):
        _replace_tip(content, member, stated)
    elif member in ("title", "note", "kind"):
        content[member] = text
    else:
        content[member] = {**content.get(member, {}), **stated} if isinstance(content.get(member, {}), dict) else stated
    if member in _SHAFT:
        for other in _SHAFT:
            if other != member:
                content.pop(other, None)


def _replace_tip(content: dict[str, Any], member: str, stated: Mapping[str, str]) -> None:
    """The uniform section at the tip is what tipLoad and tipLength state; a taper before it ends at its stiffness."""
    sections = content.setdefault("distalSections", [])
    if "tipLoad" not in content and sections and sections[-1].get("profile") == "uniform":
        tip = sections.pop()
        content["tipLength"] = tip["length"]
    content[member] = dict(stated)
    if member == "tipLoad" and sections and sections[-1].get("profile") == "linear":
        sections[-1].pop("bendingStiffness", None)


def derived_lines(file: Path, wire: Wire) -> Iterator[str]:
    """Return what a data sheet's numbers give, with how far it is known, a line each.

    Parameters
    ----------
    file : of the instrument.
    wire : it, as it is simulated.
    """
    content = json.loads(file.read_text(encoding="utf-8-sig"))
    shaft, tip = float(wire.bending[0]), float(wire.bending[-1])
    if "supportForce" in content:
        test = content["supportForce"]
        low, high = _span((_digits(test["value"]), 1), (_digits(test["span"]), 3), (_digits(test["deflection"]), -1))
        yield _line("EI of the shaft", shaft, low, high, f"F s^3/(48 u) of {test['value']} over {test['span']}; "
                                                         "friction on the supports makes it seem stiffer")
    if "coreModulus" in content:
        low, high = _span((_digits(content["coreModulus"]["value"]), 1), (_digits(content["coreDiameter"]["value"]), 4))
        yield _line("EI of the shaft", shaft, low, high, "E pi d^4/64 of the core alone; a coil adds to it")
    if "tipLoad" in content:
        low, high = _span((_digits(content["tipLoad"]["value"]), 1), (_FREE_ERROR / _FREE, 2))
        yield _line("EI of the tip", tip, low, high, f"4 P l^2/pi^2, P = {content['tipLoad']['value']} buckles "
                    f"{_FREE:g} mm that are clamped and free (l to {_FREE_ERROR:g} mm); a tip that does not slide on "
                    f"what it presses: {tip / _HELD:.3g} N m2")


def _line(what: str, value: float, low: float, high: float, why: str) -> str:
    return f"{what:36} {f'{value:.3g} N m2':22} derived   from {low * value:.3g} to {high * value:.3g} N m2: {why}"


def _digits(text: str) -> float:
    """Half a unit of the last digit of a number over the number: how far its text states it."""
    number = text.split()[0].lower()
    mantissa, _, power = number.partition("e")
    places = len(mantissa.partition(".")[2])
    return abs(0.5 * 10.0 ** (int(power or 0) - places) / float(number))


def _span(*factors: tuple[float, int]) -> tuple[float, float]:
    """Least and largest product of (1 - e)^p and (1 + e)^p over factors with error e and power p."""
    low = high = 1.0
    for error, power in factors:
        ends = sorted(((1.0 - error) ** power, (1.0 + error) ** power))
        low, high = low * ends[0], high * ends[1]
    return low, high

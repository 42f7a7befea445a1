"""The table of quantities of a run: what each is, and where logs, answers of sessions and summary.json have it.

quantities.json is what the runner prints with ``--quantities``.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Quantity:
    """One row of the table.

    Attributes
    ----------
    name : of its array in a log of format npz; of a catheter with "catheter" and a number before it.
    place : what has a row of it: "run", "node", "element", "joint" or "wall".
    letters : names of a row's numbers in a log of format json; as many as a row has.
    unit, help : the unit with a material, and what it is.
    type : "real", "exact" (8 bytes in any format), "whole" or "flag" (1 or 0).
    switch : what puts it into logs: "always", "never", "orientations", "strains", "hub", "contacts" or "sheath".
    group, key : the object of a json entry and the key there; "" is the entry itself, None is nowhere.
    form : how it stands there: "value", "rows", "byindex" or "nonzero".
    answer, part : the array of an answer that has it, and the part of a session's state.
    summary : its key in summary.json, in the object of its group.
    """

    name: str
    place: str
    letters: tuple[str, ...]
    unit: str
    help: str
    type: str
    switch: str
    group: str
    key: str | None
    form: str
    answer: str | None
    part: int
    summary: str | None

    @property
    def width(self) -> int:
        """How many numbers a row has."""
        return len(self.letters)


def _table(name: str) -> tuple[Quantity, ...]:
    rows = json.loads((Path(__file__).parent / "quantities.json").read_text(encoding="utf-8"))[name]
    return tuple(Quantity(**{**row, "letters": tuple(row["letters"])}) for row in rows)


WIRE, CATHETER, LUMEN = (_table(name) for name in ("wire", "catheter", "lumen"))


def catheter_name(name: str, number: int) -> str:
    """Return the name of a catheter's array in a log; number 0 is the outermost one."""
    return f"catheter{number + 1 if number else ''}{name[0].upper()}{name[1:]}"


_SHAPES = {"run": "", "node": "n + 1", "element": "n", "joint": "n + 1", "wall": "walls", "point": "points"}
_SWITCHES = {"always": "every log", "never": "", "sheath": "a sheath"}


def to_markdown() -> str:
    """Return the table as docs/quantities.md has it."""
    return "\n\n".join(f"## {title}\n\n{_to_markdown(rows)}" for title, rows in (
        ("Of the wire", WIRE), ("Of a catheter", CATHETER), ("Of the place in a vessel", LUMEN)))


def _to_markdown(rows: tuple[Quantity, ...]) -> str:
    table = [("array", "shape", "unit", "in", "key in JSON", "meaning")]
    for row in rows:
        shape = ", ".join(part for part in (_SHAPES[row.place], str(row.width) if row.width > 1 else "") if part)
        switch = _SWITCHES.get(row.switch, f"`log{row.switch.title()}`")
        places = ", ".join(part for part in (switch, "summary" if row.summary else "") if part)
        key = row.summary if row.key is None else row.key
        path = "" if key is None else f"`{row.group}.{key}`" if row.group else f"`{key}`"
        table.append((f"`{row.name}`", shape, "-" if row.unit == "1" else row.unit, places, path, row.help))
    columns = [column for column in zip(*table) if any(column[1:])]
    lines = ["| " + " | ".join(cells) + " |" for cells in zip(*columns)]
    return "\n".join([lines[0], "|---" * len(columns) + "|", *lines[1:]])

"""The last result of each full campaign: a row of `results.json`, which the campaign writes itself, and the table of
docs/verification.md made of the rows.

``python3 -m experiments.campaigns.results`` writes the table anew.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from datetime import date
from pathlib import Path
from typing import Any

from guidewire.prepare import ROOT
from guidewire.runs.whole_files import write_whole

FILE = Path(__file__).with_name("results.json")
PAGE = ROOT / "docs" / "verification.md"
_PROGRAM = ("Assets/Guidewire/Core", "Assets/Guidewire/Io", "headless/Guidewire.Cli")
_TABLE = re.compile(r"(?s)(?<=<!-- campaigns -->\n).*?(?=<!-- /campaigns -->)")
_NUMBER = re.compile(r"-?\d+(\.\d+)?([eE][-+]?\d+)?")


class Record:
    """A file of one JSON object a line, by which a campaign that was ended goes on: what each seed came to."""

    def __init__(self, file: Path | None) -> None:
        self._file = file
        lines = file.read_text(encoding="utf-8").splitlines() if file and file.is_file() else []
        self.found: dict[int, dict[str, Any]] = {one["seed"]: one for one in map(json.loads, lines)}

    def add(self, found: Mapping[str, Any]) -> None:
        """Take in what a seed came to; it is in the file when this returns."""
        self.found[found["seed"]] = dict(found)
        if self._file:
            with self._file.open("a", encoding="utf-8") as file:
                file.write(json.dumps(found) + "\n")


def kinds_of(reasons: Iterable[str]) -> dict[str, int]:
    """Count reasons whose first part differs in its numbers alone, the most frequent first."""
    return dict(Counter(_NUMBER.sub("#", reason.split("; ")[0]) for reason in reasons).most_common())


def keep(name: str, command: str, seeds: Sequence[int], ends: Mapping[str, int], broken: Sequence[int],
         **more: Any) -> None:
    """Write the row of a campaign, in place of its last one; its commit is the last that changed the program.

    Parameters
    ----------
    name : of the row.
    command : that repeats it.
    seeds : all that count as runs.
    ends : how many runs had each outcome.
    broken : seeds of runs that broke a claim.
    more : what else the campaign counts.
    """
    commit = subprocess.run(["git", "-C", str(ROOT), "log", "-1", "--format=%h", "--abbrev=8", "--", *_PROGRAM],
                            capture_output=True, text=True)
    rows = json.loads(FILE.read_text(encoding="utf-8")) if FILE.is_file() else {}
    rows[name] = {"command": command, "date": date.today().isoformat(), "commit": commit.stdout.strip(),
                  "seeds": [min(seeds), max(seeds)], "runs": len(seeds), "ends": dict(sorted(ends.items())),
                  "broken": sorted(broken), **more}
    write_whole(FILE, json.dumps(dict(sorted(rows.items())), indent=1) + "\n")


def table() -> str:
    """Return the table of all rows."""
    lines = ["| command | date, commit of the program | seeds | runs | ends | claims broken |",
             "|---|---|---|---|---|---|"]
    for row in json.loads(FILE.read_text(encoding="utf-8")).values():
        first, last = row["seeds"]
        ends = ", ".join(f"{count} *{end}*" if end != "finished" else f"{count} finished"
                         for end, count in row["ends"].items())
        lines.append(f"| `python3 -m experiments.campaigns.{row['command']}` | {row['date']}, "
                     f"{row['commit']} | {first} to {last} | {row['runs']:,} | "
                     f"{ends} | {len(row['broken'])} |")
    return "\n".join(lines) + "\n"


def main() -> int:
    page = PAGE.read_text(encoding="utf-8")
    write_whole(PAGE, _TABLE.sub(lambda _: table(), page))
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""The last result of each full campaign: a row of `results.json`, which the campaign writes itself, and the tables of
docs/verification.md and docs/environments.md made of the rows.

``python3 -m experiments.campaigns.results`` writes the tables anew.
"""

from __future__ import annotations

import functools
import json
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from datetime import date
from operator import itemgetter
from pathlib import Path
from typing import Any

from guidewire.prepare import ROOT
from guidewire.runs.whole_files import write_whole

FILE = Path(__file__).with_name("results.json")
VERIFICATION, ENVIRONMENTS = (ROOT / "docs" / name for name in ("verification.md", "environments.md"))
_PROGRAM = ("Assets/Guidewire/Core", "Assets/Guidewire/Io", "headless/Guidewire.Cli")
_TABLE = re.compile(r"(?s)(?<=<!-- campaigns -->\n).*?(?=<!-- /campaigns -->)")
_NUMBER = re.compile(r"-?\d+(\.\d+)?([eE][-+]?\d+)?")


class Record:
    """A file of one JSON object a line, by which a campaign that was ended goes on: what each seed came to, and the
    commit of the program that ran it."""

    def __init__(self, file: Path | None, *keys: str) -> None:
        self._file, self._key = file, itemgetter(*(keys or ("seed",)))
        lines = file.read_text(encoding="utf-8").splitlines() if file and file.is_file() else []
        self.found: dict[Any, dict[str, Any]] = {self._key(one): one for one in map(json.loads, lines)}

    def add(self, found: Mapping[str, Any]) -> dict[str, Any]:
        """Take in what was found; it is in the file when this returns. Returns its line."""
        one = {**found, "commit": commit()}
        self.found[self._key(one)] = one
        if self._file:
            with self._file.open("a", encoding="utf-8") as file:
                file.write(json.dumps(one) + "\n")
        return one


@functools.cache
def commit() -> str:
    """Return the last commit that changed the program."""
    told = subprocess.run(["git", "-C", str(ROOT), "log", "-1", "--format=%h", "--abbrev=8", "--", *_PROGRAM],
                          capture_output=True, text=True)
    return told.stdout.strip()


def kinds_of(reasons: Iterable[str]) -> dict[str, int]:
    """Count reasons whose first part differs in its numbers alone, the most frequent first."""
    return dict(Counter(_NUMBER.sub("#", reason.split("; ")[0]) for reason in reasons).most_common())


def keep(name: str, command: str, lines: Sequence[Mapping[str, Any]], ends: Mapping[str, int], broken: Sequence[int],
         **more: Any) -> None:
    """Write the row of a campaign, in place of its last one.

    Parameters
    ----------
    name : of the row.
    command : that repeats it.
    lines : of its record, all that count as runs.
    ends : how many runs had each outcome.
    broken : seeds of runs that broke a claim.
    more : what else the campaign counts.
    """
    seeds = [line["seed"] for line in lines]
    commits = dict.fromkeys(line.get("commit", "unknown") for line in lines)
    rows = json.loads(FILE.read_text(encoding="utf-8")) if FILE.is_file() else {}
    rows[name] = {"command": command, "date": date.today().isoformat(), "commit": ", ".join(commits),
                  "seeds": [min(seeds), max(seeds)], "runs": len(seeds), "ends": dict(sorted(ends.items())),
                  "broken": sorted(broken), **more}
    write_whole(FILE, json.dumps(dict(sorted(rows.items())), indent=1) + "\n")


def tables() -> dict[Path, str]:
    """Return the table of each page: of environments their own, of all other campaigns that of the verification."""
    lines = {VERIFICATION: ["| command | date, commit of the program | seeds | runs | ends | claims broken |",
                            "|---|---|---|---|---|---|"],
             ENVIRONMENTS: ["| task | date, commit of the program | seeds | episodes, steps | ends | the same bits in "
                            "other hosts | resets | faults |", "|---|---|---|---|---|---|---|---|"]}
    for row in json.loads(FILE.read_text(encoding="utf-8")).values():
        told = (f"{row['date']}, {row['commit']} | {row['seeds'][0]} to {row['seeds'][1]} | {row['runs']:,}", ", ".join(
            f"{count} *{end}*" if end in ("failed", "diverged") else f"{count} {end}"
            for end, count in row["ends"].items()))
        if "task" in row:
            resets = "; ".join(f"{int(count):,}: {grown:+.1f} MB" for count, grown in row["resets"].items())
            hosts = ", ".join(f"{count} {host}" for host, count in row["hosts"].items())
            lines[ENVIRONMENTS].append(f"| `{row['task']}` | {told[0]}, {row['steps']:,} | {told[1]} | {hosts} | "
                                       f"{resets} | {row['faults']} |")
        else:
            lines[VERIFICATION].append(f"| `python3 -m experiments.campaigns.{row['command']}` | {' | '.join(told)} | "
                                       f"{len(row['broken'])} |")
    return {page: "\n".join(own) + "\n" for page, own in lines.items()}


def quoted(page: Path) -> str:
    """Return the table that a page has."""
    return _TABLE.search(page.read_text(encoding="utf-8"))[0]


def main() -> int:
    for page, table in tables().items():
        write_whole(page, _TABLE.sub(lambda _: table, page.read_text(encoding="utf-8")))
    return 0


if __name__ == "__main__":
    sys.exit(main())

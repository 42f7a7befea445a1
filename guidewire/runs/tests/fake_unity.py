#!/usr/bin/env python3
"""A stand-in for a Unity editor or player: it takes Unity's arguments and writes what a run would leave.

The run's `-displacement` says what it does: 0 finishes, 4 diverges, 2 refuses, 5 ends with 0 and leaves nothing, 6 ends
with 0 and an unfinished summary, 7 hangs, 8 ends with 1 although its summary says finished, 9 says that the run is
already there.
"""

import json
import sys
import time
from pathlib import Path

CODES = {"0": ("finished", 0), "4": ("diverged", 4), "8": ("finished", 1)}


def main(arguments):
    unity, own = arguments[:arguments.index("-guidewire")], arguments[arguments.index("-guidewire") + 1:]
    given = dict(zip(own[::2], own[1::2]))
    wish = given.get("-displacement", "0")
    log = Path(unity[unity.index("-logFile") + 1])
    log.write_text("Initialize engine\n" + " ".join(arguments) + "\n", encoding="utf-8")
    if wish == "7":
        time.sleep(60)
    if wish == "2":
        with log.open("a", encoding="utf-8") as lines:
            lines.write("guidewire: command line: displacement = x is not allowed\n")
        return 2
    if wish == "9":
        with log.open("a", encoding="utf-8") as lines:
            lines.write("guidewire: already there: run (finished: as asked); --force runs it again\n")
        return 0
    if wish == "5":
        return 0
    outcome, code = CODES.get(wish, ("finished", 0))
    out = Path(given["-out"])
    out.mkdir(parents=True, exist_ok=True)
    summary = {"outcome": outcome} if wish == "6" else {"outcome": outcome, "complete": True}
    (out / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
    with log.open("a", encoding="utf-8") as lines:
        lines.write(f"guidewire: {outcome}: as asked -> {out}\n")
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""Whether the quick tests find an error: the code is broken on purpose, one place at a time.

    python3 guidewire.py python experiments/breaks/breaks.py [NUMBER ...]

breaks.json lists the breaks: file, text, what stands in its place, and in words what is wrong then. Those of C# are
compiled together, in a copy of the repository, with `Breaks.Is(@)` in each; tests run until one fails, first the
classes that the break names in "tests". Those of Python are made one after the other, and pytest runs what the break
names there. A line for each break says which test found it; the exit code is 1 where one was missed. Without numbers
all are tried. The unbroken code comes first, in which nothing may be found.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from itertools import chain
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
_SWITCH = """namespace Guidewire
{
    public static class Breaks
    {
        public static int Number;

        public static bool Is(int number) => number == Number;
    }
}
"""


def load() -> list[dict[str, Any]]:
    """Return the breaks; raises ValueError where one does not fit the code."""
    rows = json.loads((HERE / "breaks.json").read_text(encoding="utf-8"))
    for number, row in enumerate(rows, 1):
        count = (ROOT / row["file"]).read_text(encoding="utf-8-sig").count(row["old"])
        if count != 1:
            raise ValueError(f"break {number} ({row['what']}): its text stands {count} times in {row['file']}")
    return rows


def make(copy: Path, row: dict[str, Any], number: int) -> str:
    """Break a copy of the repository; returns what the file was."""
    path = copy / row["file"]
    before = path.read_text(encoding="utf-8-sig")
    path.write_text(before.replace(row["old"], row["new"].replace("@", str(number))), encoding="utf-8")
    return before


def try_compiled(copy: Path, rows: Sequence[dict[str, Any]], numbers: Sequence[int]) -> Iterator[tuple[int, str]]:
    """Yield what each break of C# gives, and number 0 the unbroken code."""
    for number, row in enumerate(rows, 1):
        if row["file"].endswith(".cs"):
            make(copy, row, number)
    (copy / "Assets/Guidewire/Core/Breaks.cs").write_text(_SWITCH, encoding="utf-8")
    host = copy / "headless/Guidewire.Breaks"
    shutil.copytree(HERE / "host", host)
    subprocess.run(["dotnet", "build", host, "-c", "Release", "-v", "q", "-nologo", "-p:RunAnalyzers=false",
                    "-p:Nullable=annotations"], check=True)
    left = [0, *numbers]
    while left:
        answered = 0
        # After a break that hangs a new host goes on; it measures first how long the unbroken code takes.
        asked = [f"{k}:{','.join(rows[k - 1].get('tests', []))}" for k in left[left[0] == 0:]]
        with subprocess.Popen(["dotnet", host / "bin/Release/net10.0/Breaks.dll", "0:", *asked],
                              stdout=subprocess.PIPE, text=True) as host_of_tests:
            for line in host_of_tests.stdout or ():
                number, tab, text = line.rstrip("\n").partition("\t")
                if tab and number.isdecimal():
                    answered += 1
                    yield int(number), text
        if answered < 2 and len(left) > 1:
            raise RuntimeError(f"the host of the tests ended with {host_of_tests.returncode}")
        left = left[answered - (left[0] != 0):]


def try_python(copy: Path, row: dict[str, Any], number: int) -> str:
    """Say what one break of Python gives."""
    before = make(copy, row, number)
    done = subprocess.run([sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", *row["tests"]],
                          cwd=copy, capture_output=True, text=True)
    (copy / row["file"]).write_text(before, encoding="utf-8")
    failed = [line for line in done.stdout.splitlines() if line.startswith(("FAILED", "ERROR"))]
    return f"found\t{failed[0]}" if failed else "missed\t" + "".join(done.stdout.splitlines()[-1:])


def main() -> int:
    """Try breaks and print a line for each."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("numbers", nargs="*", type=int, help="of breaks, from 1; all if there are none")
    asked = parser.parse_args().numbers
    rows = load()
    numbers = asked or list(range(1, len(rows) + 1))
    compiled = [number for number in numbers if rows[number - 1]["file"].endswith(".cs")]
    missed = []
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "copy"
        subprocess.run(["git", "clone", "-q", ROOT, copy], check=True)
        results: list[tuple[int, str]] = []
        python = [number for number in numbers if number not in compiled]
        for number, text in chain(((k, try_python(copy, rows[k - 1], k)) for k in python),
                                  try_compiled(copy, rows, compiled) if compiled else ()):
            print(f"{number}\t{rows[number - 1]['what'] if number else 'Nothing is broken'}\t{text}", flush=True)
            results.append((number, text))
        missed = [number for number, text in results if text.startswith("missed") == (number > 0)]
    print(f"{len(results)} tried, missed or found without reason: {missed or 'none'}")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())

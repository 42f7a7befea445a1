"""A stand-in for the dotnet program: it compiles nothing, and ends as the files in its folder wish.

A build joins the texts of all sources into the program's file, the first half of it at once; where the file `hold` is
there, it waits until that is gone and then reads the sources again. Where `fail` is there, a
build ends with that text and exit code 1. `journal` has a line for each build that began, its arguments, and a line
"done" for each that ended well.
"""

import sys
import time
from pathlib import Path

_PATIENCE = 60.0


def main(folder, *arguments):
    note(folder, " ".join(arguments))
    if (folder / "fail").exists():
        print((folder / "fail").read_text())
        return 1
    target = Path(next(word for word in arguments if word.endswith((".csproj", ".slnf"))))
    projects = [target] if target.suffix == ".csproj" else sorted(target.parent.glob("*/*.csproj"))
    text = sources(target)
    outputs = [path.parent / "bin" / "Release" / "net10.0" / f"{path.stem}.dll" for path in projects]
    for output in outputs:
        output.parent.mkdir(parents=True, exist_ok=True)
        output.write_text(text[:len(text) // 2])
    started = time.monotonic()
    while (folder / "hold").exists() and time.monotonic() < started + _PATIENCE:
        time.sleep(0.01)
    text = sources(target)
    for output in outputs:
        output.write_text(text)
    note(folder, "done")
    return 0


def sources(target):
    return "".join(path.read_text() for path in sorted((target.parents[2] / "Assets").rglob("*.cs")))


def note(folder, line):
    with (folder / "journal").open("a") as journal:
        journal.write(line + "\n")


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), *sys.argv[2:]))

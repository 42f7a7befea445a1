"""A stand-in for the dotnet program: it compiles nothing, and ends as the files in its folder wish.

A build joins the texts of all sources into the program's file; a line of `journal` has the arguments of each that
began. Where `fail` is there, a build ends with that text and exit code 1; where `die` is, killed with half of the file
written; where `meanwhile` is, a source that it names is edited after it was read.
"""

import os
import signal
import sys
from pathlib import Path


def main(folder, *arguments):
    with (folder / "journal").open("a") as journal:
        journal.write(" ".join(arguments) + "\n")
    if (folder / "fail").exists():
        print((folder / "fail").read_text())
        return 1
    target = Path(next(word for word in arguments if word.endswith((".csproj", ".slnf"))))
    projects = [target] if target.suffix == ".csproj" else sorted(target.parent.glob("*/*.csproj"))
    text = "".join(path.read_text() for path in sorted((target.parents[2] / "Assets").rglob("*.cs")))
    if (folder / "meanwhile").exists():
        Path((folder / "meanwhile").read_text()).write_text("class Rod { int meanwhile; }\n")
        (folder / "meanwhile").unlink()
    dies = (folder / "die").exists()
    for path in projects:
        output = path.parent / "bin" / "Release" / "net10.0" / f"{path.stem}.dll"
        output.parent.mkdir(parents=True, exist_ok=True)
        output.write_text(text[:len(text) // 2] if dies else text)
    if dies:
        os.kill(os.getpid(), signal.SIGKILL)
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), *sys.argv[2:]))

"""`guidewire.py package`: the wheel and the NuGet packages, into one folder."""

from __future__ import annotations

import argparse
import os

from guidewire.runs import checking
from tools.packaging import nuget, wheel

KINDS = {"wheel": lambda out, tell: [wheel.build(out, tell)], "nuget": nuget.build}
_ELSEWHERE = ("Windows, macOS: not tried; the same command needs the .NET SDK there with its C++ compiler, a launcher in place "
              "of runner.c, and the tag win_amd64 or macosx_11_0_arm64")


def package(arguments: argparse.Namespace) -> int:
    """Build packages and print where they are."""
    checking.check_out(arguments.out)
    for kind in arguments.kinds or list(KINDS):
        for file in KINDS[kind](arguments.out, lambda line: print(line, flush=True)):
            print(f"{kind}: {os.path.relpath(file)} ({file.stat().st_size / 1e6:.1f} MB)", flush=True)
            if kind == "wheel":
                print(_ELSEWHERE)
    return 0

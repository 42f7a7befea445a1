"""Command line: python3 -m tools.unitycheck [ROOT] [--write-metas]."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from tools.unitycheck import checks, metas
from tools.unitycheck.project import Project


def main(arguments: list[str] | None = None) -> int:
    """Print a line a violation and a last line with counts; 0 if there are none, 1 if any, 2 for bad arguments."""
    parser = argparse.ArgumentParser(prog="unitycheck", description="Check a Unity project without Unity.")
    parser.add_argument("root", nargs="?", type=Path, default=Path("."), help="folder with Assets (default: here)")
    parser.add_argument("--write-metas", action="store_true", help="write missing .meta files first")
    options = parser.parse_args(arguments)
    if not (options.root / "Assets").is_dir():
        print(f"unitycheck: {options.root}: holds no folder Assets", file=sys.stderr)
        return 2
    if options.write_metas:
        for path in metas.write_missing(Project(options.root)):
            print(f"wrote {path}")
    project = Project(options.root)
    violations = checks.run(project)
    for violation in violations:
        print(violation)
    print("unity-check: dotnet test headless/Guidewire.Unity.Tests -c Release --filter FullyQualifiedName~RuleTests "
          "builds and checks scripts and scenes")
    print(f"unity-check: {len(project.asset_files)} files under Assets, {len(violations)} violations")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())

"""Command line: python3 -m tools.unitycheck [ROOT] [--write-metas] [--write-scenes]."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from tools.unitycheck import checks, metas, scenewriter, sources
from tools.unitycheck.project import Project


def main(arguments: list[str] | None = None) -> int:
    """Print a line a violation and a last line with counts; 0 if there are none, 1 if any, 2 for bad arguments."""
    parser = argparse.ArgumentParser(prog="unitycheck", description="Check a Unity project without Unity.")
    parser.add_argument("root", nargs="?", type=Path, default=Path("."), help="folder with Assets (default: here)")
    parser.add_argument("--write-metas", action="store_true", help="write missing .meta files first")
    parser.add_argument("--write-scenes", action="store_true",
                        help="write scenes, materials and the build's scene list")
    options = parser.parse_args(arguments)
    if not (options.root / "Assets").is_dir():
        print(f"unitycheck: {options.root}: holds no folder Assets", file=sys.stderr)
        return 2
    if options.write_scenes:
        for path in scenewriter.write(options.root):
            print(f"wrote {path}")
    if options.write_metas:
        for path in metas.write_missing(Project(options.root)):
            print(f"wrote {path}")
    project = Project(options.root)
    violations = checks.run(project)
    for violation in violations:
        print(violation)
    if not sources.is_built():
        print("unity-check: the C# sources, what scenes hold of them and the guide's command lines were not checked; "
              f"that needs the build: dotnet build -c Release {sources.PROJECT}")
    print(f"unity-check: {len(project.asset_files)} files under Assets, {len(violations)} violations")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())

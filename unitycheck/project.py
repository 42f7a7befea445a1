"""A Unity project on disk: which files Unity sees, and their text, read once."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Iterator

YAML_SUFFIXES = (".unity", ".mat", ".asset", ".prefab")
TEXT_SUFFIXES = YAML_SUFFIXES + (".meta", ".cs", ".asmdef", ".json", ".rsp", ".txt", ".md")


def is_visible(name: str) -> bool:
    """True if Unity imports a file or folder of this name (Unity ignores `.name`, `name~`, `cvs` and `*.tmp`)."""
    return not (name.startswith(".") or name.endswith("~") or name.lower() == "cvs" or name.endswith(".tmp"))


class DuplicateKeyError(ValueError):
    """A JSON object that states the same key twice."""


def strict_json(text: str) -> Any:
    """Parse JSON as Unity's package manager does: no comments, no trailing commas, no key twice, no NaN."""

    def pairs(items: list[tuple[str, Any]]) -> dict[str, Any]:
        result: dict[str, Any] = {}
        for key, value in items:
            if key in result:
                raise DuplicateKeyError(f"key '{key}' stands twice")
            result[key] = value
        return result

    def constant(name: str) -> Any:
        raise ValueError(f"{name} is not JSON")

    return json.loads(text, object_pairs_hook=pairs, parse_constant=constant)


class Project:
    """The repository at `root`, listed once; paths are repository paths with forward slashes."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.asset_files: list[str] = []
        self.asset_folders: list[str] = []
        self._text: dict[str, str] = {}
        for base in self._asset_roots():
            self._list(base)

    def _asset_roots(self) -> Iterator[Path]:
        yield self.root / "Assets"
        packages = self.root / "Packages"
        if packages.is_dir():
            for folder in sorted(packages.iterdir()):
                if (folder / "package.json").is_file():
                    yield folder

    def _list(self, folder: Path) -> None:
        if not folder.is_dir():
            return
        for entry in sorted(folder.iterdir()):
            if not is_visible(entry.name):
                continue
            path = entry.relative_to(self.root).as_posix()
            if entry.is_dir():
                self.asset_folders.append(path)
                self._list(entry)
            else:
                self.asset_files.append(path)

    def exists(self, path: str) -> bool:
        """True if a file or folder stands at this repository path."""
        return (self.root / path).exists()

    def data(self, path: str) -> bytes:
        """The bytes of a file."""
        return (self.root / path).read_bytes()

    def text(self, path: str) -> str:
        """The text of a file; bytes that are not UTF-8 become U+FFFD (the text rules report them)."""
        if path not in self._text:
            self._text[path] = self.data(path).decode("utf-8", "replace").replace("\r\n", "\n")
        return self._text[path]

    def assets(self, *suffixes: str) -> list[str]:
        """Files that Unity imports whose names end in one of the suffixes."""
        return [path for path in self.asset_files if path.endswith(suffixes)]

    def settings(self) -> list[str]:
        """Files directly under ProjectSettings."""
        folder = self.root / "ProjectSettings"
        if not folder.is_dir():
            return []
        return [f"ProjectSettings/{entry.name}" for entry in sorted(folder.iterdir())
                if entry.is_file() and is_visible(entry.name)]

    def yaml_files(self) -> list[str]:
        """Everything in Unity's YAML: scenes, materials and settings (metas have their own rules)."""
        return self.assets(*YAML_SUFFIXES) + [path for path in self.settings() if path.endswith(".asset")]

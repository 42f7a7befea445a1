"""A Unity project on disk: which files Unity sees, and their text, read once."""

from __future__ import annotations

import copy
import json
from pathlib import Path
from typing import Any, Callable, Mapping

YAML_SUFFIXES = (".unity", ".mat", ".asset", ".prefab")
TEXT_SUFFIXES = YAML_SUFFIXES + (".meta", ".cs", ".asmdef", ".asmref", ".json", ".rsp", ".txt", ".md")


def is_visible(name: str) -> bool:
    """True if Unity imports a file or folder of this name (Unity ignores `.name`, `name~`, `cvs` and `*.tmp`)."""
    return not (name.startswith(".") or name.endswith("~") or name.lower() == "cvs" or name.endswith(".tmp"))


def strict_json(text: str) -> Any:
    """Parse JSON as Unity's package manager does: no comments, no trailing commas, no key twice, no NaN."""

    def pairs(items: list[tuple[str, Any]]) -> dict[str, Any]:
        result = dict(items)
        if len(result) < len(items):
            raise ValueError(f"a key stands twice among {', '.join(key for key, _ in items)}")
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
        self.changes: dict[str, bytes | None] = {}
        self._data: dict[str, bytes] = {}
        self._text: dict[str, str] = {}
        self._derived: dict[Any, Any] = {}
        self._list(root / "Assets")
        self._settings = [path.relative_to(root).as_posix() for path in sorted((root / "ProjectSettings").glob("*"))
                          if path.is_file() and is_visible(path.name)]

    def with_changes(self, changes: Mapping[str, bytes | None]) -> Project:
        """Return the same project with other bytes in some files, or (None) without them; no file is touched."""
        other = copy.copy(self)
        other.changes = {**self.changes, **changes}
        other._text = {path: text for path, text in self._text.items() if path not in changes}
        other._derived = {}
        gone = {path for path, data in changes.items() if data is None}
        new = {path for path, data in changes.items() if data is not None}
        other.asset_files = sorted(set(self.asset_files) - gone | {path for path in new if path.startswith("Assets/")})
        return other

    def derived(self, name: str, make: Callable[[Project], Any]) -> Any:
        """Return what is computed from the whole project once, whichever rule asks first. Nobody may change it."""
        if name not in self._derived:
            self._derived[name] = make(self)
        return self._derived[name]

    def _list(self, folder: Path) -> None:
        for entry in sorted(folder.iterdir()):
            if is_visible(entry.name):
                (self.asset_folders if entry.is_dir() else self.asset_files).append(
                    entry.relative_to(self.root).as_posix())
                if entry.is_dir():
                    self._list(entry)

    def exists(self, path: str) -> bool:
        """True if a file or folder stands at this repository path."""
        return self.changes[path] is not None if path in self.changes else (self.root / path).exists()

    def data(self, path: str) -> bytes:
        """Return the bytes of a file."""
        changed = self.changes.get(path)
        if changed is not None:
            return changed
        if path not in self._data:
            self._data[path] = (self.root / path).read_bytes()
        return self._data[path]

    def text(self, path: str) -> str:
        """Return the text of a file; bytes that are not UTF-8 become U+FFFD (the text rules report them)."""
        if path not in self._text:
            self._text[path] = self.data(path).decode("utf-8", "replace").replace("\r\n", "\n")
        return self._text[path]

    def assets(self, *suffixes: str) -> list[str]:
        """Files that Unity imports whose names end in one of the suffixes."""
        return [path for path in self.asset_files if path.endswith(suffixes)]

    def samples(self, suffix: str) -> list[str]:
        """Files of the package's samples, which Unity imports once a user asks for them."""
        return [path.relative_to(self.root).as_posix()
                for path in sorted(self.root.glob(f"Assets/Guidewire/Samples~/**/*{suffix}"))]

    def settings(self) -> list[str]:
        """Files directly under ProjectSettings."""
        return [path for path in self._settings if self.exists(path)]

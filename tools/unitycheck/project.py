"""A Unity project on disk: which files Unity sees, and their text, read once."""

from __future__ import annotations

import copy
import json
import os
from pathlib import Path
from typing import Any, Callable, Iterable, Iterator, Mapping

YAML_SUFFIXES = (".unity", ".mat", ".asset", ".prefab")
TEXT_SUFFIXES = YAML_SUFFIXES + (".meta", ".cs", ".asmdef", ".json", ".rsp", ".txt", ".md")


# The folder that is a package: where it stands in the repository, and in another project's Packages.
HOME, PACKAGE = "Assets/Guidewire", "Packages/org.guidewire.simulation"


def at_home(path: str) -> str:
    """A path of the package as it is in the repository; other paths as they are."""
    return HOME + path[len(PACKAGE):] if path == PACKAGE or path.startswith(f"{PACKAGE}/") else path


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
    """The repository at `root`, listed once; paths are repository paths with forward slashes.

    only : the C# sources that are checked; None for all.
    """

    def __init__(self, root: Path) -> None:
        self.root = root
        self.asset_files: list[str] = []
        self.asset_folders: list[str] = []
        self._settings: list[str] = []
        self.only: frozenset[str] | None = None
        self._changes: dict[str, bytes | None] = {}
        self._data: dict[str, bytes] = {}
        self._text: dict[str, str] = {}
        self._exists: dict[str, bool] = {}
        self._stamps: dict[str, tuple[int, int]] = {}
        self._derived: dict[Any, Any] = {}
        for base in self._asset_roots():
            self._list(base)
        if (root / "ProjectSettings").is_dir():
            self._settings = [f"ProjectSettings/{entry.name}" for entry in sorted((root / "ProjectSettings").iterdir())
                              if entry.is_file() and is_visible(entry.name)]

    @property
    def changed(self) -> set[str]:
        """The files that have other bytes than on disk, or are gone."""
        return set(self._changes)

    def with_changes(self, changes: Mapping[str, bytes | None], only: Iterable[str] | None = None) -> Project:
        """The same project with other bytes in some files, or (None) without them; nothing on disk is touched.

        Of the C# sources `only` these are checked, where it is given.
        """
        other = copy.copy(self)
        other.only = None if only is None else frozenset(only)
        other._changes = {**self._changes, **changes}
        other._text = {path: text for path, text in self._text.items() if path not in changes}
        other._derived = {}
        gone = {path for path, data in changes.items() if data is None}
        new = {path for path, data in changes.items() if data is not None}
        added = {path for path in new if path.startswith("Assets/") and all(map(is_visible, path.split("/")))}
        other.asset_files = sorted((set(self.asset_files) - gone) | added)
        folders = {path.rpartition("/")[0] for path in added} - {"Assets"}
        other.asset_folders = sorted(set(self.asset_folders) | folders)
        other._settings = sorted((set(self._settings) - gone) | {path for path in new
                                                                 if path.startswith("ProjectSettings/")})
        return other

    def derived(self, name: str, make: Callable[[Project], Any]) -> Any:
        """What is computed from the whole project once, whichever rule asks first. Nobody may change it."""
        if name not in self._derived:
            self._derived[name] = make(self)
        return self._derived[name]

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
        if path in self._changes:
            return self._changes[path] is not None
        if any(data is not None and changed.startswith(f"{path}/") for changed, data in self._changes.items()):
            return True
        if path not in self._exists:
            try:
                self._exists[path] = (self.root / path).exists()
            except (OSError, ValueError):  # a name that no file can have
                self._exists[path] = False
        return self._exists[path]

    def is_file(self, path: str) -> bool:
        """True if a file stands at this repository path."""
        return self.exists(path) and (path in self._changes or (self.root / path).is_file())

    def data(self, path: str) -> bytes:
        """The bytes of a file."""
        changed = self._changes.get(path)
        if changed is not None:
            return changed
        if path not in self._data:
            self._data[path] = (self.root / path).read_bytes()
        return self._data[path]

    def stamp(self, path: str) -> tuple[int, int]:
        """Time of change in ns and size of a file on disk, as they were when first asked for; zeros where it is not."""
        if path not in self._stamps:
            try:
                status = os.stat(f"{self.root}/{path}")
                self._stamps[path] = (status.st_mtime_ns, status.st_size)
            except OSError:
                self._stamps[path] = (0, 0)
        return self._stamps[path]

    def text(self, path: str) -> str:
        """The text of a file; bytes that are not UTF-8 become U+FFFD (the text rules report them)."""
        if path not in self._text:
            self._text[path] = self.data(path).decode("utf-8", "replace").replace("\r\n", "\n")
        return self._text[path]

    def assets(self, *suffixes: str) -> list[str]:
        """Files that Unity imports whose names end in one of the suffixes."""
        return self.derived(f"assets {suffixes}", lambda project: [
            path for path in project.asset_files if path.endswith(suffixes)])

    def embedded_packages(self) -> list[str]:
        """The package.json of each folder under Packages."""
        folder = self.root / "Packages"
        entries = folder.iterdir() if folder.is_dir() else ()
        found = {f"Packages/{entry.name}/package.json" for entry in entries if (entry / "package.json").is_file()}
        found |= {path for path in self._changes if path.startswith("Packages/") and path.endswith("/package.json")}
        return sorted(path for path in found if self.exists(path) and path.count("/") == 2)

    def settings(self) -> list[str]:
        """Files directly under ProjectSettings."""
        return self._settings

    def yaml_files(self) -> list[str]:
        """Everything in Unity's YAML: scenes, materials and settings (metas have their own rules)."""
        return self.assets(*YAML_SUFFIXES) + [path for path in self.settings() if path.endswith(".asset")]

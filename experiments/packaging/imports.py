"""Python sources as they stand in the package: all first-party packages lie below `guidewire` there, so each import of
one is written with that name before it. Nothing else of a source changes, so that traces name the same lines."""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Iterator

HOME = "guidewire"


class UnclearImport(Exception):
    """A source names a first-party package in a way that cannot be rewritten; one line says where."""


def rewrite(source: str, packages: Collection[str], name: str) -> str:
    """A source with its imports of first-party packages below `guidewire`.

    Parameters
    ----------
    source : Python text.
    packages : the first-party packages, which stand at the top in the repository.
    name : of the file, for errors.

    Raises
    ------
    UnclearImport : for `import package`, which would bind another name, and for a module named in a text.
    """
    lines = source.splitlines(keepends=True)
    last_first = sorted((node for node in ast.walk(ast.parse(source)) if hasattr(node, "lineno")),
                        key=lambda node: (-node.lineno, -node.col_offset))  # an earlier column stays where it is
    for node in last_first:
        if isinstance(node, ast.Import):
            for alias in node.names:
                if _is_of(alias.name, packages):
                    raise UnclearImport(f"{name}:{node.lineno}: 'import {alias.name}': write 'from ... import ...'")
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and _is_of(node.module or "", packages):
            line = lines[node.lineno - 1].encode()  # columns count bytes
            before, statement = line[:node.col_offset].decode(), line[node.col_offset:].decode()
            changed, count = re.subn(rf"^from(\s+){re.escape(node.module)}\b", rf"from\1{HOME}.{node.module}", statement)
            if count != 1:
                raise UnclearImport(f"{name}:{node.lineno}: the module does not stand in the line of its 'from'")
            lines[node.lineno - 1] = before + changed
        elif isinstance(node, ast.Call) and _called(node) in ("import_module", "__import__"):
            first = node.args[0] if node.args else None
            if isinstance(first, ast.Constant) and _is_of(str(first.value), packages):
                raise UnclearImport(f"{name}:{node.lineno}: a module is named in a text")
    return "".join(lines)


def first_party(source: str, packages: Collection[str]) -> Iterator[str]:
    """Every module that a source imports from the packages, or from them below `guidewire`, as the source names it."""
    for node in ast.walk(ast.parse(source)):
        names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
        if isinstance(node, ast.ImportFrom) and node.level == 0:
            names = [node.module or ""]
        yield from (name for name in names if _is_of(name.removeprefix(f"{HOME}."), packages))


def _is_of(module: str, packages: Collection[str]) -> bool:
    return module.partition(".")[0] in packages


def _called(node: ast.Call) -> str:
    return node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")

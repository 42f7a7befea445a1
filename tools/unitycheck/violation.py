"""The record of one broken rule."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, order=True)
class Violation:
    """One broken rule in one file.

    path: repository path with forward slashes; line: 1-based, 0 where the rule concerns the whole file;
    rule: the rule's name, stable, one word with hyphens; message: what is wrong and what is allowed.
    """

    path: str
    line: int
    rule: str
    message: str

    def __str__(self) -> str:
        place = f"{self.path}:{self.line}" if self.line else self.path
        return f"{place}: [{self.rule}] {self.message}"

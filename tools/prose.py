"""How the pages read: words, length of sentences, colons and semicolons of each, with the limits.

`python3 -m tools.prose [FILE...]` prints a line for each page (README.md, CONTRIBUTING.md, CHANGELOG.md and docs/*.md
if none is given). `--longest N` adds the N longest sentences of each. The exit code is 1 if a page is beyond a limit.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from guidewire.prepare import ROOT

MEAN_WORDS = 18.0     # of a sentence
CHAINING = 0.3        # colons and semicolons a sentence
CELL_WORDS = 25       # of a cell of a table
TOTAL_WORDS = 14000   # outside tables and code, over README.md and docs/*.md
OPENING_WORDS = 160   # before a page's first example
COUNTED = (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")))
PAGES = (*COUNTED, ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md")

_FENCE = re.compile(r"^( *)```.*?^\1```[^\n]*$", re.MULTILINE | re.DOTALL)
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_PRINTED = (("warnings", r"(?m)^(\|) [^|]* \|"), ("keys", r"(?m)^(\| `[^|]*\|)[^|]* \|"))
_CODE = "\x01"        # stands for a passage of code, one word
_END = re.compile(r"(?<!\be\.g)(?<!\bi\.e)(?<!\beq)(?<!\beqs)(?<!\bfig)[.!?][)\"*]*\s+(?=[^a-z])")
_ITEM = re.compile(r"^\s*(?:[-*]|\d+\.)\s+")
_WORD = re.compile(r"[\w\x01]")


@dataclass(frozen=True)
class Prose:
    """Sentences of a page outside tables and code, and the cells of its tables."""

    sentences: tuple[str, ...]
    cells: tuple[str, ...]
    opening: int | None    # words before the first example, None without one

    @property
    def words(self) -> int:
        """Words of all sentences."""
        return sum(map(words, self.sentences))

    @property
    def mean(self) -> float:
        """Words of a sentence in the mean."""
        return self.words / max(len(self.sentences), 1)

    @property
    def chaining(self) -> float:
        """Colons and semicolons of a sentence in the mean."""
        return sum(len(re.findall(r"[:;](?!//)", one)) for one in self.sentences) / max(len(self.sentences), 1)

    def faults(self, opens: bool) -> list[str]:
        """Limits that the page exceeds, one line each; with `opens` it has an example at its beginning, too."""
        found = []
        if self.mean > MEAN_WORDS:
            found.append(f"{self.mean:.1f} words a sentence, {MEAN_WORDS:g} are allowed")
        if self.chaining > CHAINING:
            found.append(f"{self.chaining:.2f} colons and semicolons a sentence, {CHAINING:g} are allowed")
        found += [f"a cell of {words(cell)} words, {CELL_WORDS} are allowed: {shown(cell)[:90]}"
                  for cell in self.cells if words(cell) > CELL_WORDS]
        if opens and (self.opening is None or self.opening > OPENING_WORDS):
            found.append(f"no example within its first {OPENING_WORDS} words")
        return found


def words(text: str) -> int:
    """Words of a text; a passage of code counts as one."""
    return sum(1 for word in text.split() if _WORD.search(word))


def shown(text: str) -> str:
    """Return a sentence or a cell as it is printed."""
    return text.replace(_CODE, "`...`")


def read(text: str) -> Prose:
    """Take a page in Markdown apart. The lines of warnings and what a key allows, in the tables that the program itself
    prints, are no prose."""
    for mark, column in _PRINTED:
        text = re.sub(rf"<!-- {mark} -->.*?<!-- /{mark} -->", lambda block: re.sub(column, r"\1 |", block[0]), text,
                      flags=re.DOTALL)
    first = _FENCE.search(text)
    opening = words(_plain(text[:first.start()])) if first else None
    text = _COMMENT.sub("\n", _FENCE.sub("\n\n", text))
    cells: list[str] = []
    blocks: list[list[str]] = [[]]
    for line in text.splitlines():
        if line.lstrip().startswith("|"):
            if not re.fullmatch(r"[\s|:-]+", line):
                found = [_plain(cell) for cell in line.strip().strip("|").split("|")]
                # a list of names is no phrase
                cells += ["" if not re.search(r"\w", cell) else cell for cell in found]
            blocks.append([])
        elif not line.strip() or line.startswith("#"):
            blocks.append([])
        elif _ITEM.match(line):
            blocks.append([_ITEM.sub("", line)])
        else:
            blocks[-1].append(line)
    sentences = [one for block in blocks if block for one in _sentences(_plain(" ".join(block)))]
    return Prose(tuple(sentences), tuple(cells), opening)


def _plain(text: str) -> str:
    text = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", text)
    text = re.sub(r"``[^`]+``|`[^`]+`", _CODE, text)
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    return re.sub(r"\$[^$]+\$", _CODE, re.sub(r"https?://\S+", _CODE, text))


def _sentences(text: str) -> Iterable[str]:
    return [one.strip() for one in _END.split(text) if words(one)]


def main(given: list[str] | None = None) -> int:
    """Print the table; the exit code."""
    parser = argparse.ArgumentParser(prog="python3 -m tools.prose", description=__doc__.split("\n")[0])
    parser.add_argument("files", nargs="*", type=Path, default=list(PAGES), metavar="FILE")
    parser.add_argument("--longest", type=int, default=0, metavar="N", help="print the N longest sentences of a page")
    arguments = parser.parse_args(given)
    pages = {path: read(path.read_text(encoding="utf-8")) for path in arguments.files}
    print(f"{'page':24} {'words':>6} {'sentences':>9} {'mean':>6} {'longest':>7} {': and ;':>7} {'cell':>5}")
    faults = []
    for path, prose in pages.items():
        longest = max(map(words, prose.sentences), default=0)
        print(f"{path.name:24} {prose.words:6} {len(prose.sentences):9} {prose.mean:6.1f} {longest:7} "
              f"{prose.chaining:7.2f} {max(map(words, prose.cells), default=0):5}")
        for sentence in sorted(prose.sentences, key=words, reverse=True)[:arguments.longest]:
            print(f"    {words(sentence)}: {shown(sentence)}")
        faults += [f"{path.name}: {fault}" for fault in prose.faults(opens=path.resolve() in COUNTED)]
    total = sum(prose.words for path, prose in pages.items() if path.resolve() in COUNTED)
    print(f"{total} words in README.md and docs, {TOTAL_WORDS} are allowed; {MEAN_WORDS:g} words, {CHAINING:g} "
          f"colons and semicolons a sentence; {CELL_WORDS} words a cell")
    if total > TOTAL_WORDS:
        faults.append(f"{total} words in all, {TOTAL_WORDS} are allowed")
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

"""Which members of Unity that the package uses are in Unity's published C# sources, and not obsolete, by version.

python3 -m tools.unitycheck.published GIT NAMES VERSION... prints the table that LibraryRuleTests reads. GIT is a clone
of the published sources, NAMES the list that this test writes, VERSION a tag. Of the sources nothing is kept but names.
"""

from __future__ import annotations

import re
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

_TYPE = re.compile(r"\b(?:class|struct|interface|enum|delegate\s+[\w<>]+)\s+(\w+)")
_BESIDE = re.compile(r'//[^\n]*|/\*.*?\*/', re.DOTALL)


def _sources(git: str, version: str) -> list[str]:
    """Return the text of every C# file of the engine and the editor, without comments."""
    listed = subprocess.run(["git", "-C", git, "ls-tree", "-r", version, "Runtime", "Editor", "Modules", "artifacts"],
                            check=True, capture_output=True, text=True).stdout
    blobs = [line.split()[2] for line in listed.splitlines() if line.endswith(".cs")]
    data = subprocess.run(["git", "-C", git, "cat-file", "--batch"], input="\n".join(blobs).encode(), check=True,
                          capture_output=True).stdout
    texts, place = [], 0
    while place < len(data):
        end = data.index(b"\n", place)
        size = int(data[place:end].split()[2])
        texts.append(_BESIDE.sub("", data[end + 1:end + 1 + size].decode("utf-8", "replace")))
        place = end + size + 2
    return texts


def _types(texts: list[str], wanted: set[str]) -> dict[str, list[str]]:
    """Return the declarations of each wanted type, by its last name, with the attributes before them."""
    found: dict[str, list[str]] = defaultdict(list)
    for text in texts:
        for match in _TYPE.finditer(text):
            if match.group(1) in wanted:
                start = max(text.rfind(";", 0, match.start()), text.rfind("}", 0, match.start()),
                            text.rfind("{", 0, match.start())) + 1
                end, depth = text.find("{", match.end()), 0
                for end in range(max(end, 0), len(text)):
                    depth += {"{": 1, "}": -1}.get(text[end], 0)
                    if depth == 0:
                        break
                found[match.group(1)].append(text[start:end + 1])
    return found


def _is_there(member: str, types: dict[str, list[str]]) -> bool:
    path, _, parameters = member.partition("(")
    is_method = bool(parameters)
    owner, _, name = path.rpartition(".")
    if path[-1:] == "." or ".." in path:    # a constructor
        return bool(types.get(path.split("..")[0].split(".")[-1].split("+")[-1].partition("`")[0]))
    owner = re.split(r"[.+]", owner)[-1].partition("`")[0]
    name = re.sub(r"^(get|set|add|remove)_", "", name)
    if name.startswith("op_"):
        return any("operator" in text for text in types.get(owner, []))
    pattern = re.compile(rf"\b{name}\s*(?:<[\w, ]+>)?\s*\(" if is_method and not path.split(".")[-1] != name
                         else rf"(?<![\w.])(?:{name}|this)\s*(?:\[[^\]]*\]\s*)?(?:\{{|=>|=|;|,|\}})")
    for text in types.get(owner, []):
        for match in pattern.finditer(text):
            before = text[max(text.rfind(";", 0, match.start()), text.rfind("}", 0, match.start()),
                              text.rfind("{", 0, match.start())) + 1:match.start()]
            is_shown = "public" in before or "protected" in before or not is_method
            if "Obsolete" not in before and is_shown:
                return True
    return False


def main(git: str, names: str, *versions: str) -> None:
    """Print a line a member: its name alone where each version has it, else the versions that have it, or "nowhere"."""
    members = [line for line in Path(names).read_text(encoding="utf-8").splitlines() if line]
    wanted = {re.split(r"[.+]", part)[-1].partition("`")[0] for member in members
              for part in (member.partition("(")[0], member.partition("(")[0].rpartition(".")[0])}
    has: dict[str, list[str]] = defaultdict(list)
    for version in versions:
        types = _types(_sources(git, version), wanted)
        for member in members:
            last = re.split(r"[.+]", member)[-1].partition("`")[0]
            is_type = last in types and "(" not in member
            if (is_type and any("Obsolete" not in text.partition("{")[0] for text in types[last])) \
                    or (not is_type and _is_there(member, types)):
                has[member].append(version)
    print("# Members of Unity that the package uses, none obsolete, in the published sources of:", *versions)
    for member in members:
        print(member, *(has[member] or ["nowhere"] if len(has[member]) < len(versions) else []))


if __name__ == "__main__":
    main(*sys.argv[1:])

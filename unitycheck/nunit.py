"""Test files: only what Unity's NUnit 3.5 has, and only shapes that Unity's Test Runner runs."""

from __future__ import annotations

import functools
from typing import Iterator

from unitycheck.csharp import closing, tokens
from unitycheck.project import Project
from unitycheck.violation import Violation

# Owner.Member, or a single name, that NUnit gained after 3.5: those of 3.6 to 3.14 by the difference of the libraries.
MEMBERS = {("Assert", "Multiple"), ("Assert", "MultipleAsync"), ("Assert", "EnterMultipleScope"), ("Assert", "Warn"),
           ("Assert", "ThatAsync"), ("Is", "AnyOf"), ("Warn", "If"), ("Warn", "Unless"),
           ("TestContext", "Progress"), ("Has", "One"), ("Is", "Default"),
           ("Contains", "KeyValuePair")}
NAMES = {"UsingPropertiesComparer", "DefaultFloatingPointTolerance", "NonParallelizable", "FixtureLifeCycle",
         "CancelAfter", "SetArgDisplayNames", "AnyOf", "ClassicAssert", "ItemAt", "WithValue", "IgnoreWhiteSpace",
         "IgnoredTestCaseData", "CurrentRepeatCount", "DictionaryContainsKeyValuePairConstraint", "EmptyGuidConstraint",
         "CountZeroConstraint", "AnyOfConstraint", "IndexerConstraint", "LifeCycle", "AddTestAttachment"}


@functools.lru_cache(maxsize=2048)
def scan(source: str) -> list[tuple[int, str]]:
    """(line, what) for everything that NUnit 3.5 in Unity lacks or cannot run."""
    items = tokens(source)
    found = []
    for i, token in enumerate(items):
        member = items[i + 2].text if i + 2 < len(items) and items[i + 1].text == "." else ""
        name = token.text[:-len("Attribute")] if token.text.endswith("Attribute") else token.text
        if (token.text, member) in MEMBERS and (not i or items[i - 1].text != "."):
            found.append((token.line, f"{token.text}.{member}"))
        elif name in NAMES and not (i and items[i - 1].text == "." and (items[i - 2].text, name) in MEMBERS):
            found.append((token.line, name))
        if token.text == "async" and i + 2 < len(items) and items[i + 1].text in ("Task", "void", "ValueTask"):
            found.append((token.line, "an async test"))
        if token.text == "class" and i + 1 < len(items) and _holds_fixture(items, i):
            found.append((token.line, "a fixture nested in a class"))
    return sorted(set(found))


def _holds_fixture(items: list, i: int) -> bool:
    start = i
    while start < len(items) and items[start].text not in ("{", ";"):
        start += 1
    if start >= len(items) or items[start].text == ";":
        return False
    return any(token.text == "TestFixture" for token in items[start:closing(items, start)])


def check(project: Project) -> Iterator[Violation]:
    """Rule nunit: Assets/**/Tests keep to NUnit 3.5, synchronous, fixtures at the top level."""
    for path in project.assets(".cs"):
        if "/Tests/" in path:
            for line, what in scan(project.text(path)):
                yield Violation(path, line, "nunit", f"{what}: Unity's NUnit 3.5 has it not or does not run it")

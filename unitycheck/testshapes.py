"""Tests in Unity: fixtures that its NUnit can make, methods that its runner can call."""

from __future__ import annotations

import re
from typing import Iterator

from unitycheck.asmdefs import assemblies, owner
from unitycheck.behaviours import by_name, chain, descendants, types
from unitycheck.csharp import Token
from unitycheck.declarations import Attribute, Declaration, Method, split
from unitycheck.project import Project
from unitycheck.violation import Violation

_TESTS = {"Test", "TestCase", "TestCaseSource", "Theory", "UnityTest", "Combinatorial", "Pairwise", "Sequential"}
_AROUND = {"SetUp", "TearDown", "OneTimeSetUp", "OneTimeTearDown", "UnitySetUp", "UnityTearDown"}
_STARTED = _TESTS | _AROUND
_FILLS = {"Values", "ValueSource", "Range", "Random"}


def check(project: Project) -> Iterator[Violation]:
    """Rules test-fixture, test-method, unity-test, test-assembly."""
    asmdefs = assemblies(project)
    made_by_unity = descendants(project, {"MonoBehaviour", "ScriptableObject"})
    for path, declared in types(project).items():
        for declaration in declared:
            marked = [method for method in declaration.methods
                      if any(attribute.name in _STARTED for attribute in method.attributes)]
            is_fixture = declaration.has("TestFixture") or declaration.has("TestFixtureSource")
            if not marked and not is_fixture:
                continue
            assembly = owner(asmdefs, path)
            if assembly is not None and not assembly.is_test:
                yield Violation(path, declaration.line, "test-assembly",
                                f"{declaration.name} holds tests, {assembly.name} is no test assembly")
            yield from _values(project, path, declaration)
            yield from _fixture(path, declaration, bool(made_by_unity & {declaration.name, *declaration.bases}))
            for method in marked:
                yield from _method(project, path, declaration, method)


def _values(project: Project, path: str, declaration: Declaration) -> Iterator[Violation]:
    """Sources that stand on parameters: each must be a static member."""
    members = {member.name: member for base in chain(project, declaration) for member in [*base.fields, *base.methods]}
    for match in re.finditer(r"\[ValueSource\((?:nameof\((\w+)\)|\"(\w+)\")\)\]", project.text(path)):
        name = match.group(1) or match.group(2)
        others = {member.name for other in types(project)[path] for member in [*other.fields, *other.methods]}
        line = project.text(path).count("\n", 0, match.start()) + 1
        if name not in members and name not in others:
            yield Violation(path, line, "test-method", f"ValueSource: there is no source {name}")
        elif name in members and not {"static", "const"} & members[name].modifiers:
            yield Violation(path, line, "test-method", f"ValueSource: {name} must be static")


def _fixture(path: str, declaration: Declaration, is_made_by_unity: bool) -> Iterator[Violation]:
    if "abstract" in declaration.modifiers and "static" not in declaration.modifiers:
        return
    given = [split(attribute.arguments) for attribute in declaration.attributes if attribute.name == "TestFixture"]
    counts = {len([part for part in arguments if not _is_named(part)]) for arguments in given} or {0}
    makers = [method for method in declaration.methods if method.name == declaration.name and not method.returns
              and "static" not in method.modifiers]
    takes = {len(method.parameters) for method in makers if "public" in method.modifiers} if makers else {0}
    from_source = declaration.has("TestFixtureSource")
    reason = "is made by Unity, not by the runner" if is_made_by_unity else \
        f"is nested in {declaration.outer[-1]}, which Unity's runner does not look into" if declaration.outer else \
        "is generic and gets no types" if declaration.is_generic and counts == {0} and not from_source else \
        "is no class" if declaration.kind not in ("class", "record") else \
        "has no public constructor for what TestFixture gives it" if not from_source and not counts <= takes \
        and not declaration.is_generic else None
    if reason is not None:
        yield Violation(path, declaration.line, "test-fixture", f"the fixture {declaration.name} {reason}")


def _is_named(part: list[Token]) -> bool:
    return len(part) > 1 and part[0].kind == "word" and part[1].text == "="


def _method(project: Project, path: str, declaration: Declaration, method: Method) -> Iterator[Violation]:
    names = {attribute.name for attribute in method.attributes}
    reason = None
    rule = "test-method"
    if "public" not in method.modifiers:
        reason = "must be public"
    elif names & {"UnityTest", "UnitySetUp", "UnityTearDown"}:
        rule = "unity-test"
        if method.returns.rpartition(".")[2] != "IEnumerator":
            reason = f"must return IEnumerator, not {method.returns or 'nothing'}"
        elif names & {"TestCase", "TestCaseSource", "Theory"}:
            reason = "cannot have cases; ValueSource gives a UnityTest its values"
        elif "Test" in names:
            reason = "is a Test as well"
        elif method.parameters and "UnityTest" not in names:
            reason = "may have no parameters"
    elif names & _AROUND:
        if method.parameters or method.returns not in ("void",):
            reason = "must return void and have no parameters"
    elif method.returns.rpartition(".")[2] == "IEnumerator":
        rule, reason = "unity-test", "yields frames that nobody makes: UnityTest, not Test"
    elif method.is_generic and not names & {"TestCase", "TestCaseSource"}:
        reason = "is generic and gets no types"
    elif method.returns != "void" and not _expects(method):
        reason = f"returns {method.returns} and expects no result"
    elif method.returns == "void" and _expects(method):
        reason = "expects a result and returns none"
    if reason is not None:
        yield Violation(path, method.line, rule, f"{method.name} {reason}")
    elif names & _TESTS:
        yield from _arguments(project, path, declaration, method)


def _expects(method: Method) -> bool:
    if any(attribute.name == "TestCaseSource" for attribute in method.attributes):
        return method.returns != "void"  # a case may name its result
    return any(token.text == "ExpectedResult" for attribute in method.attributes for token in attribute.arguments)


def _arguments(project: Project, path: str, declaration: Declaration, method: Method) -> Iterator[Violation]:
    cases = [attribute for attribute in method.attributes if attribute.name == "TestCase"]
    sources = [attribute for attribute in method.attributes if attribute.name in ("TestCaseSource", "ValueSource")]
    count = len(method.parameters)
    is_open = any(kind.endswith("[]") for kind in method.parameters[-1:])  # may be params
    for case in cases:
        given = len([part for part in split(case.arguments) if not _is_named(part)])
        if given != count and not (is_open and given >= count - 1):
            yield Violation(path, case.line, "test-method", f"{method.name} has {count} parameters, its case {given}")
    for source in sources:
        yield from _source(project, path, declaration, method, source)
    if count and not cases and not sources and not _is_filled(project, path, method):
        yield Violation(path, method.line, "test-method", f"{method.name} has parameters and nothing that fills them")


def _is_filled(project: Project, path: str, method: Method) -> bool:
    """Whether the parameters themselves say their values: found in the text, because types do not keep attributes."""
    lines = project.text(path).split("\n")
    text = " ".join(lines[method.line - 1:method.line + 3])
    return any(f"[{name}" in text for name in _FILLS) or any(attribute.name in ("Theory",) for attribute in
                                                            method.attributes)


def _source(project: Project, path: str, declaration: Declaration, method: Method,
            source: Attribute) -> Iterator[Violation]:
    parts = split(source.arguments)
    words = [token.text for token in parts[0]] if parts else []
    home = declaration
    if words[:1] == ["typeof"] and len(words) > 2:
        found = by_name(project).get(words[2])
        if not found or len(parts) < 2:
            return
        home, words, parts = found[0], [token.text for token in parts[1]], parts[1:]
    name = words[2] if words[:2] == ["nameof", "("] and len(words) == 4 else \
        parts[0][0].value if words and parts[0][0].kind == "text" else None
    if name is None:
        return
    for base in chain(project, home):
        for member in [*base.fields, *base.methods]:
            if member.name == name:
                if "static" not in member.modifiers and "const" not in member.modifiers:
                    yield Violation(path, source.line, "test-method",
                                    f"{method.name}: its source {name} must be static")
                return
    yield Violation(path, source.line, "test-method", f"{method.name}: there is no source {name}")

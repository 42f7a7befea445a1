"""What the token scan sees of a C# file, and what it must not see."""

from __future__ import annotations

import pytest

from unitycheck.csharp import tokens, unity_source


def words(source: str) -> list[str]:
    return [token.text for token in tokens(source) if token.kind == "word"]


def test_comments_and_strings_are_gone() -> None:
    source = "a // b\n/* c\n d */ e = \"f \\\" g\" + @\"h \"\" i\" + 'j' + '\\'' + k;"
    assert words(source) == ["a", "e", "k"]


def test_holes_of_interpolated_strings_are_code() -> None:
    assert words("x = $\"a {b.C(\"d\")} {{e}} {f:0.0} {(g ? h : i)}\" + j;") == ["x", "b", "C", "f", "g", "h", "i", "j"]
    assert words("x = $@\"a \"\" {b} c\" + @$\"{d}\" + e;") == ["x", "b", "d", "e"]


def test_raw_strings_end_at_their_own_quotes() -> None:
    assert words("x = \"\"\"a \"b\" c\"\"\"; d();") == ["x", "d"]


def test_lines_count_through_comments_and_strings() -> None:
    source = "a\n/* x\n */ b @\"\n\n\" c\n$\"{d}\" e"
    found = {token.text: token.line for token in tokens(source) if token.kind == "word"}
    assert found == {"a": 1, "b": 3, "c": 5, "d": 6, "e": 6}


@pytest.mark.parametrize("condition, then, otherwise", [
    ("NET8_0_OR_GREATER", False, True), ("!NET8_0_OR_GREATER", True, False), ("UNITY_EDITOR", True, True),
    ("NET8_0_OR_GREATER && X", False, True), ("NET8_0_OR_GREATER || X", True, True), ("!(NET10_0 && true)", True,
                                                                                      False),
    ("false", False, True), ("true", True, False)])
def test_conditions(condition: str, then: bool, otherwise: bool) -> None:
    source = f"#if {condition}\na\n#else\nb\n#endif\nc"
    assert words(source) == ["a"] * then + ["b"] * otherwise + ["c"]


def test_nested_and_chained_conditions_keep_line_numbers() -> None:
    source = "#if NET8_0_OR_GREATER\n#if X\na\n#endif\n#elif !NET8_0\nb\n#else\nc\n#endif\nd"
    assert unity_source(source).split("\n") == ["", "", "", "", "", "b", "", "", "", "d"]

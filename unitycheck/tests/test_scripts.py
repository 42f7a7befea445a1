"""MonoBehaviours: name, form, messages, and which fields Unity stores."""

from __future__ import annotations

import pytest

from unitycheck.declarations import declarations
from unitycheck.fields import is_stored, stored_name

SPINNER = "Assets/Guidewire/Runtime/Spinner.cs"


def fields(body: str) -> list[str]:
    declaration = declarations(f"public class A : MonoBehaviour {{ {body} }}")[0]
    return [stored_name(field) for field in declaration.fields if is_stored(field)]


@pytest.mark.parametrize("body, stored", [
    ("public int A;", ["A"]), ("int _a;", []), ("private float _a = 3f;", []), ("[SerializeField] float _a = F(1, 2);",
                                                                                ["_a"]),
    ("[SerializeField, Range(0, 1)] private float _a, _b = 2f;", ["_a", "_b"]), ("public static int A;", []),
    ("public const int A = 3;", []), ("public readonly int A = 3;", []), ("[NonSerialized] public int A;", []),
    ("public int P { get; set; }", []), ("[field: SerializeField] public int P { get; set; } = 3;",
                                         ["<P>k__BackingField"]),
    ("public int P => 3;", []), ("public event System.Action E;", []),
    ("[SerializeField] private List<int> _a = new List<int>(), _b;", ["_a", "_b"]),
    ("[field: SerializeField] public int P { get; }", []), ("[SerializeField] private int P { get; set; }", []),
    ("void F() { int a; } public int B;", ["B"]), ("int F(int a) => a; public int B;", ["B"]),
    ("[Header(\"a\")] [Tooltip(\"b\")] [SerializeField] private string[] _names = { \"a\" };", ["_names"]),
    ("private struct P { public int X; } public int B;", ["B"]), ("public A() : this(3) { } public int B;", ["B"])])
def test_stored_fields(body: str, stored: list[str]) -> None:
    assert fields(body) == stored


def test_types_of_stored_fields() -> None:
    source = "class A : MonoBehaviour { public int[] A; [SerializeField] private List<float> _b; public B.C D; }"
    assert [(field.name, field.type) for field in declarations(source)[0].fields if is_stored(field)] == [
        ("A", "int[]"), ("_b", "List<float>"), ("D", "B.C")]


def test_class_called_otherwise(sample) -> None:
    sample.edit(SPINNER, "class Spinner", "class Spiner")
    assert (SPINNER, "script-name") in sample.broken()


@pytest.mark.parametrize("form", ["internal sealed class", "public abstract class"])
def test_class_that_cannot_be_attached(sample, form: str) -> None:
    sample.edit(SPINNER, "public sealed class", form)
    assert sample.broken() == {(SPINNER, "script-form")}


def test_behaviour_in_editor_assembly(sample) -> None:
    sample.add("Assets/Guidewire/Editor/Tool.cs",
               "using UnityEngine;\n\nnamespace A\n{\n    public class Tool : MonoBehaviour\n"
               "    {\n    }\n}\n")
    assert sample.broken() == {("Assets/Guidewire/Editor/Tool.cs", "script-form")}


@pytest.mark.parametrize("wrong", ["Updte", "update", "StartIO", "OnGui"])
def test_message_that_unity_never_sends(sample, wrong: str) -> None:
    sample.edit(SPINNER, "private void Update()", f"private void {wrong}()")
    assert sample.broken() == {(SPINNER, "script-message")}


def test_static_message(breakage) -> None:
    breakage(SPINNER, "private void Update()", "private static void Update()", "script-message")


def test_private_method_that_is_called_passes(sample) -> None:
    sample.edit(SPINNER, "private void Turn()",
                "private void Start()\n        {\n        }\n\n        private void Turn()")
    assert sample.broken() == set()

"""MonoBehaviours: name, form, messages, and which fields Unity stores."""

from __future__ import annotations

from tools.unitycheck import sources
from tools.unitycheck.project import Project

SPINNER = "Assets/Guidewire/Runtime/Spinner.cs"


def fields(sample, body: str) -> dict[str, sources.Field]:
    """What a scene may hold for a behaviour with these members."""
    sample.write(SPINNER, "using System;\nusing System.Collections.Generic;\nusing UnityEngine;\nnamespace A\n{\n"
                          f"public class Spinner : MonoBehaviour {{ {body} }}\n}}\n")
    return sources.scripts(Project(sample.root))[SPINNER].fields


STORED = (
    ("public int A;", ["A"]), ("int _a;", []), ("private float _a = 3f;", []),
    ("[SerializeField] float _a = F(1, 2); static float F(int a, int b) => a;", ["_a"]),
    ("[SerializeField, Range(0, 1)] private float _a, _b = 2f;", ["_a", "_b"]), ("public static int A;", []),
    ("public const int A = 3;", []), ("public readonly int A = 3;", []), ("[NonSerialized] public int A;", []),
    ("public int P { get; set; }", []), ("[field: SerializeField] public int P { get; set; } = 3;",
                                         ["<P>k__BackingField"]),
    ("public int P => 3;", []), ("public event System.Action E;", []),
    ("[SerializeField] private List<int> _a = new List<int>(), _b;", ["_a", "_b"]),
    ("[field: SerializeField] public int P { get; }", []), ("[SerializeField] private int P { get; set; }", []),
    ("void F() { int a; } public int B;", ["B"]), ("int F(int a) => a; public int B;", ["B"]),
    ("[Header(\"a\")] [Tooltip(\"b\")] [SerializeField] private string[] _names = { \"a\" };", ["_names"]),
    ("private struct P { public int X; } public int B;", ["B"]))


def test_stored_fields(sample) -> None:
    for body, stored in STORED:
        assert list(fields(sample, body)) == stored, body


def test_types_of_stored_fields(sample) -> None:
    found = fields(sample, "public int[] A; [SerializeField] private List<float> _b; public B.C D;"
                           " public Camera E = null!; [UnityEngine.Serialization.FormerlySerializedAs(\"f\"), Range(0.01f, 2)] public float F;"
                           " public class B { public enum C { One = 1, Four = 4 } }")
    assert {name: (item.kind, item.type, item.is_list, item.is_needed) for name, item in found.items()} == {
        "A": ("number", "int", True, False), "_b": ("number", "float", True, False), "D": ("enum", "C", False, False),
        "E": ("object", "Camera", False, True), "F": ("number", "float", False, False)}
    assert (found["D"].values, found["F"].names, found["F"].range) == ({1, 4}, ("f",), (0.01, 2.0))


def test_behaviour_in_editor_assembly(sample) -> None:
    sample.add("Assets/Guidewire/Editor/Tool.cs",
               "using UnityEngine;\n\nnamespace A\n{\n    public class Tool : MonoBehaviour\n"
               "    {\n    }\n}\n")
    assert sample.broken() == {("Assets/Guidewire/Editor/Tool.cs", "script-form")}

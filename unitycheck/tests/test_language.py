"""Each feature beyond C# 9 is found; what looks like it in C# 9 is not."""

from __future__ import annotations

import pytest

from unitycheck import language

BEYOND = {
    "file-scoped namespace": ["namespace A.B;\nclass C { }"],
    "global using": ["global using System;"],
    "record struct": ["public readonly record struct P(int X);"],
    "record class": ["public record class P(int X);"],
    "constant interpolated string": ["class C { const string A = $\"x{B}\"; }"],
    "extended property pattern": ["bool b = x is { A.B: 3 };"],
    "struct initialiser": ["struct S { public S() { } }", "struct S { public int X = 3; }",
                           "struct S { int P { get; } = 3; }"],
    "lambda without target type": ["var f = (int x) => x;", "var f = () => 1;", "var f = static x => x;"],
    "lambda return type": ["Func<int, int> f = int (x) => x;"],
    "lambda attribute": ["Action f = [Obsolete] () => Run();"],
    "with on a value": ["var p = q with { X = 3 };"],
    "required member": ["class C { public required int X; }", "class C { required string Name { get; set; } }"],
    "raw string": ["var s = \"\"\"a \"b\" c\"\"\";", "var s = $\"\"\"{x}\"\"\";"],
    "list pattern": ["if (x is [1, 2]) { }", "switch (x) { case [1, ..]: break; }",
                     "var y = x switch { [1] => 2, _ => 3 };"],
    "static abstract member": ["interface I { static abstract int Zero { get; } }",
                               "interface I { abstract static void F(); }"],
    "file-local type": ["file class C { }", "file static class C { }"],
    "generic attribute": ["class C { [Made<int>] void F() { } }", "[Made<int>(3)] class C { }",
                          "class MadeAttribute<T> : Attribute { }"],
    "UTF-8 literal": ["var s = \"abc\"u8;"],
    "checked operator": ["public static C operator checked +(C a, C b) => a;"],
    "ref field": ["ref struct S { private ref int _x; }"],
    "scoped": ["void F(scoped Span<int> x) { }", "void F(scoped ref int x) { }"],
    "unsigned shift": ["int y = x >>> 2;", "y >>>= 2;", "int z = (a + b) >>> n;"],
    "collection expression": ["int[] x = [1, 2];", "F([1, 2]);", "F(a, [1, 2]);", "return [];", "int[] X => [1];",
                              "x = a ? [1] : [2];"],
    "primary constructor": ["class C(int x) { }", "struct S<T>(T x) { }", "sealed class D(int x) : C(x) { }"],
    "alias of any type": ["using Pair = (int, int);", "using Row = double[];"],
    "ref readonly parameter": ["void F(ref readonly int x) { }"],
    "lambda default": ["F f = (int x = 1) => x;"],
    "params collection": ["void F(params ReadOnlySpan<int> x) { }"],
    "allows ref struct": ["class C<T> where T : allows ref struct { }"],
    "field keyword": ["class C { int P { get => field; set => field = value; } }",
                      "class C { int P { get; set { field = value; } } }"],
    "extension block": ["static class C { extension(int x) { int Twice => 2 * x; } }"],
    "null-conditional assignment": ["a?.B = 3;"],
}

WITHIN = [
    "namespace A.B\n{\n    class C { }\n}",
    "using System;\nusing static System.Math;\nusing Row = System.Collections.Generic.List<int>;",
    "class C { global::System.Int32 x; }",
    "class C { const string A = \"x{B}\"; string D = $\"{A,5:0.00} {(A.Length > 1 ? \"a\" : \"b\")}\"; }",
    "bool b = x is { A: { B: 3 } };\nvar y = x switch { { A: 1 } => 2, _ => 3 };",
    "readonly struct S { public readonly int X; public S(int x) { X = x; } public static S Zero => new S(0);\n"
    "static readonly int Y = 3; const int Z = 4; int P => X; public static S Make() { return new S(); } }",
    "Func<int, int> f = x => x;\nAction a = () => { };\nFunc<int, int> g = static (int x) => x;",
    "var y = F(x => x);\nvar z = (a, b);\nvar w = new int[] { 1 };",
    "[Obsolete] void F([CallerMemberName] string s = \"\", [In] int x = 3) { }",
    "class C { [SerializeField, Range(1, 2)] private float[] _x = new float[3]; int this[int i] => _x[i]; }",
    "var s = @\"a \"\"\"\" b\";\nvar t = \"\";\nvar u = \"required file field with { x }\";",
    "// namespace A;\n/* global using X; record struct */",
    "var list = new List<List<List<int>>>();\nDictionary<int, List<List<int>>> x = null;\nint y = x >> 2;",
    "abstract class C { abstract void F(); static void G() { } }",
    "class C<T> where T : class { }\nclass D<T> where T : struct, IComparable<T> { }",
    "ref int F(ref int x, in int y, out int z) { ref int a = ref x; z = y; return ref a; }",
    "ref struct S { private Span<int> _x; public ref int Get() { return ref _x[0]; } }",
    "void F(params int[] x) { }\nvoid F(params List<int>[] x) { }",
    "class C { int field; int P { get => field; set => field = value; } }",
    "class C { [field: SerializeField] public int P { get; set; } }",
    "if (x is 1 or 2 and not 3) { }\nif (x is not null) { }",
    "int[,] grid = new int[2, 3];\nvar v = grid[1, 2];\nF(x[0], y[1]);\nint[][] jagged = { x[0] };",
    "a?.F();\nvar y = a?.B ?? 3;\nvar z = a?[0];",
    "#if NET8_0_OR_GREATER\nnamespace A;\nint[] x = [1];\n#else\nclass C { }\n#endif",
    "static int F(int x) => x;\nstatic void G() => H();\nasync void H() => await I();",
    "string required = \"\";\nint file = 3;\nF(required, file, scoped);",
    "var x = flag ? a[0] : b[1];\nvar y = (int[])z;\nreturn x[0];",
]


@pytest.mark.parametrize("feature", sorted(BEYOND))
def test_feature_is_found(feature: str) -> None:
    for source in BEYOND[feature]:
        assert feature in [name for _, name in language.scan(source)], source


@pytest.mark.parametrize("source", WITHIN)
def test_csharp_9_passes(source: str) -> None:
    assert language.scan(source) == []


def test_every_feature_has_a_failing_case() -> None:
    assert set(BEYOND) == set(language._VERSION)


def test_line_is_named() -> None:
    assert language.scan("class C\n{\n    int[] x =\n        [1];\n}\n") == [(4, "collection expression")]


def test_file_is_named(sample) -> None:
    path = "Assets/Guidewire/Core/Number.cs"
    sample.edit(path, "namespace Guidewire.Core\n{", "namespace Guidewire.Core;\n{")
    assert sample.broken() == {(path, "language")}


def test_init_needs_its_class(sample) -> None:
    path = "Assets/Guidewire/Core/Number.cs"
    sample.edit(path, "    {\n    }", "    {\n        public int X { get; init; }\n    }")
    assert sample.broken() == {(path, "init-accessor")}
    sample.add("Assets/Guidewire/Core/IsExternalInit.cs",
               "namespace System.Runtime.CompilerServices\n{\n"
               "    internal static class IsExternalInit\n    {\n    }\n}\n")
    assert sample.broken() == set()

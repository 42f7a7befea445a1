"""Breakages of language and library level, beyond C# 9 and netstandard2.1, and of the engine-free wall."""

from __future__ import annotations

from tools.unitycheck.tests.breakages import GUIDEWIRE, HUD, LOOP, MANIFEST, VECTOR, Breakage, insert, replace

TESTS = f"{GUIDEWIRE}/Tests/Core/Wires.cs"


def code(text: str, rule: str, path: str = VECTOR) -> Breakage:
    return Breakage(insert(path, text), path, rule)


BREAKAGES = {
    "UnityEngine in Core": Breakage(replace(VECTOR, "^using System;", "using UnityEngine;\nusing System;"), VECTOR,
                                    "CS0246"),
    "Unity type by its full name": code("private UnityEngine.Vector3 _v;", "CS0246"),
    "Unity type by an alias": Breakage(replace(VECTOR, "^using System;", "using V = UnityEngine.Vector3;"), VECTOR,
                                       "CS0246"),
    "engine in the shared tests": code("private UnityEngine.Vector3 _v;", "CS0246", TESTS),
    "file-scoped namespace": Breakage(replace(VECTOR, r"^namespace Guidewire.Core\n\{", "namespace Guidewire.Core;\n{"),
                                      VECTOR, "CS8773"),
    "collection expression": code("private static readonly int[] A = [1, 2];", "CS1525"),
    "record struct": Breakage(replace(VECTOR, "readonly struct", "readonly record struct"), VECTOR, "CS8773"),
    "raw string": code('private const string A = """b""";', "CS8652"),
    "global using": Breakage(replace(VECTOR, "^using System;", "global using System;"), VECTOR, "CS8773"),
    "primary constructor": Breakage(replace(LOOP, "class SimulationLoop ", "class SimulationLoop(int x) "), LOOP,
                                    "CS1514"),
    "required member": code("public required int A;", "CS8652", HUD),
    "list pattern": code("private bool A(int[] a) => a is [1, ..];", "CS8652", HUD),
    "struct constructor": code("public Vector3d() { X = 0; Y = 0; Z = 0; }", "CS8773"),
    "ref field": code("private ref int _a;", "CS8652"),
    "init accessor": code("public int A { get; init; }", "CS0518"),
    "record": code("private record Pair(int A, int B);", "CS0518", HUD),
    "fused multiply-add": code("private double A => Math.FusedMultiplyAdd(X, Y, Z);", "CS0117"),
    "shared random numbers": code("private double A => System.Random.Shared.NextDouble();", "CS0117", HUD),
    "intrinsics without a condition": Breakage(
        replace(VECTOR, "^using System;", "using System.Runtime.Intrinsics;"), VECTOR, "CS0234"),
    "Json of .NET": Breakage(replace(HUD, "^using System.Text;", "using System.Text.Json;"), HUD, "CS0234"),
    "guard of .NET 6": code("private void A(object a) { System.ArgumentNullException.ThrowIfNull(a); }", "CS0117", HUD),
    "IsFinite in an editor-only assembly": code("private static bool A(double a) => double.IsFinite(a);", "api-editor",
                                                TESTS),
    "float's IsFinite in the editor": code("private static bool A(float a) => float.IsFinite(a);", "api-editor",
                                           f"{GUIDEWIRE}/Editor/PlayerBuild.cs"),
    "range in an editor-only test": code("private static int[] A(int[] a) => a[1..];", "api-editor", TESTS),
    "Span in the editor": code("private static int A() => System.MemoryExtensions.AsSpan(\"a\").Length;", "api-editor",
                               f"{GUIDEWIRE}/Editor/PlayerBuild.cs"),
    "module of IMGUI missing": Breakage(replace(MANIFEST, r'    "com.unity.modules.imgui": "1.0.0",\n', ""), HUD,
                                        "module-missing"),
    "class of a module that is missing": code("private UnityEngine.AudioSource _a = null!;", "module-missing", HUD),
    "line of 130 columns": Breakage(replace(VECTOR, "^    public", 110 * " " + "/* wide */ public"), VECTOR,
                                    "text-wide"),
    "CRLF": Breakage(replace(VECTOR, "^using System;", "using System;\r"), VECTOR, "text-crlf"),
    "tab": Breakage(replace(VECTOR, "^    public", "\tpublic"), VECTOR, "text-tab"),
    "byte order mark": Breakage(lambda project: {VECTOR: b"\xef\xbb\xbf" + project.data(VECTOR)}, VECTOR, "text-bom"),
    "Latin-1": Breakage(lambda project: {VECTOR: project.data(VECTOR) + b"// \xe9\n"}, VECTOR, "text-utf8"),
    "no line end": Breakage(lambda project: {VECTOR: project.data(VECTOR).rstrip()}, VECTOR, "text-end"),
    "conflict in a source": Breakage(replace(VECTOR, "^using System;", "<<<<<<< HEAD\nusing System;"), VECTOR,
                                     "text-conflict"),
}

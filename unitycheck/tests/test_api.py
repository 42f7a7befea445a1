"""APIs that Unity's netstandard2.1 lacks are found unless .NET alone compiles them."""

from __future__ import annotations

import pytest

from unitycheck import api

LACKING = ["Vector256<double> x;", "Vector128.Create(1)", "Math.FusedMultiplyAdd(a, b, c)", "BitOperations.PopCount(x)",
           "Random.Shared.Next()", "ArgumentNullException.ThrowIfNull(x);",
           "System.Text.Json.JsonSerializer.Serialize(x)",
           "using System.Text.Json;", "Unsafe.As<int, float>(ref x)", "MemoryMarshal.GetArrayDataReference(x)",
           "CollectionsMarshal.AsSpan(x)", "NativeMemory.Alloc(8)", "Math.Log2(x)", "Environment.ProcessPath",
           "using System.Runtime.Intrinsics.X86;", "[ModuleInitializer] static void F() { }",
           "[SkipLocalsInit] void F() { }",
           "Enum.GetValues<Kind>()", "new PriorityQueue<int, int>()", "Environment.TickCount64",
           "Stopwatch.GetElapsedTime(t)",
           "var s = $\"{Random.Shared.Next()}\";"]
PRESENT = ["Math.Sqrt(x)", "Span<double> x = stackalloc double[4];", "MemoryMarshal.Cast<byte, int>(x)",
           "Math.Clamp(a, b, c)",
           "Enum.GetValues(typeof(Kind))", "_random.Shared()", "settings.Log2(x)", "using System.Text;",
           "GC.Collect();",
           "unsafe { }", "// Vector256 is not here", "var s = \"Random.Shared\";", "HashCode.Combine(a, b)",
           "#if NET8_0_OR_GREATER\nVector256<double> x;\n#endif"]


@pytest.mark.parametrize("source", LACKING)
def test_lacking(source: str) -> None:
    assert len(api.scan(source)) >= 1


@pytest.mark.parametrize("source", PRESENT)
def test_present(source: str) -> None:
    assert api.scan(source) == []


def test_file_is_named(breakage) -> None:
    breakage("Assets/Guidewire/Core/Number.cs", "    {\n    }", "    {\n        double F(double x) => "
             "System.Math.FusedMultiplyAdd(x, x, x);\n    }", "api")

"""API level: names of the base library that netstandard2.1 does not have, or that Unity keeps from its users."""

from __future__ import annotations

import functools
from typing import Iterator

from unitycheck.asmdefs import assemblies, owner
from unitycheck.csharp import Token, tokens
from unitycheck.project import Project
from unitycheck.violation import Violation

# Single names, absent from netstandard2.1 under any owner.
NAMES = {
    "BitOperations", "Vector64", "Vector128", "Vector256", "Vector512", "FusedMultiplyAdd", "BitIncrement",
    "BitDecrement",
    "CollectionsMarshal", "NativeMemory", "GetArrayDataReference", "ThrowIfNull", "ThrowIfNullOrEmpty",
    "ThrowIfNullOrWhiteSpace", "ThrowIfNegative", "ThrowIfNegativeOrZero", "ThrowIfZero", "ThrowIfGreaterThan",
    "ThrowIfLessThan",
    "ThrowIfEqual", "ThrowIfNotEqual", "ThrowIfGreaterThanOrEqual", "ThrowIfLessThanOrEqual",
    "DefaultInterpolatedStringHandler", "ModuleInitializer", "SkipLocalsInit", "CallerArgumentExpression",
    "DateOnly", "TimeOnly",
    "PriorityQueue", "Int128", "UInt128", "FrozenDictionary", "FrozenSet", "SearchValues", "PeriodicTimer",
    "CompositeFormat", "MemberNotNull", "MemberNotNullWhen", "SetsRequiredMembers", "UnreachableException",
    "InlineArray",
    "OverloadResolutionPriority", "StringSyntax", "PosixSignalRegistration",
    "AllocateUninitializedArray", "ToHexString", "TryGetNonEnumeratedCount", "MaxBy", "MinBy", "DistinctBy",
    "ForEachAsync", "WaitForExitAsync", "CreateTempSubdirectory", "GetElapsedTime", "IBinaryInteger",
    "INumber", "IFloatingPoint", "ISpanParsable", "IParsable", "ISpanFormattable",
}

# Owner.Member pairs whose single names would be too common to forbid.
MEMBERS = {
    ("Random", "Shared"), ("Math", "Log2"), ("Math", "ScaleB"), ("Math", "ILogB"), ("Math", "CopySign"),
    ("Math", "Tau"),
    ("Math", "MaxMagnitude"), ("Math", "MinMagnitude"), ("Math", "ReciprocalEstimate"), ("Math", "SinCos"),
    ("Environment", "ProcessPath"), ("Environment", "ProcessId"), ("Environment", "TickCount64"),
    ("GC", "GetTotalAllocatedBytes"), ("GC", "GetGCMemoryInfo"), ("GC", "GetTotalPauseDuration"), ("Path", "Exists"),
    ("SHA256", "HashData"), ("MD5", "HashData"), ("double", "Lerp"), ("double", "Clamp"), ("double", "Sqrt"),
    ("double", "Abs"),
    ("Array", "MaxLength"), ("Thread", "UnsafeStart"), ("Stopwatch", "GetElapsedTime"), ("File", "OpenHandle"),
    ("File", "AppendAllBytes"), ("OperatingSystem", "IsWindows"), ("OperatingSystem", "IsLinux"),
    ("RuntimeInformation", "RuntimeIdentifier"), ("CancellationTokenSource", "TryReset"),
}

# Static members of netstandard2.1 that .NET Framework, the profile that editor-only assemblies may get, does not have:
# the difference of the two reference assemblies. One such call there stops all compilation.
FRAMEWORK_LACKS = {
    "Array": {"Fill"}, "BitConverter": {"Int32BitsToSingle", "SingleToInt32Bits", "TryWriteBytes"},
    "Convert": {"TryFromBase64Chars", "TryFromBase64String", "TryToBase64Chars"},
    "double": {"IsFinite", "IsNegative", "IsNormal", "IsSubnormal"},
    "File": {"AppendAllLinesAsync", "AppendAllTextAsync", "ReadAllBytesAsync", "ReadAllLinesAsync", "ReadAllTextAsync",
             "WriteAllBytesAsync", "WriteAllLinesAsync", "WriteAllTextAsync"},
    "Path": {"GetRelativePath", "IsPathFullyQualified", "Join", "TryJoin"}, "Enumerable": {"SkipLast", "TakeLast"},
    "Math": {"Acosh", "Asinh", "Atanh", "Cbrt", "Clamp"}, "string": {"Create"},
    "StringComparer": {"FromComparison"}, "Interlocked": {"MemoryBarrierProcessWide"},
    "Thread": {"GetCurrentProcessorId"}, "Type": {"MakeGenericMethodParameter"},
}
FRAMEWORK_LACKS |= {"float": FRAMEWORK_LACKS["double"], "Double": FRAMEWORK_LACKS["double"],
                    "Single": FRAMEWORK_LACKS["double"], "String": FRAMEWORK_LACKS["string"]}

NAMESPACES = (
    ("System", "Text", "Json"), ("System", "Runtime", "Intrinsics"), ("System", "Collections", "Immutable"),
    ("System", "Collections", "Frozen"), ("System", "Numerics", "Tensors"), ("System", "Threading", "Channels"),
    ("System", "IO", "Pipelines"), ("System", "Formats"), ("System", "Diagnostics", "Metrics"),
)


def _starts(items: list[Token], i: int, words: tuple[str, ...]) -> bool:
    for offset, word in enumerate(words):
        place = i + 2 * offset
        if place >= len(items) or items[place].text != word:
            return False
        if offset and items[place - 1].text != ".":
            return False
    return True


@functools.lru_cache(maxsize=2048)
def scan(source: str) -> list[tuple[int, str]]:
    """(line, name) for every use of an API that Unity's netstandard2.1 lacks."""
    items = tokens(source)
    found = []
    for i, token in enumerate(items):
        if token.kind != "word":
            continue
        before = items[i - 1].text if i else ""
        after = items[i + 1].text if i + 1 < len(items) else ""
        member = items[i + 2].text if i + 2 < len(items) else ""
        name = token.text[:-len("Attribute")] if token.text.endswith("Attribute") else token.text
        if name in NAMES:
            found.append((token.line, name))
        is_outermost = before != "." or (i > 1 and items[i - 2].text == "System")
        if after == "." and is_outermost and (token.text, member) in MEMBERS:
            found.append((token.line, f"{token.text}.{member}"))
        if token.text == "Unsafe" and after == ".":
            found.append((token.line, "System.Runtime.CompilerServices.Unsafe"))
        if before != "." and token.text == "System":
            found += [(token.line, ".".join(words)) for words in NAMESPACES if _starts(items, i, words)]
        if token.text == "Enum" and after == "." and member in ("GetValues", "GetNames", "GetName", "IsDefined") and \
                i + 3 < len(items) and items[i + 3].text == "<":
            found.append((token.line, f"Enum.{member}<T>"))
    return sorted(set(found))


@functools.lru_cache(maxsize=4096)
def framework_scan(source: str) -> list[tuple[int, str]]:
    """(line, name) for every static member that .NET Framework lacks."""
    items = tokens(source)
    return [(token.line, f"{token.text}.{items[i + 2].text}") for i, token in enumerate(items[:-2])
            if token.text in FRAMEWORK_LACKS and items[i + 1].text == "."
            and items[i + 2].text in FRAMEWORK_LACKS[token.text]
            and (not i or items[i - 1].text != "." or items[i - 2].text == "System")]


def check(project: Project) -> Iterator[Violation]:
    """Rules api (outside `#if NET8_0_OR_GREATER` only what netstandard2.1 has) and api-editor."""
    for path in project.assets(".cs"):
        for line, name in scan(project.text(path)):
            yield Violation(path, line, "api", f"{name} is not in Unity's netstandard2.1")
        assembly = owner(assemblies(project), path)
        if assembly is not None and assembly.is_editor_only:
            for line, name in framework_scan(project.text(path)):
                yield Violation(path, line, "api-editor", f"{name} may be missing in an editor-only assembly")

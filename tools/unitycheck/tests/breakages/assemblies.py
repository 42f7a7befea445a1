"""Breakages of assembly definitions, their references, platforms, constraints and compiler options."""

from __future__ import annotations

from tools.unitycheck.tests.breakages import (
    GUIDEWIRE, HUD, LOOP, RUNTIME, VECTOR, Breakage, both, insert, remove, replace,
)
from tools.unitycheck.tests.breakages import write

CORE = f"{GUIDEWIRE}/Core/Guidewire.Core.asmdef"
IO = f"{GUIDEWIRE}/Io/Guidewire.Io.asmdef"
PLAYER = f"{RUNTIME}/Guidewire.Runtime.asmdef"
EDITOR = f"{GUIDEWIRE}/Editor/Guidewire.Editor.asmdef"
TESTS = f"{GUIDEWIRE}/Tests/Core/Guidewire.Core.Tests.asmdef"
UNITY_TESTS = f"{GUIDEWIRE}/Tests/Unity/Guidewire.Unity.Tests.asmdef"
PLAY_TESTS = f"{GUIDEWIRE}/Tests/Unity/Play/Guidewire.Unity.PlayTests.asmdef"
PLAY_SOURCE = f"{GUIDEWIRE}/Tests/Unity/Play/WirePlayTests.cs"
RSP = f"{RUNTIME}/csc.rsp"
REFERENCE = f"{RUNTIME}/Views/Views.asmref"


def asmdef(path: str, old: str, new: str, rule: str) -> Breakage:
    return Breakage(replace(path, old, new), path, rule)


def missing(path: str, name: str, source: str, error: str) -> Breakage:
    """A reference that is gone, and a source that needs it."""
    return Breakage(replace(path, name, ""), source, error)


def option(line: str) -> Breakage:
    return Breakage(write(RSP, f"-nullable:enable\n{line}\n"), RSP, "rsp-option")


def reference(text: str, rule: str = "asmref") -> Breakage:
    return Breakage(write(REFERENCE, text), REFERENCE, rule)


def constraint(text: str, path: str = PLAYER) -> Breakage:
    old = r'"defineConstraints": \[[^]]*\]'
    return asmdef(path, old, f'"defineConstraints": [{text}]', "asmdef-constraint")


BREAKAGES = {
    # References
    "cycle": asmdef(CORE, r'"references": \[\]', '"references": ["Guidewire.Io"]', "asmdef-cycle"),
    "reference misspelt": asmdef(IO, '"Guidewire.Core"', '"Guidewire.Kore"', "asmdef-reference"),
    "reference to a dll": asmdef(IO, '"Guidewire.Core"', '"Guidewire.Core.dll"', "asmdef-reference"),
    "reference by an unknown guid": asmdef(IO, '"Guidewire.Core"', '"GUID:0123456789abcdef0123456789abcdef"',
                                           "asmdef-reference"),
    "reference twice": asmdef(IO, '"Guidewire.Core"', '"Guidewire.Core", "Guidewire.Core"', "asmdef-reference"),
    "reference to itself": asmdef(IO, '"Guidewire.Core"', '"Guidewire.Core", "Guidewire.Io"', "asmdef-reference"),
    "reference to a package that is not there": asmdef(PLAYER, '"Guidewire.Io"', '"Guidewire.Io", "Unity.Burst"',
                                                       "asmdef-reference"),
    "namespace of an assembly that is not referenced": Breakage(
        replace(LOOP, "^using UnityEngine;", "using Guidewire.Editor;\nusing UnityEngine;"), LOOP, "CS0234"),
    "reference missing": missing(PLAYER, r'"Guidewire.Core",\s*', LOOP, "CS0246"),
    "reference of the editor missing": missing(EDITOR, r',\s*"Guidewire.Runtime"',
                                               f"{GUIDEWIRE}/Editor/BatchEntry.cs", "CS0234"),
    "reference of the tests missing": missing(TESTS, r'"Guidewire.Io",\s*',
                                              f"{GUIDEWIRE}/Tests/Core/Io/CommandLineHandlerTests.cs", "CS0234"),
    "reference of the play tests missing": missing(PLAY_TESTS, r'"Guidewire.Runtime",\s*', PLAY_SOURCE, "CS0234"),
    "runner missing that a test uses": asmdef(PLAY_TESTS, r'"UnityEngine.TestRunner",\s*', "", "asmdef-test"),
    "tests of one assembly used by another": Breakage(insert(PLAY_SOURCE, "private TubeMeshTests? _other;"),
                                                      PLAY_SOURCE, "CS0246"),
    "reference that is a number": asmdef(IO, '"Guidewire.Core"', '"Guidewire.Core", 3', "asmdef-form"),
    "references that are no list": asmdef(IO, r'"references": \[[^]]*\]', '"references": "Guidewire.Core"',
                                          "asmdef-form"),
    "player needs the editor": asmdef(PLAYER, '"Guidewire.Io"', '"Guidewire.Io", "Guidewire.Editor"', "asmdef-editor"),
    "player needs the tests": asmdef(PLAYER, '"Guidewire.Io"', '"Guidewire.Io", "Guidewire.Unity.PlayTests"',
                                     "asmdef-test"),
    "Core needs Runtime": asmdef(CORE, r'"references": \[\]', '"references": ["Guidewire.Runtime"]', "asmdef-engine"),
    "wall around Core opened": asmdef(CORE, '"noEngineReferences": true', '"noEngineReferences": false',
                                      "asmdef-engine"),
    "internals not shown": Breakage(replace(f"{RUNTIME}/AssemblyInfo.cs", "Guidewire.Unity.Tests",
                                            "Guidewire.Unity.Test"),
                                    f"{GUIDEWIRE}/Tests/Unity/TubeMeshTests.cs", "CS0122"),
    "internals shown to nobody": Breakage(replace(f"{RUNTIME}/AssemblyInfo.cs", "Guidewire.Unity.PlayTests",
                                                  "Guidewire.Unity.PlayTest"), f"{RUNTIME}/AssemblyInfo.cs",
                                          "internals"),
    # Precompiled
    "dll without its ending": asmdef(IO, "Newtonsoft.Json.dll", "Newtonsoft.Json", "asmdef-precompiled"),
    "dll of another spelling": asmdef(IO, "Newtonsoft.Json.dll", "NewtonSoft.Json.dll", "asmdef-precompiled"),
    "dll that is not there": asmdef(IO, '"Newtonsoft.Json.dll"', '"Newtonsoft.Json.dll", "Other.dll"',
                                    "asmdef-precompiled"),
    "dll twice": asmdef(IO, '"Newtonsoft.Json.dll"', '"Newtonsoft.Json.dll", "Newtonsoft.Json.dll"',
                        "asmdef-precompiled"),
    "dlls that do not count": asmdef(IO, '"overrideReferences": true', '"overrideReferences": false',
                                     "asmdef-precompiled"),
    "dll missing that is used": missing(IO, '"Newtonsoft.Json.dll"', f"{GUIDEWIRE}/Io/Runs/RunSummary.cs", "CS0246"),
    "override without a list": Breakage(both(
        replace(PLAYER, '"overrideReferences": false', '"overrideReferences": true'),
        replace(HUD, "^using UnityEngine;", "using Newtonsoft.Json;\nusing UnityEngine;")), HUD, "CS0246"),
    "tests without NUnit": asmdef(TESTS, r'"nunit.framework.dll",\s*', "", "asmdef-test"),
    "package of a dll missing": Breakage(replace("Packages/manifest.json",
                                                 r'    "com.unity.nuget.newtonsoft-json": "3.2.1",\n', ""), IO,
                                         "asmdef-precompiled"),
    # Constraints
    "constraint of a lone sign": constraint('"!"'),
    "constraint with and": constraint('"UNITY_EDITOR && DEBUG"'),
    "constraint with a blank": constraint('"UNITY EDITOR"'),
    "constraint of an unknown symbol": constraint('"GUIDEWIRE_ON"'),
    "constraint of another platform": constraint('"UNITY_ANDROID"', EDITOR),
    "constraint of an old editor": constraint('"UNITY_2019_4"'),
    "constraint of a later editor": constraint('"UNITY_7000_OR_NEWER"'),
    "constraint and its opposite": constraint('"DEBUG", "!DEBUG"'),
    "constraint against what always holds": constraint('"!UNITY_5_3_OR_NEWER"'),
    "player for tests only": constraint('"UNITY_INCLUDE_TESTS"'),
    "player for the editor only": constraint('"UNITY_EDITOR"'),
    "editor against the editor": constraint('"!UNITY_EDITOR"', EDITOR),
    "tests in players": asmdef(TESTS, '"UNITY_INCLUDE_TESTS"', "", "asmdef-test"),
    # Platforms
    "editor left out": asmdef(CORE, r'"excludePlatforms": \[\]', '"excludePlatforms": ["Editor"]', "asmdef-platform"),
    "editor not included": asmdef(CORE, r'"includePlatforms": \[\]', '"includePlatforms": ["LinuxStandalone64"]',
                                  "asmdef-platform"),
    "tests not in the editor": asmdef(TESTS, r'"includePlatforms": \[\s*"Editor"', '"includePlatforms": ["Android"',
                                      "asmdef-platform"),
    "unknown platform": asmdef(CORE, r'"excludePlatforms": \[\]', '"excludePlatforms": ["Linux"]', "asmdef-platform"),
    "Linux players left out": asmdef(CORE, r'"excludePlatforms": \[\]', '"excludePlatforms": ["LinuxStandalone64"]',
                                     "asmdef-platform"),
    "both lists of platforms": asmdef(EDITOR, r'"excludePlatforms": \[\]', '"excludePlatforms": ["Android"]',
                                      "asmdef-form"),
    # Files
    "two definitions in a folder": Breakage(write(f"{RUNTIME}/Other.asmdef", '{"name": "Other"}\n'),
                                            f"{RUNTIME}/Other.asmdef", "asmdef-folder"),
    "definition gone": Breakage(remove(PLAYER), LOOP, "asmdef-outside"),
    "Core's definition gone": Breakage(remove(CORE), IO, "asmdef-reference"),
    "name of another assembly": asmdef(EDITOR, '"name": "Guidewire.Editor"', '"name": "Guidewire.Runtime"',
                                       "asmdef-name"),
    "name unlike the file": asmdef(EDITOR, '"name": "Guidewire.Editor"', '"name": "Guidewire.Editing"', "asmdef-name"),
    "name empty": asmdef(EDITOR, '"name": "Guidewire.Editor"', '"name": ""', "asmdef-form"),
    "name a number": asmdef(EDITOR, '"name": "Guidewire.Editor"', '"name": 3', "asmdef-form"),
    "list for an object": Breakage(write(EDITOR, "[]\n"), EDITOR, "asmdef-form"),
    "nothing in the file": Breakage(write(EDITOR, ""), EDITOR, "json"),
    "key misspelt": asmdef(IO, "noEngineReferences", "noEngineReference", "asmdef-form"),
    "key twice": asmdef(IO, '"noEngineReferences": true', '"noEngineReferences": true, "noEngineReferences": true',
                        "json"),
    "trailing comma": asmdef(IO, "true\n}", "true,\n}", "json"),
    "number for a switch": asmdef(IO, '"autoReferenced": true', '"autoReferenced": 1', "asmdef-form"),
    "version define without a name": asmdef(IO, r'"versionDefines": \[\]', '"versionDefines": [{"define": "A"}]',
                                            "asmdef-form"),
    "conflict in a definition": asmdef(IO, "^{", "<<<<<<< HEAD\n{", "text-conflict"),
    "tests of the editor in PlayMode": asmdef(TESTS, r'"includePlatforms": \[\s*"Editor"\s*\]',
                                              '"includePlatforms": []',
                                              "asmdef-test"),
    "tests referenced by all": asmdef(TESTS, '"autoReferenced": false', '"autoReferenced": true', "asmdef-test"),
    "assembly reference to nobody": reference('{"reference": "Guidewire.Kore"}\n'),
    "assembly reference without a reference": reference("{}\n"),
    "assembly reference that is a list": reference("[]\n"),
    "assembly reference by an unknown guid": reference('{"reference": "GUID:0123456789abcdef0123456789abcdef"}\n'),
    "assembly reference beside a definition": Breakage(write(f"{RUNTIME}/Other.asmref",
                                                             '{"reference": "Guidewire.Core"}\n'),
                                                       f"{RUNTIME}/Other.asmref", "asmdef-folder"),
    "assembly reference that moves engine code into Core": Breakage(
        write(REFERENCE, '{"reference": "Guidewire.Core"}\n'), HUD, "CS0246"),
    "source outside an assembly": Breakage(write("Assets/Loose.cs", "namespace A\n{\n}\n"), "Assets/Loose.cs",
                                           "asmdef-outside"),
    "unsafe code": Breakage(insert(VECTOR, "private unsafe double* _x;"), VECTOR, "CS0227"),
    # Compiler options
    "newer language": option("-langversion:10"),
    "latest language": option("-langversion:latest"),
    "preview language": option("-langversion:preview"),
    "unknown option": option("-nullables:enable"),
    "Unity's own option": option("-target:library"),
    "option of MSBuild": option("-p:Nullable=enable"),
    "option without a dash": option("nullable"),
    "symbol of .NET": option("-define:NET8_0_OR_GREATER"),
    "library that is not there": option("-r:System.Text.Json.dll"),
    "quote that does not end": option('-define:"A'),
    "nullable switched off": Breakage(write(RSP, "-nullable:disable\n"), RSP, "nullable"),
    "options gone": Breakage(both(remove(RSP), remove(f"{RSP}.meta")), RSP, "nullable"),
    "options of the old compiler": Breakage(write(f"{RUNTIME}/mcs.rsp", "-nowarn:1\n"), f"{RUNTIME}/mcs.rsp",
                                            "rsp-option"),
    "options beside no assembly": Breakage(write(f"{RUNTIME}/Views/csc.rsp", "-nowarn:1\n"), f"{RUNTIME}/Views/csc.rsp",
                                           "rsp-option"),
}

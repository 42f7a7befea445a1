"""csc.rsp: the options that each assembly's compiler is given beside Unity's own."""

from __future__ import annotations

import re
import shlex
from typing import Iterator

from tools.unitycheck.asmdefs import assemblies
from tools.unitycheck.project import Project
from tools.unitycheck.violation import Violation

# Options that Unity's compiler takes from such a file. Others are Unity's own to set, or csc does not know them.
_OPTIONS = re.compile(
    r"^[-/](nullable(:(enable|disable|warnings|annotations)|[+-])?|(d|define):\w+([;,]\w+)*|nowarn(:[\w;,]+)?|"
    r"warnaserror([+-])?(:[\w;,]+)?|(w|warn):\d|unsafe[+-]?|checked[+-]?|(r|reference):.+|a(nalyzer)?:.+|"
    r"additionalfile:.+|langversion:.+|ruleset:.+|analyzerconfig:.+|features?:.+|optimize[+-]?|"
    r"deterministic[+-]?|doc:.+)$")
_LIBRARIES = {"Microsoft.CSharp.dll", "System.Data.dll", "System.IO.Compression.dll", "System.Net.Http.dll",
              "System.IO.Compression.FileSystem.dll", "System.Numerics.dll", "System.Xml.dll", "System.Xml.Linq.dll"}
_LANGUAGES = {"7", "7.0", "7.1", "7.2", "7.3", "8", "8.0", "9", "9.0"}


def check(project: Project) -> Iterator[Violation]:
    """Rules nullable, rsp-option."""
    homes = {asmdef.folder for asmdef in assemblies(project)}
    for asmdef in assemblies(project):
        path = f"{asmdef.folder}csc.rsp"
        if not project.exists(path) or "-nullable:enable" not in project.text(path).split():
            yield Violation(path, 0, "nullable", "needs -nullable:enable, which the sources rely on")
    for path in project.assets(".rsp"):
        folder, _, name = path.rpartition("/")
        if name != "csc.rsp":
            yield Violation(path, 0, "rsp-option", "Unity reads options from csc.rsp only")
        elif f"{folder}/" not in homes and folder != "Assets":
            yield Violation(path, 0, "rsp-option", "Unity reads csc.rsp beside an assembly definition only")
        for number, line in enumerate(project.text(path).splitlines(), 1):
            yield from _line(project, path, number, line)


def _line(project: Project, path: str, number: int, line: str) -> Iterator[Violation]:
    try:
        options = [] if line.lstrip().startswith("#") else shlex.split(line)
    except ValueError as error:
        yield Violation(path, number, "rsp-option", f"{error}")
        return
    for option in options:
        name, _, value = option[1:].partition(":")
        if not _OPTIONS.match(option):
            yield Violation(path, number, "rsp-option", f"'{option}' is no option that Unity's compiler takes here")
        elif name == "langversion" and value not in _LANGUAGES:
            yield Violation(path, number, "rsp-option", f"'{option}': Unity compiles C# 9")
        elif name in ("d", "define") and re.search(r"\b(NET\d|NETCOREAPP|UNITY_)", value):
            yield Violation(path, number, "rsp-option", f"'{option}' claims a platform that Unity is not")
        elif name in ("r", "reference", "analyzer", "a", "additionalfile", "ruleset") and \
                not project.exists(value) and value not in _LIBRARIES:
            yield Violation(path, number, "rsp-option", f"'{option}': there is no such file")

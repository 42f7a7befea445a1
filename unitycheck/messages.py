"""Unity's messages, coroutines and calls by name: methods that nobody would miss before the scene stands still."""

from __future__ import annotations

from typing import Iterator

from unitycheck.behaviours import behaviours, chain, descendants, types, words
from unitycheck.csharp import Token, closing, tokens
from unitycheck.declarations import Declaration, Method
from unitycheck.project import Project
from unitycheck.violation import Violation

_NONE = ("Awake", "Start", "Update", "FixedUpdate", "LateUpdate", "OnEnable", "OnDisable", "OnDestroy", "OnGUI",
         "OnValidate", "Reset", "OnDrawGizmos", "OnDrawGizmosSelected", "OnApplicationQuit", "OnRenderObject",
         "OnPreRender", "OnPostRender", "OnPreCull", "OnWillRenderObject", "OnBecameVisible", "OnBecameInvisible",
         "OnMouseDown", "OnMouseUp", "OnMouseDrag", "OnMouseEnter", "OnMouseExit", "OnMouseOver",
         "OnMouseUpAsButton", "OnTransformChildrenChanged", "OnTransformParentChanged",
         "OnBeforeTransformParentChanged", "OnAnimatorMove", "OnParticleTrigger", "OnParticleSystemStopped",
         "OnParticleUpdateJobScheduled", "OnCanvasGroupChanged", "OnCanvasHierarchyChanged",
         "OnRectTransformDimensionsChange", "OnDidApplyAnimationProperties", "OnConnectedToServer",
         "OnServerInitialized")
# Each message with the parameters it may have; where one is optional, without it too.
MESSAGES: dict[str, set[tuple[str, ...]]] = {name: {()} for name in _NONE} | {
    name: {(), (kind,)} for kind, names in {
        "Collision": ("OnCollisionEnter", "OnCollisionStay", "OnCollisionExit"),
        "Collision2D": ("OnCollisionEnter2D", "OnCollisionStay2D", "OnCollisionExit2D"),
        "Collider": ("OnTriggerEnter", "OnTriggerStay", "OnTriggerExit"),
        "Collider2D": ("OnTriggerEnter2D", "OnTriggerStay2D", "OnTriggerExit2D"),
        "bool": ("OnApplicationPause", "OnApplicationFocus"), "float": ("OnJointBreak",),
        "Joint2D": ("OnJointBreak2D",), "GameObject": ("OnParticleCollision",), "int": ("OnAnimatorIK",),
        "ControllerColliderHit": ("OnControllerColliderHit",)}.items() for name in names} | {
    "OnRenderImage": {("RenderTexture", "RenderTexture")}, "OnAudioFilterRead": {("float[]", "int")}}
# Messages that may be coroutines; the others Unity refuses when it sends them.
_COROUTINES = ("Start", "OnCollision", "OnTrigger", "OnMouse", "OnBecame", "OnApplicationPause", "OnApplicationFocus")
_TASKS = {"Task", "Awaitable", "UniTask", "UniTaskVoid", "ValueTask"}
# A method with one of these may be called from elsewhere.
_REACHABLE = {"public", "internal", "protected", "override", "static", "abstract", "virtual"}
_BY_NAME = {"Invoke", "InvokeRepeating", "CancelInvoke", "IsInvoking", "StartCoroutine", "StopCoroutine"}
_SENT = {"SendMessage", "SendMessageUpwards", "BroadcastMessage"}


def near(a: str, b: str) -> bool:
    """Whether one letter added, lost, changed or exchanged with its neighbour makes one word the other."""
    if len(a) > len(b):
        a, b = b, a
    if a == b or len(b) - len(a) > 1:
        return False
    first = next((i for i in range(len(a)) if a[i] != b[i]), len(a))
    if len(a) < len(b):
        return a[first:] == b[first + 1:]
    return a[first + 1:] == b[first + 1:] or (a[first + 1:first + 2] == b[first] and a[first] == b[first + 1]
                                              and a[first + 2:] == b[first + 2:])


def check(project: Project) -> Iterator[Violation]:
    """Rules script-message, script-coroutine, script-invoke."""
    behaving = descendants(project, {"MonoBehaviour"})
    for path, declared in behaviours(project).items():
        for script in declared:
            if not set(script.bases) & behaving:
                continue
            for method in script.methods:
                yield from _message(project, path, method)
                yield from _coroutine(project, path, script, method)
    for path in project.assets(".cs"):
        if any(word in words(project.text(path)) for word in _BY_NAME | _SENT):
            yield from _calls(project, path)


def _bare(kind: str) -> str:
    return kind.rstrip("?").rpartition(".")[2]


def _message(project: Project, path: str, method: Method) -> Iterator[Violation]:
    name, line = method.name, method.line
    if name in MESSAGES:
        returns = _bare(method.returns)
        may_wait = name.startswith(_COROUTINES) and returns == "IEnumerator"
        if "static" in method.modifiers or method.is_generic:
            yield Violation(path, line, "script-message", f"{name} must be an instance method without type parameters")
        elif returns != "void" and not may_wait and returns not in _TASKS:
            yield Violation(path, line, "script-message", f"{name} returns {method.returns}; Unity's message is void")
        elif tuple(map(_bare, method.parameters)) not in MESSAGES[name] and "override" not in method.modifiers:
            allowed = " or ".join(sorted(f"({', '.join(kinds)})" for kinds in MESSAGES[name]))
            yield Violation(path, line, "script-message",
                            f"{name}({', '.join(method.parameters)}) is never sent; its parameters are {allowed}")
        return
    if method.attributes or _bare(method.returns) not in ("void", "IEnumerator") or "override" in method.modifiers:
        return
    right = next((message for message in MESSAGES if message.lower() == name.lower()), None)
    if right is not None:
        yield Violation(path, line, "script-message", f"{name}: Unity's message is called {right}")
        return
    if _bare(method.returns) != "void" or _is_used(project, path, name, bool(_REACHABLE & method.modifiers)):
        return
    like = next((message for message in MESSAGES if near(message, name)), None)
    if like is not None:
        yield Violation(path, line, "script-message", f"{name}: Unity's message is called {like}")
    elif not _REACHABLE & method.modifiers:
        yield Violation(path, line, "script-message", f"{name} is no message of Unity's and nobody calls it")


def _is_used(project: Project, path: str, name: str, everywhere: bool) -> bool:
    """Whether a name stands more than once in its file, or anywhere else: in code, or in a scene's event."""
    if words(project.text(path)).get(name, 0) > 1:
        return True
    others = (other for other in project.assets(".cs") if other != path)
    if any(f'"{name}"' in project.text(other) or (everywhere and name in words(project.text(other)))
           for other in others):
        return True
    return any(f"m_MethodName: {name}\n" in project.text(other) for other in project.yaml_files())


def _coroutine(project: Project, path: str, script: Declaration, method: Method) -> Iterator[Violation]:
    if _bare(method.returns) != "IEnumerator" or method.name in MESSAGES or method.attributes:
        return
    if not _is_used(project, path, method.name, bool(_REACHABLE & method.modifiers)):
        yield Violation(path, method.line, "script-coroutine", f"nobody starts the coroutine {method.name}")
    for caller in script.methods:
        for i, token in enumerate(caller.body):
            before = caller.body[i - 1].text if i else ""
            if token.text == method.name and before in (";", "{", "}", ")") and i + 1 < len(caller.body) \
                    and caller.body[i + 1].text == "(":
                end = closing(caller.body, i + 1)
                if end + 1 < len(caller.body) and caller.body[end + 1].text == ";":
                    yield Violation(path, token.line, "script-coroutine",
                                    f"{method.name}() alone runs nothing: StartCoroutine({method.name}())")


def _named(items: list[Token], start: int) -> str | None:
    """The method that a call's first argument names, from "Name" or nameof(Name); None where it is anything else."""
    if start >= len(items):
        return None
    if items[start].kind == "text" and items[start].text == '"' and start + 1 < len(items) \
            and items[start + 1].text in (",", ")"):
        return items[start].value
    words_in = [item.text for item in items[start:start + 4]]
    return words_in[2] if words_in[:2] == ["nameof", "("] and words_in[3:] == [")"] else None


def _calls(project: Project, path: str) -> Iterator[Violation]:
    items = tokens(project.text(path))
    own = [declaration for declaration in types(project)[path] if declaration.kind == "class"]
    known = {method.name: method for declaration in own for base in chain(project, declaration)
             for method in base.methods}
    everywhere = {method.name for declared in types(project).values() for declaration in declared
                  for method in declaration.methods}
    for i, token in enumerate(items):
        if token.text not in _BY_NAME | _SENT or i + 2 >= len(items) or items[i + 1].text != "(":
            continue
        name = _named(items, i + 2)
        before = items[i - 1].text if i else ""
        is_own = before != "." or (i > 1 and items[i - 2].text == "this")
        if name is None or (token.text in _BY_NAME and not is_own):
            continue
        if token.text in _SENT:
            if name not in everywhere:
                yield Violation(path, token.line, "script-invoke", f"{token.text}: no script has a method {name}")
        elif name not in known:
            yield Violation(path, token.line, "script-invoke", f"{token.text}: this script has no method {name}")
        elif "Coroutine" in token.text and _bare(known[name].returns) != "IEnumerator":
            yield Violation(path, token.line, "script-invoke", f"{token.text}: {name} returns no IEnumerator")
        elif token.text.startswith("Invoke") and known[name].parameters:
            yield Violation(path, token.line, "script-invoke", f"{token.text}: {name} has parameters")

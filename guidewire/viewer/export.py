"""A self-contained file with the page and its data: it needs neither a server nor a network."""

from __future__ import annotations

import base64
import gzip
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from guidewire.viewer.parts import PAGE

_HIGHEST = 9  # compression
# Unpacks what stands in this file: modules get an address each, by the name that they have in the import map.
_BOOT = """
const unpack = (node) => {
  const packed = Uint8Array.from(atob(node.textContent), (character) => character.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip")));
};
const start = async () => {
  const imports = {};
  for (const node of document.querySelectorAll("script[data-module]")) {
    const text = new Blob([await unpack(node).text()], { type: "text/javascript" });
    imports[node.dataset.module] = URL.createObjectURL(text);
  }
  const recordings = [...document.querySelectorAll("script[data-recording]")];
  globalThis.guidewireRecordings = await Promise.all(recordings.map((node) => unpack(node).arrayBuffer()));
  const map = Object.assign(document.createElement("script"), { type: "importmap" });
  map.textContent = JSON.stringify({ imports });
  document.head.append(map);
  await import("guidewire/main.js");
};
start().catch((error) => {
  document.getElementById("said").textContent = `this browser cannot show the run (${error.message})`;
});
"""
_RELATIVE = re.compile(r"(\bfrom\s*|\bimport\s*)([\"'])\./([\w.]+)\2")
_BY_NAME = {"three.module.js": "three", "OrbitControls.js": "three/addons/controls/OrbitControls.js"}
_STYLE = '<link rel="stylesheet" href="style.css">'
_MAIN = '<script type="module" src="./main.js"></script>'
_MAP = re.compile(r"<script type=\"importmap\">.*?</script>\n", re.DOTALL)


def to_html(files: Mapping[str, Path], recordings: Sequence[bytes]) -> str:
    """The page as one file.

    Parameters
    ----------
    files : of the page by name, as of `guidewire.viewer.server.page_files`.
    recordings : what it shows.
    """
    page = _MAP.sub("", (PAGE / "index.html").read_text(encoding="utf-8"))
    style = (PAGE / "style.css").read_text(encoding="utf-8")
    modules = [_block("module", _name(name), _with_names(path.read_text(encoding="utf-8")).encode())
               for name, path in files.items() if path.suffix == ".js"]
    packed = [_block("recording", str(k), block) for k, block in enumerate(recordings)]
    page = page.replace(_STYLE, f"<style>\n{style}</style>")
    return page.replace(_MAIN, "").replace(
        "</body>", "\n".join([*modules, *packed, f"<script>{_BOOT}</script>", "</body>"]))


def _name(file: str) -> str:
    """What modules import a file by: where it is not one of their neighbours, as in the page's import map."""
    return _BY_NAME.get(file, f"guidewire/{file}")


def _with_names(module: str) -> str:
    """A module whose neighbours are named as in the import map: from an address of its own it has none."""
    return _RELATIVE.sub(lambda found: f'{found[1]}"{_name(found[3])}"', module)


def _block(kind: str, name: str, content: bytes) -> str:
    text = base64.b64encode(gzip.compress(content, _HIGHEST, mtime=0)).decode("ascii")
    return f'<script type="text/plain" data-{kind}="{name}">{text}</script>'

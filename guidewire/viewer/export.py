"""A self-contained file with the page and its data: it needs neither a server nor a network."""

from __future__ import annotations

import base64
import gzip
import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from guidewire.viewer.parts import PAGE

_HIGHEST = 9  # compression
_STYLE = '<link rel="stylesheet" href="style.css">'
_MAIN = '<script type="module" src="./main.js"></script>'
_MAP = re.compile(r"<script type=\"importmap\">.*?</script>\n", re.DOTALL)
_BOOT = "boot.js"  # unpacks the modules


def to_html(files: Mapping[str, Path], recordings: Sequence[bytes]) -> str:
    """Return the page as one file.

    Parameters
    ----------
    files : of the page by name, as of `guidewire.viewer.server.page_files`.
    recordings : what it shows.
    """
    style = (PAGE / "style.css").read_text(encoding="utf-8")
    boot = (PAGE / _BOOT).read_text(encoding="utf-8")
    packed = [_block("modules", modules_of(files)), *(_block("recording", pack(block)) for block in recordings)]
    page = page_of_packed().replace(_STYLE, f"<style>\n{style}</style>")
    return page.replace("</body>", "\n".join([*packed, f"<script>{boot}</script>", "</body>"]))


def page_of_packed(boot: str = "") -> str:
    """Return the page's frame, where its modules are packed; `boot` takes the place of the main module."""
    page = (PAGE / "index.html").read_text(encoding="utf-8")
    return _MAP.sub("", page).replace(_MAIN, boot)


def modules_of(files: Mapping[str, Path]) -> bytes:
    """Return the page's modules and words in one block, which boot.js takes: JSON of their texts by name, packed."""
    texts = {name: path.read_text(encoding="utf-8") for name, path in files.items()
             if path.suffix in (".js", ".json") and name != _BOOT}
    return pack(json.dumps(texts).encode())


def pack(content: bytes) -> bytes:
    """Pack it as DecompressionStream of a browser unpacks it."""
    return gzip.compress(content, _HIGHEST, mtime=0)


def _block(kind: str, packed: bytes) -> str:
    return f'<script type="text/plain" data-{kind}>{base64.b64encode(packed).decode("ascii")}</script>'

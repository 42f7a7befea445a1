"""Serves the page on this machine alone: a fixed list of files, recordings, and the run in progress.

Whoever asks needs the token in the address; names of hosts and origins other than this server's are refused, so that
neither another page nor a name that is pointed here reaches it. There are no paths in a file system to ask for: what is
served stands in a table.
"""

from __future__ import annotations

import asyncio
import base64
import hashlib
import json
import re
import secrets
import signal
import socket
from collections.abc import Awaitable, Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from aiohttp import web

from guidewire.prepare import report
from guidewire.viewer.parts import PAGE

if TYPE_CHECKING:
    from guidewire.viewer.live import LiveRun

HOST = "127.0.0.1"
MOST_PAGES = 8
LONGEST_MESSAGE = 4096  # bytes; what a page says is short
_SECONDS_TO_CLOSE = 2.0
_HEARTBEAT = 10.0  # s
_TYPES = {".html": "text/html", ".css": "text/css", ".js": "text/javascript"}
_WORDS = "application/json"
_INLINE = re.compile(r"<script type=\"importmap\">(.*?)</script>", re.DOTALL)


def page_files(parts: Mapping[str, Path]) -> dict[str, Path]:
    """Return every file of the page by its name in the address."""
    own = {path.name: path for path in PAGE.iterdir() if path.suffix in _TYPES}
    words = {f"words/{path.name}": path for path in (PAGE / "words").glob("*.json")}
    return {**own, **words, **parts}


class Server:
    """The page, and what it shows.

    Parameters
    ----------
    files : as of `page_files`.
    recordings : blocks of bytes of runs that have ended; of a run that goes on the block as it is now.
    live : the run that goes on, or None.
    choose : of a vessel: makes an end the inlet, by its number, and returns what to tell; None elsewhere.
    """

    def __init__(self, files: Mapping[str, Path], recordings: Sequence[bytes], live: LiveRun | None,
                 choose: Callable[[int], str] | None = None) -> None:
        self._files = files
        self._choose = choose
        self._recordings = recordings
        self._live = live
        self._token = secrets.token_urlsafe(16)
        self._hosts: frozenset[str] = frozenset()
        inline = _INLINE.search((PAGE / "index.html").read_text(encoding="utf-8"))
        digest = base64.b64encode(hashlib.sha256(inline.group(1).encode()).digest()).decode()
        self._headers = {
            "Content-Security-Policy": f"default-src 'self'; script-src 'self' 'sha256-{digest}'; img-src 'self' "
                                       "data:; object-src 'none'; base-uri 'none'; frame-ancestors 'none'",
            "X-Content-Type-Options": "nosniff", "Referrer-Policy": "no-referrer", "Cache-Control": "no-store",
            "Cross-Origin-Resource-Policy": "same-origin",
        }

    def run(self, ready: Callable[[str], None]) -> None:
        """Serve until Ctrl-C or SIGTERM.

        Parameters
        ----------
        ready : called with the address when the page can be opened.
        """
        asyncio.run(self._serve(ready))

    async def _serve(self, ready: Callable[[str], None]) -> None:
        application = web.Application(middlewares=[self._guard], client_max_size=LONGEST_MESSAGE)
        application.router.add_get("/{token}/{name:.*}", self._answer)
        application.router.add_post(r"/{token}/inlet/{number:\d{1,4}}", self._answer_choice)
        runner = web.AppRunner(application, access_log=None)
        await runner.setup()
        listening = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        listening.bind((HOST, 0))
        port = listening.getsockname()[1]
        self._hosts = frozenset(f"{name}:{port}" for name in (HOST, "localhost"))
        await web.SockSite(runner, listening).start()
        ended = asyncio.Event()
        loop = asyncio.get_running_loop()
        for number in (signal.SIGINT, signal.SIGTERM):
            loop.add_signal_handler(number, ended.set)
        going = [asyncio.ensure_future(self._live.go())] if self._live is not None else []
        try:
            ready(f"http://{HOST}:{port}/{self._token}/")
            await asyncio.wait([asyncio.ensure_future(ended.wait()), *going], return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in going:
                task.cancel()
            errors = [error for error in await asyncio.gather(*going, return_exceptions=True)
                      if not isinstance(error, asyncio.CancelledError)]
            if self._live is not None:
                await self._live.close()
            # Its own limit for requests under way is a minute, and stands elsewhere in each version of aiohttp.
            with suppress(asyncio.TimeoutError):
                await asyncio.wait_for(runner.cleanup(), _SECONDS_TO_CLOSE)
        for error in errors:
            raise error

    @web.middleware
    async def _guard(self, request: web.Request,
                     handler: Callable[[web.Request], Awaitable[web.StreamResponse]]) -> web.StreamResponse:
        try:
            if request.headers.get("Host") not in self._hosts:
                raise web.HTTPForbidden(text="this server answers to its own name only")
            origin = request.headers.get("Origin")
            if origin is not None and origin.partition("http://")[2] not in self._hosts:
                raise web.HTTPForbidden(text="this server answers to its own page only")
            token = request.match_info.get("token", "")
            if not secrets.compare_digest(token.encode(), self._token.encode()):
                raise web.HTTPNotFound()
            response = await handler(request)
        except web.HTTPException as refused:
            refused.headers.update(self._headers)
            raise
        except ConnectionError:    # the page is gone
            raise
        except Exception as error:
            report(error, self._token)
            raise web.HTTPInternalServerError(text="this server has failed", headers=self._headers) from None
        if not response.prepared:
            response.headers.update(self._headers)
        return response

    async def _answer(self, request: web.Request) -> web.StreamResponse:
        name = request.match_info["name"] or "index.html"
        if name in self._files:
            path = self._files[name]
            return web.Response(body=path.read_bytes(), content_type=_TYPES.get(path.suffix, _WORDS), charset="utf-8")
        if name == "show.json":
            shown = {"isLive": self._live is not None, "recordings": len(self._recordings)}
            return web.Response(text=json.dumps(shown), content_type="application/json")
        steered = re.fullmatch(r"steered(?:-(\d))?\.csv", name)
        if steered is not None and self._live is not None:
            return web.Response(text=await self._live.steered_csv(int(steered.group(1) or 0)), content_type="text/csv")
        if name == "live" and self._live is not None:
            return await self._join(request, self._live)
        recordings = self._recordings if self._live is None else [await self._live.recording()]
        index = re.fullmatch(r"recording/(\d)", name)
        if index is None or int(index.group(1)) >= len(recordings):
            raise web.HTTPNotFound()
        return web.Response(body=recordings[int(index.group(1))], content_type="application/octet-stream")

    async def _answer_choice(self, request: web.Request) -> web.StreamResponse:
        if self._choose is None:
            raise web.HTTPNotFound()
        if request.headers.get("Origin") is None:
            raise web.HTTPForbidden(text="the vessel is for this server's page only")
        return web.Response(text=self._choose(int(request.match_info["number"])))

    async def _join(self, request: web.Request, live: LiveRun) -> web.StreamResponse:
        if request.headers.get("Origin") is None:
            raise web.HTTPForbidden(text="the run is for this server's page only")
        if live.pages >= MOST_PAGES:
            raise web.HTTPServiceUnavailable(text=f"{MOST_PAGES} pages look on already")
        page = web.WebSocketResponse(max_msg_size=LONGEST_MESSAGE, heartbeat=_HEARTBEAT, compress=False)
        await page.prepare(request)
        await live.serve(page)
        return page

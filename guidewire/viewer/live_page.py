"""A page that is open: what is sent to it, and how many pictures of it are on the way."""

from __future__ import annotations

from collections.abc import Awaitable

from aiohttp import WSCloseCode, web

MOST_IN_FLIGHT = 2    # pictures that a page has not shown yet; of further ones it gets the last


class Page:
    """A page that is open."""

    def __init__(self, socket: web.WebSocketResponse) -> None:
        self.socket = socket
        self.on_the_way = 0
        self.waiting: bytes | None = None    # the newest frame, where too many are on the way

    async def tell(self, text: str) -> None:
        """Send a message."""
        await _send(self.socket.send_str(text))

    async def show(self, frame: bytes) -> None:
        """Send a frame, or the newest of several when the page has shown others."""
        if self.on_the_way < MOST_IN_FLIGHT:
            self.on_the_way += 1
            await _send(self.socket.send_bytes(frame))
        else:
            self.waiting = frame

    async def has_shown(self) -> None:
        """The page is ready for one more."""
        self.on_the_way = max(0, self.on_the_way - 1)
        frame, self.waiting = self.waiting, None
        if frame is not None:
            await self.show(frame)

    async def say_goodbye(self) -> None:
        """Close it, as the server ends."""
        await self.socket.close(code=WSCloseCode.GOING_AWAY, message=b"the server has ended")


async def _send(sending: Awaitable[None]) -> None:
    try:
        await sending
    except (ConnectionError, RuntimeError):
        pass  # the page has been closed; its own loop reports that

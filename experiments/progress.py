"""What a terminal shows while somebody waits."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def seconds_counted() -> Iterator[Callable[[str], None]]:
    """A function that prints a line and, on a terminal, counts the seconds behind it to the end of the block."""
    screen, ended, counters = sys.stderr, threading.Event(), []

    def count(line: str, ended: threading.Event) -> None:
        seconds = 0
        while not ended.wait(1.0):
            seconds += 1
            print(f"\r{line}: {seconds} s", end="", file=screen, flush=True)

    def tell(line: str) -> None:
        nonlocal ended
        if counters:
            finish()
        print(line, end="" if screen.isatty() else "\n", file=screen, flush=True)
        if screen.isatty():
            ended = threading.Event()
            counters.append(threading.Thread(target=count, args=(line, ended), daemon=True))
            counters[-1].start()

    def finish() -> None:
        ended.set()
        counters.pop().join()
        print(file=screen)

    try:
        yield tell
    finally:
        if counters:
            finish()

"""Progress display in a terminal."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from guidewire.sweeps.sweep import Bar


@contextmanager
def seconds_counted() -> Iterator[Callable[[str], None]]:
    """Provide a function that prints a line and, on a terminal, counts the seconds behind it to the end of the
    block."""
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


def bar_of(name: str) -> Callable[[int, int, int], Bar]:
    """Return a bar for each round, with a rate and the time that is left; a line now and then where stderr is no
    terminal."""
    def bar(number: int, total: int, found: int) -> Bar:
        from tqdm import tqdm

        return tqdm(
            desc=name if number == 1 else f"{name}, round {number}", total=total, initial=found, unit="run",
            mininterval=0.2 if sys.stderr.isatty() else 30.0, dynamic_ncols=True,
        )

    return bar


def tell_frames(done: int, count: int, what: str = "frame") -> None:
    """On a terminal a line that counts; elsewhere a line now and then."""
    if sys.stderr.isatty():
        print(f"\r{what} {done} of {count}", end="\n" if done == count else "", file=sys.stderr, flush=True)
    elif done % max(1, count // 4) == 0:
        print(f"{what} {done} of {count}", file=sys.stderr, flush=True)

"""How a command ends: its exit code, and one line where it did not end well."""

from __future__ import annotations

import argparse
import os
import select
import sys
from collections.abc import Callable

from guidewire.prepare import PreparationError, report
from guidewire.runs.runner import FAILED, INTERNAL_ERROR, INTERRUPTED
from guidewire.runs.whole_files import FULL

NO_READER = 141    # as a shell counts a program that a closed pipe has ended


def code_of(action: Callable[[argparse.Namespace], int], arguments: argparse.Namespace, left: str) -> int:
    """Execute an action and return its exit code.

    Raises PreparationError for what a user has to mend. Any other error is the program's own: its trace goes into a
    file, and one line says where.

    Parameters
    ----------
    left : what an interrupted action leaves, said after the word.
    """
    try:
        code = action(arguments)
        sys.stdout.flush()
        return code
    except KeyboardInterrupt:
        print(f"guidewire: interrupted{left}", file=sys.stderr)
        return INTERRUPTED
    except PreparationError:
        raise
    except Exception as error:
        if isinstance(error, BrokenPipeError) and _has_no_reader():
            return NO_READER
        if isinstance(error, OSError) and error.errno in FULL:
            place = f"{error.filename}: " if error.filename else ""
            print(f"guidewire: {place}{error.strerror}: free some space, the same command continues from here",
                  file=sys.stderr)
            return FAILED
        if isinstance(error, OSError) and error.filename is not None:
            raise PreparationError(f"{error.filename}: {error.strerror}") from error
        report(error)
        return INTERNAL_ERROR


def _has_no_reader() -> bool:
    """Return whether whoever read this program's output has gone, as `head` does; what is still to be written is
    dropped."""
    output = select.poll()
    output.register(sys.stdout.fileno(), 0)
    if not any(events & select.POLLERR for _, events in output.poll(0)):
        return False
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return True

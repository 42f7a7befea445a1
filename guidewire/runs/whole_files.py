"""Atomic writing of files: a file is complete or absent."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)  # no space left: of the disk, of the user, of the process


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Provide a name beside a file, with its ending, to write to: at the end of the block it takes the file's place at
    once.

    Raises
    ------
    OSError : what the block met, with the file's name where it had none; nothing of it is left.
    """
    partial = path.with_name(f"{path.stem}.partial{path.suffix}")
    try:
        yield partial
        os.replace(partial, path)
    except BaseException as error:
        partial.unlink(missing_ok=True)
        if isinstance(error, OSError) and error.errno is not None and error.filename in (None, str(partial), partial):
            raise OSError(error.errno, error.strerror, str(path)) from error
        raise


def write_whole(path: Path, text: str) -> None:
    """Write a text as UTF-8: a reader finds the old file or the new one, never a part.

    Raises
    ------
    OSError : as `whole_file`.
    """
    with whole_file(path) as partial:
        partial.write_text(text, encoding="utf-8")

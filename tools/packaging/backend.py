"""What a build front end, such as pip, calls where it finds pyproject.toml (PEP 517)."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from tools.packaging import wheel


def build_wheel(wheel_directory: str, config_settings: Mapping[str, Any] | None = None,
                metadata_directory: str | None = None) -> str:
    """Build the wheel there; returns its name."""
    return wheel.build(Path(wheel_directory), lambda line: print(line, file=sys.stderr, flush=True)).name


def build_sdist(sdist_directory: str, config_settings: Mapping[str, Any] | None = None) -> str:
    """Refused: what the wheel is built from is the repository."""
    raise NotImplementedError("guidewire has no source distribution: clone the repository")

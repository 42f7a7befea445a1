"""JSON that people write: what is wrong with a text that is none, and notes for readers."""

from __future__ import annotations

import json
import re
from typing import Any

NOTE = "note"  # key that may hold a text in any object
_DECIMAL_COMMA = re.compile(r"\d,0*$")


def problem_of(text: str, error: json.JSONDecodeError) -> str:
    """Why a text is no JSON and where, in one phrase; the runner says the same."""
    behind = text[error.pos:].lstrip()
    found = f"line {error.lineno}, column {error.colno}"
    if behind[:1] in ("#", "/"):
        return f"{found} has a comment, and JSON has none: a text under the key \"{NOTE}\" can say the same"
    if behind[:1].isdigit() and _DECIMAL_COMMA.search(text[:error.pos]):
        return f"{found} has a number with a comma: JSON has a decimal point, not a comma"
    return f"{error.msg} in {found}"


def without_notes(value: Any) -> Any:
    """Return the value of a JSON text without the notes in its objects."""
    if isinstance(value, dict):
        return {key: without_notes(one) for key, one in value.items() if key != NOTE or not isinstance(one, str)}
    return [without_notes(one) for one in value] if isinstance(value, list) else value

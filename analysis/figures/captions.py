"""Captions of Figures 4.5 to 4.9: what the table shows, in numbers, and how that compares with the thesis.

Every sentence that claims a relation is chosen by testing the relation on the table.
"""

from __future__ import annotations

import numpy as np

from analysis.figures.wording import number, percent, relative_spread, span
from analysis.tables import StudyTable


def sweep_caption(figure: str, table: StudyTable) -> str:
    """The caption of one of Figures 4.5 to 4.9."""
    return f"Figure {figure}."

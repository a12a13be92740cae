"""What Canvas's own export, given as the class list, says of its assignments.

Canvas takes a grade in the points of the assignment. Its importer reads the line of points as a
wish to change them, and a head that it does not know as a new assignment. Source: Canvas's
importer, lib/gradebook_importer.rb (`process_pp`, `parse_assignments`).
"""

from __future__ import annotations

import re
from pathlib import Path

from roslings_class.tables import read_cells

POINTS = "points possible"
_NUMBER = re.compile(r"\d+(?:[.,]\d+)?")
_WITH_ID = re.compile(r".+ \(\d+\)")
"""So Canvas calls each assignment, and no other column."""


def points_of_assignments(path: Path) -> dict[str, float | None]:
    """The head of each assignment to its points; None where it has none.

    Empty for a list that is not Canvas's. Raises BadTable.
    """
    (_, head), *lines = read_cells(path).lines
    for _, cells in lines:
        if cells and cells[0].strip().lower() == POINTS:
            told = {name.strip(): _as_points(text) for name, text in zip(head, cells, strict=False)}
            return {
                name: points for name, points in told.items() if points or _WITH_ID.fullmatch(name)
            }
    return {}


def _as_points(text: str) -> float | None:
    number = text.strip()
    return float(number.replace(",", ".")) or None if _NUMBER.fullmatch(number) else None

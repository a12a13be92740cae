"""Read a CSV file that an instructor wrote or a learning platform exported."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from roslings.batch.errors import BadTable

MOST_BYTES = 50_000_000
SEPARATORS = ",;\t"


@dataclass(frozen=True)
class Row:
    """One line of the table: column, in small letters, to text."""

    table: Path
    line: int
    cells: dict[str, str]

    def first(self, columns: Sequence[str]) -> str:
        """The text in the first of these columns that has one; empty where none has."""
        return next((text for name in columns if (text := self.cells.get(name, "").strip())), "")

    def needed(self, columns: Sequence[str]) -> str:
        """The same. Raises BadTable where there is none."""
        if text := self.first(columns):
            return text
        step = f"Fill in this column: {columns[0]}."
        raise BadTable(self.table, self.line, f"there is no {columns[0]} here.", step)


def read_table(path: Path) -> list[Row]:
    """Every line below the head. Raises BadTable."""
    lines = _text(path).splitlines()
    if not lines:
        step = "Its first line names the columns, for example: name,id,email"
        raise BadTable(path, 1, "the table is empty.", step)
    separator = max(SEPARATORS, key=lines[0].count)
    return list(_rows(path, csv.reader(lines, delimiter=separator)))


def _rows(path: Path, lines: Iterator[list[str]]) -> Iterator[Row]:
    head = [name.strip().lower() for name in next(lines, [])]
    for number, cells in enumerate(lines, start=2):
        if any(cell.strip() for cell in cells):
            yield Row(path, number, dict(zip(head, cells, strict=False)))


def _text(path: Path) -> str:
    try:
        return path.read_bytes()[:MOST_BYTES].decode("utf-8-sig")
    except UnicodeDecodeError:
        step = "Save it as CSV in UTF-8 (in Excel: CSV UTF-8)."
        raise BadTable(path, 1, "this is no UTF-8 text.", step) from None
    except OSError as error:
        step = "Look at the path: is it the right one?"
        raise BadTable(path, 1, f"it cannot be read ({error.strerror}).", step) from None

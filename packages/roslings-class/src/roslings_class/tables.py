"""Read a CSV file that an instructor wrote or a learning platform exported."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from roslings_class.errors import BadTable
from roslings_class.headings import english

MOST_BYTES = 50_000_000
SEPARATORS = ",;\t"
MARK = "\ufeff"
"""Excel and Moodle put it before a text in UTF-8."""


@dataclass(frozen=True)
class TableRow:
    """One line of the table: column, in English and small letters, to text."""

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


def read_table(path: Path) -> list[TableRow]:
    """Every line below the head. Raises BadTable."""
    (_, head), *lines = read_cells(path).lines
    names = english(head)
    return [
        TableRow(path, number, dict(zip(names, cells, strict=False)))
        for number, cells in lines
        if any(cell.strip() for cell in cells)
    ]


@dataclass(frozen=True)
class Cells:
    """A table as it was written, and how."""

    lines: list[tuple[int, list[str]]]
    """Each line's cells with the number of the line that it ends in, the head first."""
    separator: str
    line_end: str
    mark: str
    """What stands before the first cell: that the text is UTF-8, or nothing."""
    all_quoted: bool


def read_cells(path: Path) -> Cells:
    """Every line with all that is in it. A quoted cell may hold ends of lines. Raises BadTable."""
    text = _text(path)
    plain = text.removeprefix(MARK)
    head = plain.partition("\n")[0]
    if not head.strip():
        step = "Its first line names the columns, for example: name,id,email"
        raise BadTable(path, 1, "the table is empty.", step)
    separator = max(SEPARATORS, key=head.count)
    reader = csv.reader(io.StringIO(plain, newline=""), delimiter=separator)
    try:
        lines = [(reader.line_num, cells) for cells in reader]
    except csv.Error as error:
        step = "Export it again as CSV, and give it as it is."
        raise BadTable(
            path, reader.line_num, f"this is no line of a table ({error}).", step
        ) from error
    ends = "\r\n" if head.endswith("\r") else "\n"
    cells = head.rstrip("\r").split(separator)
    quoted = all(cell.startswith('"') and cell.endswith('"') for cell in cells)
    return Cells(lines, separator, ends, MARK if plain != text else "", quoted)


def _text(path: Path) -> str:
    try:
        return path.read_bytes()[:MOST_BYTES].decode("utf-8")
    except UnicodeDecodeError:
        step = "Save it as CSV in UTF-8 (in Excel: CSV UTF-8)."
        raise BadTable(path, 1, "this is no UTF-8 text.", step) from None
    except OSError as error:
        step = "Look at the path: is it the right one?"
        raise BadTable(path, 1, f"it cannot be read ({error.strerror}).", step) from None

"""Moodle's grading worksheet, written back as it was given, with grades and feedback in it.

An assignment gives it to an instructor ("Download grading worksheet") and takes it back ("Upload
grading worksheet"). Its importer wants the three columns of `NEEDED`, called as in the language in
which Moodle is read then (`headings.yaml` knows some). By the date it sees whether somebody gave
another grade meanwhile. So each cell stays as it is, but for the grade and the feedback of whom we
graded.

Source: Moodle's own importer, mod/assign/feedback/offline/importgradeslib.php.
"""

from __future__ import annotations

import csv
import html
import io
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from roslings_class import headings
from roslings_class.errors import BadTable
from roslings_class.roster import FIRST, IDS, LOGINS, NAMES
from roslings_class.tables import Cells, read_cells

IDENTIFIER, GRADE, CHANGED = "Identifier", "Grade", "Last modified (grade)"
NEEDED = (IDENTIFIER, GRADE, CHANGED)
MAXIMUM, FEEDBACK = "Maximum Grade", "Feedback comments"
SCALE = "scale"
"""Its column stands in place of the maximum where the grade is a word, as `passed`."""
USUAL_MAXIMUM = 100.0
AGAIN = (
    "Give the worksheet as Moodle writes it: the assignment's page, Grading action,\n"
    "Download grading worksheet."
)
FEWEST_COLUMNS = 4
_PARTICIPANT = re.compile(r"(\D+)\d+")
_IN_ANY_LANGUAGE = re.compile(r"(\D{2,})\d+")
_NUMBER = re.compile(r"\d+(?:[.,]\d+)?")


@dataclass(frozen=True)
class Mark:
    """What a student gets; no grade where what was handed in could not be graded."""

    score: float | None
    """0 to 100."""
    comment: str


@dataclass(frozen=True)
class Worksheet:
    """One, as it was given."""

    cells: Cells
    maximum: float
    """The points that Moodle gives for the whole."""
    has_decimal_comma: bool

    def filled(self, marks: Mapping[str, Mark]) -> bytes:
        """The file to upload; `marks` are by the identifier."""
        text = io.StringIO()
        writer = csv.writer(
            text,
            delimiter=self.cells.separator,
            lineterminator=self.cells.line_end,
            quoting=csv.QUOTE_ALL if self.cells.all_quoted else csv.QUOTE_MINIMAL,
        )
        writer.writerows(self._lines(marks))
        return f"{self.cells.mark}{text.getvalue()}".encode()

    def _lines(self, marks: Mapping[str, Mark]) -> Iterator[Sequence[str]]:
        (_, head), *lines = self.cells.lines
        yield head
        places = {name: at for at, name in enumerate(headings.english(head))}
        for _, line in lines:
            at = places[IDENTIFIER.lower()]
            mark = marks.get(line[at].strip()) if at < len(line) else None
            yield line if mark is None else self._with(line, mark, places)

    def _with(self, line: list[str], mark: Mark, places: Mapping[str, int]) -> list[str]:
        own = [*line, *[""] * (len(places) - len(line))]
        if mark.score is not None:
            own[places[GRADE.lower()]] = self._points(mark.score)
        if (at := places.get(FEEDBACK.lower())) is not None:
            own[at] = html.escape(mark.comment, quote=False)  # Moodle reads HTML there
        return own

    def _points(self, score: float) -> str:
        text = f"{score * self.maximum / 100:.2f}"
        return text.replace(".", ",") if self.has_decimal_comma else text


def read_worksheet(path: Path) -> Worksheet | None:
    """The worksheet; None for another class list. Raises BadTable for what Moodle would refuse."""
    cells = read_cells(path)
    (_, head), *lines = cells.lines
    names = headings.english(head)
    whole = [line for _, line in lines if any(cell.strip() for cell in line)]
    if not _is_of_moodle(path, names, whole):
        return None
    if wanting := [name for name in NEEDED if name.lower() not in names]:
        problem = f"Moodle would not take this worksheet back: it has no column {wanting[0]!r}."
        raise BadTable(path, 1, problem, f"{AGAIN}\n{headings.other_language()}")
    maximum = _maximum(path, names, whole)
    return Worksheet(cells, _as_points(maximum), "," in maximum)


def _is_of_moodle(path: Path, names: Sequence[str], lines: Sequence[Sequence[str]]) -> bool:
    """Raises BadTable where it is one, in a language that nobody here knows."""
    if IDENTIFIER.lower() in names:
        at = names.index(IDENTIFIER.lower())
        return any(at < len(line) and _is_participant(line[at]) for line in lines)
    words = [_IN_ANY_LANGUAGE.fullmatch(line[0].strip()) for line in lines]
    same = len({word[1] if word else "" for word in words}) == 1 and all(words)
    if same and len(names) >= FEWEST_COLUMNS and not {*NAMES, *FIRST, *IDS, *LOGINS} & set(names):
        problem = "this looks like a grading worksheet of a Moodle in a language that is not known."
        raise BadTable(path, 1, problem, headings.other_language())
    return False


def _is_participant(cell: str) -> bool:
    """`Participant 12`, `Teilnehmer/in12`: some languages have no space there."""
    found = _PARTICIPANT.fullmatch(cell.strip())
    return found is not None and found[1].strip() in headings.participants()


def _maximum(path: Path, names: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    """What Moodle says that the whole is worth. Raises BadTable where these are no points."""
    column = next((name for name in (MAXIMUM.lower(), SCALE) if name in names), None)
    if column is None:
        return f"{USUAL_MAXIMUM}"
    at = names.index(column)
    said = next((line[at].strip() for line in lines if at < len(line) and line[at].strip()), "")
    if column != SCALE and _NUMBER.fullmatch(said) and _as_points(said) > 0:
        return said
    problem = f"this assignment is not graded by points: its {column} is {said!r}."
    step = "Moodle, the assignment's settings, Grade: choose the type Point, and download it again."
    raise BadTable(path, 2, problem, step)


def _as_points(text: str) -> float:
    return float(text.replace(",", "."))

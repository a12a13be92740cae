"""All labs of a class as a page, as a CSV file, and in the terminal."""

from __future__ import annotations

import os
import statistics
from collections.abc import Iterable, Iterator, Sequence
from datetime import timezone
from functools import partial
from pathlib import Path
from urllib.parse import quote

from ros2_on_pip.markup import Markup, joined, tag
from ros2_on_pip.typed_paths import from_here
from roslings_class.csv_files import Line, write_lines
from roslings_class.folders import PAGE, folder_of
from roslings_class.messages import few
from roslings_class.overview import (
    HANDED_IN,
    NOT_BEGUN,
    LabGrades,
    Overview,
    Since,
    StudentStanding,
    score_in,
)
from roslings_class.sorted_table import Column, sorted_table, write_page

OVERVIEW, TABLE = "overview.html", "overview.csv"


def write_overview(found: Overview, folder: Path) -> list[str]:
    """Write page and table into `folder`; what the command says. Raises CannotWriteFile."""
    write_page(folder / OVERVIEW, f"{len(found.labs)} labs", "All labs", _parts(found, folder))
    write_lines(folder / TABLE, _lines(found))
    return [*_told(found), f"All labs in one table: {from_here(folder / OVERVIEW)}"]


def _told(found: Overview) -> Iterator[str]:
    yield f"{len(found.standings)} students, {len(found.labs)} labs: {', '.join(found.labs)}."
    for state in (NOT_BEGUN, *(f"stopped after {lab}" for lab in found.labs[:-1])):
        if names := [each.student.name for each in found.in_state(state)]:
            yield few(state.capitalize(), names)
    if found.not_in_list:
        yield few("Of a lab's own list, and not in this one", found.not_in_list)


# --- the page ----------------------------------------------------------------------------------


def _parts(found: Overview, folder: Path) -> Iterator[Markup]:
    begun = len(found.standings) - len(found.in_state(NOT_BEGUN))
    yield tag("p", f"{begun} of {len(found.standings)} students have begun.")
    yield tag("section", tag("h2", "The labs"), _labs(found, folder))
    lines = sorted(found.standings, key=_rank)
    columns = [*_columns(found, folder)]
    yield sorted_table(columns, lines, f"a name, or: {NOT_BEGUN}")
    if any(each.since and each.since.what != HANDED_IN for each in lines):
        words = "* When it was handed in is not known: then it was graded first."
        yield tag("p", words, class_="about")


def _rank(each: StudentStanding) -> tuple[int, str]:
    """Who did least comes first."""
    return len(each.grades), each.student.name


def _labs(found: Overview, folder: Path) -> Markup:
    head = ("lab", "handed in", "pass", "median", "last lab of")
    top = tag("tr", *(tag("th", cell, scope="col") for cell in head))
    rows = [
        tag("tr", *(tag("td", cell) for cell in _lab_line(found, each, folder)))
        for each in found.books
    ]
    return tag("table", tag("thead", top), tag("tbody", *rows))


def _lab_line(found: Overview, book: LabGrades, folder: Path) -> Iterator[str]:
    grades = [each.grades[book.lab] for each in found.standings if book.lab in each.grades]
    scores = [grade.final for grade in grades if grade.final is not None]
    is_last = [each for each in found.standings if [*each.grades][-1:] == [book.lab]]
    yield _link(book.folder / "class.html", book.lab, folder)
    yield f"{len(grades)}"
    yield f"{sum(grade.outcome == 'pass' for grade in grades)}"
    yield f"{statistics.median(scores):g}" if scores else ""
    yield f"{len(is_last)}"


def _columns(found: Overview, folder: Path) -> Iterator[Column[StudentStanding]]:
    yield Column("who", "who", lambda each: each.student.name)
    if any(each.student.id for each in found.standings):
        yield Column("id", "id", lambda each: each.student.id)
    yield Column("stands", "stands", lambda each: each.state(found.labs))
    yield Column("since", "since", _day)
    for book in found.books:
        yield Column(book.lab, "lab", partial(_score, book, folder), partial(_key, book.lab))


def _score(book: LabGrades, folder: Path, each: StudentStanding) -> str:
    grade = each.grades.get(book.lab)
    if grade is None or not grade.submission:
        return score_in(grade)
    page = folder_of(book.folder, grade.submission) / PAGE
    return _link(page, score_in(grade), folder)


def _key(lab: str, each: StudentStanding) -> str:
    """A number alone sorts; a word comes where nothing stands."""
    grade = each.grades.get(lab)
    return "" if grade is None or grade.final is None else f"{grade.final:g}"


def _link(page: Path, text: str, folder: Path) -> Markup:
    """The way from our page to another, if that is there."""
    if not page.is_file():
        return joined(text)
    address = os.path.relpath(page.absolute(), folder.absolute())
    return tag("a", text, href=quote(Path(address).as_posix()))


def _day(each: StudentStanding) -> str:
    return f"{_utc(each.since)[:10]}{_only_graded(each.since)}" if each.since else ""


def _only_graded(since: Since) -> str:
    """A star where the time of handing in is not known."""
    return "" if since.what == HANDED_IN else "*"


def _utc(since: Since) -> str:
    return f"{since.at.astimezone(timezone.utc):%Y-%m-%d %H:%M}"


# --- the file ----------------------------------------------------------------------------------


def _lines(found: Overview) -> Iterable[Line]:
    per_lab = [head for lab in found.labs for head in (lab, f"{lab} outcome")]
    yield ("name", "id", "email", "stands", "since (UTC)", "since is", "handed in", *per_lab)
    for each in found.standings:
        who, since = each.student, each.since
        seen = (_utc(since), since.what) if since else ("", "")
        state, count = each.state(found.labs), f"{len(each.grades)}"
        yield (who.name, who.id, who.email, state, *seen, count, *_cells(each, found.labs))


def _cells(each: StudentStanding, labs: Sequence[str]) -> Iterator[str]:
    for lab in labs:
        grade = each.grades.get(lab)
        yield _key(lab, each)
        yield grade.outcome if grade else "missing"

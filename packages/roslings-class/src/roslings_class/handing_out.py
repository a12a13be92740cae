"""Everything that an instructor takes away, made from the gradebook alone."""

from __future__ import annotations

import textwrap
from datetime import datetime
from pathlib import Path

from pydantic import BaseModel

from ros2_on_pip.typed_paths import from_here
from roslings.course import Lab
from roslings_class.class_page import write_class_page
from roslings_class.csv_files import write_all
from roslings_class.fingerprints import fingerprint
from roslings_class.gradebook import Gradebook
from roslings_class.grades import SAY_WHOSE, Class, LateRule, class_of
from roslings_class.messages import COLUMNS
from roslings_class.moodle_worksheet import read_worksheet
from roslings_class.roster import read_roster
from roslings_class.student_pages import write_pages

KEY = "handout"


class Settings(BaseModel):
    """What `grade` was told last; an override or a regrade writes everything anew by it."""

    roster: Path | None = None
    rule: LateRule | None = None
    times: dict[str, datetime] = {}
    """Submission to the time of handing in, where a list told it."""
    hidden: Path | None = None
    """The checks that students do not have."""
    assignment: str = ""
    """What Canvas calls the lab: the head of its column; empty for the lab's own title."""


def settings_of(book: Gradebook) -> Settings:
    """The settings that the gradebook keeps."""
    kept = book.about(KEY)
    return Settings.model_validate_json(kept) if kept else Settings()


def keep(book: Gradebook, settings: Settings) -> None:
    """Keep settings for later commands."""
    book.note(KEY, settings.model_dump_json())


def hand_out(book: Gradebook, lab: Lab, folder: Path) -> list[str]:
    """Write the CSV files, a page for each student and one for the class; what is to be known.

    Raises BadTable where the class list cannot be read, and CannotWrite.
    """
    settings = settings_of(book)
    students = read_roster(settings.roster) if settings.roster else ()
    found = class_of(book, settings.times, students, settings.rule)
    worksheet = read_worksheet(settings.roster) if settings.roster else None
    write_all(found.grades, lab, folder, settings.assignment, worksheet)
    write_pages(book, lab, found.grades, folder / "students")
    write_class_page(lab, found, fingerprint(lab.starter).marks, folder / "class.html")
    back = [f"To upload as Moodle's worksheet: {from_here(folder)}/moodle.csv"] if worksheet else []
    return [
        *_remarks(found, settings),
        *back,
        f"The class on one page: {from_here(folder)}/class.html",
    ]


def _remarks(found: Class, settings: Settings) -> list[str]:
    lines = []
    if found.missing:
        lines.append(_few("Handed in nothing", [grade.name for grade in found.missing]))
    if found.unknown:
        lines.append(_few("Of nobody in the class list", found.unknown))
    if found.unclear:
        lines.append(_few("Unclear whose", [grade.submission for grade in found.unclear]))
        lines.append(_wrapped(f"  {SAY_WHOSE}"))
    if found.twice:
        lines.append(
            _few("Handed in several, the newest that was graded counts", list(found.twice))
        )
    untimed = sum(grade.late_days is None for grade in found.grades if grade.result)
    if settings.rule and untimed:
        lines.append(
            f"For {untimed} submissions the time is not known: none of them counts as late.\n"
            "Give a CSV file with the columns student, path, submitted."
        )
    return lines


def _few(label: str, names: list[str], most: int = 8) -> str:
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return _wrapped(f"{label} ({len(names)}): {', '.join(names[:most])}{more}")


def _wrapped(text: str) -> str:
    return textwrap.fill(
        text, COLUMNS, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
    )

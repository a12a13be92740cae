"""A folder for each submission: the page, the verdict, and the shapes that other tools read."""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterator
from pathlib import Path

from roslings.course import Lab
from roslings.report import Refusal, write_check50, write_gradescope, write_json, write_junit
from roslings.report.flow import paragraphs
from roslings.report.html import OfClass
from roslings.report.html.document import POLICY, brand, style
from roslings.report.html.markup import prose, tag
from roslings.report.whole_file import write_whole
from roslings.saving import Graded
from roslings.verdict import Verdict
from roslings_class.gradebook import Gradebook
from roslings_class.grades import Grade
from roslings_class.grading import unpacked
from roslings_class.result import Result

LONGEST_NAME = 60
CLASS_PAGE = "../../class.html"
"""Seen from the folder of a submission."""
STAMP = "made-from"
"""Holds the name of the result that a folder was made from, so that it is made once."""
_UNSAFE = re.compile(r"[^\w-]+", re.ASCII)


def folder_name(submission: str) -> str:
    """The folder of a submission; one of its own, whatever the submission is called."""
    safe = _UNSAFE.sub("_", submission).strip("_")[:LONGEST_NAME]
    if safe == submission:
        return safe
    return f"{safe or 'submission'}-{zlib.crc32(submission.encode('utf-8', 'replace')):08x}"


def write_pages(book: Gradebook, lab: Lab, grades: list[Grade], folder: Path) -> None:
    """Bring the folder of each submission up to date. Raises CannotWrite."""
    for grade in (grade for grade in grades if grade.result):
        assert grade.result
        place = folder / folder_name(grade.result.submission)
        stamp = f"{grade.result.digest} {grade.result.attempt} {grade.name}\n"
        if _stamp_of(place) == stamp:
            continue
        place.mkdir(parents=True, exist_ok=True)
        _write(book, lab, grade, grade.result, place)
        write_whole(place / STAMP, stamp.encode())


def _stamp_of(place: Path) -> str:
    stamp = place / STAMP
    return stamp.read_text("utf-8") if stamp.is_file() else ""


def _write(book: Gradebook, lab: Lab, grade: Grade, result: Result, place: Path) -> None:
    verdict = result.verdict
    told = verdict or _refusal(lab, result)
    write_gradescope(told, place / "results.json")
    write_junit(told, place / "junit.xml")
    write_check50(told, place / "check50.json")
    if verdict is None:
        write_whole(place / "report.html", _page_without(grade.name, result).encode())
        return
    write_json(verdict, place / "verdict.json")
    content = book.evidence(result)
    if content is not None:
        graded = Graded(lab, verdict, unpacked(content))
        graded.write_page(place / "report.html", OfClass(grade.name, CLASS_PAGE))
    else:
        write_whole(place / "report.html", _page_of_lines(grade.name, verdict).encode())


def _refusal(lab: Lab, result: Result) -> Refusal:
    """For the platforms."""
    return Refusal(lab.name, *result.told_to_student, result.state == "refused")


def _page_of_lines(name: str, verdict: Verdict) -> str:
    lines = [f"{check.outcome}: {check.title}" for check in verdict.checks]
    score = "no score" if verdict.score is None else f"{verdict.score:g} of 100"
    return _page(name, score, lines)


def _page_without(name: str, result: Result) -> str:
    words = {
        "refused": "This could not be graded as it was handed in",
        "inconclusive": "No verdict yet: not everything could be told",
    }
    return _page(name, words[result.word], _told(result))


def _told(result: Result) -> Iterator[str]:
    for text in result.told_to_student:
        yield from paragraphs(text)


def _page(name: str, heading: str, lines: Iterator[str] | list[str]) -> str:
    """A short page, where there is no evidence to show."""
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", http_equiv="Content-Security-Policy", content=POLICY),
        tag("meta", name_="viewport", content="width=device-width, initial-scale=1"),
        tag("title", f"{name}: {heading}"),
        style(),
    )
    over = tag("p", name, class_="over")
    back = tag("a", "The class", href=CLASS_PAGE)
    header = tag("header", over, tag("h1", heading))
    told = tag("main", *(tag("p", prose(line)) for line in lines))
    body = tag("body", brand(back), header, told)
    return f"<!DOCTYPE html>\n{tag('html', head, body, lang='en')}\n"

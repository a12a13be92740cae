"""A folder for each submission: the page, the verdict, and the shapes that other tools read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from ros2_on_pip.markup import prose, tag
from roslings.course import Lab
from roslings.course.contract import as_typed
from roslings.grading.saving import Graded
from roslings.report.check50 import write_check50
from roslings.report.flow import paragraphs
from roslings.report.gradescope import write_gradescope
from roslings.report.html import OfClass
from roslings.report.html.document import POLICY, brand, style
from roslings.report.json_file import write_json
from roslings.report.junit import write_junit
from roslings.report.refusal import Refusal
from roslings.report.shown_checks import shown_checks
from roslings.report.whole_file import write_whole
from roslings.verdict import Verdict
from roslings_class.folders import PAGE, bring_over, folder_name
from roslings_class.gradebook import Gradebook
from roslings_class.grades import Class, StudentGrade
from roslings_class.grading import unpacked
from roslings_class.own_cards import Courses
from roslings_class.result import GradingResult

STAMP = "made-from"
"""Holds the name of the result that a folder was made from, so that it is made once."""


def write_pages(book: Gradebook, courses: Courses, found: Class, folder: Path) -> None:
    """Bring the folder of each submission up to date. Raises CannotWriteFile."""
    counts = found.counts
    for grade in one_each(found.grades):
        assert grade.result
        place = folder / folder_name(grade.result.submission)
        bring_over(folder, grade.result.submission)
        reader = OfClass(whose(grade), " ".join(_counts(grade.result, counts[grade.submission])))
        stamp = f"{grade.result.digest} {grade.result.attempt} {reader.student} {reader.counts}\n"
        if _stamp_of(place) == stamp:
            continue
        place.mkdir(parents=True, exist_ok=True)
        _write(book, courses.lab_of(grade.result), reader, grade.result, place)
        write_whole(place / STAMP, stamp.encode())


def one_each(grades: list[StudentGrade]) -> Iterator[StudentGrade]:
    """One of each submission: a team's grades have the same page."""
    yield from {grade.submission: grade for grade in reversed(grades) if grade.result}.values()


def whose(grade: StudentGrade) -> str:
    """Whose work it is, all of a team."""
    return ", ".join(grade.team) or grade.name


def _counts(result: GradingResult, said: str) -> Iterator[str]:
    """What is to be known beside the verdict: by whose card, and what a person or a clock did."""
    if result.words:
        own = ", ".join(f"{name} {as_typed(value)}" for name, value in result.words.items())
        yield f"Judged by the card of {result.whose}: {own}."
    if said:
        yield said


def _stamp_of(place: Path) -> str:
    stamp = place / STAMP
    return stamp.read_text("utf-8") if stamp.is_file() else ""


def _write(book: Gradebook, lab: Lab, reader: OfClass, result: GradingResult, place: Path) -> None:
    verdict = result.verdict
    told = verdict or _refusal(lab, result)
    write_gradescope(told, place / "results.json")
    write_junit(told, place / "junit.xml")
    write_check50(told, place / "check50.json")
    if verdict is None:
        (place / "verdict.json").unlink(missing_ok=True)  # of what was handed in before
        write_whole(place / PAGE, _page_without(reader, result).encode())
        return
    write_json(verdict, place / "verdict.json")
    content, shown = book.evidence(result), for_students(verdict)
    if content is not None:
        graded = Graded(lab, shown, unpacked(content))
        graded.write_page(place / PAGE, reader)
    else:
        write_whole(place / PAGE, _page_of_lines(reader, shown).encode())


def for_students(verdict: Verdict) -> Verdict:
    """The same with one line for all checks that students do not have."""
    return verdict.model_copy(update={"checks": shown_checks(verdict)})


def _refusal(lab: Lab, result: GradingResult) -> Refusal:
    """For the platforms."""
    return Refusal(lab.name, *result.told_to_student, result.state == "refused")


def _page_of_lines(reader: OfClass, verdict: Verdict) -> str:
    lines = [f"{check.outcome}: {check.title}" for check in verdict.checks]
    score = "no score" if verdict.score is None else f"{verdict.score:g} of 100"
    return _page(reader.student, score, filter(None, (reader.counts, *lines)))


def _page_without(reader: OfClass, result: GradingResult) -> str:
    words = {
        "refused": "This could not be graded as it was handed in",
        "inconclusive": "No verdict yet: not everything could be told",
    }
    lines = filter(None, (reader.counts, *_told(result)))
    return _page(reader.student, words[result.word], lines)


def _told(result: GradingResult) -> Iterator[str]:
    for text in result.told_to_student:
        yield from paragraphs(text)


def _page(name: str, heading: str, lines: Iterable[str]) -> str:
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
    header = tag("header", over, tag("h1", heading))
    told = tag("main", *(tag("p", prose(line)) for line in lines))
    body = tag("body", brand(), header, told)
    return f"<!DOCTYPE html>\n{tag('html', head, body, lang='en')}\n"

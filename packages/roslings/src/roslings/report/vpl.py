"""A verdict as Moodle's Virtual Programming Lab (VPL) reads it from what a program prints.

Source: the documentation of VPL, "Automated program assessment". A line that begins with the mark
of a comment is shown to the student. `-` makes it a heading, `>` shows it as it is. The last line
with the mark of a grade is the proposed grade. Without such a line no grade is proposed.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ros2_on_pip.language import Text, said
from ros2_on_pip.safe_text import harmless
from roslings.report.junit import lines_of
from roslings.report.not_graded import INCONCLUSIVE, NO_GRADE
from roslings.report.refusal import Refusal
from roslings.report.shown_checks import shown_checks
from roslings.report.wall_words import held
from roslings.report.whole_file import write_whole
from roslings.verdict import CheckOutcome, CheckResult, Verdict

COMMENT, GRADE = "Comment :=>>", "Grade :=>>"
OUTCOMES: dict[CheckOutcome, Text] = {
    "pass": Text("export.outcome.pass", "pass"),
    "fail": Text("export.outcome.fail", "fail"),
    "skip": Text("export.outcome.skip", "skip"),
    "inconclusive": Text("export.outcome.inconclusive", "inconclusive"),
}
MARKS = (":=>>", "<|--", "--|>")
"""What VPL looks for in the output: in a student's words it is written otherwise."""


def write_vpl(told: Verdict | Refusal, path: Path) -> None:
    """Write a verdict, or why there is none, to `path`. Raises CannotWriteFile."""
    lines = refused(told) if isinstance(told, Refusal) else vpl_of(told)
    write_whole(path, ("\n".join(lines) + "\n").encode("utf-8", "replace"))


def vpl_of(verdict: Verdict) -> Iterator[str]:
    """The lines; the grade is of 100."""
    if verdict.score is None:
        yield from _comments(str(INCONCLUSIVE))
    for check in shown_checks(verdict):
        yield from _lines(check)
    yield from _comments("\n".join(filter(None, [*verdict.advice, held(verdict)])))
    if verdict.score is not None:
        yield f"{GRADE} {verdict.score:g}"


def refused(refusal: Refusal) -> Iterator[str]:
    """The lines where there is no verdict."""
    if refusal.is_students:
        yield from _comments(refusal.text)
        yield f"{GRADE} 0"
    else:
        yield from _comments(f"{NO_GRADE}\n{refusal.text}")


def _lines(check: CheckResult) -> Iterator[str]:
    of = "({points:g} of {most:g})"
    points = said("export.points", of, points=check.points, most=check.max_points)
    yield f"{COMMENT}-{_plain(check.title)} {points} {OUTCOMES[check.outcome]}"
    if check.outcome != "pass":
        yield from _comments("\n".join(lines_of(check)[1:]))
        yield from (f"{COMMENT}>{_plain(line)}" for line in check.log)


def _comments(text: str) -> Iterator[str]:
    yield from (f"{COMMENT}{_plain(line)}" for line in text.splitlines())


def _plain(text: str) -> str:
    text = harmless(text)
    for mark in MARKS:
        text = text.replace(mark, f"{mark[0]} {mark[1:]}")
    return text

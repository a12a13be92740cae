"""What an instructor does after the grading: give a score by hand, judge all evidence again."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path

from roslings import course
from roslings.course import Lab
from roslings.judge import judge
from roslings_class.changes import CHANGED_LAST, Regrading, changed_lines, changes
from roslings_class.errors import BatchError, NoGradebook
from roslings_class.gradebook import Gradebook, gradebook, lab_of
from roslings_class.grades import SAY_WHOSE, Class, class_of
from roslings_class.grading import rates_of, unpacked
from roslings_class.handing_out import hand_out, keep, settings_of
from roslings_class.messages import summary_lines
from roslings_class.own_cards import courses_of, in_course
from roslings_class.result import GradingResult
from roslings_class.roster import read_roster
from roslings_class.signed_gradebook import forged_lines, take_key
from roslings_class.signing import BadKey
from roslings_class.version import version_of


def override(folder: Path, submission: str, score: float, reason: str, by: str) -> list[str]:
    """Put a person's score beside the measured one, and write everything anew.

    `submission` is its name, or what the class list says of the student.
    Raises BatchError for a submission that is not there, a score that is none, no reason, nobody.
    """
    if not reason.strip():
        raise BatchError("A score by hand needs a reason.", 'Say it: --reason "..."')
    if not by.strip():
        raise BatchError("A score by hand needs somebody who gives it.", 'Say who: --by "..."')
    if not 0 <= score <= 100:
        raise BatchError(f"{score:g} is no score.", "Give a number from 0 to 100.")
    name = _lab_in(folder)
    with gradebook(folder, name) as book:
        lab = course.lab(name, settings_of(book).hidden)
        submission = _meant(book, submission)
        book.override(submission, score, reason, by)
        told = f"{submission} has {score:g} of 100 now; the measured score is kept beside it."
        if team := _class(book).teams.get(submission):
            told += f"\nIt counts for the whole team: {', '.join(team)}."
        return [told, *_about_key(book, folder), *hand_out(book, lab, folder)]


def _about_key(book: Gradebook, folder: Path) -> list[str]:
    """A score by hand needs no evidence: what is wrong with the key is only told."""
    try:
        return take_key(book, folder)
    except BadKey as bad:
        return [str(bad)]


def _lab_in(folder: Path) -> str:
    found = lab_of(folder)
    if found is None:
        raise NoGradebook(folder)
    return found


def _meant(book: Gradebook, who: str) -> str:
    """The submission of that name, else the one that counts for that student. Raises BatchError."""
    if who in book.latest():
        return who
    found = [
        grade for grade in _class(book).grades if grade.student and grade.student.is_called(who)
    ]
    if not found:
        raise _nobody(book, who)
    if len(found) > 1:
        several = ", ".join(f"{grade.name} ({grade.submission or 'nothing'})" for grade in found)
        raise BatchError(
            f"{who!r} may be one of several: {several}.", "Give the submission's name."
        )
    if found[0].may_have_sent:
        several = ", ".join(found[0].may_have_sent)
        raise BatchError(f"It is unclear which is of {found[0].name}: {several}.", SAY_WHOSE)
    if not found[0].result:
        step = "A score by hand stands beside a measured one: grade something of theirs first."
        raise BatchError(f"{found[0].name} handed in nothing.", step)
    return found[0].submission


def _class(book: Gradebook) -> Class:
    settings = settings_of(book)
    students = read_roster(settings.roster) if settings.roster else ()
    return class_of(book, settings.known_times(), students, settings.rule)


def _nobody(book: Gradebook, who: str) -> BatchError:
    names = list(book.latest())
    near = ", ".join(name for name in names if who.lower() in name.lower())
    step = f"Is it one of these: {near}?" if near else "The names are in grades.csv."
    return BatchError(f"There is no submission and no student {who!r} here.", step)


@dataclass(frozen=True)
class Regraded:
    """What the command says, and what it could not judge."""

    lines: list[str]
    forged: dict[str, str]
    """Submissions whose evidence is not what was measured, and why."""


def regrade_all(folder: Path, lab_name: str, hidden: Path | None) -> Regraded:
    """Judge all kept evidence again, running nothing; earlier verdicts are kept.

    Without `hidden`, the hidden checks of the grading are used. Evidence that was not measured here
    is not judged. Raises BadGradebook and BadKey.
    """
    with gradebook(folder, course.lab(lab_name).name) as book:
        about_key = take_key(book, folder)
        settings = settings_of(book)
        if hidden:
            settings = settings.model_copy(update={"hidden": hidden.absolute()})
            keep(book, settings)
        lab = course.lab(lab_name, settings.hidden)
        forged = book.forged()
        before = {name: each for name, each in book.latest().items() if name not in forged}
        with courses_of(lab) as courses:
            told = Counter(_again(book, each, courses.lab_of(each)) for each in before.values())
        changed, same, without = (told[word] for word in ("changed", "same", "without"))
        lines = [*about_key, f"{changed + same} judged again, {changed} scores changed."]
        lines += changed_lines(_noted(book, before, changed + same), _class(book).grades, folder)
        if without:
            lines.append(f"{without} have no evidence: grade those again to judge them anew.")
        lines += forged_lines(forged, lab.name, folder)
        lines += summary_lines(book, list(book.latest()))
        return Regraded([*lines, *hand_out(book, lab, folder)], forged)


def _noted(book: Gradebook, before: Mapping[str, GradingResult], judged: int) -> Regrading:
    """What was changed; kept for the page of the class, where it is anything."""
    latest = book.latest()
    found = [
        change
        for name, result in before.items()
        if result.verdict and (verdict := latest[name].verdict)
        for change in changes(name, result.verdict, verdict)
    ]
    regrading = Regrading(at=datetime.now(timezone.utc), judged=judged, changes=found)
    if found:
        book.note(CHANGED_LAST, regrading.model_dump_json())
    return regrading


def _again(book: Gradebook, result: GradingResult, lab: Lab) -> str:
    content = book.evidence(result)
    if result.verdict is None:
        return "refused"
    if content is None:
        return "without"
    evidence = unpacked(content)
    with in_course(lab):
        verdict = judge(lab, evidence)
    verdict = verdict.model_copy(update={"seconds": result.verdict.seconds})
    version = version_of(lab)
    if verdict == result.verdict and version == result.lab_version:
        return "same"
    attempt = book.attempts(result.submission, result.digest) + 1
    words = {
        "verdict": verdict,
        "lab_version": version,
        "attempt": attempt,
        "rates": rates_of(evidence, lab),
    }
    book.judged_again(result.model_copy(update=words), content)
    return "same" if verdict.score == result.score else "changed"

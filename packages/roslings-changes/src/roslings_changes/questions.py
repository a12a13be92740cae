"""Questions about a package that passes: which check fails first, where one line is another?

Each change is made in a copy of the package, and a grading of that copy gives the answer. Which
changes are asked about hangs on what the package holds, so two packages get other questions.
"""

from __future__ import annotations

import hashlib
import shutil
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from roslings.course import Lab
from roslings.verdict import CheckResult, Verdict
from roslings_changes.candidates import CodeChange, candidates

WANTED = 3
MOST_GRADED = 12
"""Where so many changes gave no three questions, there are fewer."""
PLAIN = frozenset(
    {"number", "unit", "sign", "arithmetic", "comparison", "condition", "name", "text", "drop"}
)
"""Operators that change what stands in one line; the others put lines of their own into it."""
LONGEST_LINES = 6
"""A question is read on a screen."""

Grade = Callable[[Path], Verdict]


@dataclass(frozen=True)
class Question:
    """A change, and what the grader says of it."""

    change: CodeChange
    failed: CheckResult
    """The first check that fails."""
    checks: tuple[CheckResult, ...]
    """All of the lab, in the grader's order."""


def questions(lab: Lab, package: Path, grade: Grade) -> Iterator[Question]:
    """At most `WANTED`, each about another check. Raises what `grade` raises."""
    asked: set[str] = set()
    for change in list(drawn(candidates(lab, package)))[:MOST_GRADED]:
        verdict = graded(package, change, grade)
        failed = verdict.failed()[0] if verdict.outcome == "fail" and verdict.failed() else None
        if failed and failed.id not in asked:
            asked.add(failed.id)
            yield Question(change, failed, verdict.checks)
        if len(asked) == WANTED:
            return


def drawn(found: Iterable[CodeChange]) -> Iterator[CodeChange]:
    """Those that are read easily, in an order that the package draws: each on another line."""
    plain = [
        each
        for each in found
        if each.operator in PLAIN and len(each.changed.splitlines()) <= LONGEST_LINES
    ]
    lines: set[tuple[str, int]] = set()
    for change in sorted(plain, key=_lot):
        if change.place not in lines:
            lines.add(change.place)
            yield change


def _lot(change: CodeChange) -> str:
    return hashlib.sha256(f"{change.before}\0{change.file}\0{change.changed}".encode()).hexdigest()


def graded(package: Path, change: CodeChange, grade: Grade) -> Verdict:
    """What is said of a copy in which it is made; the package itself stays as it is."""
    with TemporaryDirectory(prefix="roslings-explain-") as folder:
        copy = Path(folder) / package.name
        shutil.copytree(package, copy, symlinks=True)
        (copy / change.file).write_text(change.after, "utf-8")
        return grade(copy)

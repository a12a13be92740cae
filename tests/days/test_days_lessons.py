"""Every lesson that is written: its rules, its cells, its anchors, and what it gives away."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from lesson_runs import days, lessons, names, run_by_nbval, run_steps, steps_of

from roslings.course import all_labs, root
from roslings.lessons import read_glossary
from roslings.lessons.rules import Lesson, broken_rules

WRITTEN = list(lessons())
ANCHOR = re.compile(r"\b([0-9]{2}-[a-z0-9-]+)#([a-z0-9-]+)")
POINTING = ("labs/*/hints.yaml", "labs/*/task.md", "graders/*.py", "src/**/*.py", "src/**/*.yaml",
            "src/**/*.md", "glossary/*.yaml")  # fmt: skip
each_lesson = pytest.mark.parametrize("lesson", WRITTEN, ids=names(WRITTEN))


@each_lesson
def test_a_lesson_breaks_no_rule(lesson: Lesson) -> None:
    """The rules that a machine can check."""
    broken = broken_rules(lesson, read_glossary(root()))
    assert not broken, "\n".join(map(str, broken))


@pytest.mark.slow
@each_lesson
def test_nbval_runs_a_lesson(lesson: Lesson, tmp_path: Path) -> None:
    """From top to bottom, as a student would."""
    done = run_by_nbval(lesson.path, tmp_path, root())
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.slow
@each_lesson
def test_cells_run_again_and_in_another_order(lesson: Lesson, tmp_path: Path) -> None:
    """Down, and up again in the same kernel; changes fail before the edit and pass after it.

    On the way up they are made already: what they built (a file, a package) may still stand.
    """
    steps = steps_of(lesson)
    backwards = [step for step in steps[:0:-1] if step.wanted != "assert"]
    wrong = run_steps([*steps, *backwards], tmp_path, root(), lesson.path.parent)
    assert wrong == []


def anchors_wanted() -> dict[str, set[tuple[str, str]]]:
    """Day to the anchors that others point to, and where they do."""
    found: dict[str, set[tuple[str, str]]] = {}
    for pattern in POINTING:
        for file in sorted(root().glob(pattern)):
            for day, anchor in ANCHOR.findall(file.read_text("utf-8")):
                found.setdefault(day, set()).add((anchor, str(file.relative_to(root()))))
    return found


@each_lesson
def test_hints_find_their_paragraph(lesson: Lesson) -> None:
    """Labs and the doctor link to headings of the lesson."""
    wanted = anchors_wanted().get(lesson.day.id, set())
    missing = sorted((anchor, file) for anchor, file in wanted if anchor not in lesson.anchors)
    assert missing == []


def test_hints_name_days_of_the_path() -> None:
    """An anchor of a day that does not exist leads nowhere, whatever is written later."""
    known = {day.id for day in days()}
    labs = {lab.card.day for lab in all_labs()}
    assert labs <= known and set(anchors_wanted()) <= known


def test_every_day_has_a_lesson_and_a_quiz() -> None:
    """The path names no day that is not there."""
    folders = [root() / "days" / day.id for day in days()]
    assert [f.name for f in folders if not (f / "lesson.ipynb").is_file()] == []
    assert [f.name for f in folders if not (f / "quiz.yaml").is_file()] == []

"""The rules of a lesson that a machine can check: `python -m roslings_learn.lessons.rules FILE...`.

Each rule tells cell, line and mend; all broken rules are told at once. Runs no cell.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from roslings_learn.lessons.glossary import Glossary
from roslings_learn.lessons.lessons import read_glossary
from roslings_learn.lessons.path import Day
from roslings_learn.lessons.rules import code, concept, form, links, reading, sections, vocabulary
from roslings_learn.lessons.rules.lesson_file import (
    BrokenRule,
    Lesson,
    LessonCell,
    NoLesson,
    read_lesson,
)

__all__ = ["BrokenRule", "Day", "Lesson", "LessonCell", "NoLesson", "broken_rules", "read_lesson"]


def broken_rules(lesson: Lesson, glossary: Glossary) -> list[BrokenRule]:
    """Every rule that `lesson` breaks, in the order of its cells."""
    return sorted(set(_broken(lesson, glossary)))


def _broken(lesson: Lesson, glossary: Glossary) -> Iterator[BrokenRule]:
    for room in (form, sections, concept, code, reading, links):
        yield from room.broken(lesson)
    yield from vocabulary.broken(lesson, glossary)


def glossary_of(root: Path) -> Glossary:
    """The words of the course in `root`. Raises BadLessons."""
    return read_glossary(root)

"""Rules on a concept: picture, predict, run, explain, change."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from roslings_learn.lessons.rules.lesson_file import BrokenRule, Lesson, LessonCell
from roslings_learn.lessons.rules.prose import IMAGE
from roslings_learn.lessons.rules.sections import concepts

STEPS = ("predict", "run", "explain", "change")
CODE_STEPS = ("run", "change")


def broken(lesson: Lesson) -> Iterator[BrokenRule]:
    """Every rule on concepts that `lesson` breaks."""
    for title in concepts(lesson):
        yield from _concept(lesson, title, lesson.sections[title])
    for cell in lesson.cells:
        yield from _step(lesson, cell)
        if "change" in cell.tags and cell.is_code:
            yield from _change(lesson, cell)


def _concept(lesson: Lesson, title: str, cells: Sequence[LessonCell]) -> Iterator[BrokenRule]:
    if not any(IMAGE.search(cell.text) for cell in cells if not cell.is_code):
        mend = "Add ![what it shows](pictures/NAME.svg) before the cell that asks to predict."
        yield lesson.broken_at(cells[0], 1, f"The concept '{title}' has no picture.", mend)
    steps = [step for cell in cells for step in STEPS if step in cell.tags]
    shape = [step for at, step in enumerate(steps) if at == 0 or steps[at - 1] != step]
    if not shape or shape != list(STEPS) * (len(shape) // len(STEPS)):
        mend = "Tag its cells in this order: predict, run, explain, change."
        what = f"The concept '{title}' goes: {', '.join(steps) or 'no tagged cell'}."
        yield lesson.broken_at(cells[0], 1, what, mend)


def _step(lesson: Lesson, cell: LessonCell) -> Iterator[BrokenRule]:
    for step in STEPS:
        if step in cell.tags and cell.is_code != (step in CODE_STEPS):
            kind = "code" if step in CODE_STEPS else "Markdown"
            mend = f"Make it a {kind} cell, or take the tag away."
            yield lesson.broken_at(cell, 1, f"The tag '{step}' is for {kind}.", mend)


def _change(lesson: Lesson, cell: LessonCell) -> Iterator[BrokenRule]:
    if "raises-exception" not in cell.tags:
        mend = "Add the tag raises-exception: it fails before the edit."
        yield lesson.broken_at(cell, 1, "Not every run of this cell ends well.", mend)
    if not cell.text.startswith("# Change: "):
        mend = "Begin it with: # Change: what to do."
        yield lesson.broken_at(cell, 1, "The cell does not say what to change.", mend)
    yield from _asserts(lesson, cell)
    yield from _answer(lesson, cell)


def _asserts(lesson: Lesson, cell: LessonCell) -> Iterator[BrokenRule]:
    tree = parsed(cell.text)
    if tree is None:
        return
    found = [node for node in ast.walk(tree) if isinstance(node, ast.Assert)]
    if not found:
        mend = "End it with: assert condition, 'what is still wrong'."
        yield lesson.broken_at(cell, 1, "A change cell needs an assert.", mend)
    for node in (node for node in found if node.msg is None):
        mend = "Add a message that helps: assert rate == 10, 'Still 2 Hz: ...'."
        yield lesson.broken_at(cell, node.lineno, "The assert says nothing.", mend)


def _answer(lesson: Lesson, cell: LessonCell) -> Iterator[BrokenRule]:
    if not cell.answer:
        mend = 'Add metadata: "roslings": {"answer": [["old text", "new text"]]}.'
        yield lesson.broken_at(cell, 1, "The right edit is not known.", mend)
        return
    try:
        after = cell.answered()
    except ValueError as error:
        mend = "Choose an old text that stands in the cell exactly once."
        yield lesson.broken_at(cell, 1, f"The answer does not fit: {error}.", mend)
        return
    if after == cell.text or parsed(after) is None:
        mend = "Give a new text that is another one, and right Python."
        yield lesson.broken_at(cell, 1, "The answer changes nothing, or is no Python.", mend)


def parsed(code: str) -> ast.Module | None:
    """The syntax tree; None where it is no Python (a cell may show a syntax error on purpose)."""
    try:
        return ast.parse(code)
    except SyntaxError:
        return None

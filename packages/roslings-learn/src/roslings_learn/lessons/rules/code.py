"""Rules on code cells and on blocks of commands."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from roslings_learn.lessons.rules.concept import parsed
from roslings_learn.lessons.rules.lesson_file import BrokenRule, Lesson, LessonCell

MOST_LINES, MOST_COLUMNS = 15, 88
FIRST_LINES = 8
"""Of the first cell: something happens before anything is explained."""
SHELLS = ("bash", "console", "sh", "shell", "shell-session")
MACHINE = re.compile(r"\b(terminal|pi|laptop|robot)\b", re.IGNORECASE)
PLACE = re.compile(r"folder|~|directory", re.IGNORECASE)


def broken(lesson: Lesson) -> Iterator[BrokenRule]:
    """Every rule on code that `lesson` breaks."""
    cells = [cell for cell in lesson.cells if cell.is_code]
    for cell in cells:
        yield from _size(lesson, cell, FIRST_LINES if cell is cells[0] else MOST_LINES)
        yield from _sleeps(lesson, cell)
    yield from _commands(lesson)


def _size(lesson: Lesson, cell: LessonCell, most: int) -> Iterator[BrokenRule]:
    lines = cell.text.splitlines()
    if not cell.text.strip():
        yield lesson.broken_at(cell, 1, "The cell is empty.", "Delete it.")
    if len(lines) > most:
        what = f"The cell has {len(lines)} lines."
        yield lesson.broken_at(cell, most + 1, what, f"At most {most}: make two of it.")
    for number, line in enumerate(lines, 1):
        if len(line) > MOST_COLUMNS:
            what = f"The line has {len(line)} columns."
            yield lesson.broken_at(cell, number, what, f"At most {MOST_COLUMNS}: break it.")


def _sleeps(lesson: Lesson, cell: LessonCell) -> Iterator[BrokenRule]:
    tree = parsed(cell.text)
    for call in _own_calls(tree) if tree else ():
        name = ast.unparse(call.func)
        if name in ("sleep", "time.sleep", "asyncio.sleep"):
            mend = "Wait for what you need: ros.collect, ros.until, ros.wait."
            yield lesson.broken_at(cell, call.lineno, "The cell sleeps for a fixed time.", mend)


def _own_calls(node: ast.AST) -> Iterator[ast.Call]:
    """Calls that the cell itself makes; what stands in a function may be the mistake to show."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            continue
        if isinstance(child, ast.Call):
            yield child
        yield from _own_calls(child)


def _commands(lesson: Lesson) -> Iterator[BrokenRule]:
    before = None
    for part in lesson.parts:
        if part.block.kind == "code" and part.block.language in SHELLS:
            said = before.block.text if before and before.cell == part.cell else ""
            if not (MACHINE.search(said) and PLACE.search(said)):
                mend = "Write before it, for example: Terminal 1, in the roslings folder:"
                what = "These commands do not say in which terminal and folder."
                yield lesson.broken_at(part.cell, part.block.line, what, mend)
        before = part

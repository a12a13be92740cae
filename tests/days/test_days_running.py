"""What runs the lessons, tried on a tiny one: right and wrong cells are told apart."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from lesson_runs import Walk, walk
from tiny_course import Cell, read_tiny, with_cell, write_course


def walk_of(cells: tuple[Cell, ...], folder: Path) -> Walk:
    """A walk through the tiny lesson with these cells."""
    lesson = read_tiny(write_course(folder / "course", cells))
    return walk(lesson, folder, folder / "course")


def test_what_goes_otherwise_than_tagged_is_found(tmp_path: Path) -> None:
    """An error that no tag announces, a change that does not help, a mistake that raises nothing.

    All else is in order: tagged errors are expected, the kernel is found, the quiz is there.
    """
    cells = with_cell("blink-change", answer=[["0.5", "0.2"]])
    changed = {"wrong-2": "1", "wrong-1-mended": "print(1 / 0)"}
    cells = tuple(replace(cell, text=changed.get(cell.id, cell.text)) for cell in cells)
    found = walk_of(cells, tmp_path)
    divided = "wrong-1-mended: raised ZeroDivisionError: division by zero"
    tame = "wrong-2: raised nothing"
    assert sorted(found.down) == [divided, tame]
    assert sorted(found.up) == [
        "blink-change, edited: raised AssertionError: Still 2 Hz.", divided, tame,
    ]  # fmt: skip
    assert "ZeroDivisionError" in found.executed and "edited" not in found.executed

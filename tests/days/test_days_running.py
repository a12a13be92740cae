"""What runs the lessons, tried on a tiny one: right and wrong cells are told apart."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from lesson_runs import run_by_nbval, run_steps, steps_of
from tiny_course import CELLS, read_tiny, with_cell, write_course


@pytest.mark.slow
def test_nbval_runs_a_lesson_and_finds_the_cell_that_fails(tmp_path: Path) -> None:
    """Tagged errors are expected, the kernel is found, the quiz is there; other errors count."""
    lesson = write_course(tmp_path / "course", with_cell("wrong-1-mended", text="print(1 / 0)"))
    done = run_by_nbval(lesson, tmp_path, tmp_path / "course")
    passed = sum(cell.code for cell in CELLS) - 1
    assert done.returncode == 1 and f"1 failed, {passed} passed" in done.stdout, done.stdout
    assert "ZeroDivisionError" in done.stdout


def test_what_goes_otherwise_than_tagged_is_found(tmp_path: Path) -> None:
    """A change that does not help, and a mistake that raises nothing; all else is in order."""
    cells = with_cell("blink-change", answer=[["0.5", "0.2"]])
    mistake = next(cell for cell in cells if cell.id == "wrong-2")
    tame = tuple(replace(cell, text="1") if cell is mistake else cell for cell in cells)
    lesson = read_tiny(write_course(tmp_path / "course", tame))
    assert run_steps(steps_of(lesson), tmp_path, tmp_path / "course", tmp_path) == [
        "blink-change, edited: raised AssertionError: Still 2 Hz.",
        "wrong-2: raised nothing",
    ]

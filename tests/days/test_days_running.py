"""What runs the lessons, tried on a tiny one: right and wrong cells are told apart."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from tiny_course import CELLS, DAY, Cell, printed, with_cell, write_course

from lesson_runs import run_lesson, walk

pytestmark = pytest.mark.slow


def changed(cells: tuple[Cell, ...], **texts: str) -> tuple[Cell, ...]:
    """These cells say another thing; a line for a minus sign."""
    return tuple(replace(c, text=texts.get(c.id.replace("-", "_"), c.text)) for c in cells)


def test_what_goes_otherwise_than_tagged_is_found(tmp_path: Path) -> None:
    """An error that no tag announces, a change that does not help, a mistake that raises nothing.

    All else is in order: tagged errors are expected, the kernel is found, the quiz is there.
    """
    cells = with_cell("blink-change", answer=[["0.5", "0.2"]])
    cells = changed(cells, wrong_2="1", wrong_1_mended="print(1 / 0)")
    found, said = walk(write_course(tmp_path / "course", cells), tmp_path / "walks")
    divided = "wrong-1-mended: raised ZeroDivisionError: division by zero"
    tame = "wrong-2: raised nothing"
    assert [each.partition("\n")[0] for each in sorted(found.down)] == [
        "wrong-1-mended: Cell execution caused an exception",
        tame,
    ]
    assert sorted(found.up) == [
        "blink-change, edited: raised AssertionError: Still 2 Hz.",
        divided,
        tame,
    ]
    assert "ZeroDivisionError" in found.executed and "edited" not in found.executed
    assert "2 failed" in said


def test_another_word_in_a_compared_output_is_found_and_can_be_saved(tmp_path: Path) -> None:
    """Then the lesson is as it was before the word was changed, letter by letter."""
    ran = {"execution_count": 2, "outputs": [printed("[0, 1, 0, 2]\n")]}
    lesson = write_course(tmp_path / "course", with_cell("blink-run", more=ran))
    found, said = walk(lesson, tmp_path / "walks")
    assert [each.partition("\n")[0] for each in found.down] == ["blink-run: Cell outputs differ"]
    assert f"./roslings test days/{DAY} --nbval-lax --save-outputs" in said
    right = write_course(tmp_path / "right")
    walk(lesson, tmp_path / "walks", "--save-outputs")
    assert lesson.read_text("utf-8") == right.read_text("utf-8")
    assert walk(lesson, tmp_path / "walks")[0].down == []


def test_nothing_is_left_in_the_course(tmp_path: Path) -> None:
    """What a cell writes beside itself is thrown away with the copy."""
    cells = changed(CELLS, check_run="open('here.txt', 'w').close()")
    lesson = write_course(tmp_path / "course", cells)
    before = sorted(tmp_path.joinpath("course").rglob("*"))
    assert walk(lesson, tmp_path / "walks")[0].down == []
    assert sorted(tmp_path.joinpath("course").rglob("*")) == before


def test_one_cell_alone_runs_after_those_above_it(tmp_path: Path) -> None:
    """As `.ci/run` does, where a cell failed beside others."""
    cells = changed(CELLS, check_run="assert lamp == 1 and on")
    lesson = write_course(tmp_path / "course", cells)
    assert "1 passed" in run_lesson(Path(f"{lesson}::check-run"))

"""The drills' files: what may stand in them, and how a mistake is told."""

from __future__ import annotations

import shutil
from collections import Counter
from pathlib import Path

import pytest

from roslings.course import root
from roslings.course.files import BadCourseFile
from roslings_class.release import is_for_students
from roslings_learn.drills import Drill, NoSuchDrill, all_drills, drill
from roslings_learn.drills.course import of_day, problems

DAY_OF_TEN = Counter(mend=4, listen=3, predict=2, write=1)
CARD = """
title: A lamp
kind: mend
lesson: days/02-nodes#timers
idea: Something.
nodes: [{node: /lamp}]
starter: {check: runs, fault: DidNotComeUp, names: ended}
hints: [a, b, c]
"""


@pytest.fixture
def tiny(tmp_path: Path) -> Path:
    """A course with the lesson of day 2 and one drill, in which nothing is wrong."""
    lesson = tmp_path / "days" / "02-nodes" / "lesson.ipynb"
    folder = lesson.parent / "drills" / "01_lamp"
    folder.mkdir(parents=True)
    shutil.copy(root() / "days" / "02-nodes" / "lesson.ipynb", lesson)
    (folder / "drill.yaml").write_text(CARD.lstrip())
    (folder / "starter.py").write_text("1\n2\n3\n")
    return tmp_path


def told(course: Path) -> list[tuple[str, int]]:
    """File and line of each mistake in a course."""
    return [(each.path.name, each.line) for one in all_drills(course) for each in problems(one)]


def rewrite(course: Path, before: str, after: str) -> None:
    """Change the card."""
    card = course / "days" / "02-nodes" / "drills" / "01_lamp" / "drill.yaml"
    assert before in card.read_text()
    card.write_text(card.read_text().replace(before, after))


@pytest.mark.parametrize("one", all_drills(), ids=lambda one: one.name)
def test_nothing_is_wrong_in_a_drill(one: Drill) -> None:
    """Cards, anchors, lengths."""
    assert [str(each) for each in problems(one)] == []


@pytest.mark.parametrize("one", all_drills(), ids=lambda one: one.name)
def test_the_last_hint_has_code(one: Drill) -> None:
    """It promises "the same idea in other code"."""
    assert any(line.startswith("    ") for line in one.card.hints[2].splitlines())


@pytest.mark.parametrize("day", sorted({one.day for one in all_drills()}))
def test_a_day_has_the_usual_kinds(day: str) -> None:
    """Of ten: four to mend, three that nobody hears, two to foretell, one to write."""
    drills = of_day(all_drills(), day)
    assert [one.number for one in drills] == list(range(1, len(drills) + 1))
    kinds = Counter(one.card.kind for one in drills)
    assert kinds == DAY_OF_TEN if len(drills) == 10 else set(kinds) <= set(DAY_OF_TEN)


def test_a_good_drill_has_no_mistake(tiny: Path) -> None:
    """The tests below change one thing in it."""
    assert told(tiny) == []


@pytest.mark.parametrize(
    ("before", "after", "line"),
    [
        ("#timers", "#timer", 3),
        ("days/02-nodes", "days/03-topics", 3),
        ("kind: mend", "kind: repair", 2),
        ("/lamp}", "lamp}", 5),
        ("idea:", "ideas:", 1),
        ("a, b, c", "a, b", 7),
        ("kind: mend", "kind: predict", 1),
        ("nodes: [{node: /lamp}]", "prints: [lit]\nsays: 1", 1),
        ("nodes:", "tells: [{topic: /on, type: a/msg/B, message: {data: true}}]\nnodes:", 5),
    ],
)
def test_a_mistake_is_told_with_its_line(tiny: Path, before: str, after: str, line: int) -> None:
    """Of the card."""
    rewrite(tiny, before, after)
    assert ("drill.yaml", line) in told(tiny)


def test_a_missing_starter_is_told(tiny: Path) -> None:
    """By its name."""
    (tiny / "days" / "02-nodes" / "drills" / "01_lamp" / "starter.py").unlink()
    assert told(tiny) == [("starter.py", 1)]


def test_a_starter_is_short(tiny: Path) -> None:
    """One file that is read at one look."""
    starter = tiny / "days" / "02-nodes" / "drills" / "01_lamp" / "starter.py"
    starter.write_text("1\n" * 71)
    assert told(tiny) == [("starter.py", 1)]


def test_two_drills_of_one_name_are_told(tiny: Path) -> None:
    """Who types the name would mean either."""
    folder = tiny / "days" / "02-nodes" / "drills"
    shutil.copytree(folder / "01_lamp", folder / "02_lamp")
    with pytest.raises(BadCourseFile, match="is called lamp, too"):
        all_drills(tiny)


def test_an_unknown_name_gets_the_nearest() -> None:
    """And the way to see all."""
    name = all_drills()[0].name
    with pytest.raises(NoSuchDrill, match=f"Did you mean '{name}'"):
        drill(f"{name}x")


def test_students_get_no_solution() -> None:
    """Cards, starters and what runs beside: yes."""
    folder = "days/02-nodes/drills/01_no_spin"
    assert is_for_students(f"{folder}/starter.py")
    assert is_for_students(f"{folder}/drill.yaml")
    assert not is_for_students(f"{folder}/solution.py")
    assert not is_for_students(f"{folder}/solution.sh")

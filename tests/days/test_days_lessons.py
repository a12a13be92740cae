"""Every lesson that is written: its rules, its cells, and what it gives away."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from lesson_runs import days, lessons, walked
from roslings.course import all_labs, root
from roslings_learn.drills import all_drills
from roslings_learn.lessons import read_glossary
from roslings_learn.lessons.rules import Lesson, broken_rules
from roslings_learn.lessons.rules.alternatives import untold

WRITTEN = list(lessons())
each_lesson = pytest.mark.parametrize(
    "lesson",
    [
        pytest.param(lesson, id=lesson.day.id, marks=pytest.mark.xdist_group(lesson.day.id))
        for lesson in WRITTEN
    ],
)


@each_lesson
def test_a_lesson_breaks_no_rule(lesson: Lesson) -> None:
    """The rules that a machine can check."""
    broken = broken_rules(lesson, read_glossary(root()))
    assert not broken, "\n".join(map(str, broken))


def section_of(lesson: Lesson, anchor: str) -> str:
    """The H2 that an anchor lies in."""
    section = ""
    for _, heading in lesson.headings:
        section = heading.text if heading.level == 2 else section
        if heading.slug == anchor:
            return section
    raise AssertionError(f"{lesson.day.id} has no #{anchor}")


@each_lesson
def test_each_drill_is_named_in_the_section_of_its_idea(lesson: Lesson) -> None:
    """The reader meets it there; the rest comes before the lab."""
    wanted: dict[str, list[str]] = {}
    for drill in (each for each in all_drills() if each.day == lesson.day.id):
        anchor = drill.card.lesson.partition("#")[2]
        wanted.setdefault(section_of(lesson, anchor), []).append(drill.name)
    named = {
        title: sorted(re.findall(r"`(\w+)`", line))
        for title, cells in lesson.sections.items()
        for cell in cells
        for line in cell.text.splitlines()
        if line.startswith(("**Drill:**", "**Drills:**"))
    }
    assert named == {title: sorted(names) for title, names in wanted.items()}


@pytest.mark.slow
@each_lesson
def test_a_lesson_runs_from_top_to_bottom(lesson: Lesson, shared_folder: Path) -> None:
    """Errors only where a tag announces them; changes fail before the edit."""
    assert walked(shared_folder, lesson).down == []


@pytest.mark.slow
@each_lesson
def test_cells_run_again_and_in_another_order(lesson: Lesson, shared_folder: Path) -> None:
    """Up again in the same kernel, with each change made: it passes then.

    What cells built on the way down (a file, a package) still stands.
    """
    assert walked(shared_folder, lesson).up == []


def test_labs_name_days_of_the_path() -> None:
    """A lab of no day has no lesson."""
    assert {lab.card.day for lab in all_labs()} <= {day.id for day in days()}


def read(file: Path) -> str:
    """Its text."""
    return file.read_text("utf-8")


def pages() -> list[Path]:
    """All Markdown that a student reads beside the lessons."""
    return sorted([*root().glob("days/*/*.md"), *root().glob("site/pages/reference/*.md")])


PICTURE = re.compile(r"!\[([^\]]*)\]\((pictures/[^)]+\.svg)\)")


def test_pages_beside_a_lesson_tell_the_pictures_that_are_drawn() -> None:
    """As the rules want it of lessons."""
    shown = [(page, *each) for page in pages() for each in PICTURE.findall(read(page))]
    assert shown
    wrong = {(target, *untold(alt, page.parent / target)) for page, alt, target in shown}
    assert {each for each in wrong if len(each) > 1} == set()


LEVEL = re.compile(r"\*\*Level:\*\* (\w+)\.")


@each_lesson
def test_a_day_and_its_labs_are_of_one_level(lesson: Lesson) -> None:
    """The same word at the head of the lesson and of each task."""
    (level,) = LEVEL.findall("\n".join(cell.text for cell in lesson.cells if not cell.is_code))
    assert level in ("beginner", "middle")
    tasks = {lab.name: read(lab.task) for lab in all_labs() if lab.card.day == lesson.day.id}
    assert {name: LEVEL.findall(text) for name, text in tasks.items()} == {
        name: [level] for name in tasks
    }


def test_every_day_has_a_lesson_and_a_quiz() -> None:
    """The path names no day that is not there."""
    folders = [root() / "days" / day.id for day in days()]
    assert [f.name for f in folders if not (f / "lesson.ipynb").is_file()] == []
    assert [f.name for f in folders if not (f / "quiz.yaml").is_file()] == []

"""Every lesson that is written: its rules, its cells, its anchors, and what it gives away."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from lesson_runs import days, lessons, walked

from roslings.course import all_labs, root
from roslings.drills import all_drills
from roslings.lessons import read_glossary
from roslings.lessons.rules import Lesson, broken_rules
from roslings.lessons.rules.alternatives import untold
from roslings.lessons.rules.prose import slug

WRITTEN = list(lessons())
ANCHOR = re.compile(r"\b([0-9]{2}-[a-z0-9-]+)#([a-z0-9-]+)")
POINTING = ("labs/*/hints.yaml", "labs/*/task.md", "graders/*.py", "src/**/*.py", "src/**/*.yaml",
            "src/**/*.md", "glossary/*.yaml")  # fmt: skip
LINK_TO_PAGE = re.compile(r"\]\(([a-z0-9./-]+\.md)#([a-z0-9-]+)\)")
PAGE_OF_CHECK = re.compile(r'lesson="((?:reference|[0-9]{2}-[a-z-]+)/[a-z0-9-]+)#([a-z0-9-]+)"')
each_lesson = pytest.mark.parametrize("lesson", [
    pytest.param(lesson, id=lesson.day.id, marks=pytest.mark.xdist_group(lesson.day.id))
    for lesson in WRITTEN
])  # fmt: skip


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


def anchors_wanted() -> dict[str, set[tuple[str, str]]]:
    """Day to the anchors that others point to, and where they do."""
    found: dict[str, set[tuple[str, str]]] = {}
    for pattern in POINTING:
        for file in sorted(root().glob(pattern)):
            for day, anchor in ANCHOR.findall(file.read_text("utf-8")):
                found.setdefault(day, set()).add((anchor, str(file.relative_to(root()))))
    return found


def test_what_points_to_a_page_finds_its_paragraph() -> None:
    """Pages beside a lesson, and reference pages: from lessons, from pages, from the doctor."""
    pointing = [*pages(), *(lesson.path for lesson in WRITTEN)]
    found = [(file, *link) for file in pointing for link in LINK_TO_PAGE.findall(read(file))]
    found += [
        (file, place, anchor)
        for file in sorted(root().glob("src/roslings/doctor/checks/*.py"))
        for place, anchor in PAGE_OF_CHECK.findall(read(file))
    ]
    assert len(found) > 10
    missing = [each for each in found if each[2] not in anchors_of(page_meant(*each[:2]))]
    assert missing == []


def read(file: Path) -> str:
    """Its text."""
    return file.read_text("utf-8")


def pages() -> list[Path]:
    """All Markdown that a student reads between the lessons."""
    return sorted([*root().glob("days/*/*.md"), *root().glob("site/pages/reference/*.md")])


def page_meant(file: Path, place: str) -> Path:
    """The file that a link in `file` means; the doctor's places begin in the course."""
    if file.suffix != ".py":
        return (file.parent / place).resolve()
    above = "site/pages" if place.startswith("reference/") else "days"
    return root() / above / f"{place}.md"


def anchors_of(page: Path) -> set[str]:
    """The slugs of its headings; none where there is no such page."""
    text = re.sub(r"```.*?```", "", read(page) if page.is_file() else "", flags=re.DOTALL)
    return {slug(title) for title in re.findall(r"^#+ (.+)$", text, re.MULTILINE)}


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

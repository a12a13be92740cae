"""Whatever points to a paragraph finds it: every anchor in every file of the repository."""

from __future__ import annotations

import html
import re
import subprocess
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from ros_doctor.registry import all_checks
from roslings.course import root
from roslings_learn.lessons import read_glossary
from roslings_learn.lessons.anchors import anchors_of, cells_of

COURSE = "example-course/course/"
"""Its days are places of their own."""
NOT_READ = re.compile(r"(?:packages/[\w-]+/)?tests/")
"""Tests write courses of their own, and links that lead nowhere on purpose."""
PLACE = re.compile(
    r"(?<![\w/.-])(?:days/|site/pages/)?"
    r"((?:[0-9]{2}-[a-z0-9-]+|reference|teachers)(?:/[a-z0-9-]+)?)#([\w-]+)"
)
"""`days/03-topics#timers`, and in the doctor `01-install#apt` and `reference/network#wi-fi`."""
LINK = re.compile(r"\]\(<?([\w./-]*)#([\w-]+)>?\)")
"""Of Markdown, to this page or to another file."""
HREF = re.compile(r"href=[\"']([\w./-]*)#([\w-]+)[\"']")
TAGS = re.compile(r"<[^>]+>")
LINKED = (".md", ".ipynb", ".yaml", ".html")


def tracked() -> list[Path]:
    """Every file that is kept."""
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=root(), capture_output=True, text=True, check=True
    ).stdout
    names = [name for name in listed.split("\0") if name and not NOT_READ.match(name)]
    return [root() / name for name in names if (root() / name).is_file()]


@cache
def read(file: Path) -> str:
    """What is said in a file: of a notebook its cells, of a drawing its letters."""
    try:
        text = file.read_text("utf-8")
    except UnicodeDecodeError:
        return ""
    if file.suffix == ".ipynb":
        return cells_of(text, ("markdown", "code"))
    return html.unescape(TAGS.sub("", text)) if file.suffix == ".svg" else text


def page_of(place: str, course: Path) -> Path:
    """The file that a place of the course means: a lesson, or a page beside it, or one of the site.

    >>> page_of("03-topics", root()).name
    'lesson.ipynb'
    """
    if place.startswith(("reference", "teachers")):
        return root() / "site" / "pages" / f"{place}.md"
    folder = course / "days" / place
    return folder / "lesson.ipynb" if "/" not in place else folder.with_suffix(".md")


def pointing(file: Path) -> Iterator[tuple[Path, str]]:
    """Each page and anchor that a file names."""
    course = root() / (COURSE if str(file.relative_to(root())).startswith(COURSE) else "")
    return pointing_of(read(file), file, course)


def pointing_of(text: str, file: Path, course: Path) -> Iterator[tuple[Path, str]]:
    """Each page and anchor that a text in `file` names."""
    for place, anchor in PLACE.findall(text):
        yield page_of(place, course), anchor
    if file.suffix in LINKED:
        for target, anchor in [*LINK.findall(text), *HREF.findall(text)]:
            yield ((file.parent / target).resolve() if target else file), anchor


def is_there(page: Path, anchor: str) -> bool:
    """A word has its anchor in the glossary, whatever page speaks of it."""
    return anchor in anchors_of(page) or anchor in made_anchors()


@cache
def made_anchors() -> frozenset[str]:
    """What the site makes by itself: one for each word, and one for each check of the doctor."""
    words = {f"word-{each}" for each in read_glossary(root()).by_id}
    return frozenset(words | {f"check-{check.id}" for check in all_checks()})


FILES = [file for file in tracked() if "#" in read(file)]
KINDS = {
    "labs/*/hints.yaml": 100,
    "days/*/drills/*/drill.yaml": 90,
    "days/*/lesson.ipynb": 200,
    "days/*/*.md": 3,
    "site/pages/*/*.md": 5,
    "packages/ros-doctor/src/ros_doctor/checks/*.py": 30,
    "glossary/*.yaml": 10,
    "example/labs/*/hints.yaml": 9,
    "README.md": 1,
    "CONTRIBUTING.md": 1,
    "site/pictures/verdict.json": 9,
    "days/*/pictures/one-letter.svg": 1,
    "days/*/quiz.yaml": 30,
    "example-course/course/labs/*/hints.yaml": 7,
}
"""Files to how many anchors they name at least: so that a pattern that finds nothing is seen."""


def test_every_anchor_in_the_repository_is_there() -> None:
    """In hints, tasks, drills, quizzes, words, lessons, pages, pictures, the engine, the doctor."""
    dead = sorted(
        f"{file.relative_to(root())}: {page.relative_to(root())}#{anchor}"
        for file in FILES
        for page, anchor in pointing(file)
        if not is_there(page, anchor)
    )
    assert dead == []


@pytest.mark.parametrize(("files", "least"), KINDS.items(), ids=KINDS)
def test_anchors_of_each_kind_are_found(files: str, least: int) -> None:
    """A file of which no anchor is found has not been checked."""
    found = [file for file in FILES if file.match(files)]
    assert sum(len([*pointing(file)]) for file in found) >= least


@pytest.mark.parametrize(
    "text",
    [
        "read  days/03-topics#no-such",
        "lesson: days/99-moon#timers",
        "See [it](#no-such).",
        "[there](../../site/pages/reference/faq.md#no-such)",
        "[page](no-such.md#network)",
        'lesson="reference/faq#no-such"',
        "A [lamp](#word-no-such).",
        "[a](#check-no-such)",
        '<a href="lesson.ipynb#no-such">',
        "01-install/first-15-minutes#no-such",
    ],
)
def test_a_dead_anchor_of_each_form_is_seen(text: str, tmp_path: Path) -> None:
    """Written into a page beside a lesson."""
    page = root() / "days" / "03-topics" / f"{tmp_path.name}.md"
    found = [*pointing_of(text, page, root())]
    assert len(found) == 1 and not is_there(*found[0])

"""Further reading and watching: links have the right form. None is loaded."""

from __future__ import annotations

import re
from urllib.parse import urlsplit

import pytest

from lesson_runs import lessons, names
from roslings_learn.lessons.rules import Lesson

READING = "Further reading and watching"
LINK = re.compile(r"\[[^\]]+\]\(([^)]*)\)")
LESSONS = list(lessons())
HOST = re.compile(r"[a-z0-9-]+(\.[a-z0-9-]+)+")
each_lesson = pytest.mark.parametrize("lesson", LESSONS, ids=names(LESSONS))


def items(lesson: Lesson) -> list[str]:
    """What is recommended, one entry each."""
    text = "\n".join(cell.text for cell in lesson.sections[READING])
    return [line for line in text.splitlines() if line.startswith("- ")]


@each_lesson
def test_each_link_has_the_form_of_an_address(lesson: Lesson) -> None:
    """https, a host, no blank; words of the course and its own pages are links of another kind."""
    links = [link for item in items(lesson) for link in LINK.findall(item)]
    foreign = [link for link in links if not link.startswith(("#word-", "../"))]
    assert foreign
    for link in foreign:
        parts = urlsplit(link)
        assert parts.scheme == "https", link
        assert HOST.fullmatch(parts.netloc), link
        assert not re.search(r"\s", link), link


@pytest.mark.parametrize("number", range(1, 6))
def test_days_1_to_5_have_something_to_watch(number: int) -> None:
    """With its author, and what it is for."""
    (lesson,) = (each for each in LESSONS if each.day.number == number)
    (watch,) = (item for item in items(lesson) if item.startswith("- To watch: "))
    assert re.search(r"\]\(https://[^)]+\) \([A-Z]\w+ [A-Z]\w+\), .{20,}", watch)

"""The paragraph of a lesson, in the terminal; and where the whole page is."""

from __future__ import annotations

import json
import re
import textwrap
from collections.abc import Iterator
from pathlib import Path

from ros2_on_pip.language import Text, said
from roslings.course import root
from roslings.report.lesson_link import link_of
from roslings_learn.lessons.glossary import LINK
from roslings_learn.lessons.rules.prose import slug

COLUMNS = 80
PICTURED = Text("watch.picture", "(Picture: {what})")
HEADING = re.compile(r"^(#{1,4}) (.+)$")
DIRECTIVE = re.compile(r"^(:::|```\{)")
PICTURE = re.compile(r"!\[([^\]]*)\]\([^)]*\)")
OTHER_LINK = re.compile(r"\[([^\]]*)\]\([^)]*\)")
MARKS = re.compile(r"(\*\*|\{[a-z-]+\}(?=`))")
LISTED = re.compile(r"^\s*([-*>] |\||\d+\. )")


def show(lesson: str, program: str) -> None:
    """Print what the lesson says there. `lesson` is `days/DAY#heading`, or `days/DAY`."""
    day, _, anchor = lesson.partition("#")
    for line in section(root() / day / "lesson.ipynb", anchor) if anchor else ():
        print(line)
    page = link_of(lesson)
    if page:
        print(f"\n{said('watch.page', 'The whole page: {page}', page=page)}", flush=True)
    else:
        number = int(Path(day).name[:2])
        text = "The whole lesson, in another terminal: {command}"
        told = said("watch.lesson", text, command=f"{program} lab {number}")
        print(f"\n{told}", flush=True)


def section(notebook: Path, anchor: str) -> Iterator[str]:
    """The lines from a heading to the next one, at most 80 columns wide; code as it is.

    Empty where there is no such heading.
    """
    if not notebook.is_file():
        return
    inside, only_titles = False, True
    for kind, lines in _blocks(notebook):
        found = HEADING.match(lines[0]) if kind == "prose" else None
        if found:
            # Where a heading follows at once, the paragraph is below that one.
            inside = slug(found[2]) == anchor or (inside and only_titles)
            lines = [found[2].replace("`", "")]
        if inside:
            only_titles = bool(found)
            yield from ("", *(_prose(lines) if kind == "prose" else _code(lines)))


def _blocks(notebook: Path) -> Iterator[tuple[str, list[str]]]:
    """Paragraphs and pieces of code, in their order; a heading is a paragraph of its own."""
    for cell in json.loads(notebook.read_text("utf-8"))["cells"]:
        text = "".join(cell["source"])
        if cell["cell_type"] == "code":
            yield "code", text.splitlines() or [""]
            continue
        for number, part in enumerate(re.split(r"^```.*$", text, flags=re.M)):
            if number % 2:
                yield "code", part.strip("\n").splitlines()
            else:
                yield from (("prose", each) for each in _paragraphs(part))


def _paragraphs(text: str) -> Iterator[list[str]]:
    for part in re.split(r"\n\s*\n", text.strip()):
        lines = [line for line in part.splitlines() if not DIRECTIVE.match(line)]
        while lines and HEADING.match(lines[0]):
            yield [lines.pop(0)]
        if lines:
            yield lines


def _prose(lines: list[str]) -> Iterator[str]:
    """Filled; a list and a table keep their lines."""
    if any(LISTED.match(line) for line in lines):
        for line in lines:
            hang = " " * (len(line) - len(line.lstrip()) + 2)
            yield from textwrap.wrap(_plain(line), COLUMNS, subsequent_indent=hang) or [""]
    else:
        yield from textwrap.wrap(_plain(" ".join(lines)), COLUMNS)


def _plain(text: str) -> str:
    """Words are words here, and no links."""
    text = PICTURE.sub(lambda found: PICTURED.filled(what=found[1]), text)
    for pattern in (LINK, OTHER_LINK):
        text = pattern.sub(r"\1", text)
    return MARKS.sub("", text)


def _code(lines: list[str]) -> Iterator[str]:
    return (f"    {line}".rstrip() for line in lines)

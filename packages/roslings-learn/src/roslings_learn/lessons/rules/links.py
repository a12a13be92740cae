"""Rules on pictures and on links to other pages of the course."""

from __future__ import annotations

import re
import xml.etree.ElementTree as Xml
from collections.abc import Iterator
from pathlib import Path

from roslings_learn.lessons.rules.alternatives import untold
from roslings_learn.lessons.rules.lesson_file import BrokenRule, Lesson, SectionBlock
from roslings_learn.lessons.rules.prose import IMAGE, LINK

SHORTEST_ALT, WIDTH, SMALLEST_PX = 10, 720.0, 14.0
PICTURES = (".svg", ".png")
FOREIGN = re.compile(r"url\(\s*['\"]?https?:|@import|(?:href|src)\s*=\s*['\"]https?:")


def broken(lesson: Lesson) -> Iterator[BrokenRule]:
    """Every rule on pictures and links that `lesson` breaks."""
    for part in lesson.parts:
        if part.block.kind == "code":
            continue
        for alt, target in IMAGE.findall(part.block.text):
            yield from _picture(lesson, part, alt, target)
        for _, target in LINK.findall(part.block.text):
            yield from _link(lesson, part, target)


def _picture(lesson: Lesson, part: SectionBlock, alt: str, target: str) -> Iterator[BrokenRule]:
    line = part.block.line
    if len(alt.strip()) < SHORTEST_ALT:
        mend = "Say in a sentence what the picture shows."
        yield lesson.broken_at(part.cell, line, f"'{target}' has no text alternative.", mend)
    file = lesson.path.parent / target
    if not file.is_file():
        mend = "Draw it, or correct the path: pictures/NAME.svg."
        yield lesson.broken_at(part.cell, line, f"There is no picture '{target}'.", mend)
    elif file.suffix not in PICTURES:
        yield lesson.broken_at(part.cell, line, f"'{target}' is no SVG or PNG.", "Use SVG.")
    elif file.suffix == ".svg":
        for what in faults_of_svg(file):
            mend = "See the section Pictures of the form."
            yield lesson.broken_at(part.cell, line, f"{target}: {what}", mend)
        if missing := ", ".join(untold(alt, file)):
            what = f"{target}: its text alternative names {missing}, and the drawing does not."
            mend = "Say what is drawn, or write it into the drawing's <desc>."
            yield lesson.broken_at(part.cell, line, what, mend)


def faults_of_svg(file: Path) -> Iterator[str]:
    """What is wrong with a drawing."""
    text = file.read_text("utf-8", errors="replace")
    try:
        drawing = Xml.fromstring(text)
    except Xml.ParseError as error:
        yield f"this is no XML ({error})."
        return
    for name in ("title", "desc"):
        found = drawing.find(f"{{*}}{name}")
        if found is None or not (found.text or "").strip():
            yield f"it has no <{name}>."
    box = (drawing.get("viewBox") or "0 0 0 0").replace(",", " ").split()
    if len(box) != 4 or float(box[2]) != WIDTH:
        yield f"its viewBox is not {WIDTH:g} wide."
    if FOREIGN.search(text):
        yield "it takes something from outside."
    sizes = [float(px) for px in re.findall(r"font-size\s*[:=]\s*[\"']?\s*([\d.]+)", text)]
    if sizes and min(sizes) < SMALLEST_PX:
        yield f"a text is {min(sizes):g} px high, and {SMALLEST_PX:g} is the least."


def _link(lesson: Lesson, part: SectionBlock, target: str) -> Iterator[BrokenRule]:
    if target.startswith(("http://", "https://", "mailto:", "#word-")):
        return
    file, _, anchor = target.partition("#")
    line = part.block.line
    if file and not (lesson.path.parent / file).exists():
        if not _day_to_come(lesson, file):
            mend = "Correct the path, for example ../03-topics/lesson.ipynb."
            yield lesson.broken_at(part.cell, line, f"The link '{target}' leads nowhere.", mend)
    elif not file and anchor not in lesson.anchors:
        mend = "Use the slug of a heading of this lesson."
        yield lesson.broken_at(part.cell, line, f"There is no heading for '{target}'.", mend)


def _day_to_come(lesson: Lesson, file: str) -> bool:
    """A lesson that is not written yet, of a day that is known."""
    known = lesson.path.parents[1] / "path.yaml"
    found = re.fullmatch(r"\.\./([0-9]{2}-[a-z0-9-]+)/lesson\.ipynb", file)
    return bool(found and known.is_file() and f"id: {found[1]}\n" in known.read_text("utf-8"))

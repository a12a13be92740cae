"""Rules on the order of a lesson, and on what each section must hold."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from roslings_learn.lessons.rules.lesson_file import BrokenRule, Lesson, LessonCell
from roslings_learn.lessons.rules.prose import LINK

WORDS = "Words of the day"
GOES_WRONG, REAL, LAB, CHECK = "What goes wrong", "On a real robot", "The lab", "The check"
READING, QUIZ = "Further reading and watching", "Quiz"
BEFORE = ("Like in everyday life", WORDS)
AFTER = (GOES_WRONG, REAL, LAB, CHECK, READING, QUIZ)
FREE = frozenset({REAL, READING})
"""Sections that may use words of later days, where they link them."""

HEAD = ("Goal", "Level", "Time", "You need")
FIRST_CODE_LINES, FIRST_CODE_SIGNS = 40, 1500
FEWEST_WORDS, MOST_WORDS = 6, 12
LONGEST_LESSON, LONGEST_ASIDE = 3000, 80
"""Words of prose, tables and commands. Aside: of the section on real robots."""
TIMED = re.compile(r"\d+\s*(?:min|minutes?|h|hours?)\b")
EMBEDDED = re.compile(r"<iframe|<video|<embed|YouTubeVideo|IFrame\(")


def concepts(lesson: Lesson) -> list[str]:
    """The H2s that teach a concept."""
    return [title for title in lesson.sections if title and title not in (*BEFORE, *AFTER)]


def broken(lesson: Lesson) -> Iterator[BrokenRule]:
    """Every rule on sections that `lesson` breaks."""
    yield from _title(lesson)
    yield from _order(lesson)
    yield from _first_screen(lesson)
    yield from _twins(lesson)
    yield from _words_of_the_day(lesson)
    yield from _goes_wrong(lesson)
    yield from _ends(lesson)
    yield from _no_video(lesson)
    yield from _length(lesson)


def _title(lesson: Lesson) -> Iterator[BrokenRule]:
    wanted = f"# {lesson.day.name}"
    first = lesson.cells[0] if lesson.cells else None
    if first is None or first.text.partition("\n")[0].strip() != wanted:
        yield lesson.broken(f"It does not begin with '{wanted}'.", "Use the title of path.yaml.")
    extra = [(cell, h) for cell, h in lesson.headings if h.level == 1][1:]
    for cell, heading in extra:
        yield lesson.broken_at(cell, heading.line, "This is a second H1.", "Use ## or ###.")
    head = "\n".join(cell.text for cell in lesson.sections[""] if not cell.is_code)
    for label in HEAD:
        if f"**{label}" not in head:
            what = f"The head has no '{label}'."
            yield lesson.broken(what, f"Add a line '- **{label}:** ...' below the title.")


def _order(lesson: Lesson) -> Iterator[BrokenRule]:
    there = [heading.text for _, heading in lesson.headings if heading.level == 2]
    named = [title for title in there if title in (*BEFORE, *AFTER)]
    for title in (*BEFORE, *AFTER):
        if title not in there:
            yield lesson.broken(f"The section '{title}' is missing.", f"Add '## {title}'.")
    if named != sorted(set(named), key=(*BEFORE, *AFTER).index):
        mend = f"Their order is: {', '.join(BEFORE)}, concepts, {', '.join(AFTER)}."
        yield lesson.broken("The sections are not in order, or one is there twice.", mend)
    if not concepts(lesson):
        yield lesson.broken("There is no concept.", f"Add an H2 between '{WORDS}' and the end.")
    for title in concepts(lesson):
        at = there.index(title)
        if there[:at].count(WORDS) == 0 or any(after in there[:at] for after in AFTER):
            mend = f"Concepts stand between '{WORDS}' and '{GOES_WRONG}'."
            yield lesson.broken(f"'{title}' is no section of its place.", mend)


def _first_screen(lesson: Lesson) -> Iterator[BrokenRule]:
    before = []
    for cell in lesson.cells:
        if cell.is_code:
            break
        before.append(cell.text)
    text = "\n\n".join(before)
    lines = len(text.splitlines())
    if lines > FIRST_CODE_LINES or len(text) > FIRST_CODE_SIGNS:
        what = f"{lines} lines and {len(text)} signs stand before the first code."
        mend = f"At most {FIRST_CODE_LINES} and {FIRST_CODE_SIGNS}: say less there, or later."
        yield lesson.broken(what, mend)


def _twins(lesson: Lesson) -> Iterator[BrokenRule]:
    times = Counter(heading.slug for _, heading in lesson.headings)
    for cell, heading in lesson.headings:
        if times[heading.slug] > 1:
            what = f"The heading '{heading.text}' is there twice: links cannot tell which."
            yield lesson.broken_at(cell, heading.line, what, "Word one of them otherwise.")


def _words_of_the_day(lesson: Lesson) -> Iterator[BrokenRule]:
    items = [p for p in lesson.parts if p.section == WORDS and p.block.kind == "item"]
    if WORDS in lesson.sections and not FEWEST_WORDS <= len(items) <= MOST_WORDS:
        mend = f"List {FEWEST_WORDS} to {MOST_WORDS}, one item each."
        yield lesson.broken(f"'{WORDS}' has {len(items)} words.", mend)
    for part in items:
        if not any(target.startswith("#word-") for _, target in LINK.findall(part.block.text)):
            mend = "Begin it so: - [topic](#word-topic): one short sentence."
            yield lesson.broken_at(part.cell, part.block.line, "No word is linked here.", mend)


def _goes_wrong(lesson: Lesson) -> Iterator[BrokenRule]:
    cells = [cell for cell in lesson.sections.get(GOES_WRONG, ()) if cell.is_code]
    if GOES_WRONG in lesson.sections and len(cells) < 4:
        mend = "Show two or three mistakes: a cell with the mistake, then a cell that is mended."
        yield lesson.broken(f"'{GOES_WRONG}' has {len(cells)} code cells.", mend)


def _ends(lesson: Lesson) -> Iterator[BrokenRule]:
    if not TIMED.search(_text(lesson, LAB)) and LAB in lesson.sections:
        yield lesson.broken("The steps of the lab tell no times.", "Say for each: (10 min).")
    if "check(" not in _text(lesson, CHECK) and CHECK in lesson.sections:
        yield lesson.broken(f"'{CHECK}' checks nothing.", 'Add a cell: check("LAB").')
    if "](http" not in _text(lesson, READING) and READING in lesson.sections:
        yield lesson.broken(f"'{READING}' has no link.", "Add links to the official pages.")
    last = lesson.cells[-1].text.strip() if lesson.cells else ""
    if last != f'quiz("{lesson.day.id}")':
        yield lesson.broken("The last cell is not the quiz.", f'Add: quiz("{lesson.day.id}")')


def _length(lesson: Lesson) -> Iterator[BrokenRule]:
    count = sum(len(cell.text.split()) for cell in lesson.cells if not cell.is_code)
    if count > LONGEST_LESSON:
        mend = f"At most {LONGEST_LESSON}: what the lab does not need stands on a page beside it."
        yield lesson.broken(f"It has {count} words.", mend)
    if (aside := len(_text(lesson, REAL).split())) > LONGEST_ASIDE:
        mend = f"At most {LONGEST_ASIDE}, and a link: site/pages/reference/real-robot.md."
        yield lesson.broken(f"'{REAL}' has {aside} words.", mend)


def _text(lesson: Lesson, title: str) -> str:
    return "\n".join(cell.text for cell in lesson.sections.get(title, ()))


def _no_video(lesson: Lesson) -> Iterator[BrokenRule]:
    for cell in lesson.cells:
        if found := EMBEDDED.search(cell.text):
            line = _line_of(cell, found.start())
            yield lesson.broken_at(cell, line, "Something is embedded.", "Give title and link.")


def _line_of(cell: LessonCell, position: int) -> int:
    return cell.text[:position].count("\n") + 1

"""Rules on words: linked where first used, few at a time, none before its day."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass

from roslings_learn.lessons.glossary import Glossary, Term
from roslings_learn.lessons.rules.lesson_file import BrokenRule, Lesson, SectionBlock
from roslings_learn.lessons.rules.prose import CODE, IMAGE, LINK
from roslings_learn.lessons.rules.sections import FREE, WORDS

MOST_NEW = 3
PREFIX = "#word-"
LABEL = re.compile(r"^\*\*[^*]+\*\*:?")


@dataclass(frozen=True)
class Use:
    """One place where a lesson uses a word."""

    part: SectionBlock
    term: Term
    linked: bool
    text: str


def broken(lesson: Lesson, glossary: Glossary) -> Iterator[BrokenRule]:
    """Every rule on words that `lesson` breaks."""
    yield from _links(lesson, glossary)
    uses = list(uses_of(lesson, glossary))
    yield from _too_early(lesson, uses)
    yield from _not_linked(lesson, uses)
    yield from _too_many(lesson, uses)


def uses_of(lesson: Lesson, glossary: Glossary) -> Iterator[Use]:
    """Every use of a glossary's word in prose, in order; headings and code do not count."""
    spelt = Spelling(glossary, frozenset(lesson.day.senses))
    for part in lesson.parts:
        if part.block.kind in ("paragraph", "item", "table"):
            yield from _in_part(part, glossary, spelt)


def _in_part(part: SectionBlock, glossary: Glossary, spelt: Spelling) -> Iterator[Use]:
    text = part.block.text if part.section else LABEL.sub("", part.block.text)
    rest, found = _without_code(text), list[tuple[int, Use]]()
    for link in LINK.finditer(rest):
        term = glossary.by_id.get(link[2].removeprefix(PREFIX))
        if link[2].startswith(PREFIX) and term:
            found.append((link.start(), Use(part, term, True, link[1])))
    bare = LINK.sub(lambda link: _blank(link), rest)
    found += [(at, Use(part, term, False, said)) for at, term, said in spelt.find(bare)]
    yield from (use for _, use in sorted(found, key=lambda pair: pair[0]))


def _without_code(text: str) -> str:
    return IMAGE.sub(_blank, CODE.sub(_blank, text))


def _blank(found: re.Match[str]) -> str:
    """As long as before: places stay true. A link to a page is read too, its word is not ours."""
    return "\0" * len(found[0])


class Spelling:
    """Finds words by how they are spelt, where only one meaning is possible."""

    def __init__(self, glossary: Glossary, senses: frozenset[str]) -> None:
        self._meant = {
            form: term
            for each in glossary.by_id.values()
            for spelling in each.spellings
            if (term := glossary.meant(spelling, senses)) is not None
            for form in (spelling, spelling[:1].upper() + spelling[1:])
        }
        longest_first = sorted(self._meant, key=len, reverse=True)
        choice = "|".join(map(re.escape, longest_first)) or r"(?!)"
        self._pattern = re.compile(rf"(?<![\w/.~$-])(?:{choice})(?![\w-]|[/.:]\w|/)")

    def find(self, text: str) -> Iterator[tuple[int, Term, str]]:
        """Place, term and spelling of each word in `text`."""
        for found in self._pattern.finditer(text):
            yield found.start(), self._meant[found[0]], found[0]


def _links(lesson: Lesson, glossary: Glossary) -> Iterator[BrokenRule]:
    for part in lesson.parts:
        for _, target in LINK.findall(part.block.text):
            if not target.startswith(PREFIX):
                continue
            if part.block.kind == "heading":
                what, mend = "A heading holds a linked word.", "Link it in the text below."
                yield lesson.broken_at(part.cell, part.block.line, what, mend)
            if target.removeprefix(PREFIX) not in glossary.by_id:
                what = f"There is no word '{target.removeprefix(PREFIX)}'."
                mend = "Use an id of glossary/*.yaml."
                yield lesson.broken_at(part.cell, part.block.line, what, mend)


def _too_early(lesson: Lesson, uses: list[Use]) -> Iterator[BrokenRule]:
    for use in uses:
        day = use.term.day
        if day is not None and day <= lesson.day.number:
            continue
        if use.part.section in FREE and use.linked:
            continue
        free = use.part.section in FREE and _linked_before(use, uses)
        if not free:
            yield _early(lesson, use)


def _linked_before(use: Use, uses: list[Use]) -> bool:
    """Linked once in a free section is enough for that section."""
    return any(
        each.linked and each.term == use.term and each.part.section == use.part.section
        for each in uses[: uses.index(use)]
    )


def _early(lesson: Lesson, use: Use) -> BrokenRule:
    when = f"a word of day {use.term.day}" if use.term.day else "a word of no day"
    free = use.part.section in FREE
    mend = f"Link it: [{use.text}]({PREFIX}{use.term.id})." if free else _mend_early(use)
    return lesson.broken_at(use.part.cell, use.part.block.line, f"'{use.text}' is {when}.", mend)


def _mend_early(use: Use) -> str:
    return "Say it in other words, or give it an earlier day in glossary/*.yaml" + (
        f" (term {use.term.id})."
    )


def _not_linked(lesson: Lesson, uses: list[Use]) -> Iterator[BrokenRule]:
    seen = set[str]()
    for use in uses:
        new = use.term.day == lesson.day.number and use.term.id not in seen
        if not new or use.part.section == WORDS or use.part.block.kind == "table":
            continue
        seen.add(use.term.id)
        if not use.linked:
            mend = f"Link it here: [{use.text}]({PREFIX}{use.term.id})."
            what = f"'{use.text}' is new today and not linked where it first stands."
            yield lesson.broken_at(use.part.cell, use.part.block.line, what, mend)


def _too_many(lesson: Lesson, uses: list[Use]) -> Iterator[BrokenRule]:
    seen = set[str]()
    new: dict[str, list[Use]] = defaultdict(list)
    for use in uses:
        today = use.term.day == lesson.day.number and use.part.section != WORDS
        if today and use.linked and use.term.id not in seen:
            seen.add(use.term.id)
            new[use.part.under].append(use)
    for section, first in new.items():
        if len(first) > MOST_NEW:
            fourth = first[MOST_NEW]
            names = ", ".join(use.text for use in first)
            what = (
                f"The section '{section or lesson.day.name}' has {len(first)} new words: {names}."
            )
            mend = f"At most {MOST_NEW}: begin a new section (### ...), or use one later."
            yield lesson.broken_at(fourth.part.cell, fourth.part.block.line, what, mend)

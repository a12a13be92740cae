"""Rules on how a lesson reads: sentences, paragraphs."""

from __future__ import annotations

from collections.abc import Iterator

from roslings_learn.lessons.rules.lesson_file import BrokenRule, Lesson, SectionBlock
from roslings_learn.lessons.rules.prose import plain, sentences, words

MOST_ON_AVERAGE, MOST_WORDS, MOST_IN_A_CELL = 14.0, 25, 120


def broken(lesson: Lesson) -> Iterator[BrokenRule]:
    """Every rule on reading that `lesson` breaks."""
    lengths = []
    for part in _prose(lesson):
        for sentence in sentences(part.block.text):
            length = words(sentence)
            if length > MOST_WORDS:
                what = f"A sentence has {length} words: {_begin(sentence)}"
                mend = f"At most {MOST_WORDS}: make two of it."
                yield lesson.broken_at(part.cell, part.block.line, what, mend)
            if _is_sentence(part, sentence):
                lengths.append(length)
    average = sum(lengths) / len(lengths) if lengths else 0.0
    if average > MOST_ON_AVERAGE:
        what = f"Its sentences have {average:.1f} words on average."
        yield lesson.broken(what, f"At most {MOST_ON_AVERAGE:g}: cut the longest.")
    yield from _long_cells(lesson)


def average_sentence(lesson: Lesson) -> float:
    """Words of a sentence, on average."""
    lengths = [
        words(sentence)
        for part in _prose(lesson)
        for sentence in sentences(part.block.text)
        if _is_sentence(part, sentence)
    ]
    return sum(lengths) / len(lengths) if lengths else 0.0


def _prose(lesson: Lesson) -> list[SectionBlock]:
    return [part for part in lesson.parts if part.block.kind in ("paragraph", "item")]


def _is_sentence(part: SectionBlock, sentence: str) -> bool:
    """An item of a list may be a name or a title."""
    return part.block.kind == "paragraph" or sentence.endswith((".", "?", "!"))


def _long_cells(lesson: Lesson) -> Iterator[BrokenRule]:
    for cell in lesson.cells:
        total = sum(words(plain(b.text)) for b in cell.blocks if b.kind == "paragraph")
        if total > MOST_IN_A_CELL:
            mend = f"At most {MOST_IN_A_CELL}: put code or a picture between, or make two cells."
            yield lesson.broken_at(cell, 1, f"The cell has {total} words of prose.", mend)


def _begin(sentence: str) -> str:
    return " ".join(sentence.split()[:6]) + " ..."

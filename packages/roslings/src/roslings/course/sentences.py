"""The sentences of a task that somebody wrote by hand: where each stands, and what it may ask.

Above the steps the task says what the package does: each sentence there asks for something until
somebody says that it does not. In the steps, one that has a word of `DEMANDING` does.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

STEPS = re.compile(r"^## .*\bsteps\b", re.IGNORECASE)
DEMANDING = re.compile(
    r"\b(must|never|always|only|exactly|within|at (?:least|most)|(?:more|less) than|may not)\b",
    re.IGNORECASE,
)
"""Who says so in the steps asks for something."""

_LEFT_OUT = re.compile(
    r"<!-- card: \w+ -->.*?<!-- /card -->|```.*?(?:```|\Z)|^\|[^\n]*\n\|[ :|-]+$",
    re.DOTALL | re.MULTILINE,
)
"""What is drawn from the card, code, and the head of a table."""
_ALONE = re.compile(r"^(?:#|\||- |\d\. )")
"""A heading, a row of a table, and a thing of a list begin on a line of their own."""
_NO_PASSAGE = re.compile(r"^(?:#|\*\*Level:|---$)")
_ASKS_NOTHING = re.compile(r"^\*\*[^*]*\*\*$|\?$")
"""A title in bold, and a question."""
_END = re.compile(r"""[.!?:]["'`*)]*(?=\s+["'`*(]*[A-Z`])|$""")


@dataclass(frozen=True)
class TaskSentence:
    """From here to there in the text of its passage."""

    start: int
    end: int
    asks: bool
    """It must be accounted for."""


@dataclass(frozen=True)
class Passage:
    """A paragraph, a row of a table or a thing of a list, on one line."""

    text: str
    line: int
    in_the_steps: bool = False

    @cached_property
    def sentences(self) -> tuple[TaskSentence, ...]:
        """The sentences, in order."""
        return tuple(self._sentences())

    def _sentences(self) -> Iterator[TaskSentence]:
        start = 0
        for end in (found.end() for found in _END.finditer(self.text)):
            if said := self.text[start:end].strip():
                yield TaskSentence(end - len(said), end, self._asks(said))
            start = end

    def _asks(self, said: str) -> bool:
        if _ASKS_NOTHING.search(said):
            return False
        return not self.in_the_steps or bool(DEMANDING.search(said))


def passages_of(task: str) -> list[Passage]:
    """What stands in a task outside of what is drawn from the card, and of code."""
    text = _LEFT_OUT.sub(lambda found: "\n" * found[0].count("\n"), task)
    lines = text.splitlines()
    steps = next((n for n, line in enumerate(lines) if STEPS.search(line)), len(lines))
    return [
        Passage(" ".join(part), number + 1, number > steps)
        for number, part in _parts(lines)
        if not _NO_PASSAGE.search(part[0])
    ]


def _parts(lines: list[str]) -> Iterator[tuple[int, list[str]]]:
    """Number of the first line, and the lines, of what belongs together."""
    part: list[str] = []
    for number, line in enumerate([*lines, ""]):
        words = " ".join(line.split())
        if part and (not words or _ALONE.search(words) or _ends_alone(part[0])):
            yield number - len(part), part
            part = []
        if words:
            part.append(words)


def _ends_alone(first: str) -> bool:
    """A heading and a row of a table have one line."""
    return first.startswith(("#", "|"))

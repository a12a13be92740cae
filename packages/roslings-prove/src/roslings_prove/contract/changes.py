"""Other words for a card, one at a time: what the solution does must then be wrong, or still right.

A change is plausible: what an instructor could write for another term. Names get one letter more,
numbers another value, types another type, limits move to the other side of what was measured.
"""

from __future__ import annotations

import copy
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from roslings.course.files import Location
from roslings.course.kinds import Kind
from roslings_changes.card_words import CardWord

OTHER_TYPES = {
    "msg": ("std_msgs/msg/String", "std_msgs/msg/Int32"),
    "srv": ("std_srvs/srv/Trigger", "std_srvs/srv/SetBool"),
    "action": ("test_msgs/action/Fibonacci", "test_msgs/action/NestedMessage"),
}
TYPE = re.compile(r"^[a-z0-9_]+/(msg|srv|action)/\w+$")
NEXT_TO_NOTHING_S = 1e-6
HUGE = 100_000
FAR = 4
"""A rate is another one where it lies so many tolerances away."""

BESIDE = 0.05
"""So far from a limit, as a part of the tolerance, lie the two sides of it."""


@dataclass(frozen=True)
class CardChange:
    """Another card, and what must come of the unchanged solution by it."""

    word: CardWord
    about: str
    """What the card says now."""
    places: tuple[tuple[Location, Any], ...]
    must_fail: bool = True

    def apply(self, tree: Mapping[str, Any]) -> Any:
        """The card with the other words."""
        changed = copy.deepcopy(tree)
        for path, value in self.places:
            part: Any = changed
            for step in path[:-1]:
                part = part[step]
            part[path[-1]] = value
        return changed

    def grader(self, text: str) -> str:
        """The grader, which may call a thing by this word of the card.

        A lab may have the same name, as new labs do of which nobody said another one.
        """
        if self.word.kind is not Kind.KEY:
            return text
        (_, value), *_ = self.places
        own = rf'(?<!\blab\()"{re.escape(self.word.value)}"'
        return re.sub(own, lambda _: f'"{value}"', text)


def changes_of(word: CardWord) -> list[CardChange]:
    """What proves the word; empty where only a mutant can."""
    return list(_BY_KIND[word.kind](word))


def _other(word: CardWord) -> Iterator[CardChange]:
    if word.key == "hz":
        yield _says(word, word.value * (1 + FAR * word.around["within"]))
        return
    for value in _others(word.value, word.choices):
        yield _says(word, value)


def _says(word: CardWord, value: Any, must_fail: bool = True) -> CardChange:
    return CardChange(word, f"{word.key}: {value}", ((word.path, value),), must_fail)


def _others(value: Any, choices: tuple[Any, ...]) -> list[Any]:
    if choices:
        return [each for each in choices if each != value][:1]
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return [value + 1]
    if isinstance(value, float):
        return [value * 1.5 if value else 1.0]
    if found := TYPE.match(str(value)):
        return [next(each for each in OTHER_TYPES[found[1]] if each != value)]
    return [_one_letter_more(str(value))]


def _one_letter_more(text: str) -> str:
    """Behind the first word: a file keeps its ending, and a template its `{text}`."""
    found = re.match(r"^[^A-Za-z]*[\w/-]*[A-Za-z]", text)
    end = found.end() if found else 0
    return f"{text[:end]}x{text[end:]}"


SIDES = tuple(
    (side * (1 + beside), must_fail)
    for side in (-1, 1)
    for beside, must_fail in ((BESIDE, True), (-2 * BESIDE, False))
)
"""So many tolerances off, on both sides: just outside fails, just inside does not."""


def _tolerance(word: CardWord) -> Iterator[CardChange]:
    """What is asked for moves; what the solution does is then just outside, or just inside."""
    return _of_a_rate(word) if "hz" in word.around else _of_numbers(word)


def _of_a_rate(word: CardWord) -> Iterator[CardChange]:
    hz, within = word.around["hz"], word.value
    rate = (*word.path[:-1], "hz")
    for off, must_fail in SIDES:
        moved = round(hz / (1 + off * within), 6)
        about = f"hz: {moved} and within: {within}, with {hz} Hz measured"
        yield CardChange(word, about, ((rate, moved),), must_fail)


def _of_numbers(word: CardWord) -> Iterator[CardChange]:
    """By a number that each message holds; none where the card names none."""
    fields = word.around.get("fields", {})
    numbers = [(name, value) for name, value in fields.items() if isinstance(value, float)]
    for name, value in numbers[:1]:
        place = (*word.path[:-1], "fields", name)
        for off, must_fail in SIDES:
            moved = round(value + off * word.value * max(1.0, abs(value)), 9)
            about = f"{name}: {moved} and {word.key}: {word.value}, with {value} measured"
            yield CardChange(word, about, ((place, moved),), must_fail)


def _most(word: CardWord) -> Iterator[CardChange]:
    yield _says(word, NEXT_TO_NOTHING_S)


def _least(word: CardWord) -> Iterator[CardChange]:
    yield _says(word, HUGE)


def _edge(word: CardWord) -> Iterator[CardChange]:
    """By a tenth of what lies between both edges, and by one where there is one alone."""
    least, most = word.around.get("least"), word.around.get("most")
    between = (most - least) / 10 if least is not None and most is not None else 1
    step = max(1, round(between)) if word.around.get("type") == "integer" else between
    for moved in (word.value - step, word.value + step):
        yield _says(word, moved)


def _none(word: CardWord) -> Iterator[CardChange]:
    return iter(())


_BY_KIND: dict[Kind, Callable[[CardWord], Iterator[CardChange]]] = {
    Kind.EXPECTED: _other,
    Kind.TOLERANCE: _tolerance,
    Kind.MOST: _most,
    Kind.LEAST: _least,
    Kind.EDGE: _edge,
    Kind.KEY: _other,
    Kind.STIMULUS: _none,
    Kind.PROSE: _none,
}

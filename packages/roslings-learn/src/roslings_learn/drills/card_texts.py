"""The texts of a drill's card that people read, in the language that is asked for.

What the program prints, names and code stay as the card has them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ros2_on_pip.language import ENGLISH, language, template
from roslings_learn.drills.card import DrillCard, Prediction

Change = Callable[[str, str], str]
"""From a text's id and its English to what stands in its place."""


def translated(name: str, card: DrillCard) -> DrillCard:
    """The card of the drill that is called so, for who reads it."""
    return card if language() == ENGLISH else _changed(name, card, template)


def texts_of(name: str, card: DrillCard) -> Iterator[tuple[str, str]]:
    """The id and the English of each text of a card that is as its author wrote it."""
    found: dict[str, str] = {}

    def keep(id: str, text: str) -> str:
        found[id] = text
        return text

    _changed(name, card, keep)
    yield from found.items()


def _changed(name: str, card: DrillCard, change: Change) -> DrillCard:
    room = f"drills.{name}"
    hints = tuple(change(f"{room}.hint.{n}", step) for n, step in enumerate(card.hints, 1))
    found: dict[str, object] = {
        "title": change(f"{room}.title", card.title),
        "idea": change(f"{room}.idea", card.idea),
        "hints": hints,
    }
    if card.answer:
        found["answer"] = _answer(room, card.answer, change)
    return card.model_copy(update=found)


def _answer(room: str, answer: Prediction, change: Change) -> Prediction:
    question = change(f"{room}.question", answer.question)
    because = change(f"{room}.because", answer.because)
    return answer.model_copy(update={"question": question, "because": because})

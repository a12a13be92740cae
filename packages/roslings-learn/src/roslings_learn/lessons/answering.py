"""What comes of an answer that was typed: whether it is right, and what is said of it.

An answer is typed as letters (`b`, `ac`, `bdca`), or as the text that a program prints.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from string import ascii_lowercase

from roslings_learn.lessons.quiz import Choice, One, Order, OrderedStep, Prints, Question, Several


class NoAnswer(Exception):
    """What was typed is no answer to this question; its text says what would be one."""


@dataclass(frozen=True)
class Judged:
    """An answer, looked at."""

    right: bool
    said: tuple[str, ...]
    """Why, a sentence for each part of it. Of a wrong answer, nothing that gives the right one."""


def how_to_answer(question: Question) -> str:
    """What to type, in a few words."""
    if isinstance(question, Prints):
        return "What does it print?"
    last = ascii_lowercase[len(_parts(question)) - 1]
    if isinstance(question, One):
        return f"One letter, a to {last}:"
    if isinstance(question, Several):
        return f"One or more letters, a to {last}, for example ac:"
    return f"All letters, a to {last}, in the right order:"


def judged(question: Question, typed: str) -> Judged:
    """Raises NoAnswer."""
    if isinstance(question, Prints):
        return _printed(question, typed)
    places = _places(question, typed)
    if isinstance(question, Order):
        return _ordered(question, [question.shown[place] for place in places])
    return _chosen(question, places)


def right_answer(question: Question) -> list[str]:
    """The right answer with its reasons, a line for each part."""
    if isinstance(question, Prints):
        return [f"It prints: {question.prints}", question.why]
    if isinstance(question, Order):
        steps = enumerate(question.steps, 1)
        return [f"{place}. {explained(step)}" for place, step in steps]
    named = zip(ascii_lowercase, question.choices, strict=False)
    return [f"{letter}) {choice.why}" for letter, choice in named if choice.right]


def explained(part: Choice | OrderedStep) -> str:
    """A choice or a step with its reason, as one sentence."""
    return f"{part.text.removesuffix('.')}: {part.why}"


def _parts(question: One | Several | Order) -> Sequence[Choice | OrderedStep]:
    return question.steps if isinstance(question, Order) else question.choices


def _places(question: One | Several | Order, typed: str) -> list[int]:
    """The places of the letters, in the order in which they were typed."""
    letters = [letter for letter in typed.lower() if letter not in " ,;)."]
    known = ascii_lowercase[: len(_parts(question))]
    wanted = f"Type this: {how_to_answer(question).removesuffix(':')}."
    if not letters or not set(letters) <= set(known) or len(letters) != len(set(letters)):
        raise NoAnswer(wanted)
    if isinstance(question, One) and len(letters) > 1:
        raise NoAnswer(wanted)
    if isinstance(question, Order) and len(letters) < len(known):
        raise NoAnswer(wanted)
    return [known.index(letter) for letter in letters]


def _chosen(question: One | Several, places: Sequence[int]) -> Judged:
    taken = [question.choices[place] for place in sorted(places)]
    missing = any(choice.right and choice not in taken for choice in question.choices)
    right = not missing and all(choice.right for choice in taken)
    if isinstance(question, One):
        return Judged(right, (taken[0].why,))
    said = [explained(choice) for choice in taken]
    more = ["Something that is right is not chosen yet."] if missing else []
    return Judged(right, (*said, *more))


def _ordered(question: Order, places: Sequence[int]) -> Judged:
    wrong = next((at for at, place in enumerate(places) if at != place), None)
    if wrong is None:
        return Judged(True, tuple(explained(step) for step in question.steps))
    return Judged(False, (f"The first {wrong} are right." if wrong else "Another one is first.",))


def _printed(question: Prints, typed: str) -> Judged:
    if not typed.strip():
        raise NoAnswer("Type what the program prints.")
    text = " ".join(typed.split())
    if text == " ".join(question.prints.split()):
        return Judged(True, (question.why,))
    known = {" ".join(each.text.split()): each.why for each in question.mistakes}
    return Judged(False, (known.get(text, "Read the code once more, line by line."),))

"""What comes of an answer that was typed: whether it is right, and what is said of it.

An answer is typed as letters (`b`, `ac`, `bdca`), or as the text that a program prints.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from string import ascii_lowercase

from ros2_on_pip.language import counted, said
from roslings_learn.lessons.quiz import (
    One,
    OrderedStep,
    OrderQuestion,
    Prints,
    Question,
    QuizChoice,
    Several,
)


class NotAnAnswer(Exception):
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
        return said("quiz.prints", "What does it print?")
    last = ascii_lowercase[len(_parts(question)) - 1]
    if isinstance(question, One):
        return said("quiz.one", "One letter, a to {last}:", last=last)
    if isinstance(question, Several):
        several = "One or more letters, a to {last}, for example {example}:"
        return said("quiz.several", several, last=last, example="ac")
    return said("quiz.order", "All letters, a to {last}, in the right order:", last=last)


def judged(question: Question, typed: str) -> Judged:
    """Raises NotAnAnswer."""
    if isinstance(question, Prints):
        return _printed(question, typed)
    places = _places(question, typed)
    if isinstance(question, OrderQuestion):
        return _ordered(question, [question.shown[place] for place in places])
    return _chosen(question, places)


def right_answer(question: Question) -> list[str]:
    """The right answer with its reasons, a line for each part."""
    if isinstance(question, Prints):
        return [said("quiz.it_prints", "It prints: {text}", text=question.prints), question.why]
    if isinstance(question, OrderQuestion):
        steps = enumerate(question.steps, 1)
        return [f"{place}. {explained(step)}" for place, step in steps]
    named = zip(ascii_lowercase, question.choices, strict=False)
    return [f"{letter}) {choice.why}" for letter, choice in named if choice.right]


def explained(part: QuizChoice | OrderedStep) -> str:
    """A choice or a step with its reason, as one sentence."""
    text = part.text.removesuffix(".")
    return said("quiz.explained", "{text}: {why}", text=text, why=part.why)


def _parts(question: One | Several | OrderQuestion) -> Sequence[QuizChoice | OrderedStep]:
    return question.steps if isinstance(question, OrderQuestion) else question.choices


def _places(question: One | Several | OrderQuestion, typed: str) -> list[int]:
    """The places of the letters, in the order in which they were typed."""
    letters = [letter for letter in typed.lower() if letter not in " ,;)."]
    known = ascii_lowercase[: len(_parts(question))]
    how = how_to_answer(question).removesuffix(":")
    wanted = said("quiz.type_this", "Type this: {how}.", how=how)
    if not letters or not set(letters) <= set(known) or len(letters) != len(set(letters)):
        raise NotAnAnswer(wanted)
    if isinstance(question, One) and len(letters) > 1:
        raise NotAnAnswer(wanted)
    if isinstance(question, OrderQuestion) and len(letters) < len(known):
        raise NotAnAnswer(wanted)
    return [known.index(letter) for letter in letters]


def _chosen(question: One | Several, places: Sequence[int]) -> Judged:
    taken = [question.choices[place] for place in sorted(places)]
    missing = any(choice.right and choice not in taken for choice in question.choices)
    right = not missing and all(choice.right for choice in taken)
    if isinstance(question, One):
        return Judged(right, (taken[0].why,))
    told = [explained(choice) for choice in taken]
    missed = said("quiz.missed", "Something that is right is not chosen yet.")
    more = [missed] if missing else []
    return Judged(right, (*told, *more))


def _ordered(question: OrderQuestion, places: Sequence[int]) -> Judged:
    wrong = next((at for at, place in enumerate(places) if at != place), None)
    if wrong is None:
        return Judged(True, tuple(explained(step) for step in question.steps))
    if not wrong:
        return Judged(False, (said("quiz.another_first", "Another one is first."),))
    one, other = "The first {count} is right.", "The first {count} are right."
    return Judged(False, (counted("quiz.first_right", wrong, one=one, other=other),))


def _printed(question: Prints, typed: str) -> Judged:
    if not typed.strip():
        raise NotAnAnswer(said("quiz.type_output", "Type what the program prints."))
    text = " ".join(typed.split())
    if text == " ".join(question.prints.split()):
        return Judged(True, (question.why,))
    known = {" ".join(each.text.split()): each.why for each in question.mistakes}
    again = said("quiz.read_again", "Read the code once more, line by line.")
    return Judged(False, (known.get(text, again),))

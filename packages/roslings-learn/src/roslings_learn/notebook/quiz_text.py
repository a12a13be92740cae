"""A quiz in plain text: the questions first, the answers with their reasons below."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from string import ascii_lowercase

from roslings_learn.lessons import Choice, One, Order, Prints, Question, Quiz, Several
from roslings_learn.lessons.glossary import LINK
from roslings_learn.lessons.quiz import OrderedStep

WIDTH = 80


def as_text(quiz: Quiz) -> str:
    """The whole quiz, in lines of at most 80 columns."""
    lines = [f"Quiz of {quiz.day}: {len(quiz.questions)} questions.", ""]
    for number, question in enumerate(quiz.questions, 1):
        lines += [*_asked(number, question), ""]
    lines += ["Answers", ""]
    for number, question in enumerate(quiz.questions, 1):
        lines += [*_answered(number, question), ""]
    return "\n".join(lines).rstrip()


def without_links(text: str) -> str:
    """A text in which words are words, and no links."""
    return LINK.sub(r"\1", text)


def explained(part: Choice | OrderedStep) -> str:
    """A choice or a step with its reason, as one sentence."""
    return f"{part.text.removesuffix('.')}: {part.why}"


def _asked(number: int, question: Question) -> Iterator[str]:
    yield from _filled(f"{number}. {question.ask}", "   ")
    yield from _code(question)
    if isinstance(question, One | Several):
        if isinstance(question, Several):
            yield "   (one or more are right)"
        for letter, choice in zip(ascii_lowercase, question.choices, strict=False):
            yield from _filled(f"   {letter}) {choice.text}", "      ")
    elif isinstance(question, Order):
        for place in question.shown:
            yield from _filled(f"   - {question.steps[place].text}", "     ")


def _code(question: Question) -> Iterator[str]:
    if question.code:
        yield from ("", *(f"       {line}" for line in question.code.rstrip().splitlines()), "")


def _answered(number: int, question: Question) -> Iterator[str]:
    if isinstance(question, One | Several):
        yield f"{number}."
        for letter, choice in zip(ascii_lowercase, question.choices, strict=False):
            word = "right" if choice.right else "wrong"
            yield from _filled(f"   {letter}) {word}: {choice.why}", "      ")
    elif isinstance(question, Order):
        yield f"{number}. In this order:"
        for place, step in enumerate(question.steps, 1):
            yield from _filled(f"   {place}) {explained(step)}", "      ")
    elif isinstance(question, Prints):
        yield from _filled(f"{number}. It prints {question.prints}: {question.why}", "   ")


def _filled(text: str, indent: str) -> list[str]:
    return textwrap.wrap(without_links(text), WIDTH, subsequent_indent=indent)

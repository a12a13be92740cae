"""A quiz in plain text: the questions first, the answers with their reasons below."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from string import ascii_lowercase

from roslings_learn.lessons import One, Order, Prints, Question, Quiz, Several
from roslings_learn.lessons.answering import explained
from roslings_learn.lessons.glossary import LINK

WIDTH = 80


def as_text(quiz: Quiz) -> str:
    """The whole quiz, in lines of at most 80 columns."""
    lines = [f"Quiz of {quiz.day}: {len(quiz.questions)} questions.", ""]
    for number, question in enumerate(quiz.questions, 1):
        lines += [*asked(number, question), ""]
    lines += ["Answers", ""]
    for number, question in enumerate(quiz.questions, 1):
        lines += [*_answered(number, question), ""]
    return "\n".join(lines).rstrip()


def without_links(text: str) -> str:
    """A text in which words are words, and no links."""
    return LINK.sub(r"\1", text)


def asked(number: int, question: Question) -> Iterator[str]:
    """A question, with a letter for each choice and for each step that is to be ordered."""
    yield from filled(f"{number}. {question.ask}", "   ")
    yield from _code(question)
    if isinstance(question, One | Several):
        if isinstance(question, Several):
            yield "   (one or more are right)"
        for letter, choice in zip(ascii_lowercase, question.choices, strict=False):
            yield from filled(f"   {letter}) {choice.text}", "      ")
    elif isinstance(question, Order):
        for letter, place in zip(ascii_lowercase, question.shown, strict=False):
            yield from filled(f"   {letter}) {question.steps[place].text}", "      ")


def _code(question: Question) -> Iterator[str]:
    if question.code:
        yield from ("", *(f"       {line}" for line in question.code.rstrip().splitlines()), "")


def _answered(number: int, question: Question) -> Iterator[str]:
    if isinstance(question, One | Several):
        yield f"{number}."
        for letter, choice in zip(ascii_lowercase, question.choices, strict=False):
            word = "right" if choice.right else "wrong"
            yield from filled(f"   {letter}) {word}: {choice.why}", "      ")
    elif isinstance(question, Order):
        yield f"{number}. In this order:"
        for place, step in enumerate(question.steps, 1):
            yield from filled(f"   {place}) {explained(step)}", "      ")
    elif isinstance(question, Prints):
        yield from filled(f"{number}. It prints {question.prints}: {question.why}", "   ")


def filled(text: str, indent: str) -> list[str]:
    """Lines of at most 80 columns, with words in place of links."""
    return textwrap.wrap(without_links(text), WIDTH, subsequent_indent=indent)

"""A quiz in plain text: the questions first, the answers with their reasons below."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from string import ascii_lowercase

from ros2_on_pip.language import counted, said
from roslings_learn.lessons import One, OrderQuestion, Prints, Question, Quiz, Several
from roslings_learn.lessons.answering import explained
from roslings_learn.lessons.glossary import LINK

WIDTH = 80


def as_text(quiz: Quiz) -> str:
    """The whole quiz, in lines of at most 80 columns."""
    one, other = "Quiz of {day}: {count} question.", "Quiz of {day}: {count} questions."
    count = len(quiz.questions)
    lines = [counted("quiz.head", count, one=one, other=other, day=quiz.day), ""]
    for number, question in enumerate(quiz.questions, 1):
        lines += [*question_lines(number, question), ""]
    lines += [said("quiz.answers", "Answers"), ""]
    for number, question in enumerate(quiz.questions, 1):
        lines += [*_answered(number, question), ""]
    return "\n".join(lines).rstrip()


def without_links(text: str) -> str:
    """A text in which words are words, and no links."""
    return LINK.sub(r"\1", text)


def question_lines(number: int, question: Question) -> Iterator[str]:
    """A question, with a letter for each choice and for each step that is to be ordered."""
    yield from filled(f"{number}. {question.ask}", "   ")
    yield from _code(question)
    if isinstance(question, One | Several):
        if isinstance(question, Several):
            yield f"   {said('quiz.one_or_more', '(one or more are right)')}"
        for letter, choice in zip(ascii_lowercase, question.choices, strict=False):
            yield from filled(f"   {letter}) {choice.text}", "      ")
    elif isinstance(question, OrderQuestion):
        for letter, place in zip(ascii_lowercase, question.shown, strict=False):
            yield from filled(f"   {letter}) {question.steps[place].text}", "      ")


def _code(question: Question) -> Iterator[str]:
    if question.code:
        yield from ("", *(f"       {line}" for line in question.code.rstrip().splitlines()), "")


def _answered(number: int, question: Question) -> Iterator[str]:
    if isinstance(question, One | Several):
        yield f"{number}."
        for letter, choice in zip(ascii_lowercase, question.choices, strict=False):
            right = said("quiz.choice_right", "right: {why}", why=choice.why)
            wrong = said("quiz.choice_wrong", "wrong: {why}", why=choice.why)
            yield from filled(f"   {letter}) {right if choice.right else wrong}", "      ")
    elif isinstance(question, OrderQuestion):
        yield f"{number}. {said('quiz.in_this_order', 'In this order:')}"
        for place, step in enumerate(question.steps, 1):
            yield from filled(f"   {place}) {explained(step)}", "      ")
    elif isinstance(question, Prints):
        text, why = question.prints, question.why
        told = said("quiz.prints_because", "It prints {text}: {why}", text=text, why=why)
        yield from filled(f"{number}. {told}", "   ")


def filled(text: str, indent: str) -> list[str]:
    """Lines of at most 80 columns, with words in place of links."""
    return textwrap.wrap(without_links(text), WIDTH, subsequent_indent=indent)

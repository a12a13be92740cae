"""`./roslings quiz`: a day's questions, in the terminal."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ros2_on_pip.errors import OK
from roslings import course
from roslings.typed import program

if TYPE_CHECKING:
    from roslings_learn.lessons import Day, Lessons, Question, Quiz

QUIT = "q"
TRIES = 2
LOOK = "Press Enter for the next question, or q to end: "
Read = Callable[[str], str]
"""Asks by its text, and gives the line that was typed. Raises EOFError where nobody answers."""


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument(
        "day", metavar="DAY", nargs="?", help="for example: 5, or 05-actions (default: today's)"
    )


def run(options: argparse.Namespace) -> int:
    """Ask the questions of a day; in a pipe, print them and the answers."""
    from roslings_learn.lessons import read_lessons
    from roslings_learn.lessons.quiz_text import as_text

    lessons = read_lessons(course.root())
    quiz = _quiz_of(options.day, lessons)
    if sys.stdin.isatty() and sys.stdout.isatty():
        _play(quiz)
    else:
        print(as_text(quiz))
    return OK


def _quiz_of(wanted: str | None, lessons: Lessons) -> Quiz:
    """Of the day with this number, id or name; without one, of today. Raises NoSuchDay."""
    from roslings_learn.jupyter.errors import NoSuchDay

    day = _today(lessons) if wanted is None else _named(wanted, lessons)
    quiz = lessons.quiz(day.id) if day else None
    if quiz is None:
        there = [each for each in lessons.days if lessons.quiz(each.id)]
        raise NoSuchDay(wanted or "today", tuple(there))
    return quiz


def _named(wanted: str, lessons: Lessons) -> Day | None:
    for day in lessons.days:
        if wanted in (str(day.number), f"{day.number:02}", day.id, day.id[3:]):
            return day
    return None


def _today(lessons: Lessons) -> Day | None:
    """The day of the lab that is next; the last one when all are done."""
    from roslings.workspace.progress import today

    at = today().at
    days = (day for day in lessons.days if at is None or day.id == at.lab.outline.day)
    return list(days)[-1]


# --- one round ---------------------------------------------------------------------------------


@dataclass
class Round:
    """How many questions were asked so far, and which were right at the first try."""

    asked: int = 0
    right: int = 0
    whole: bool = False
    """Whether all questions were asked."""


def _play(quiz: Quiz) -> None:
    """Ask, and keep the score of a whole round."""
    print(f"{len(quiz.questions)} questions. After each answer comes its reason.", end="\n\n")
    found = ask_all(quiz, input)
    if not found.whole:
        print(f"\nEnded after {found.asked} of {len(quiz.questions)}: no score is kept.")
        return
    print(f"\nScore  {found.right} of {found.asked} right at the first try.{_best(quiz, found)}")
    print(f"Next   {program()}")


def _best(quiz: Quiz, found: Round) -> str:
    """Keep it in the progress; what is the best so far."""
    from roslings.workspace.errors import WorkspaceError
    from roslings.workspace.progress import record_quiz

    try:
        best = record_quiz(quiz.day, found.right, found.asked)
    except WorkspaceError as error:
        return f"\nroslings: the score was not kept. {error}"
    return f" Your best: {best.best} of {best.of}." if best.rounds > 1 else ""


def ask_all(quiz: Quiz, read: Read) -> Round:
    """Ask each question; `q`, Ctrl-D and Ctrl-C end it."""
    found = Round()
    try:
        for number, question in enumerate(quiz.questions, 1):
            right = _ask(number, question, read)
            found.asked, found.right = number, found.right + right
            if number < len(quiz.questions) and _typed(read, LOOK) == QUIT:
                raise EOFError
            print()
        found.whole = True
    except (EOFError, KeyboardInterrupt):
        print()
    return found


def _ask(number: int, question: Question, read: Read) -> bool:
    """Until it is right, at most `TRIES` times; whether the first answer was. Raises EOFError."""
    from roslings_learn.lessons.answering import judged, right_answer
    from roslings_learn.lessons.quiz_text import asked, filled

    print("\n".join(asked(number, question)))
    for attempt in range(1, TRIES + 1):
        found = judged(question, _answer(question, read))
        word = "Right." if found.right else "Not yet."
        print("\n".join(filled(f"{word} {' '.join(found.said)}", "  ")))
        if found.right:
            return attempt == 1
    print("This is right:")
    for line in right_answer(question):
        print("\n".join(filled(f"  {line}", "     ")))
    return False


def _answer(question: Question, read: Read) -> str:
    """A line that is an answer. Raises EOFError."""
    from roslings_learn.lessons.answering import NoAnswer, how_to_answer, judged

    while True:
        typed = _typed(read, f"{how_to_answer(question)} ")
        if typed == QUIT:
            raise EOFError
        try:
            judged(question, typed)
        except NoAnswer as no_answer:
            print(no_answer)
        else:
            return typed


def _typed(read: Read, text: str) -> str:
    return read(text).strip()

"""`./roslings quiz`: a day's questions, in the terminal."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ros2_on_pip.errors import OK
from ros2_on_pip.label_column import LabelledLine, labelled, wrapped
from ros2_on_pip.language import Text, counted, said
from roslings import course
from roslings.commands.invocation import program

if TYPE_CHECKING:
    from roslings_learn.lessons import Day, Lessons, Question, Quiz

QUIT = "q"
LABELS = 7
TRIES = 2
LOOK = Text("quiz.look", "Press Enter for the next question, or q to end:")
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
        raise NoSuchDay(wanted or said("quiz.today", "today"), tuple(there))
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
class QuizRound:
    """How many questions were asked so far, and which were right at the first try."""

    asked: int = 0
    right: int = 0
    whole: bool = False
    """Whether all questions were asked."""


def _play(quiz: Quiz) -> None:
    """Ask, and keep the score of a whole round."""
    count = len(quiz.questions)
    one = "{count} question. After each answer comes its reason."
    other = "{count} questions. After each answer comes its reason."
    print(counted("quiz.begin", count, one=one, other=other), end="\n\n")
    found = ask_all(quiz, input)
    print("", *(_score(quiz, found) if found.whole else _broken_off(found, count)), sep="\n")


def _broken_off(found: QuizRound, count: int) -> list[str]:
    ended = "Ended after {asked} of {count}: no score is kept."
    return wrapped(said("quiz.ended", ended, asked=found.asked, count=count))


def _score(quiz: Quiz, found: QuizRound) -> Iterator[str]:
    """What was reached is kept, and what to type next."""
    reached = "{right} of {asked} right at the first try."
    score = said("quiz.reached", reached, right=found.right, asked=found.asked)
    best, trouble = _best(quiz, found)
    yield from labelled(
        [
            LabelledLine(said("quiz.score", "Score"), " ".join(filter(None, (score, best)))),
            *([LabelledLine("", typed=trouble)] if trouble else ()),
            LabelledLine(said("quiz.next", "Next"), typed=program()),
        ],
        LABELS,
    )


def _best(quiz: Quiz, found: QuizRound) -> tuple[str, str]:
    """Keep it in the progress; what is the best so far, and why it could not be kept."""
    from roslings.workspace.errors import WorkspaceError
    from roslings.workspace.progress import record_quiz

    try:
        best = record_quiz(quiz.day, found.right, found.asked)
    except WorkspaceError as error:
        return "", said("quiz.not_kept", "roslings: the score was not kept. {why}", why=error)
    if best.rounds < 2:
        return "", ""
    return said("quiz.best", "Your best: {best} of {of}.", best=best.best, of=best.of), ""


def ask_all(quiz: Quiz, read: Read) -> QuizRound:
    """Ask each question; `q`, Ctrl-D and Ctrl-C end it."""
    found = QuizRound()
    try:
        for number, question in enumerate(quiz.questions, 1):
            right = _ask(number, question, read)
            found.asked, found.right = number, found.right + right
            if number < len(quiz.questions) and _typed(read, str(LOOK)) == QUIT:
                raise EOFError
            print()
        found.whole = True
    except (EOFError, KeyboardInterrupt):
        print()
    return found


def _ask(number: int, question: Question, read: Read) -> bool:
    """Until it is right, at most `TRIES` times; whether the first answer was. Raises EOFError."""
    from roslings_learn.lessons.answering import judged, right_answer
    from roslings_learn.lessons.quiz_text import filled, question_lines

    print("\n".join(question_lines(number, question)))
    for attempt in range(1, TRIES + 1):
        found = judged(question, _answer(question, read))
        word = said("quiz.right", "Right.") if found.right else said("quiz.not_yet", "Not yet.")
        print("\n".join(filled(f"{word} {' '.join(found.said)}", "  ")))
        if found.right:
            return attempt == 1
    print(said("quiz.this_is_right", "This is right:"))
    for line in right_answer(question):
        print("\n".join(filled(f"  {line}", "     ")))
    return False


def _answer(question: Question, read: Read) -> str:
    """A line that is an answer. Raises EOFError."""
    from roslings_learn.lessons.answering import NotAnAnswer, how_to_answer, judged

    while True:
        typed = _typed(read, how_to_answer(question))
        if typed == QUIT:
            raise EOFError
        try:
            judged(question, typed)
        except NotAnAnswer as no_answer:
            print(no_answer)
        else:
            return typed


def _typed(read: Read, text: str) -> str:
    """What stands behind the last line of the text."""
    *before, last = wrapped(text)
    print("".join(f"{line}\n" for line in before), end="")
    return read(f"{last} ").strip()

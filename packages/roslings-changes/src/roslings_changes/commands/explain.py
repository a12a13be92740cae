"""`./roslings explain`: three small changes in one's own package; which check fails, and why?"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from ros2_on_pip.errors import EXIT_OF_OUTCOME, OK, RoslingsError
from roslings import course
from roslings.commands.invocation import program
from roslings.commands.options import package_options, whose_option

if TYPE_CHECKING:
    from roslings.course import Lab
    from roslings.verdict import Verdict
    from roslings_changes.questions import Grade, Question


NOTHING = "No question was asked."


class DoesNotPass(RoslingsError):
    """What a wrong line does is asked about a right package only."""

    def __init__(self, lab: str, verdict: Verdict) -> None:
        said = "could not be told" if verdict.score is None else f"has {verdict.score:g} of 100"
        super().__init__(
            f"explain asks about a package that passes, and this one {said}.\n"
            f"What is missing: {program()} check {lab}"
        )
        self.exit_status = EXIT_OF_OUTCOME[verdict.outcome]


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    package_options(word)
    whose_option(word, "ask by the card of NAME, where each student has another one")
    word.add_argument(
        "--answers", action="store_true", help="print the questions with their answers"
    )
    word.add_argument(
        "--as-stranger",
        action="store_true",
        help="hold somebody else's package as grade does, or refuse it where nothing can",
    )


def run(options: argparse.Namespace) -> int:
    """Ask; in a pipe, print the questions and the answers. Raises DoesNotPass."""
    from roslings.grading.platforms import handed_in
    from roslings_changes.questions import questions

    lab = _lab(options)
    with (
        handed_in(lab, options.path, options.as_stranger) as package,
        _grading(lab, options.as_stranger) as grade,
    ):
        print("First the package as it is: does it pass? ...", flush=True)
        if (verdict := grade(package)).outcome != "pass":
            raise DoesNotPass(lab.name, verdict)
        found = questions(lab, package, grade)
        if options.answers or not (sys.stdin.isatty() and sys.stdout.isatty()):
            _print(found)
        else:
            _play(found)
    return OK


def _lab(options: argparse.Namespace) -> Lab:
    """By the card of whose package it is."""
    from roslings.workspace.own_card import own_lab

    if options.as_stranger and not options.whose:
        return course.lab(options.lab)
    return own_lab(options.lab, whose=options.whose)


@contextmanager
def _grading(lab: Lab, strangers: bool) -> Iterator[Grade]:
    """What grades one package after the other."""
    from roslings.experiment import MeasuringOptions, insist_on_wall
    from roslings.grading.checking import any_seed, ready, ready_again_and_again

    if strangers:
        insist_on_wall(lab)
    again = ready_again_and_again(lab)

    def grade(package: Path) -> Verdict:
        began_ns = time.monotonic_ns()
        if strangers:
            with ready(lab, MeasuringOptions(any_seed(), strangers=True)) as begun:
                return begun.grade(package, began_ns, quiet=True).verdict
        return next(again).grade(package, began_ns, quiet=True).verdict

    try:
        yield grade
    finally:
        again.close()


def _print(found: Iterator[Question]) -> None:
    from roslings_changes.asking import answered, question_lines

    number = 0
    for number, question in enumerate(found, 1):
        print("\n".join(["", *question_lines(number, question), *answered(question)]), flush=True)
    if not number:
        print(NOTHING)


def _play(found: Iterator[Question]) -> None:
    from roslings_changes.asking import ask_all

    print("Three small changes, one at a time, each in a copy: your files stay as they are.")
    print("Each copy is graded before it is shown, which takes as long as a check.\n", flush=True)
    round_ = ask_all(found, input)
    print(f"You named {round_.right} of {round_.asked}." if round_.asked else NOTHING)
    print(f"Next   {program()}")

"""The questions in a terminal: one says which check fails, and why, and then the grader tells."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from roslings.verdict import CheckResult
from roslings_changes.questions import WANTED, Question

QUIT = "q"
WIDTH = 79
Read = Callable[[str], str]
"""Asks by its text, and gives the line that was typed. Raises EOFError where nobody answers."""


@dataclass
class ExplainRound:
    """How many questions were asked so far, and how many first checks were named."""

    asked: int = 0
    right: int = 0


def ask_all(
    found: Iterable[Question], read: Read, say: Callable[[str], None] = print
) -> ExplainRound:
    """Ask each; `q`, Ctrl-D and Ctrl-C end it."""
    round_ = ExplainRound()
    try:
        for question in found:
            say(
                "\n".join(
                    [*listed(question.checks), "", *question_lines(round_.asked + 1, question)]
                )
            )
            named = _named(question.checks, read, say)
            read("Why? One line, for yourself: ")
            round_.asked += 1
            round_.right += named == question.failed.id
            say("\n".join(answered(question, named)))
    except (EOFError, KeyboardInterrupt):
        say("")
    return round_


def listed(checks: Sequence[CheckResult]) -> list[str]:
    """The checks to choose from."""
    room = WIDTH - max(len(check.id) for check in checks) - 8
    return [
        f"  {place:2}  {check.id:{WIDTH - room - 8}}  {_cut(check.title, room)}"
        for place, check in enumerate(checks, 1)
    ]


def _cut(text: str, room: int) -> str:
    return textwrap.shorten(text, room, placeholder=" ...")


def question_lines(number: int, question: Question) -> list[str]:
    """Where the change is, and what it is."""
    change = question.change
    place = f"{number} of {WANTED}   {change.file}, line {change.line}"
    return [place, "", *(f"    {line}" for line in shown(change.changed)), ""]


def shown(changed: str) -> Iterator[str]:
    """Lines with - and +, moved to the left as far as all of them go."""
    lines = [(line[0], line[1:]) for line in changed.splitlines()]
    moved = textwrap.dedent("\n".join(text for _, text in lines)).splitlines()
    yield from (f"{sign} {text}" for (sign, _), text in zip(lines, moved, strict=True))


def answered(question: Question, named: str = "") -> list[str]:
    """What the grader says; with the check that somebody has named, whether it is that one."""
    failed = question.failed
    word = "" if not named else "Right. " if named == failed.id else f"Not {named}. "
    return [f"{word}The first check that fails is {failed.id}: {failed.title}", *told(failed)]


def told(failed: CheckResult) -> Iterator[str]:
    """As a verdict has it."""
    for word in ("expected", "measured", "why"):
        if text := getattr(failed, word):
            yield from filled(f"{word.capitalize():10}{text}")
    yield ""


def filled(text: str) -> list[str]:
    """Lines of a screen's width, with the text below the text."""
    return textwrap.wrap(
        text, WIDTH, initial_indent="  ", subsequent_indent=" " * 12, break_on_hyphens=False
    )


def _named(checks: Sequence[CheckResult], read: Read, say: Callable[[str], None]) -> str:
    """The check that is meant by its number or its name. Raises EOFError."""
    ids = [check.id for check in checks]
    while True:
        typed = read("Which check fails first? Its number or name (q ends): ").strip()
        if typed == QUIT:
            raise EOFError
        if typed in ids:
            return typed
        if typed.isdecimal() and 1 <= int(typed) <= len(ids):
            return ids[int(typed) - 1]
        say(f"Type a number from 1 to {len(ids)}, or a name as it stands there.")

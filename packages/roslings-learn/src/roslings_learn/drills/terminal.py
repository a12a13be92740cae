"""The small judge, of scripts and of what makes no node: what a program prints, how it ends."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterator

from roslings.judge import ExperimentView, come_up
from roslings.judge.demands import require_steady
from roslings.judge.faults import DidNotComeUp
from roslings.judge.views import ProcessView
from roslings.judge.words import end_of
from roslings_learn.drills import faults
from roslings_learn.drills.card import PROGRAM, DrillCard

Look = Callable[[ExperimentView], None]
"""One demand on what was seen of the program."""
NEAR_LINE = 0.5


def prints(text: str) -> Look:
    """The text stands in a line of it."""

    def demand(view: ExperimentView) -> None:
        lines = view.labelled(PROGRAM).texts
        if not any(text in line for line in lines):
            require_steady(view.seen.stall_s)
            near = difflib.get_close_matches(text, lines, n=1, cutoff=NEAR_LINE) or lines[:1]
            raise faults.NotPrinted(text, near[0] if near else None, log=tuple(lines[-40:]))

    return demand


def never_prints(text: str) -> Look:
    """The text stands in no line of it."""

    def demand(view: ExperimentView) -> None:
        for line in view.labelled(PROGRAM).texts:
            if text in line:
                raise faults.PrintedAnyway(text, line)

    return demand


def ends_by_itself(exit_code: int) -> Look:
    """It does its task and ends, with this exit code."""

    def demand(view: ExperimentView) -> None:
        process = view.labelled(PROGRAM)
        if not process.seen.ended_by_itself:
            require_steady(view.seen.stall_s)
            raise faults.RunsOn(PROGRAM, view.seen.watching_s, when=faults.AT_ITS_END)
        if process.seen.status != exit_code:
            raise faults.OtherExitCode(
                PROGRAM,
                faults.AT_ITS_END,
                exit_code,
                end_of(process.seen),
                log=process.last_lines(),
            )

    return demand


def script_comes_up(process: ProcessView) -> None:
    """As `come_up`, in words for a script."""
    try:
        come_up(process)
    except DidNotComeUp as fault:
        raise faults.ScriptMakesNoNode(
            fault.executable, fault.after_s, fault.end, log=fault.log
        ) from None


def steps_of_output(card: DrillCard) -> Iterator[tuple[str, str, Look]]:
    """Name, title and demand for each text of the card."""
    for text in card.prints:
        yield "prints", f"It prints {text!r}.", prints(text)
    for text in card.never_prints:
        yield "silent", f"It does not print {text!r}.", never_prints(text)

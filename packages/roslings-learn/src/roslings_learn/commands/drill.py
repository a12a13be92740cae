"""`./roslings drill`: a tiny program to mend: the next one, or the verdict on one."""

from __future__ import annotations

import argparse

from ros2_on_pip.errors import EXIT_OF_OUTCOME, OK
from ros2_on_pip.language import said
from roslings.commands.invocation import program


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument(
        "drill",
        metavar="NAME",
        nargs="?",
        help="the drill to check (default: show the next one, and put its file in place)",
    )
    word.add_argument("--day", metavar="DAY", help="the next one of this day, for example 3")
    word.add_argument("--list", action="store_true", help="all drills, and which are done")
    word.add_argument(
        "--hint",
        metavar="STEP",
        type=int,
        choices=(1, 2, 3),
        nargs="?",
        const=1,
        help="a hint for it: 1 where, 2 which idea, 3 other code",
    )
    word.add_argument(
        "--solution", action="store_true", help="check the course's own solution instead"
    )


def run(options: argparse.Namespace) -> int:
    """Show the next drill, or check one."""
    from roslings_learn.drills.command import DrillOptions
    from roslings_learn.drills.command import run as run_drill

    day = _day_of_drills(options.day) if options.day else None
    name = options.drill or (_drill_at_hand(day) if options.hint else None)
    asked = DrillOptions(program(), name, options.hint, day, options.solution, options.list)
    verdict = run_drill(asked)
    return EXIT_OF_OUTCOME[verdict.outcome] if verdict else OK


def _drill_at_hand(day: str | None) -> str | None:
    """The drill that a hint without a name is for."""
    from roslings_learn.drills.student import next_drill

    status = next_drill(day=day)
    return status.drill.name if status else None


def _day_of_drills(text: str) -> str:
    """The day's folder. Raises NoSuchDrill."""
    from roslings_learn.drills import NoSuchDrill, all_drills
    from roslings_learn.drills.course import of_day

    every = all_drills()
    found = of_day(every, text)
    if not found:
        last = max(int(each.day[:2]) for each in every)
        told = "There is no drill of the day {day!r}. Give a day from 1 to {last}."
        raise NoSuchDrill(said("drill.no_such_day", told, day=text, last=last))
    return found[0].day

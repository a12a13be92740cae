"""Drills: the next one, or the verdict on one."""

from __future__ import annotations

import argparse

from roslings.errors import EXIT_OF_OUTCOME, OK
from roslings.typed import program


def drill(options: argparse.Namespace) -> int:
    """Show the next drill, or check one."""
    from roslings.drills.command import Asked, run

    day = _day_of_drills(options.day) if options.day else None
    name = options.drill or (_drill_at_hand(day) if options.hint else None)
    asked = Asked(program(), name, options.hint, day, options.solution, options.list)
    verdict = run(asked)
    return EXIT_OF_OUTCOME[verdict.outcome] if verdict else OK


def _drill_at_hand(day: str | None) -> str | None:
    """The drill that a hint without a name is for."""
    from roslings.drills.student import next_drill

    status = next_drill(day=day)
    return status.drill.name if status else None


def _day_of_drills(text: str) -> str:
    """The day's folder. Raises NoSuchDrill."""
    from roslings.drills import NoSuchDrill, all_drills
    from roslings.drills.course import of_day

    found = of_day(all_drills(), text)
    if not found:
        raise NoSuchDrill(f"There is no drill of the day {text!r}. Give a day from 1 to 7.")
    return found[0].day

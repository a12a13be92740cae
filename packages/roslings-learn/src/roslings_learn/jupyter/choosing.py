"""Which day to open: the one that was asked for, or today's."""

from __future__ import annotations

from roslings_learn.jupyter.copies import Copies
from roslings_learn.jupyter.errors import NoSuchDay, NotWritten
from roslings_learn.jupyter.server import JupyterOptions
from roslings_learn.lessons import Day


def chosen_day(wanted: str | None, days: tuple[Day, ...], copies: Copies) -> Day | None:
    """The day of a number, an id or a name; without one, today's, or None for the list of days.

    Raises NoSuchDay, NotWritten.
    """
    if wanted is None:
        return _today(days, copies)
    names = {str(day.number): day for day in days}
    names |= {f"{day.number:02}": day for day in days}
    names |= {name: day for day in days for name in (day.id, day.id[3:])}
    if wanted not in names:
        raise NoSuchDay(wanted, days)
    if not copies.lesson_of(names[wanted]).is_file():
        raise NotWritten(names[wanted])
    return names[wanted]


def _today(days: tuple[Day, ...], copies: Copies) -> Day | None:
    """Day 1 until it was opened; then the day of the next lab."""
    from roslings.workspace.progress import today

    first = days[0] if days else None
    if first and copies.lesson_of(first).is_file() and not (copies.folder / first.id).exists():
        return first
    at = today(copies.workspace).at
    found = next((day for day in days if at and day.id == at.lab.card.day), None)
    return found if found and copies.lesson_of(found).is_file() else None


def place_for(
    wanted: str | None, days: tuple[Day, ...], copies: Copies, port: int | None, browser: bool
) -> JupyterOptions:
    """Where JupyterLab is to open. Raises NoSuchDay, NotWritten."""
    day = chosen_day(wanted, days, copies)
    return JupyterOptions(copies, day.id if day else None, port, browser)

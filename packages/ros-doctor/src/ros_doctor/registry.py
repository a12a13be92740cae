"""The list of checks. A check is a function with `@check` above it; its docstring is the symptom.

The order of the list is the order of mending: causes stand before their consequences.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Literal

from ros_doctor.finding import Finding
from ros_doctor.machine import ExaminedMachine
from ros_doctor.texts import template

CheckText = Literal["title", "looks_at", "symptom"]
Examine = Callable[[ExaminedMachine], Finding]


class UnknownCheck(Exception):
    """No check has this id. `near` holds ids that are spelled alike."""

    def __init__(self, wanted: str, near: list[str]) -> None:
        super().__init__(wanted)
        self.wanted = wanted
        self.near = near


@dataclass(frozen=True)
class DoctorCheck:
    """One thing that the doctor looks at. Its texts are in English; `told` has them in another
    language.

    `rows` are the numbers of the known troubles of beginners that it covers.
    `needs` are ids of checks: at a fault in one of them this check is not run.
    `live` marks a check that starts processes; live checks run side by side.
    """

    id: str
    title: str
    looks_at: str
    symptom: str
    lesson: str
    theme: str
    examine: Examine
    rows: tuple[int, ...] = ()
    needs: tuple[str, ...] = ()
    live: bool = False

    def told(self, part: CheckText) -> str:
        """One of its texts, in the language that is asked for."""
        return template(self.text_id(part), getattr(self, part))

    def text_id(self, part: CheckText) -> str:
        """The id of that text."""
        return f"doctor.{self.id}.{part}"


_checks: dict[str, DoctorCheck] = {}


def check(
    id: str,
    title: str,
    *,
    looks_at: str,
    lesson: str,
    rows: tuple[int, ...] = (),
    needs: tuple[str, ...] = (),
    live: bool = False,
) -> Callable[[Examine], Examine]:
    """Register a function as a check. Its docstring is the symptom as the student sees it.

    `lesson` is a place in the course: `01-install#domain`, or `reference/real-robot#clock`.
    """

    def register(examine: Examine) -> Examine:
        theme = examine.__module__.rpartition(".")[2]
        symptom = " ".join(inspect.cleandoc(examine.__doc__ or "").split())
        _checks[id] = DoctorCheck(
            id, title, looks_at, symptom, _place(lesson), theme, examine, rows, needs, live
        )
        return examine

    return register


def _place(lesson: str) -> str:
    """Where a paragraph stands in the course's folder."""
    return f"site/pages/{lesson}" if lesson.startswith("reference/") else f"days/{lesson}"


def all_checks() -> tuple[DoctorCheck, ...]:
    """Return every check, causes before consequences."""
    import_module("ros_doctor.checks")  # which registers them

    return tuple(_checks.values())


def find_check(wanted: str) -> DoctorCheck:
    """Return the check with this id.

    Raises:
        UnknownCheck: there is none; the exception names ids that are spelled alike.
    """
    known = {one.id: one for one in all_checks()}
    if wanted in known:
        return known[wanted]
    import difflib

    raise UnknownCheck(wanted, difflib.get_close_matches(wanted, known, n=3, cutoff=0.5))

"""Runs checks on a machine: quick ones in order, live ones side by side."""

from __future__ import annotations

import re
import threading
import time
from collections.abc import Iterable
from dataclasses import dataclass, replace

from ros_doctor.finding import Finding, Status, not_applicable, say, unknown
from ros_doctor.machine import ExaminedMachine
from ros_doctor.registry import DoctorCheck
from ros_doctor.texts import said
from ros_doctor.usage import for_this_place

WORST_FIRST = list(Status)
OF_THE_COURSE = ("notebook",)
"""Themes that are about the lessons of the roslings course."""


@dataclass(frozen=True)
class ExaminedCheck:
    """A check, what it found, and the seconds that it took."""

    check: DoctorCheck
    finding: Finding
    seconds: float


@dataclass(frozen=True)
class Examination:
    """Everything that was found on one machine, in the order of mending within each status."""

    machine: ExaminedMachine
    results: tuple[ExaminedCheck, ...]
    seconds: float

    def worst_first(self) -> list[ExaminedCheck]:
        """Return the results, faults first; among equals, causes before consequences."""
        return sorted(self.results, key=lambda one: WORST_FIRST.index(one.finding.status))

    def count(self, status: Status) -> int:
        """Return how many checks ended with this status."""
        return sum(one.finding.status == status for one in self.results)

    @property
    def worst(self) -> Status:
        """The worst status found; `ok` where nothing needs a mend."""
        found = [one.finding.status for one in self.results if one.finding.status.needs_a_mend]
        return min(found, key=WORST_FIRST.index, default=Status.OK)


def examine(machine: ExaminedMachine, checks: Iterable[DoctorCheck]) -> Examination:
    """Run the checks and return what they found. Never raises for an ill machine."""
    start = time.monotonic()
    wanted = list(checks)
    found: dict[str, ExaminedCheck] = {}
    for check in wanted:
        if not check.live:
            found[check.id] = _one(machine, check, found)
    _side_by_side(machine, [check for check in wanted if check.live], found)
    return Examination(
        machine, tuple(found[check.id] for check in wanted), time.monotonic() - start
    )


def _side_by_side(
    machine: ExaminedMachine, checks: list[DoctorCheck], found: dict[str, ExaminedCheck]
) -> None:
    quick = dict(found)

    def work(check: DoctorCheck) -> None:
        found[check.id] = _one(machine, check, quick)

    threads = [threading.Thread(target=work, args=(check,)) for check in checks]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def _one(
    machine: ExaminedMachine, check: DoctorCheck, found: dict[str, ExaminedCheck]
) -> ExaminedCheck:
    start = time.monotonic()
    ill = [name for name in check.needs if _at_fault(found.get(name))]
    finding = (
        unknown(said("doctor.examine.one.unknown", "first mend {ill}", ill=ill[0]))
        if ill
        else _examined(machine, check)
    )
    if check.theme in OF_THE_COURSE and not machine.has_course:
        finding = not_applicable(
            said(
                "doctor.examine.one.not_applicable",
                "there is no folder of the roslings course here",
            )
        )
    shown = for_this_place(machine, for_this_user(machine, finding))
    return ExaminedCheck(check, shown, time.monotonic() - start)


def for_this_user(machine: ExaminedMachine, finding: Finding) -> Finding:
    """Return the finding with mends that this user can type: root has, and needs, no sudo."""
    if machine.user != 0:
        return finding
    steps = [replace(step, command=re.sub(r"\bsudo ", "", step.command)) for step in finding.mend]
    return replace(finding, mend=tuple(steps))


def _at_fault(result: ExaminedCheck | None) -> bool:
    return result is not None and result.finding.status == Status.FAULT


def _examined(machine: ExaminedMachine, check: DoctorCheck) -> Finding:
    try:
        return check.examine(machine)
    except PermissionError as problem:
        return unknown(
            said(
                "doctor.examine.examined.unknown",
                "you may not open {filename}",
                filename=problem.filename,
            )
        )
    except Exception as problem:  # a strange machine must not hide the other findings
        kind = type(problem).__name__
        return unknown(
            said(
                "doctor.examine.examined.unknown_2",
                "the check itself failed ({kind}: {problem})",
                kind=kind,
                problem=problem,
            ),
            say(
                said(
                    "doctor.examine.examined.say",
                    "This is a mistake of the doctor. Report it with this line.",
                )
            ),
        )

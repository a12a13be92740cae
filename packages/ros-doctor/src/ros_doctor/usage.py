"""Commands as they are typed here: in the roslings course, or where this package came alone."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from ros_doctor.finding import Finding, MendStep
from ros_doctor.machine import ExaminedMachine

COURSE = "./roslings"
ALONE = {f"{COURSE} doctor": "ros-doctor", f"{COURSE} break": "ros-doctor break"}
"""What is typed in a course's folder, to what is typed without one."""


def doctor(machine: ExaminedMachine) -> str:
    """Return how this program is called."""
    return as_typed(machine, f"{COURSE} doctor")


def exercises(machine: ExaminedMachine) -> str:
    """Return how its exercises are called."""
    return as_typed(machine, f"{COURSE} break")


def as_typed(machine: ExaminedMachine, text: str) -> str:
    """Return the text with the commands that there are."""
    for in_the_course, alone in () if machine.has_course else ALONE.items():
        text = text.replace(in_the_course, alone)
    return text


def for_this_place(machine: ExaminedMachine, finding: Finding) -> Finding:
    """Return the finding with what can be typed; steps that need the course go where it is not."""
    if machine.has_course:
        return finding
    mend = tuple(step for step in _typed(machine, finding.mend) if COURSE not in str(step))
    return replace(finding, found=as_typed(machine, finding.found), mend=mend)


def _typed(machine: ExaminedMachine, steps: Iterable[MendStep]) -> Iterable[MendStep]:
    for step in steps:
        yield MendStep(as_typed(machine, step.text), as_typed(machine, step.command))

"""Which package is which part today: the student's best one, today's, or a borrowed one."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.errors import RoslingsError
from roslings.commands.invocation import program
from roslings.course import Lab
from roslings.workspace.best import best_package
from roslings.workspace.progress import status
from roslings_my_rover.parts import PARTS, RoverPart, day_number, labs_of_parts

FULL = 100.0


class NoPart(RoslingsError):
    """The rover would be the bare robot."""

    def __init__(self) -> None:
        super().__init__(
            "No part of your rover is there yet: each lab is one.\n"
            f"Begin with the first: {program()} start nodes\n"
            f"The bare robot drives, too: {program()} rover"
        )


class CannotBorrow(RoslingsError):
    """There is nothing to borrow for that day."""

    def __init__(self, day: int, because: str) -> None:
        super().__init__(f"Nothing can be borrowed for day {day}: {because}")


@dataclass(frozen=True)
class ChosenPart:
    """A part that is there, and its package."""

    part: RoverPart
    lab: Lab
    package: Path
    score: float | None
    """Of the last check, 0 to 100; None where it was never checked."""
    whose: str = "yours"
    """`yours`, or `borrowed`."""

    @property
    def remark(self) -> str:
        """What is to be known of it; empty where it is whole and the student's."""
        if self.whose == "borrowed":
            return "borrowed from the course"
        if self.score is None:
            return "never checked"
        return "" if self.score == FULL else f"{self.score:g} of 100"


@dataclass(frozen=True)
class AbsentPart:
    """A part that is not there yet."""

    part: RoverPart
    lab: Lab

    @property
    def line(self) -> str:
        """`no eyes yet: day 7`."""
        return f"no {self.part.name} yet: day {day_number(self.lab)}"


@dataclass(frozen=True)
class ChosenParts:
    """All parts, each there or absent, in the order of the days."""

    there: tuple[ChosenPart, ...]
    absent: tuple[AbsentPart, ...]


def chosen(
    last_day: int | None = None, borrowed: Collection[int] = (), todays: bool = False
) -> ChosenParts:
    """The parts up to a day; of the days `borrowed` the course's, where the student has none.

    With `todays`, the packages as they lie in the workspace, not those of the best score. Raises
    CannotBorrow and CannotRead.
    """
    labs = labs_of_parts()
    _insist_on_days(borrowed, labs)
    mine = {each.lab.name: each for each in status()}
    there, absent = list[ChosenPart](), list[AbsentPart]()
    for part in PARTS:
        lab = labs.get(part.name)
        if lab is None or (last_day is not None and day_number(lab) > last_day):
            continue
        own = mine[lab.name]
        package = own.package if todays else best_package(lab) or own.package
        score = own.progress.best if own.progress.checks else None
        if todays and own.progress.checks:
            score = own.progress.last
        if package:
            there.append(ChosenPart(part, lab, package, score))
        elif day_number(lab) in borrowed:
            there.append(ChosenPart(part, lab, lab.solution, None, "borrowed"))
        else:
            absent.append(AbsentPart(part, lab))
    return ChosenParts(tuple(there), tuple(absent))


def _insist_on_days(borrowed: Collection[int], labs: dict[str, Lab]) -> None:
    days = {day_number(lab): lab for lab in labs.values()}
    for day in borrowed:
        if day not in days:
            known = ", ".join(map(str, sorted(days)))
            raise CannotBorrow(day, f"its lab is no part of the rover. Those of days {known} are.")
        if not days[day].solution.is_dir():
            raise CannotBorrow(
                day,
                "this is the students' edition, without solutions. Do its lab first:"
                f" {program()} start {days[day].name}",
            )


def told(choice: ChosenParts) -> Iterator[str]:
    """A line a part: `day 7  eyes  pi-camera  60 of 100`, for `--parts`."""
    lines = [(day_number(each.lab), _there(each)) for each in choice.there]
    lines += [
        (
            day_number(each.lab),
            f"{each.part.name:8} not there yet   {program()} start {each.lab.name}",
        )
        for each in choice.absent
    ]
    for day, line in sorted(lines):
        yield f"day {day:2}  {line}".rstrip()


def _there(each: ChosenPart) -> str:
    remark = f"  ({each.remark})" if each.remark else ""
    return f"{each.part.name:8} {each.part.can}{remark}"

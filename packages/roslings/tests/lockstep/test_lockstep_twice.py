"""A drive is believed where half the speed changes nothing; records are kept whole."""

from __future__ import annotations

from pathlib import Path

import pytest
from pydantic import ValidationError

from roslings.lockstep import DriveBudget, DriveTick, LockstepDrive, drive_twice
from roslings.lockstep.record import BumpSeen, SleeperSeen, VelocityCommand
from roslings.lockstep.twice import SAME_PLACE_M

BUMP = BumpSeen(time_s=0.1, x_m=0.0, y_m=0.0, moving=False)
ASLEEP = SleeperSeen(pid=7, ticks=9, words="A loop of your node sleeps on the wall clock.")


def drive(x_m: float = 1.0, **words: object) -> LockstepDrive:
    """Two ticks, and where the rover is at their end."""
    said = (VelocityCommand(forward_m_s=0.2, turn_rad_s=0.1),)
    ticks = (
        DriveTick(time_s=0.05, x_m=0.0, y_m=0.0, heading_rad=0.0, commands=said),
        DriveTick(time_s=0.1, x_m=x_m, y_m=0.0, heading_rad=0.0),
    )
    all_words = {"room": 17, "period_s": 0.05, "end": "done", "ticks": ticks, "wall_s": 0.008}
    return LockstepDrive.model_validate({**all_words, **words})


def twice(first: LockstepDrive, second: LockstepDrive) -> tuple[str, list[DriveBudget]]:
    """Why it is not believed, and the budgets of the drives that were needed."""
    budgets: list[DriveBudget] = []

    def run(budget: DriveBudget) -> LockstepDrive:
        budgets.append(budget)
        return (first, second)[len(budgets) - 1]

    believed = drive_twice(run)
    assert believed.first is first
    assert believed.is_believed is not bool(believed.why_not)
    return believed.why_not, budgets


def test_the_same_end_is_believed() -> None:
    """Where the rover stands need not be the same to the last digit."""
    assert twice(drive(), drive(1.0 + SAME_PLACE_M / 2))[0] == ""


@pytest.mark.parametrize(
    "second",
    [
        drive(1.0 + 2 * SAME_PLACE_M),
        drive(bumps=(BUMP,)),
        drive(way_m=0.5),
        drive(end="done", ticks=()),
    ],
    ids=["place", "bumps", "way", "ticks"],
)
def test_another_end_is_not(second: LockstepDrive) -> None:
    """The student hears what that means, and what is done about it."""
    why, budgets = twice(drive(), second)
    assert why.startswith("At half the speed the same room ends otherwise")
    assert len(budgets) == 2


def test_the_second_drive_has_half_the_speed() -> None:
    """Each tick takes twice what one took, and there is twice the time for all."""
    _, (first, second) = twice(drive(), drive())
    assert first == DriveBudget()
    assert second.pace_s == pytest.approx(2 * 0.004)
    assert second.computing_s == 2 * first.computing_s
    assert second.cap_s == 2 * first.cap_s
    assert second.room_s == 2 * first.room_s


def test_who_sleeps_is_not_driven_twice() -> None:
    """Real time judges it in any case."""
    why, budgets = twice(drive(sleepers=(ASLEEP,)), drive())
    assert why == ASLEEP.words
    assert len(budgets) == 1


def test_a_drive_that_broke_off_is_not_believed() -> None:
    """Its own words say why."""
    why, budgets = twice(drive(end="over budget", why="The time is over."), drive())
    assert why == "The time is over."
    assert len(budgets) == 1


def test_a_lab_may_compare_by_its_own_outcome() -> None:
    """As by its points."""
    two = iter((drive(1.0), drive(2.0)))
    assert drive_twice(lambda _: next(two), alike=lambda one, other: True).is_believed


def test_a_record_is_read_as_it_was_written(tmp_path: Path) -> None:
    """All of it, and the command of each tick."""
    written = drive(bumps=(BUMP,), sleepers=(ASLEEP,), refused_commands=2)
    written.write(tmp_path / "drive.json")
    read = LockstepDrive.read(tmp_path / "drive.json")
    assert read == written
    assert read.commands == (VelocityCommand(forward_m_s=0.2, turn_rad_s=0.1), None)


def test_a_record_of_another_form_is_refused() -> None:
    """No grader judges half of it."""
    with pytest.raises(ValidationError):
        LockstepDrive.model_validate_json('{"room": 17, "period_s": 0.05, "end": "fine"}')

"""Real nodes in a room, in lockstep: the same commands each time, and no more than that is claimed.

Each drive is of ten robot seconds, in a domain of its own.
"""

from __future__ import annotations

import threading
from itertools import pairwise

import pytest
from lockstep_drives import CREWS, SCAN, TIMER, Crew, driven, driven_in_real_time

from roslings.lockstep import DriveBudget, LockstepDrive, NoDrive, drive_twice

pytestmark = pytest.mark.slow

RUNS = 5
COMPUTING = Crew(("computing",), ("/follower",), ("computes_s:=0.1",))
COMPUTING_LONG = Crew(("computing",), ("/follower",), ("computes_s:=0.7",))
SLEEPER = Crew(("sleeper",), ("/follower",))
RESTLESS = Crew(("restless",), ("/follower",))
LEAVER = Crew(("leaver",), ("/follower",))
PATIENT = DriveBudget(computing_s=20.0, cap_s=60.0, room_s=300.0)
"""A machine that does other work, too, may hold a node up for longer than it computes."""


def commands_said(drive: LockstepDrive) -> list[tuple[int, float]]:
    """The tick of each command, and its speed."""
    return [
        (number, round(command.forward_m_s, 6))
        for number, tick in enumerate(drive.ticks)
        for command in tick.commands
    ]


@pytest.mark.parametrize("name", CREWS)
def test_the_same_nodes_say_the_same_each_time(name: str) -> None:
    """At each tick; and they drive, so that there is something to compare."""
    drives = [driven(CREWS[name], budget=PATIENT) for _ in range(RUNS)]
    assert [(drive.end, drive.why) for drive in drives] == [("done", "")] * RUNS
    assert len({drive.commands for drive in drives}) == 1
    assert len({drive.ticks for drive in drives}) == 1
    assert [len(drive.ticks) for drive in drives] == [200] * RUNS
    assert len(commands_said(drives[0])) >= 50
    assert drives[0].way_m > 0.3
    assert all(drive.sleepers == () for drive in drives)


def test_a_timer_speaks_at_its_own_ticks() -> None:
    """Ten times a second is at each second tick, and no command is a tick late."""
    said = [number for number, _ in commands_said(driven(TIMER, budget=PATIENT))]
    assert {after - before for before, after in pairwise(said)} == {2}


def test_who_answers_a_scan_does_so_in_its_tick() -> None:
    """The scanner turns five times a second."""
    said = [number for number, _ in commands_said(driven(SCAN, budget=PATIENT))]
    assert said == list(range(0, 200, 4))


def test_computing_within_the_budget_costs_no_tick() -> None:
    """A tenth of a second for each command: they come at the ticks of its timer all the same."""
    drive = driven(COMPUTING, budget=PATIENT)
    assert (drive.end, drive.why) == ("done", "")
    assert not any(tick.late for tick in drive.ticks)
    said = [number for number, _ in commands_said(drive)]
    assert len(said) >= 19
    assert {after - before for before, after in pairwise(said)} == {10}


def test_computing_beyond_it_is_not_free() -> None:
    """Robot time goes on: the command counts at a later tick, and the tick says so."""
    allowed = DriveBudget(computing_s=0.3, cap_s=60.0, room_s=300.0)
    drive = driven(COMPUTING_LONG, length_s=3.0, budget=allowed)
    assert (drive.end, drive.why) == ("done", "")
    late = [number for number, tick in enumerate(drive.ticks) if tick.late]
    said = commands_said(drive)
    assert late
    assert said
    for number, _ in said:
        assert number - 1 in late, "it was computed for longer than one tick may take"


def test_who_sleeps_on_the_wall_clock_is_named() -> None:
    """Then no second drive is needed: real time judges it."""
    believed = drive_twice(lambda budget: driven(SLEEPER, budget=budget))
    assert not believed.is_believed
    assert believed.second is None
    (sleeper,) = believed.first.sleepers
    assert believed.why_not == sleeper.words
    assert sleeper.thread == ""
    assert "its main thread" in sleeper.words
    assert "judged in real time" in sleeper.words


def test_what_never_waits_is_refused() -> None:
    """By the cap, and the words tell what to look for."""
    drive = driven(RESTLESS, budget=DriveBudget(computing_s=0.2, cap_s=2.0))
    assert drive.end == "never quiet"
    assert drive.why.startswith("After ")
    assert "`spin_once(timeout_sec=0)`" in drive.why
    assert drive.ticks == ()


def test_a_node_that_ends_ends_the_drive() -> None:
    """What was driven before stays in the record."""
    drive = driven(LEAVER, budget=PATIENT)
    assert drive.end == "a node ended"
    assert 0 < len(drive.ticks) < 200


def test_a_node_that_is_not_there_is_named() -> None:
    """Its name may be another one."""
    drive = driven(Crew(("by_timer",), ("/follow",)), discovery_s=5.0)
    assert drive.end == "nobody follows"
    assert drive.why == "These nodes were not found: /follow."


def test_a_room_has_its_time() -> None:
    """Whoever computes for each command uses it up."""
    drive = driven(COMPUTING, budget=DriveBudget(room_s=0.5))
    assert drive.end == "over budget"
    assert "have computed for more than 0.5 s after" in drive.why


def test_a_follower_is_believed() -> None:
    """Half the speed ends at the same place."""
    believed = drive_twice(lambda budget: driven(TIMER, budget=budget), PATIENT)
    assert believed.is_believed, believed.why_not
    assert believed.second
    assert believed.second.wall_s > believed.first.wall_s
    assert believed.second.commands == believed.first.commands


@pytest.mark.parametrize("crew", [SLEEPER, TIMER], ids=["sleeper", "timer"])
def test_real_time_drives_whoever_there_is(crew: Crew) -> None:
    """Who sleeps, and who does not: the rover goes as it is told, and each tick is there."""
    drive = driven_in_real_time(crew)
    assert (drive.end, drive.why, drive.room) == ("done", "", 17)
    assert len(drive.ticks) == 100
    assert drive.way_m > 0.1
    assert len(commands_said(drive)) > 10
    assert drive.sleepers == ()
    assert drive.stall_s > 0


def test_where_nobody_drives_the_rover_stands() -> None:
    """It starts all the same, when nobody has come for long."""
    drive = driven_in_real_time(LEAVER, length_s=1.0, discovery_s=3.0)
    assert len(drive.ticks) == 20


def test_a_drive_is_called_off() -> None:
    """Whoever waits for it is told."""
    called_off = threading.Event()
    called_off.set()
    with pytest.raises(NoDrive, match="called off"):
        driven_in_real_time(TIMER, called_off=called_off)

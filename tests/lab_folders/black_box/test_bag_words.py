"""What is said of a program that reads bags: what it wrote is what is told, with its own hint."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from graders.black_box import demands, diagnosis, faults
from graders.black_box.contract import BagWords
from graders.black_box.record import (
    BagGiven,
    BagsSeen,
    DriveHeld,
    PauseHeld,
    TopicHeld,
)
from roslings.course import lab
from roslings.course import written as said
from roslings.evidence import ExperimentSeen, LogLine, PackageSeen, ProcessSeen
from roslings.judge import ExperimentView, Fault
from roslings.judge.views import PackageView
from roslings_rover.models.drives.sick_rover import sick_rover
from ways_to_write import WAYS, written

CARD = lab("black-box").card
READER = said(CARD.of(BagWords).reads_bags, CARD.package)
DIAGNOSIS = said(CARD.of(BagWords).diagnosis, CARD.package)
PATH = "/w/devices/missing_amber"
HELD = DriveHeld(
    duration_s=20.0,
    distance_m=3.0,
    top_speed_m_s=0.5,
    topics=[TopicHeld(name=name, count=90, rate_hz=5.0) for name in ("/odom", "/left/range")],
    pauses=[
        PauseHeld(topic="/odom", seconds=2.0, start_s=1.0, periods=10.0),
        PauseHeld(topic="/odom", seconds=3.0, start_s=9.0, periods=15.0),
        PauseHeld(topic="/left/range", seconds=0.5, start_s=4.0, periods=2.5),
    ],
)
FIRST, SECOND = "gap /odom: 2.00 s, from 1.00 s", "gap /odom: 3.00 s, from 9.00 s"
CRASH = ("Traceback (most recent call last):", "IndexError: list index out of range")
Demand = Callable[[ExperimentView], None]


def view(*lines: str, status: int = 0, way: str = "print") -> ExperimentView:
    """The program got a bag with two gaps, or with nothing to tell, and wrote these lines."""
    process = ProcessSeen(
        executable=READER.executable,
        started_ns=0,
        ended_ns=10**9,
        status=status,
        ended_by_itself=True,
        lines=[LogLine(arrival_ns=n, text=text, source="terminal") for n, text in enumerate(lines)],
    )
    given = BagsSeen(given=[BagGiven(label="drive", path=PATH, holds=HELD)])
    seen = ExperimentSeen(
        name="x", clock="wall", processes={"drive": process}, parts={"bags": given}
    )
    return ExperimentView(written(seen, way))


def fault_of(demand: Demand, seen: ExperimentView) -> Fault:
    """What is not met."""
    with pytest.raises(Fault) as raised:
        demand(seen)
    return raised.value


GAPS = demands.tell_gaps(READER, "drive")
NO_BAG, NO_DRIVE = demands.tell_no_bag(READER, "drive"), demands.tell_no_drive(READER, "drive")
TOLD, NEAR_DRIVE = f"no bag: {PATH}", "no drive: no message on /odom"


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize(
    ("lines", "measured"),
    [
        ([], "it wrote no line about a gap of /odom"),
        (["gap /left/range: 1.00 s, from 2.00 s"], "it wrote no line about a gap of /odom"),
        ([FIRST], f"of the gaps of /odom it wrote only `{FIRST}`"),
        ([SECOND], f"of the gaps of /odom it wrote only `{SECOND}`"),
        ([FIRST, "gap /odom: 3.00 s, from 8.00 s"], "it wrote `gap /odom: 3.00 s, from 8.00 s`"),
        (["gap /odom: 2 s"], "it wrote `gap /odom: 2 s`"),
        ([FIRST, "Gap in /odom: 3.00 s"], "it wrote `Gap in /odom: 3.00 s`"),
        (["gap odom: 2.00 s, from 1.00 s"], "it wrote `gap odom: 2.00 s, from 1.00 s`"),
        (["gap /odom: 2,00 s, from 1,00 s"], "it wrote `gap /odom: 2,00 s, from 1,00 s`"),
        (["gap /odometry: 2.00 s, from 1.00 s"], "it wrote no line about a gap of /odom"),
    ],
)
def test_a_gap_that_is_missed_is_told_with_what_was_written(
    lines: list[str], measured: str, way: str
) -> None:
    """Whatever the program wrote about this topic, and no other one."""
    fault = fault_of(GAPS, view(*lines, way=way))
    assert type(fault) is faults.GapMissed
    assert fault.measured == measured
    assert fault.expected in (f"`{FIRST}`", f"`{SECOND}`")


REFUSALS: list[tuple[Demand, tuple[str, ...], int, str, str]] = [
    (NO_BAG, (), 1, "there is no such line; it ended with exit code 1", "letter by letter"),
    (NO_BAG, ("no bag",), 1, "it wrote `no bag`; it ended with exit code 1", "letter by letter"),
    (
        NO_BAG,
        ("no bag: missing_amber",),
        0,
        "it wrote `no bag: missing_amber`; it ended with exit code 0",
        "letter by letter",
    ),
    (NO_BAG, (TOLD,), 0, "it wrote the line, and ended with exit code 0", "`return 1`"),
    (NO_BAG, CRASH, 1, "there is no such line; it ended with exit code 1", "reader.open()"),
    (NO_DRIVE, (), 0, "there is no such line; it ended with exit code 0", "letter by letter"),
    (
        NO_DRIVE,
        ("no drive",),
        2,
        "it wrote `no drive`; it ended with exit code 2",
        "letter by letter",
    ),
    (NO_DRIVE, (NEAR_DRIVE,), 1, "it wrote the line, and ended with exit code 1", "`return 2`"),
    (NO_DRIVE, CRASH, 1, "there is no such line; it ended with exit code 1", "is empty"),
]
"""Demand, lines, exit code, what is told as measured, and what the hint says."""


@pytest.mark.parametrize(("demand", "lines", "status", "measured", "hint"), REFUSALS)
def test_a_bag_that_cannot_be_told_of(
    demand: Demand, lines: tuple[str, ...], status: int, measured: str, hint: str
) -> None:
    """The line that was wanted stands there in full, and the hint is about this very fault."""
    fault = fault_of(demand, view(*lines, status=status))
    wanted = TOLD if demand is NO_BAG else NEAR_DRIVE
    assert fault.measured == measured
    assert f"the line `{wanted}`" in fault.expected
    others = {"letter by letter", "`return ", "reader.open()", "is empty"} - {hint[:8], hint}
    assert hint in fault.hint and not any(other in fault.hint for other in others)


@pytest.mark.parametrize("way", WAYS)
def test_who_refuses_as_the_card_says_is_right(way: str) -> None:
    """In each way of writing."""
    NO_BAG(view(TOLD, status=1, way=way))
    NO_DRIVE(view(NEAR_DRIVE, status=2, way=way))


# --- the diagnosis -----------------------------------------------------------------------------


TRUTH = sick_rover("Ada").planted
RIGHT = [{"fault": one.fault, "topic": one.topic, "number": one.number} for one in TRUTH]
GUESS = {"fault": "flood", "topic": "/nowhere", "number": 1.0}
OFF = {**RIGHT[0], "number": RIGHT[0]["number"] * 1.2}
WHICH = f"{TRUTH[0].fault} of {TRUTH[0].topic}"


def package(*entries: dict[str, Any]) -> PackageView:
    """A package with a diagnosis of Ada's rover."""
    text = f"name: Ada\nfaults: {list(entries)}"
    files = PackageSeen.model_construct(documents={"diagnosis.yaml": text})
    return PackageView(files, None, "black-box")


@pytest.mark.parametrize(
    ("entries", "measured", "hint"),
    [
        (RIGHT[:2], "2 right", "Go on in the order"),
        ([*RIGHT, GUESS], "5 right; 1 with a fault that its topic does not have", "no proof"),
        ([*RIGHT, RIGHT[0]], f"5 right; made a second time: {WHICH}", "second entry"),
        ([*RIGHT, OFF], f"5 right; made a second time: {WHICH}", "second entry"),
        (
            [OFF, *RIGHT],
            f"4 right; made a second time: {WHICH}; the number alone is wrong in: {WHICH}",
            "second entry",
        ),
        ([OFF, *RIGHT[1:]], f"4 right; the number alone is wrong in: {WHICH}", "Measure again"),
        (
            [*RIGHT[1:], GUESS, GUESS],
            "4 right; 1 with a fault that its topic does not have;"
            " made a second time: flood of /nowhere",
            "second entry",
        ),
    ],
)
def test_a_diagnosis_is_told_as_it_is(
    entries: list[dict[str, Any]], measured: str, hint: str
) -> None:
    """A right entry that was made twice is no fault that its topic does not have."""
    demand = demands.find(DIAGNOSIS.faults, "diagnosis.yaml", DIAGNOSIS)
    with pytest.raises(faults.TooFewFound) as raised:
        demand(package(*entries))
    assert raised.value.measured == measured
    assert hint in raised.value.hint


def test_each_second_entry_costs_what_a_right_one_gives() -> None:
    """Else two guesses of a number would be free."""
    truth = diagnosis.read(f"name: Ada\nfaults: {RIGHT}").entries
    for more, net in (((), 5), (truth[:1], 4), (truth[:2], 3)):
        assert diagnosis.tally((*truth, *more), TRUTH, DIAGNOSIS.number_within).net == net

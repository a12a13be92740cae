"""The sick rover of a name: the same for the same name, and sick in the way that it says."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from statistics import mean

import pytest

from graders.black_box import diagnosis
from graders.black_box.contract import BagWords
from roslings.course import lab, root, written
from roslings_rover.models.drives.faults import FAULTS
from roslings_rover.models.drives.recording import NS, RecordedMessage, TopicPlan, of_topic
from roslings_rover.models.drives.sheet import SHEET
from roslings_rover.models.drives.sick_rover import (
    PLANTED,
    NotARoverName,
    Planted,
    SickRover,
    may_be,
    sick_rover,
    words_of,
)

NAMES = [f"student {number}" for number in range(16)]


@cache
def rover_of(name: str) -> SickRover:
    """Made once for all tests."""
    return sick_rover(name)


def planted_in(fault: str) -> Iterator[tuple[Planted, TopicPlan, list[RecordedMessage]]]:
    """The fault in each rover that has it, with the messages of its topic."""
    for name in NAMES:
        rover = rover_of(name)
        for each in rover.planted:
            if each.fault == fault:
                topic = next(t for t in rover.plan.topics if t.name == each.topic)
                yield each, topic, of_topic(rover.said, each.topic)


def test_a_name_has_one_rover_however_it_is_written() -> None:
    """Order, accents, capitals and commas count for nothing."""
    assert words_of("Lovelace, Ada") == words_of("ada  LOVELACE") == ("ada", "lovelace")
    assert words_of("Zoë") == words_of("zoe")
    assert sick_rover("Zoë K").planted == sick_rover("k_zoe").planted


def test_it_stays_as_it_was_written_down() -> None:
    """A bag that a student has made must not go wrong with the next version."""
    found = {each.fault: each.topic for each in sick_rover("Grace Hopper").planted}
    assert found == {
        "lost_parameter": "/cmd_vel",
        "stale_stamps": "/range",
        "wrong_clock": "/imu",
        "flood": "/battery",
        "wrong_namespace": "/robot1/temperature",
    }


@pytest.mark.parametrize("name", ["", " ", "?", "x"])
def test_no_name_has_no_rover(name: str) -> None:
    """Two letters at least."""
    with pytest.raises(NotARoverName):
        sick_rover(name)


def test_each_has_five_faults_in_five_topics() -> None:
    """And all ten faults come in some class."""
    rovers = [rover_of(name).planted for name in NAMES]
    assert all(len({each.fault for each in rover}) == PLANTED for rover in rovers)
    assert all(len({each.topic for each in rover}) == PLANTED for rover in rovers)
    assert {each.fault for rover in rovers for each in rover} == set(FAULTS)


def test_one_diagnosis_does_not_fit_another_rover() -> None:
    """Copied from the neighbour, it earns nothing, or next to nothing."""
    within = written(lab("black-box").card.of(BagWords).diagnosis, "black-box").number_within
    nets = []
    for mine, theirs in pairwise(NAMES):
        copied = tuple(
            diagnosis.Entry(each.fault, each.topic, each.number) for each in rover_of(mine).planted
        )
        nets.append(diagnosis.tally(copied, rover_of(theirs).planted, within).net)
    assert max(nets) <= 0


def test_stamps_stand_still() -> None:
    """From some message on, and the number is how old the last one is."""
    for each, topic, said in planted_in("stale_stamps"):
        assert len({one.stamp_ns for one in said[-10:]}) == 1
        assert each.number == pytest.approx((said[-1].time_ns - said[-1].stamp_ns) / NS)
        assert topic.still_from_s < math.inf


def test_a_clock_is_off_by_the_same_time() -> None:
    """Every stamp, up to milliseconds; a minus is behind."""
    for each, _, said in planted_in("wrong_clock"):
        offs = [(one.stamp_ns - one.time_ns) / NS for one in said]
        assert max(offs) - min(offs) < 0.01 and abs(each.number) > 1.9
        assert each.number == pytest.approx(mean(offs), abs=0.01)


def test_a_dead_node_says_nothing_any_more() -> None:
    """Its last message comes long before the end."""
    for each, _, said in planted_in("dead_node"):
        assert (said[-1].time_ns - said[0].time_ns) / NS == pytest.approx(each.number, abs=0.3)


def test_a_wheel_is_slower_on_straight_ways() -> None:
    """Measured as a student would, from what the bag holds."""
    for name in NAMES:
        rover = rover_of(name)
        drift = [each for each in rover.planted if each.fault == "drifting_wheel"]
        if not drift:
            continue
        left, right = _straight(rover)
        slower = 100 * abs(left - right) / max(left, right)
        assert slower == pytest.approx(drift[0].number, rel=0.05)


def _straight(rover: SickRover) -> tuple[float, float]:
    """The mean speed of each wheel while the rover was told to drive straight on."""
    told = [
        one.values
        for one in of_topic(rover.said, "/wheel_speeds")
        if _is_straight(rover, (one.time_ns - rover.plan.start_ns) / NS)
    ]
    return mean(values[0] for values in told), mean(values[1] for values in told)


def _is_straight(rover: SickRover, time_s: float) -> bool:
    motion = rover.plan.piece_at(time_s).motion
    return motion.forward_m_s > 0 and motion.turn_rad_s == 0


def test_other_faults_leave_their_trace() -> None:
    """A unit, frames, a flood, a namespace, a QoS and a parameter."""
    for _, _, said in planted_in("wrong_unit"):
        assert said
    for each, topic, said in planted_in("wrong_frame"):
        wrong = [one for one in said if one.frame != topic.sheet.frame]
        assert 0 < len(wrong) == each.number < len(said)
        assert wrong == said[-len(wrong) :]
    for each, topic, _ in planted_in("flood"):
        assert each.number > 5 * topic.sheet.rate_hz
    for each, topic, _ in planted_in("wrong_namespace"):
        assert re.fullmatch(rf"/\w+{topic.sheet.name}", each.topic)
    for each, topic, said in planted_in("qos_mismatch"):
        assert topic.sheet.asks_reliable and not topic.reliable and each.number == len(said)
    for each, _, said in planted_in("lost_parameter"):
        assert 0.3 * 1.2 < each.number == max(one.values[0] for one in said)


@pytest.mark.parametrize(
    ("name", "handed_in_as", "own"),
    [
        ("Ada Lovelace", "Lovelace_Ada_4711_black-box", True),
        ("Ada Lovelace", "Ada Lovelace_1234_assignsubmission_file_", True),
        ("Ada Lovelace", "lab-black-box-adalovelace", True),
        ("Ada Lovelace", "lovelaceada_55_66_black_box", True),
        ("ada", "ada", True),
        ("Ada Lovelace", "charles_babbage", False),
        ("Ada Lovelace", "ada_byron", False),
        ("black box", "charles_babbage_black-box", False),
        ("file", "charles_babbage_assignsubmission_file", False),
        ("Ada Lovelace", "black-box", True),
        ("Ada Lovelace", "4711", True),
        ("Ada Lovelace", "black-box_s1001_v2", True),
    ],
)
def test_a_name_is_held_against_the_submission(name: str, handed_in_as: str, own: bool) -> None:
    """Where the submission's name tells who it was."""
    assert may_be(name, handed_in_as, "black-box black_box") is own


def test_the_task_tells_sheet_and_faults_as_they_are() -> None:
    """Each topic and each fault is a row of the tables of step 6."""
    task = (root() / "labs" / "black-box" / "task.md").read_text("utf-8")
    for sheet in SHEET:
        frame = f"`{sheet.frame}`" if sheet.stamped else "none"
        asks = "reliable" if sheet.asks_reliable else "best effort"
        row = (
            f"| `{sheet.name}` | `{sheet.node}` | {sheet.rate_hz:g} | {frame} | {sheet.value} |"
            f" {asks} |"
        )
        assert row in task
    for fault in FAULTS.values():
        assert f"| `{fault.name}` | {fault.about} | {fault.number} |" in task

"""What the tab of the frames makes of what comes on /tf and /tf_static; time is the test's own."""

from __future__ import annotations

import math
from typing import Any

import pytest
from geometry_msgs.msg import TransformStamped

from roslings_desk.frames_now import (
    CEASED_S,
    FORGOTTEN_S,
    LATELY_S,
    MOST_FRAMES,
    TF,
    TF_STATIC,
    FrameRow,
    FramesLook,
    FramesNow,
)
from skips import imported

TFMessage = imported("tf2_msgs.msg").TFMessage
SAID_BY = {TF: ["/rover"], TF_STATIC: ["/rover"]}
START_S = 1_000.0


def step(parent: str, child: str, at_s: float, x_m: float = 0.0, yaw_rad: float = 0.0) -> Any:
    """One step, with the stamp of this time."""
    told = TransformStamped(child_frame_id=child)
    told.header.frame_id = parent
    told.header.stamp.sec, told.header.stamp.nanosec = int(at_s), round(at_s % 1 * 1e9)
    told.transform.translation.x = x_m
    told.transform.rotation.z, told.transform.rotation.w = (
        math.sin(yaw_rad / 2),
        math.cos(yaw_rad / 2),
    )
    return told


def heard(now: FramesNow, *steps: Any, at_s: float, fixed: bool = False) -> None:
    """One message that comes at once."""
    now.take(TFMessage(transforms=list(steps)), at_s, fixed)


def drive(now: FramesNow, seconds: float, hz: float = 20.0, parent: str = "odom") -> float:
    """A rover that says where it is; the time afterwards."""
    at_s = START_S
    for number in range(int(seconds * hz)):
        at_s = START_S + number / hz
        heard(now, step(parent, "base_link", at_s, x_m=1.5, yaw_rad=0.5), at_s=at_s)
    return at_s


def look(now: FramesNow, at_s: float, said_by: Any = None) -> FramesLook:
    """At a time of both clocks."""
    now.forget(at_s)
    return FramesLook(now, SAID_BY if said_by is None else said_by, at_s, round(at_s * 1e9))


@pytest.fixture
def now() -> FramesNow:
    """Nothing was heard yet."""
    return FramesNow()


def test_the_tree_has_all_that_is_asked_for(now: FramesNow) -> None:
    """Root first; each below its parent, with rate, age, place, turn, and who says it."""
    heard(now, step("base_link", "laser", START_S), at_s=START_S, fixed=True)
    at_s = drive(now, 2.0)
    seen = look(now, at_s + 0.25)
    assert list(seen.rows()) == [
        FrameRow("odom", 0),
        FrameRow("base_link", 1, "20.0 Hz, 0.25 s old", "1.500, 0.000, 0.000", "28.6", "/rover"),
        FrameRow("laser", 2, "static", "0.000, 0.000, 0.000", "0.0", "/rover"),
    ]
    assert list(seen.faults()) == []


def test_two_who_say_one_frame_are_named_until_one_ends(now: FramesNow) -> None:
    """In words; a fault that was mended is no fault any more."""
    drive(now, 1.0)
    at_s = drive(now, 1.0, parent="map")
    (told,) = (words for words in look(now, at_s).faults() if "several" in words)
    assert told.startswith("'base_link' has several parents: 'odom', 'map'.")
    later_s = at_s + LATELY_S + 0.1
    for number in range(3):
        heard(now, step("odom", "base_link", later_s + number / 20), at_s=later_s + number / 20)
    assert list(look(now, later_s + 0.2).faults()) == []


def test_a_step_that_has_ceased_is_named(now: FramesNow) -> None:
    """It stays in the tree for a while, and what hangs below it, too."""
    at_s = drive(now, 1.0)
    assert list(look(now, at_s + CEASED_S - 0.1).faults()) == []
    late = look(now, at_s + CEASED_S + 1, {TF: [], TF_STATIC: []})
    assert list(late.faults()) == [
        "'base_link' has ceased: nothing of it comes on /tf. Does its node still run?"
    ]
    assert list(late.rows())[1].age == "ceased 4 s ago"
    assert list(late.rows())[1].said_by == "nobody any more"
    assert list(look(now, at_s + FORGOTTEN_S + 1).rows()) == []


def test_it_is_no_fault_any_more_when_it_is_said_again(now: FramesNow) -> None:
    """As after its node was started anew."""
    at_s = drive(now, 1.0) + CEASED_S + 1
    heard(now, step("odom", "base_link", at_s), at_s=at_s)
    assert list(look(now, at_s + 0.1).faults()) == []


def test_what_stands_and_is_kept_by_nobody_is_named(now: FramesNow) -> None:
    """Who comes later would not know it."""
    heard(now, step("base_link", "laser", START_S), at_s=START_S, fixed=True)
    assert list(look(now, START_S + 100).faults()) == []
    (told,) = look(now, START_S + 100, {TF: [], TF_STATIC: []}).faults()
    assert told.startswith("Nobody publishes /tf_static any more")


@pytest.mark.parametrize(("off_s", "side"), [(-60.0, "behind"), (60.0, "ahead of")])
def test_stamps_of_another_clock_are_named(now: FramesNow, off_s: float, side: str) -> None:
    """A look-up for now would find nothing."""
    heard(now, step("odom", "base_link", START_S + off_s), at_s=START_S)
    (told,) = look(now, START_S).faults()
    assert told.startswith(f"The stamps of 'base_link' are {side} this computer's clock.")


def test_a_loop_ends_no_look(now: FramesNow) -> None:
    """Each frame of it is shown once."""
    heard(now, step("a", "b", START_S), step("b", "a", START_S), at_s=START_S)
    seen = look(now, START_S)
    assert sorted(row.name for row in seen.rows()) == ["a", "b"]
    assert any("go round in a loop" in words for words in seen.faults())


def test_no_message_makes_the_table_large(now: FramesNow) -> None:
    """Whoever says a thousand frames fills no page."""
    steps = [step(f"f{number}", f"f{number + 1}", START_S) for number in range(1_000)]
    heard(now, *steps, at_s=START_S)
    assert len(list(look(now, START_S).rows())) == MOST_FRAMES + 1


def test_the_words_that_are_read_aloud_stay(now: FramesNow) -> None:
    """A line that counts seconds would be said again and again."""
    at_s = drive(now, 1.0) + CEASED_S
    heard(now, step("odom", "other", START_S - 90), at_s=at_s + 1)
    assert [*look(now, at_s + 1).faults()] == [*look(now, at_s + 2).faults()]

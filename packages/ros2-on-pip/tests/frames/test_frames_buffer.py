"""`tf2_ros.Buffer` without a node: asked and told in ROS's messages."""

from __future__ import annotations

import asyncio
import math
import threading
from collections.abc import Iterator
from typing import Any

import pytest
import rclpy
import yaml
from frame_messages import NEWEST, as_message, at, for_s, step
from frame_stand_ins import STAND_INS, tf2_py, tf2_ros

from ros2_on_pip.domain_lease import leased_domain

WAIT_S = 60.0
"""Only a test that fails waits so long."""


@pytest.fixture
def buffer() -> Any:
    """odom to base_link, which drives one metre a second from 1 to 3 s; the laser is on it."""
    made = tf2_ros.Buffer()
    for time_s in (1.0, 2.0, 3.0):
        made.set_transform(step("odom", "base_link", time_s, x_m=time_s), "test")
    made.set_transform_static(step("base_link", "laser", x_m=0.1, yaw_rad=math.pi / 2), "test")
    return made


def test_these_are_ours() -> None:
    """No real one is in this environment: else the tests of this folder would be of that."""
    assert tf2_ros.__file__.startswith(str(STAND_INS)) or "site-packages" in tf2_ros.__file__
    assert tf2_ros.Buffer.__mro__[1].__module__ == "ros2_on_pip.stand_ins._frames.buffer_core"


def test_a_look_up_is_a_message(buffer: Any) -> None:
    """Its header is the target, its child the source: it takes numbers of the laser to odom's."""
    found = buffer.lookup_transform("odom", "laser", at(1.5))
    assert (found.header.frame_id, found.child_frame_id) == ("odom", "laser")
    assert found.header.stamp == as_message(1.5)
    assert found.transform.translation.x == pytest.approx(1.6)
    assert found.transform.rotation.z == pytest.approx(math.sin(math.pi / 4))


@pytest.mark.parametrize("time", [at(1.5), as_message(1.5)])
def test_each_kind_of_time(buffer: Any, time: Any) -> None:
    """rclpy's, and that of a header."""
    assert buffer.lookup_transform("odom", "base_link", time).transform.translation.x == 1.5


@pytest.mark.parametrize("time", [1.5, "now", None])
def test_what_is_no_time(buffer: Any, time: Any) -> None:
    """In geometry2's words."""
    with pytest.raises(TypeError, match=r"^time must have sec and nanosec, or nanoseconds\.$"):
        buffer.lookup_transform("odom", "base_link", time)
    with pytest.raises(TypeError, match="duration must have sec and nanosec"):
        buffer.lookup_transform("odom", "base_link", at(1.5), time)


def test_the_newest(buffer: Any) -> None:
    """Time() asks for it, and the stamp says of when it is."""
    found = buffer.lookup_transform("odom", "laser", NEWEST)
    assert found.header.stamp == as_message(3.0)
    assert buffer.get_latest_common_time("odom", "laser") == at(3.0)
    assert buffer.get_latest_common_time("base_link", "base_link") == at(3.0)


def test_from_one_time_to_another(buffer: Any) -> None:
    """Where the robot of then lies for the robot of now; odom has not moved between."""
    asked = "base_link", at(3.0), "base_link", at(1.0), "odom"
    found = buffer.lookup_transform_full(*asked)
    assert found.transform.translation.x == pytest.approx(-2.0)
    assert found.header.stamp == as_message(3.0)
    assert buffer.can_transform_full(*asked)


def test_can_it_be_looked_up(buffer: Any) -> None:
    """And if not, why."""
    assert buffer.can_transform("odom", "laser", at(2.0))
    assert buffer.can_transform("nobody", "nobody", NEWEST)
    asked = {"return_debug_tuple": True}
    assert buffer.can_transform("odom", "laser", at(2.0), **asked) == (True, "")
    can, why = buffer.can_transform("odom", "laser", at(9.0), **asked)
    assert not can
    assert why.startswith("Lookup would require extrapolation into the future.")
    assert buffer.can_transform("map", "laser", NEWEST, **asked) == (
        False,
        'Invalid frame ID "map" passed to canTransform argument target_frame'
        " - frame does not exist",
    )
    assert buffer.can_transform("odom", "", NEWEST, **asked)[1] == (
        'Invalid frame ID "" passed to canTransform argument source_frame'
        " - in tf2 frame_ids cannot be empty"
    )
    full = buffer.can_transform_full("odom", NEWEST, "laser", NEWEST, "/map", **asked)
    assert full[1] == (
        'Invalid frame ID "/map" passed to canTransform argument fixed_frame'
        " - in tf2 frame_ids cannot start with a '/'"
    )
    assert not buffer.can_transform_full("odom", at(9.0), "laser", at(2.0), "base_link")
    assert not buffer.can_transform_full("base_link", at(2.0), "laser", at(9.0), "odom")


def test_the_arguments_have_their_names(buffer: Any) -> None:
    """All can be written out, as in Jazzy."""
    buffer.lookup_transform(
        target_frame="odom", source_frame="laser", time=NEWEST, timeout=for_s(0.0)
    )
    buffer.lookup_transform_full(
        target_frame="odom",
        target_time=NEWEST,
        source_frame="laser",
        source_time=NEWEST,
        fixed_frame="odom",
        timeout=for_s(0.0),
    )
    buffer.lookup_transform_core(target_frame="odom", source_frame="laser", time=NEWEST)


def test_names_with_a_slash_lose_it_where_they_are_told(buffer: Any) -> None:
    """Drivers of ROS 1's time still say it."""
    buffer.set_transform_static(step("/base_link", "/camera"), "test")
    assert buffer.can_transform("odom", "camera", at(2.0))
    with pytest.raises(tf2_ros.InvalidArgumentException, match="cannot start with a '/'"):
        buffer.lookup_transform("odom", "/camera", at(2.0))


def _bad(**changes: Any) -> Any:
    made = step("odom", "wheel", 1.0)
    for name, value in changes.items():
        setattr(made.transform.rotation, name, value)
    return made


@pytest.mark.parametrize(
    ("told", "word"),
    [
        (step("odom", "odom"), "TF_SELF_TRANSFORM"),
        (step("odom", ""), "TF_NO_CHILD_FRAME_ID"),
        (step("", "wheel"), "TF_NO_FRAME_ID"),
        (step("odom", "wheel", x_m=math.nan), "TF_NAN_INPUT"),
        (_bad(w=90.0), "TF_DENORMALIZED_QUATERNION"),  # degrees in a quaternion
        (_bad(w=0.0), "TF_DENORMALIZED_QUATERNION"),
    ],
)
def test_what_makes_no_sense_is_logged_and_left_aside(
    told: Any, word: str, capfd: pytest.CaptureFixture[str]
) -> None:
    """In geometry2's words, with who said it."""
    buffer = tf2_ros.Buffer()
    buffer.set_transform(told, "the wheel")
    assert buffer._getFrameStrings() == []
    logged = "".join(capfd.readouterr())  # rcutils chose the stream when it logged first
    assert f"{word}: Ignoring transform" in logged
    assert "the wheel" in logged


def test_what_comes_too_late_is_logged(buffer: Any, capfd: pytest.CaptureFixture[str]) -> None:
    """It is older than all that is kept."""
    buffer.set_transform(step("odom", "base_link", 100.0), "test")
    buffer.set_transform(step("odom", "base_link", 50.0), "test")
    told = "TF_OLD_DATA ignoring data from the past for frame base_link at time 50.000000"
    assert told in "".join(capfd.readouterr())


@pytest.mark.parametrize(("kept_s", "known"), [(None, False), (60.0, True)])
def test_for_how_long_it_keeps(kept_s: float | None, known: bool) -> None:
    """Ten seconds, or as long as is asked for."""
    buffer = tf2_ros.Buffer(None if kept_s is None else for_s(kept_s))
    for time_s in (1.0, 2.0, 20.0):
        buffer.set_transform(step("odom", "base_link", time_s), "test")
    assert buffer.can_transform("odom", "base_link", at(1.5)) is known


def test_all_frames_as_text(buffer: Any) -> None:
    """For people, and as YAML."""
    assert buffer.all_frames_as_string() == (
        "Frame base_link exists with parent odom.\nFrame laser exists with parent base_link.\n"
    )
    told = yaml.safe_load(buffer.all_frames_as_yaml())
    assert told["base_link"] == {
        "parent": "odom",
        "broadcaster": "test",
        "rate": 1.5,
        "most_recent_transform": 3.0,
        "oldest_transform": 1.0,
        "buffer_length": 2.0,
    }
    assert told["laser"]["rate"] == 10000.0
    assert yaml.safe_load(tf2_py.BufferCore().all_frames_as_yaml()) == []
    assert buffer._frameExists("odom")
    assert buffer._chain("odom", NEWEST, "laser", NEWEST, "odom") == ["laser", "base_link", "odom"]


# --- waiting -----------------------------------------------------------------------------------


def test_a_wait_ends_when_the_step_has_come() -> None:
    """Long before its time is over."""
    buffer = tf2_ros.Buffer()
    found: list[Any] = []

    def wait() -> None:
        found.append(buffer.lookup_transform("odom", "base_link", at(1.0), for_s(10 * WAIT_S)))

    waiting = threading.Thread(target=wait, daemon=True)
    waiting.start()
    buffer.set_transform(step("odom", "base_link", 1.0), "test")
    waiting.join(WAIT_S)
    assert found[0].transform.translation.x == 1.0


def test_a_wait_that_is_over_says_what_is_missing() -> None:
    """As without one: no TimeoutException, as in Jazzy."""
    buffer = tf2_ros.Buffer()
    with pytest.raises(tf2_ros.LookupException, match="does not exist"):
        buffer.lookup_transform("odom", "base_link", NEWEST, for_s(0.01))
    assert not buffer.can_transform("odom", "base_link", NEWEST, for_s(0.01))


def test_a_future_is_done_when_the_step_has_come(buffer: Any) -> None:
    """And at once where it is known."""
    assert buffer.wait_for_transform_async("odom", "laser", at(2.0)).done()
    future = buffer.wait_for_transform_async("odom", "laser", at(3.5))
    full = buffer.wait_for_transform_full_async("odom", at(3.5), "laser", at(3.5), "odom")
    buffer.set_transform_static(step("base_link", "camera"), "test")
    assert not future.done() and not full.done()
    buffer.set_transform(step("odom", "base_link", 4.0, x_m=4.0), "test")
    assert future.result().transform.translation.x == pytest.approx(3.6)
    assert full.result().transform.translation.x == pytest.approx(3.6)
    assert buffer._waiting == []


def test_who_is_told_may_ask_again_at_once(buffer: Any) -> None:
    """Within the call that tells."""
    later: list[Any] = []
    first = buffer.wait_for_transform_async("odom", "base_link", at(4.0))
    first.add_done_callback(
        lambda _: later.append(buffer.wait_for_transform_async("odom", "base_link", at(5.0)))
    )
    buffer.set_transform(step("odom", "base_link", 4.0), "test")
    buffer.set_transform(step("odom", "base_link", 5.0), "test")
    assert later[0].done()


def test_nobody_waits_for_a_future_that_was_cancelled(buffer: Any) -> None:
    """It is forgotten with the next step."""
    buffer.wait_for_transform_async("odom", "base_link", at(9.0)).cancel()
    buffer.set_transform(step("odom", "base_link", 4.0), "test")
    assert buffer._waiting == []


def test_awaiting(buffer: Any) -> None:
    """As a coroutine of a callback does."""

    async def ask() -> float:
        found = await buffer.lookup_transform_async("odom", "base_link", at(2.5))
        full = await buffer.lookup_transform_full_async("odom", at(2.5), "laser", at(2.5), "odom")
        return float(found.transform.translation.x + full.transform.translation.x)

    assert asyncio.run(ask()) == pytest.approx(2.5 + 2.6)


# --- a clock that jumps ------------------------------------------------------------------------


@pytest.fixture
def node() -> Iterator[Any]:
    """One that follows a clock which the test sets."""
    with leased_domain() as domain:
        context = rclpy.Context()
        rclpy.init(context=context, domain_id=domain)
        yield rclpy.create_node("follower", context=context)
        context.try_shutdown()


@pytest.mark.parametrize(("to_s", "known"), [(6.0, True), (4.5, True), (1.0, False)])
def test_where_time_jumps_back_all_that_moves_is_forgotten(
    node: Any, to_s: float, known: bool
) -> None:
    """A bag that begins anew. Less than a second back is no jump."""
    clock = node.get_clock()
    clock._set_ros_time_is_active(True)
    clock.set_ros_time_override(at(5.0))
    buffer = tf2_ros.Buffer(node=node)
    buffer.set_transform(step("odom", "base_link", 5.0), "test")
    buffer.set_transform_static(step("base_link", "laser"), "test")
    clock.set_ros_time_override(at(to_s))
    assert buffer.can_transform("odom", "base_link", NEWEST) is known
    assert buffer.can_transform("base_link", "laser", NEWEST)

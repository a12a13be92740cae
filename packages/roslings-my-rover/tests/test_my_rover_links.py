"""The rover's links: a stranger there moves no wheel, and who looks sees them all the same."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest
from carried import until

from ros2_on_pip.domain_lease import leased_domain
from roslings_my_rover.parts import CABLE, GUARD, LIMITER
from roslings_my_rover.robot import MyRover
from roslings_my_rover.wiring import wired
from roslings_rover.rover.rover import Rover

pytestmark = pytest.mark.slow
MARK = "_1a2b3c"
PARTS = (LIMITER, GUARD)


@pytest.fixture
def rover(monkeypatch: pytest.MonkeyPatch) -> Iterator[MyRover]:
    """Of a limiter and a guard, whose programs are not there."""
    with leased_domain() as domain:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
        with MyRover(Rover(), wiring=wired(PARTS, mark=MARK).robot) as node:
            yield node


@contextmanager
def another(name: str) -> Iterator[Any]:
    """A node in a context of its own."""
    import rclpy
    from rclpy.signals import SignalHandlerOptions

    context = rclpy.Context()
    rclpy.init(
        args=["--ros-args", "--disable-external-lib-logs"],
        context=context,
        signal_handler_options=SignalHandlerOptions.NO,
    )
    node = rclpy.create_node(name, context=context)
    try:
        yield node
    finally:
        node.destroy_node()
        context.try_shutdown()


def command(forward_m_s: float) -> Any:
    """A Twist."""
    from geometry_msgs.msg import Twist

    twist = Twist()
    twist.linear.x = forward_m_s
    return twist


def turning(rover: MyRover, condition: Any, meanwhile: Any = lambda: None) -> Any:
    """Let the rover go on until something holds."""

    def found() -> Any:
        meanwhile()
        rover.turn()
        return condition()

    return until(found, lambda: f"{rover.notice!r}, at {rover.rover.pose}")


def test_a_command_on_the_rovers_own_link_turns_the_wheels(rover: MyRover) -> None:
    """And it is seen under the name that people know, by who listens there."""
    from geometry_msgs.msg import Twist
    from rclpy.executors import SingleThreadedExecutor

    with another("guard") as guard, another("looker") as looker:
        speaker = guard.create_publisher(Twist, f"/rover/motors{MARK}", 10)
        seen: list[Any] = []
        looker.create_subscription(Twist, "/rover/motors", seen.append, 10)
        executor = SingleThreadedExecutor(context=looker.context)
        executor.add_node(looker)

        def speak() -> None:
            speaker.publish(command(0.3))
            executor.spin_once(timeout_sec=0)

        turning(rover, lambda: rover.rover.pose.x_m > 0.1 and len(seen) > 3, speak)
        assert {each.linear.x for each in seen} == {0.3}
        executor.shutdown()


def test_a_command_under_the_known_name_turns_none(rover: MyRover) -> None:
    """However often it is said; who says it is named, until it is gone."""
    from geometry_msgs.msg import Twist

    with another("drive_server") as stranger:
        speakers = [
            stranger.create_publisher(Twist, link, 10)
            for link in ("/rover/limited", "/cmd_vel_raw", "/rover/motors")
        ]
        said = 0

        def speak() -> None:
            nonlocal said
            for each in speakers:
                each.publish(command(0.5))
            said += 1

        turning(rover, lambda: rover.notice and said > 50, speak)
        assert rover.notice == (
            "Held off: /drive_server on /rover/limited. Let it speak on /cmd_vel."
        )
        assert len(rover.notice) <= 80
        assert rover.commands == 0 and rover.rover.way_m == 0
    turning(rover, lambda: not rover.notice)


def test_two_who_say_where_the_rover_is_are_told(rover: MyRover) -> None:
    """One of them is wrong, and the pilot drives by it."""
    from nav_msgs.msg import Odometry

    with another("drive_server") as stranger:
        stranger.create_publisher(Odometry, "/odom", 10)
        turning(rover, lambda: rover.notice)
        assert rover.notice == (
            "/drive_server and /rover both say /odom. End what does not belong there."
        )


def test_who_looks_is_no_load_when_nobody_does(rover: MyRover) -> None:
    """A mirror listens only while somebody listens to it."""
    from geometry_msgs.msg import Twist

    link = f"/rover/motors{MARK}"
    with another("looker") as looker:
        own = looker.create_subscription(Twist, "/rover/motors", lambda _: None, 10)
        before = rover._node.count_subscribers(link)
        turning(rover, lambda: rover._node.count_subscribers(link) == before + 1)
        looker.destroy_subscription(own)
        turning(rover, lambda: rover._node.count_subscribers(link) == before)


def test_another_wiring_has_other_links(rover: MyRover) -> None:
    """What the old one mirrored and waited for is gone."""
    rover.connect(wired([CABLE], mark=MARK).robot)
    turning(rover, lambda: "/rover/motors" not in topics(rover))
    assert not rover.rover.way_m and rover.silent(plugged=False) == ()


def topics(rover: MyRover) -> set[str]:
    """All that are there."""
    return {name for name, _ in rover._node.get_topic_names_and_types()}

"""The robot of experiments: it does what it was told last, for a while, and is given up on."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from typing import cast

import pytest

from graders.actions import act as acting
from graders.actions.floor import COMMAND_LASTS_S, FLOOR, Robot, start_near
from ros2_on_pip.domain_lease import leased_domain
from roslings.capabilities.robot.record import RobotSeen
from roslings.course import lab
from roslings.evidence import Endpoint, ExperimentSeen, Qos
from roslings.experiment.scene import Scene
from roslings.probe import Probe
from roslings_rover.rover import Pose, Rover
from skips import imported

imported("rclpy")
TWIST = "geometry_msgs/msg/Twist"
WITHIN_S = 20.0


@pytest.fixture
def probe(monkeypatch: pytest.MonkeyPatch) -> Iterator[Probe]:
    """A probe on a domain where nothing runs."""
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    seen = ExperimentSeen(name="driving", clock="wall")
    with leased_domain() as domain, Probe(domain, seen, record=False) as running:
        yield running


def test_it_does_what_it_was_told_last(probe: Probe) -> None:
    """Until the next command; what is no number it leaves aside."""
    from geometry_msgs.msg import Twist

    publisher = probe.node.create_publisher(Twist, "/speed", 10)
    with Robot(probe, Rover(FLOOR, Pose(1.0, 2.0))) as robot:
        robot.listen_to("/speed", TWIST)
        assert probe.until(lambda: publisher.get_subscription_count() > 0, WITHIN_S)
        faster = Twist()
        faster.linear.x = 0.5
        publisher.publish(faster)
        assert probe.until(lambda: robot.distance_to(1.0, 2.0) > 0.2, WITHIN_S)
        wrong = Twist()
        wrong.linear.x = math.nan

        def drives_on() -> bool:
            publisher.publish(faster)
            publisher.publish(wrong)
            return robot.distance_to(1.0, 2.0) > 0.4

        assert probe.until(drives_on, WITHIN_S)
        publisher.publish(Twist())
        assert probe.until(lambda: robot.stands, WITHIN_S)
    drive = probe.seen.part(RobotSeen).drive
    assert drive is not None
    assert {c.forward_m_s for c in drive.commands[:-1]} == {0.5}
    assert drive.commands[-1].forward_m_s == 0.0
    assert drive.path[0].x_m == pytest.approx(1.0, abs=0.2)
    assert drive.path[-1].x_m == pytest.approx(robot.pose.x_m, abs=0.02)


@pytest.mark.parametrize("ended_by", ["silence", "nan"])
def test_it_stops_by_itself_when_commands_cease(probe: Probe, ended_by: str) -> None:
    """A node that Ctrl-C ended says nothing any more; a speed that is no number is no command."""
    from geometry_msgs.msg import Twist

    publisher = probe.node.create_publisher(Twist, "/speed", 10)
    wrong = Twist()
    wrong.linear.x = math.nan
    with Robot(probe, Rover(FLOOR)) as robot:
        robot.listen_to("/speed", TWIST)
        assert probe.until(lambda: publisher.get_subscription_count() > 0, WITHIN_S)
        command = Twist()
        command.linear.x = 0.5
        publisher.publish(command)
        assert probe.until(lambda: not robot.stands, WITHIN_S)

        def stands() -> bool:
            if ended_by == "nan":
                publisher.publish(wrong)
            return robot.stands

        assert probe.until(stands, WITHIN_S)
    drive = probe.seen.part(RobotSeen).drive
    assert drive is not None and [c.forward_m_s for c in drive.commands] == [0.5]


def test_the_card_says_how_long_a_command_lasts() -> None:
    """Who writes the loop reads it there, and in the task."""
    (commands,) = lab("actions").card.node("drive_server").publishes
    assert f"no command for {COMMAND_LASTS_S:g} s stops it" in commands.about


@pytest.mark.parametrize("reliability", ["reliable", "best_effort"])
def test_a_node_knows_where_it_is_when_its_reader_got_a_message(
    probe: Probe, reliability: str
) -> None:
    """One that confirms nothing is believed when it was told a few times."""
    from nav_msgs.msg import Odometry
    from rclpy.qos import QoSProfile, ReliabilityPolicy

    heard: list[Odometry] = []
    quality = QoSProfile(depth=10, reliability=ReliabilityPolicy[reliability.upper()])
    probe.node.create_subscription(Odometry, "/odom", heard.append, quality)
    subscription = Endpoint(
        kind="subscription",
        node="/it",
        topic="/odom",
        type="nav_msgs/msg/Odometry",
        qos=Qos(reliability=reliability),
        gid="",
    )
    with Robot(probe, Rover(FLOOR)) as robot:
        assert not robot.is_known
        robot.speak_to(subscription)
        assert probe.until(lambda: robot.is_known, WITHIN_S)
        assert probe.until(lambda: bool(heard), WITHIN_S)


@pytest.mark.parametrize("wrong", ["std_msgs/msg/String", "nowhere/msg/Nothing"])
def test_a_topic_of_another_type_moves_nothing(probe: Probe, wrong: str) -> None:
    """Nor does it end the experiment."""
    with Robot(probe, Rover(FLOOR)) as robot:
        robot.listen_to("/speed", wrong)
        assert robot.stands


def test_a_robot_that_stands_is_not_waited_for(
    probe: Probe, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nor is one that does not come nearer."""
    monkeypatch.setattr(acting, "RESTS_S", 0.1)
    with Robot(probe, Rover(FLOOR)) as robot:
        assert probe.until(acting.Rest(robot, {"x": 1.0, "y": 0.0}).is_over, WITHIN_S)
        monkeypatch.setattr(acting, "RESTS_S", 1000.0)
        monkeypatch.setattr(acting, "STRAYS_S", 0.1)
        assert probe.until(acting.Rest(robot, {"x": 1.0, "y": 0.0}).is_over, WITHIN_S)
        monkeypatch.setattr(acting, "STRAYS_S", 1000.0)
        assert not acting.Rest(robot, {"x": 1.0, "y": 0.0}).is_over()


class Dice:
    """What a scene has of chance."""

    def between(self, low: float, high: float) -> float:
        """Any number."""
        return random.uniform(low, high)


def test_a_start_is_beside_its_goal_and_above_it() -> None:
    """So that who looks along x only, or along y only, is far from the truth."""
    found = [start_near(cast(Scene, Dice()), 3.0, 5.0, 1.0, 1.3) for _ in range(1000)]
    ways = [(pose.x_m - 3.0, pose.y_m - 5.0) for pose in found]
    assert all(1.0 <= math.hypot(*way) <= 1.3 for way in ways)
    assert all(max(map(abs, way)) < 0.82 * math.hypot(*way) for way in ways)
    assert len({(x > 0, y > 0) for x, y in ways}) == 4

"""The frames of a rover of parts: odom to base_link is what /odom says, whoever says that."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import pytest
import rclpy
from carried import until
from rclpy.executors import SingleThreadedExecutor
from rclpy.time import Time

from ros2_on_pip.domain_lease import leased_domain
from roslings_my_rover.parts import CABLE
from roslings_my_rover.robot import MyRover
from roslings_my_rover.wiring import RoverWiring, wired
from roslings_rover.rover.rover import Rover
from skips import skip_without

skip_without("module tf2_msgs")
pytestmark = pytest.mark.slow


class LookerAt:
    """A node beside a rover of parts."""

    def __init__(self, rover: MyRover, context: Any) -> None:
        import tf2_ros

        self.rover, self.node = rover, rclpy.create_node("looker", context=context)
        self._executor = SingleThreadedExecutor(context=context)
        self._executor.add_node(self.node)
        self.buffer = tf2_ros.Buffer(node=self.node)
        self._listener = tf2_ros.TransformListener(self.buffer, self.node)

    def until(self, holds: Callable[[], Any]) -> None:
        """Both do what is due meanwhile."""

        def looked() -> bool:
            self.rover.turn(0.005)
            self._executor.spin_once(timeout_sec=0.0)
            return bool(holds())

        until(looked, lambda: self.rover.notice)

    @property
    def body(self) -> Any:
        """The newest step from odom to base_link."""
        return self.buffer.lookup_transform("odom", "base_link", Time())


@contextmanager
def looker_at(wiring: RoverWiring) -> Iterator[LookerAt]:
    """Both in a domain of their own."""
    with leased_domain() as domain, pytest.MonkeyPatch.context() as patched:
        patched.setenv("ROS_DOMAIN_ID", str(domain))
        context = rclpy.Context()
        rclpy.init(context=context, domain_id=domain)
        with MyRover(Rover(), wiring=wiring) as rover:
            yield LookerAt(rover, context)
        context.try_shutdown()


def test_the_robot_says_its_frames() -> None:
    """Where no part says /odom, and where its laser sits."""
    with looker_at(RoverWiring()) as looker:
        looker.until(lambda: looker.buffer.can_transform("odom", "laser", Time()))
        assert looker.body.transform.translation.x == 0.0


def test_a_bridge_that_errs_is_believed_on_tf() -> None:
    """With the stamps of its own /odom; what is no number is left out."""
    from nav_msgs.msg import Odometry
    from tf2_msgs.msg import TFMessage

    def told(x_m: float, seconds: int) -> Any:
        odom = Odometry(child_frame_id="base_link")
        odom.header.frame_id, odom.header.stamp.sec = "odom", seconds
        odom.pose.pose.position.x = x_m
        odom.pose.pose.orientation.w = 1.0
        return odom

    with looker_at(wired([CABLE]).robot) as looker:
        said: list[Any] = []
        looker.node.create_subscription(TFMessage, "/tf", said.append, 10)
        bridge = looker.node.create_publisher(Odometry, "odom", 10)
        looker.until(
            lambda: (
                bridge.publish(told(1.25, 100))
                or looker.buffer.can_transform("odom", "base_link", Time())
            )
        )
        assert looker.body.transform.translation.x == 1.25
        assert looker.body.header.stamp.sec == 100
        bridge.publish(told(math.nan, 101))
        bridge.publish(told(1.5, 102))

        def stamps_s() -> set[int]:
            return {step.header.stamp.sec for each in said for step in each.transforms}

        looker.until(lambda: looker.body.header.stamp.sec == 102 and 102 in stamps_s())
        assert stamps_s() == {100, 102}
        assert looker.rover.rover.pose.x_m == 0.0


def test_where_a_part_says_them_the_robot_is_silent() -> None:
    """And says them again when the part is gone: a frame has one parent, and a step one voice."""
    with looker_at(replace(RoverWiring(), says_frames=False)) as looker:
        looker.until(lambda: looker.node.count_publishers("/odom"))
        assert not looker.node.count_publishers("/tf")
        looker.until(lambda: looker.buffer.can_transform("base_link", "camera_optical", Time()))
        assert not looker.buffer.can_transform("base_link", "laser", Time())
        looker.rover.connect(RoverWiring())
        looker.until(lambda: looker.buffer.can_transform("odom", "laser", Time()))
        assert looker.node.count_publishers("/tf_static") == 1
        looker.rover.connect(RoverWiring(says_frames=False))
        looker.until(lambda: not looker.node.count_publishers("/tf"))
        assert not looker.rover.publishes_tf

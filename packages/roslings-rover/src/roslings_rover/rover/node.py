"""The rover as a ROS node: it listens on /cmd_vel and publishes /odom, /scan, /tf and /tf_static.

What its camera sees is on /camera/image_raw, as long as somebody listens.
"""

from __future__ import annotations

import array
import math
import time
from contextlib import ExitStack
from dataclasses import dataclass, field
from types import TracebackType
from typing import TYPE_CHECKING, Any

from roslings_rover.models.differential_drive import Motion
from roslings_rover.rover.frames import (
    CAMERA_FRAME,
    FrameOptions,
    FramePublishers,
    frame_publishers,
)
from roslings_rover.rover.messages import (
    LONGEST_PAUSE_S,
    ODOM_EVERY_S,
    QUIET,
    STEP_S,
    laser_scan,
    odometry,
)
from roslings_rover.rover.odometer import Odometer
from roslings_rover.rover.rover import Rover
from roslings_rover.rover.subscriptions import HeardSentence, RoverSubscriptions, subscribing

if TYPE_CHECKING:
    from roslings_rover.camera import Frame

NAME = "rover"
PICTURE_EVERY_S = 0.1
LOOK_EVERY_S = 2.0
COMMAND_LASTS_S = 1.5
"""`ros2 topic pub` repeats a command once a second: the rover then drives without a break."""


@dataclass
class RoverNode:
    """Moves a rover in real time and lets ROS speak with it.

    A context manager: leaving the block ends the node and its context. `turn` must be called
    again and again; nothing moves without it.
    """

    rover: Rover
    notice: str = ""
    """What the person at the screen should know; empty where all is well."""
    commands: int = 0
    frames: FrameOptions = FrameOptions()  # noqa: RUF009 - it cannot change
    by_keys: bool = False
    """The keys of this terminal drive it."""
    listens: bool = False
    """It hears what others say, too."""
    _frames: FramePublishers | None = field(default=None, init=False, repr=False)
    _told_s: float = field(default=-math.inf, repr=False)
    _subscriptions: RoverSubscriptions | None = field(default=None, repr=False)
    _parts: ExitStack = field(default_factory=ExitStack, repr=False)

    def __post_init__(self) -> None:
        self.odometer = Odometer(self.rover.pose, self.frames.drift_percent)
        """What /odom says."""

    def __enter__(self) -> RoverNode:
        import rclpy
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.signals import SignalHandlerOptions

        self._context = rclpy.Context()
        rclpy.init(
            args=QUIET, context=self._context, signal_handler_options=SignalHandlerOptions.NO
        )
        self._node = rclpy.create_node(NAME, context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._open_topics()
        self._open_timers()
        if self.listens:
            subscriptions = subscribing(self._context, self._executor, self.rover)
            self._subscriptions = self._parts.enter_context(subscriptions)
        self._stepped_s = time.monotonic()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._parts.close()
        self._executor.shutdown()
        self._node.destroy_node()
        self._context.try_shutdown()

    @property
    def publishes_tf(self) -> bool:
        """Somebody wants it, and its type is there."""
        return self._frames is not None

    @property
    def lacks_tf(self) -> bool:
        """It would say it, and the type is missing."""
        return self.frames.published and not self.publishes_tf

    @property
    def sentence(self) -> HeardSentence | None:
        """What it hears somebody say; None where nobody says something, or it does not listen."""
        return self._subscriptions.sentence if self._subscriptions else None

    def turn(self, within_s: float = 0.02) -> None:
        """Do the next thing that is due, or wait for it as long as this."""
        self._executor.spin_once(timeout_sec=within_s)

    def _open_topics(self) -> None:
        from geometry_msgs.msg import Twist
        from nav_msgs.msg import Odometry
        from rclpy.qos import qos_profile_sensor_data
        from sensor_msgs.msg import Image, LaserScan

        from roslings_rover.camera import SyntheticCamera

        node = self._node
        self._subscription = node.create_subscription(Twist, "cmd_vel", self._hear, 10)
        self._odom = node.create_publisher(Odometry, "odom", 10)
        self._scan = node.create_publisher(LaserScan, "scan", qos_profile_sensor_data)
        self._pictures = node.create_publisher(Image, "camera/image_raw", qos_profile_sensor_data)
        self._camera = SyntheticCamera(self.rover.camera_model)
        self._open_frames()

    def _open_frames(self) -> None:
        if self.frames.published and self._frames is None:
            self._frames = frame_publishers(self._node, self.frames.map_frame)

    def _close_frames(self) -> None:
        if self._frames is not None:
            self._frames.close(self._node)
            self._frames = None

    def _open_timers(self) -> None:
        node = self._node
        self._timers = [
            node.create_timer(STEP_S, self._step),
            node.create_timer(ODOM_EVERY_S, self._tell_where),
            node.create_timer(1 / self.rover.scanner.turns_hz, self._tell_distances),
            node.create_timer(PICTURE_EVERY_S, self._show_picture),
            node.create_timer(LOOK_EVERY_S, self._look_for_twins),
        ]

    def _hear(self, twist: Any) -> None:
        motion = Motion(twist.linear.x, twist.angular.z)
        try:
            self.rover.drive(motion)
        except ValueError:
            self.notice = "A command was no finite number. The rover did not follow it."
            return
        self.commands += 1
        self._told_s = time.monotonic()
        self.notice = _what_it_cannot_do(twist)

    def _step(self) -> None:
        now_s = time.monotonic()
        if now_s - self._told_s > COMMAND_LASTS_S:
            self.rover.drive(Motion())
        self.rover.step(min(now_s - self._stepped_s, LONGEST_PAUSE_S))
        self._stepped_s = now_s
        self.odometer.follow(self.rover)

    def _now(self) -> Any:
        """The stamp of this moment; the rover is then where it is at this moment."""
        self._step()
        return self._node.get_clock().now().to_msg()

    def _tell_where(self) -> None:
        stamp = self._now()
        self._odom.publish(odometry(self.odometer, stamp))
        self._tell_frames(stamp)

    def _tell_frames(self, stamp: Any) -> None:
        if self._frames is not None:
            self._frames.say(self.rover.pose, self.odometer.pose, stamp)

    def _tell_distances(self) -> None:
        self._scan.publish(laser_scan(self.rover, self._now()))

    def _show_picture(self) -> None:
        if self._pictures.get_subscription_count():
            stamp = self._now()
            self._pictures.publish(_image(self._camera.look(self.rover), stamp))

    def _look_for_twins(self) -> None:
        if self._node.get_node_names().count(NAME) > 1:
            self.notice = "A second rover runs here: both follow /cmd_vel. End one with Ctrl-C."


def _what_it_cannot_do(twist: Any) -> str:
    """A word on the parts of a command that a robot on two wheels leaves aside."""
    aside = {
        "linear.y": twist.linear.y,
        "linear.z": twist.linear.z,
        "angular.x": twist.angular.x,
        "angular.y": twist.angular.y,
    }
    used = [name for name, value in aside.items() if value]
    if not used:
        return ""
    return f"{used[0]} does nothing: use linear.x (forward) and angular.z (turn left)."


def _image(frame: Frame, stamp: Any) -> Any:
    from sensor_msgs.msg import Image

    image = Image(
        height=frame.height,
        width=frame.width,
        encoding=frame.encoding,
        step=frame.step,
        data=array.array("B", frame.content),  # other types are copied value by value
    )
    image.header.stamp, image.header.frame_id = stamp, CAMERA_FRAME
    return image

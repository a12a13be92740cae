"""The rover as a ROS node: it listens on /cmd_vel and publishes /odom, /scan and, asked to, /tf.

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
from roslings_rover.rover.rover import Rover
from roslings_rover.rover.subscriptions import HeardSentence, RoverSubscriptions, subscribing

if TYPE_CHECKING:
    from roslings_rover.camera import Frame

NAME = "rover"
ODOM_FRAME, BODY_FRAME, CAMERA_FRAME = "odom", "base_link", "camera"
STEP_S = 0.02
ODOM_EVERY_S = 0.05
PICTURE_EVERY_S = 0.1
LOOK_EVERY_S = 2.0
COMMAND_LASTS_S = 1.5
"""`ros2 topic pub` repeats a command once a second: the rover then drives without a break."""

LONGEST_PAUSE_S = 0.25
"""A computer that slept, or a stopped process, does not let the rover leap."""

QUIET = ["--ros-args", "--disable-external-lib-logs", "--disable-stdout-logs"]
"""The map is on the screen: log lines would tear it, and files in ~/.ros nobody tidies."""


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
    tf: bool = False
    """Somebody asked for /tf."""
    publishes_tf: bool = False
    by_keys: bool = False
    """The keys of this terminal drive it."""
    listens: bool = False
    """It hears what others say, too."""
    _told_s: float = field(default=-math.inf, repr=False)
    _subscriptions: RoverSubscriptions | None = field(default=None, repr=False)
    _parts: ExitStack = field(default_factory=ExitStack, repr=False)

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
        self._tf = _tf_publisher(node) if self.tf else None
        self.publishes_tf = self._tf is not None

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

    def _tell_where(self) -> None:
        stamp = self._node.get_clock().now().to_msg()
        self._odom.publish(odometry(self.rover, stamp))
        if self._tf is not None:
            self._tf.publish(_transforms(self.rover, stamp))

    def _tell_distances(self) -> None:
        self._scan.publish(laser_scan(self.rover, self._node.get_clock().now().to_msg()))

    def _show_picture(self) -> None:
        if self._pictures.get_subscription_count():
            stamp = self._node.get_clock().now().to_msg()
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


def _tf_publisher(node: Any) -> Any | None:
    """A publisher on /tf, where tf2_msgs is: no wheel has it, and `--tf` brings it."""
    try:
        from tf2_msgs.msg import TFMessage
    except ImportError:
        return None
    return node.create_publisher(TFMessage, "/tf", 100)


def odometry(rover: Rover, stamp: Any) -> Any:
    """A nav_msgs/msg/Odometry of where the rover is and how it moves."""
    from nav_msgs.msg import Odometry

    told = Odometry(child_frame_id=BODY_FRAME)
    told.header.stamp, told.header.frame_id = stamp, ODOM_FRAME
    place = told.pose.pose
    place.position.x, place.position.y = rover.pose.x_m, rover.pose.y_m
    _turn(place.orientation, rover.pose.heading_rad)
    told.twist.twist.linear.x = rover.motion.forward_m_s
    told.twist.twist.angular.z = rover.motion.turn_rad_s
    return told


def _turn(quaternion: Any, angle_rad: float) -> None:
    """A turn about the upright axis: z = sin(a / 2), w = cos(a / 2)."""
    quaternion.z, quaternion.w = math.sin(angle_rad / 2), math.cos(angle_rad / 2)


def laser_scan(rover: Rover, stamp: Any) -> Any:
    """A sensor_msgs/msg/LaserScan of what the scanner reads: a turn of it, in metres."""
    from sensor_msgs.msg import LaserScan

    scanner = rover.scanner
    scan = LaserScan(
        angle_min=0.0,
        angle_max=scanner.step_rad * (scanner.rays - 1),
        angle_increment=scanner.step_rad,
        scan_time=1 / scanner.turns_hz,
        range_min=scanner.nearest_m,
        range_max=scanner.farthest_m,
        ranges=array.array("f", rover.scan()),  # it is sent in a fifth of a list's time
    )
    scan.header.stamp, scan.header.frame_id = stamp, BODY_FRAME
    return scan


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


def _transforms(rover: Rover, stamp: Any) -> Any:
    from geometry_msgs.msg import TransformStamped
    from tf2_msgs.msg import TFMessage

    moved = TransformStamped(child_frame_id=BODY_FRAME)
    moved.header.stamp, moved.header.frame_id = stamp, ODOM_FRAME
    moved.transform.translation.x = rover.pose.x_m
    moved.transform.translation.y = rover.pose.y_m
    _turn(moved.transform.rotation, rover.pose.heading_rad)
    return TFMessage(transforms=[moved])

"""A rover on an empty floor, driven by the student's node.

It stands in for `./roslings rover`, and like that it stops by itself when commands cease, only
sooner. A node that forgets to stop it is seen by the last command that it gave.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Literal

from roslings.capabilities.robot.record import CommandSeen, PoseSeen, RobotDriveSeen, RobotSeen
from roslings.course import TopicContract
from roslings.evidence import Endpoint
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S
from roslings.experiment.scene import Scene
from roslings.probe.content import UnknownType, message_class
from roslings.probe.probe import Probe, offering
from roslings.seen.matching import nearest_endpoint
from roslings_rover.rover import Box, Motion, Pose, Rover, World
from roslings_rover.rover.messages import LONGEST_PAUSE_S, ODOM_EVERY_S, STEP_S, odometry

FLOOR = World(room=Box(-100.0, -100.0, 100.0, 100.0))
COMMAND_LASTS_S = 0.5
"""No stop leaves a node after Ctrl-C, so the robot itself must notice. The card says so, too."""

KNOWS_AFTER = 3
"""So many messages after the two are joined, a node knows where the robot is."""

LAST_ONLY = 1
"""A subscription that was joined late asks for what it missed, and has nothing before it got that.

With one message kept, Fast DDS says with each message that the earlier ones are gone. With more it
says so every 3 s, its `heartbeat_period`. A node would not know where the robot is until then.
"""

HEARD_S = 0.01
"""So long the robot waits after each message for the reader to confirm it, until it once has."""

KEPT_DECIMALS = 6
"""Micrometres: a path has hundreds of places, and no check looks closer."""

STANDS_M_S = 0.005
STANDS_RAD_S = 0.02
STANDS_WITHIN_S = 1.5
DIAGONAL_RAD = (math.radians(35), math.radians(55))


class Robot:
    """A rover in real time that tells where it is and does what it is told, for a while.

    A context manager: leaving the block ends its thread and its end of the topics.
    """

    def __init__(self, probe: Probe, rover: Rover) -> None:
        self._probe, self._rover = probe, rover
        self._lock = threading.Lock()
        self._closing = threading.Event()
        self._command_subscription: Any = None
        self._odom_publisher: Any = None
        self._commanded_s = -math.inf
        self.told = 0
        """Messages sent while somebody was there to hear them."""
        self.heard = False
        """The reader has said that it got one, if it is one that says so (reliable)."""
        self.seen = RobotDriveSeen()

    def __enter__(self) -> Robot:
        self._probe.seen.recording(RobotSeen).drive = self.seen
        self._thread = threading.Thread(target=self._live, name="robot")
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._closing.set()
        self._thread.join()
        if self._command_subscription is not None:
            self._probe.node.destroy_subscription(self._command_subscription)

    @property
    def pose(self) -> Pose:
        """Where it really is."""
        return self._rover.pose

    @property
    def is_known(self) -> bool:
        """The node has been told often enough, and its reader got one.

        We have found the reader, but that does not say that it has found us. On a busy computer,
        what is sent in between is dropped there, for seconds.
        """
        return self.told >= KNOWS_AFTER and self.heard

    @property
    def stands(self) -> bool:
        """Neither drives nor turns."""
        motion = self._rover.motion
        return abs(motion.forward_m_s) < STANDS_M_S and abs(motion.turn_rad_s) < STANDS_RAD_S

    def distance_to(self, x_m: float, y_m: float) -> float:
        """How far it really is from a point, in metres.

        >>> scene.until(lambda: robot.distance_to(3.0, 5.0) < 0.1, 30.0)
        """
        return math.hypot(x_m - self.pose.x_m, y_m - self.pose.y_m)

    def listen_to(self, topic: str, type_: str) -> None:
        """Do what is said on this topic, `COMMAND_LASTS_S` long; nothing of a type without speeds.

        >>> robot.listen_to(CMD_VEL.topic, CMD_VEL.type)
        """
        from rclpy.qos import QoSProfile, ReliabilityPolicy

        try:
            commands = message_class(type_)
        except UnknownType:
            return
        quality = QoSProfile(depth=50, reliability=ReliabilityPolicy.BEST_EFFORT)
        self._command_subscription = self._probe.node.create_subscription(
            commands, topic, self._hear, quality
        )

    def speak_to(self, subscription: Endpoint) -> None:
        """Tell this subscription where it is.

        >>> robot.speak_to(subscription)
        """
        from nav_msgs.msg import Odometry

        probe_node = self._probe.node
        quality = offering(subscription.qos, depth=LAST_ONLY)
        self._odom_publisher = probe_node.create_publisher(Odometry, subscription.topic, quality)

    def _hear(self, twist: Any) -> None:
        try:
            motion = Motion(twist.linear.x, twist.angular.z)
            with self._lock:
                self._rover.drive(motion)
                self._commanded_s = time.monotonic()
        except (AttributeError, ValueError):  # another type; a speed that is no number
            return
        command = CommandSeen(
            arrival_ns=time.monotonic_ns(),
            forward_m_s=motion.forward_m_s,
            turn_rad_s=motion.turn_rad_s,
        )
        if self._probe.store.keeps("requests", command):
            self.seen.commands.append(command)
        self._probe.notify()

    def _live(self) -> None:
        stepped_s = told_s = time.monotonic()
        while not self._closing.wait(STEP_S):
            now_s = time.monotonic()
            with self._lock:
                if now_s - self._commanded_s > COMMAND_LASTS_S:
                    self._rover.drive(Motion())
                self._rover.step(min(now_s - stepped_s, LONGEST_PAUSE_S))
            stepped_s = now_s
            if now_s - told_s >= ODOM_EVERY_S:
                told_s = now_s
                self._tell()

    def _tell(self) -> None:
        pose = self.pose
        self.seen.path.append(
            PoseSeen(
                arrival_ns=time.monotonic_ns(),
                x_m=round(pose.x_m, KEPT_DECIMALS),
                y_m=round(pose.y_m, KEPT_DECIMALS),
                heading_rad=round(pose.heading_rad, KEPT_DECIMALS),
            )
        )
        if self._odom_publisher is not None and self._odom_publisher.get_subscription_count():
            stamp = self._probe.node.get_clock().now().to_msg()
            self._odom_publisher.publish(odometry(self._rover, stamp))
            self.told += 1
            self.heard = self.heard or self._is_confirmed()

    def _is_confirmed(self) -> bool:
        """A reader that confirms nothing (best effort) is not waited for."""
        from rclpy.duration import Duration

        return bool(self._odom_publisher.wait_for_all_acked(Duration(seconds=HEARD_S)))


@contextmanager
def robot_beside(
    scene: Scene, pose: Pose, driven_by: TopicContract, tells: TopicContract
) -> Iterator[Robot]:
    """A robot that is joined with the running node, or with the topics nearest to the card's.

    >>> with scene.run(SERVER), robot_beside(scene, Pose(1.0, 2.0), CMD_VEL, ODOM) as robot:
    ...     scene.until(lambda: robot.distance_to(3.0, 5.0) < 0.1, 30.0)
    """
    with Robot(scene.probe, Rover(FLOOR, pose)) as robot:
        commands = _found(scene, "publisher", driven_by)
        subscription = _found(scene, "subscription", tells)
        if commands:
            robot.listen_to(commands.topic, commands.type)
        if subscription and subscription.type == tells.type:
            robot.speak_to(subscription)
            scene.until(lambda: robot.is_known, FIRST_MESSAGE_WITHIN_S)
        yield robot


def _found(
    scene: Scene, kind: Literal["publisher", "subscription"], contract: TopicContract
) -> Endpoint | None:
    """The endpoint that is meant, once one of the right type is there."""

    def find() -> Endpoint | None:
        return nearest_endpoint(scene.seen.graph, kind, contract.topic, contract.type)

    def there() -> bool:
        found = find()
        return found is not None and found.type == contract.type

    scene.appears(there, f"a {kind} on {contract.topic} of its type")
    return find()


def start_near(scene: Scene, x_m: float, y_m: float, nearest_m: float, farthest_m: float) -> Pose:
    """A place that nobody can know before, so far from a point; it looks elsewhere.

    It lies about as far along x as along y: whoever forgets one of them is far from the truth.
    """
    quarter = math.floor(scene.between(0, 4)) * math.pi / 2
    angle = quarter + scene.between(*DIAGONAL_RAD)
    way_m = scene.between(nearest_m, farthest_m)
    back = angle + math.pi + scene.between(-1.2, 1.2)
    return Pose(
        x_m + way_m * math.cos(angle), y_m + way_m * math.sin(angle), math.remainder(back, math.tau)
    )

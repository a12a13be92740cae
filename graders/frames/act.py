"""Tells a node of a drive that nobody knows, and keeps what it says of frames, walls and cells.

All of it is judged by stamps. So a busy computer may tell the drive as slowly as it likes.
"""

from __future__ import annotations

import array
import math
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from graders.frames.cells import measured
from graders.frames.contract import TreeContract
from graders.frames.drive import (
    STEP_RAD,
    Drive,
    LaserMount,
    Odometry,
    Scan,
    beams_rad,
    drive_in,
)
from graders.frames.places import mistake_in, off_the_walls_m
from graders.frames.record import (
    HEARS_ON,
    BodySeen,
    FramesDriveSeen,
    FramesSeen,
    MapSeen,
    ScanSaid,
    Source,
    Stamp,
    StepSeen,
    WallsSeen,
)
from ros2_on_pip.near_names import nearest
from roslings.course import NodeContract, TopicContract
from roslings.evidence import Endpoint
from roslings.experiment.missed import hears, says
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S
from roslings.experiment.own_time import PATIENCE_S, OwnTime
from roslings.experiment.scene import Scene
from roslings.experiment.timing import accounting
from roslings.probe.content import message_class
from roslings.probe.events import no_publisher_events, no_subscription_events
from roslings.probe.probe import offering
from roslings.seen.matching import nearest_endpoint
from roslings_rover.models.differential_drive import Pose, wrapped

NS_PER_S = 10**9
QUEUE = 500
MOST_KEPT = 2000
"""Messages of one kind: a drive needs a tenth of it."""

MADE_UP_S = 0.02
"""So much of a delay the next pauses make up for; more of it only makes the drive longer."""

CONFIRMED_S = 2.0
"""So long the first odometry waits until the node's reader has it, if it is one that says so."""

BLOCKED_S = 1.0
"""A callback that takes so long, of the node's own time, waits for something."""

SETTLES_S = 1.0
"""The last points may come so long after the drive, of the node's own time."""

MAP_WITHIN_S = 3.0
LATE_WITHIN_S = 3.0
EXACT_DECIMALS = 4
MOST_VALUES = 8
MOST_STEPS, MOST_POINTS, LONGEST_NAME = 100, 5000, 100
LEVEL = 1e-4
LOOKED_INTO_M = 0.015
"""Points that are farther off are asked for the mistake."""


@dataclass(frozen=True)
class FrameTopics:
    """The topics of a node that says frames."""

    odometry: TopicContract
    scan: TopicContract
    tf_static: TopicContract
    tf: TopicContract
    walls: TopicContract
    map: TopicContract


# --- what it says ------------------------------------------------------------------------------


@dataclass
class HeardOfFrames:
    """What came of the four topics, as it came."""

    steps: list[tuple[Source, Any]] = field(default_factory=list)
    """Each a TransformStamped."""
    walls: list[Any] = field(default_factory=list)
    map: Any = None
    maps: int = 0

    def hear_steps(self, source: Source, message: Any) -> None:
        """A message of /tf or /tf_static."""
        if len(self.steps) < MOST_KEPT:
            self.steps += [(source, step) for step in message.transforms]

    def hear_walls(self, message: Any) -> None:
        """Points."""
        if len(self.walls) < MOST_KEPT:
            self.walls.append(message)

    def hear_map(self, message: Any) -> None:
        """The last one counts."""
        self.map, self.maps = message, self.maps + 1


@contextmanager
def hearing(scene: Scene, roads: FrameTopics) -> Iterator[HeardOfFrames]:
    """Hear what a node will say of frames; who wants to know of all begins before the node does.

    Subscriptions of our own hear it. Those of the probe are cut where many large messages pile up,
    and what they hear is kept as a number here.
    """
    heard = HeardOfFrames()
    for type_name, read in SIZES.items():
        scene.probe.read_as_it_comes(type_name, read)
    with (
        _subscribed(scene, roads.tf, partial(heard.hear_steps, "tf")),
        _subscribed(scene, roads.tf_static, partial(heard.hear_steps, "tf_static"), kept=True),
        _subscribed(scene, roads.walls, heard.hear_walls),
        _subscribed(scene, roads.map, heard.hear_map, kept=True),
    ):
        yield heard


SIZES: dict[str, Callable[[Any], int]] = {
    "tf2_msgs/msg/TFMessage": lambda message: len(message.transforms),
    "geometry_msgs/msg/PolygonStamped": lambda message: len(message.polygon.points),
    "nav_msgs/msg/OccupancyGrid": lambda message: len(message.data),
}
"""Type to what the evidence keeps of each message."""


@contextmanager
def _subscribed(
    scene: Scene, topic: TopicContract, hear: Callable[[Any], None], kept: bool = False
) -> Iterator[None]:
    """`kept`: also what was said before."""
    from rclpy.qos import DurabilityPolicy, QoSProfile

    durability = DurabilityPolicy.TRANSIENT_LOCAL if kept else DurabilityPolicy.VOLATILE

    def hear_and_tell(message: Any) -> None:
        hear(message)
        scene.probe.notify()

    subscription = scene.probe.node.create_subscription(
        message_class(topic.type),
        topic.topic,
        hear_and_tell,
        QoSProfile(depth=QUEUE, durability=durability),
        event_callbacks=no_subscription_events(),
    )
    try:
        yield
    finally:
        scene.probe.node.destroy_subscription(subscription)


def join_late(scene: Scene, topic: TopicContract) -> None:
    """Subscribe now to what never moves, and write down what was kept."""
    heard = HeardOfFrames()
    scene.appears(lambda: _publisher(scene, topic) is not None, says(topic))
    with _subscribed(scene, topic, partial(heard.hear_steps, "late"), kept=True):
        scene.until_own(lambda: bool(heard.steps), LATE_WITHIN_S)
    _write_steps(scene, heard)


def _publisher(scene: Scene, topic: TopicContract) -> Endpoint | None:
    return nearest_endpoint(scene.seen.graph, "publisher", topic.topic, topic.type)


# --- what it is told ---------------------------------------------------------------------------


class DriveTeller:
    """Tells one node of a drive, in the drive's own time or more slowly."""

    def __init__(
        self, scene: Scene, node: NodeContract, roads: FrameTopics, tree: TreeContract, drive: Drive
    ) -> None:
        self._scene, self._node, self._roads = scene, node, roads
        self._tree, self._drive = tree, drive
        self.began_ns = time.time_ns() // 10**6 * 10**6
        """The stamp of the drive's first moment."""
        self._publishers: dict[str, Any] = {}
        self._is_confirmed = False
        """We have found the reader; with the first confirmation it has found us."""
        self._next_s = 0.0
        """When the last message was due."""

    def stamp_ns(self, at_s: float) -> int:
        """Of a time of the drive."""
        return self.began_ns + round(at_s * 10**6) * 1000

    def is_heard(self) -> bool:
        """Whether the node has subscribed to both topics: then publishers are joined with it."""
        for topic in (self._roads.odometry, self._roads.scan):
            found = self._subscription(topic)
            if found is None or found.type != topic.type:
                return False
            publisher = self._open(topic, found)
            self._scene.until(publisher.get_subscription_count, FIRST_MESSAGE_WITHIN_S)
        return True

    def _subscription(self, topic: TopicContract) -> Endpoint | None:
        def find() -> Endpoint | None:
            graph = self._scene.seen.graph
            return nearest_endpoint(graph, "subscription", topic.topic, topic.type)

        self._scene.appears(lambda: find() is not None, hears(topic))
        return find()

    def _open(self, topic: TopicContract, found: Endpoint) -> Any:
        publisher = self._scene.probe.node.create_publisher(
            message_class(topic.type),
            found.topic,
            offering(found.qos),
            event_callbacks=no_publisher_events(),
        )
        self._publishers[topic.topic] = publisher
        return publisher

    def tell_all(self) -> bool:
        """The whole drive; whether its callbacks kept up."""
        near = nearest(self._node.node, self._scene.seen.graph.nodes)
        with self._scene.probe.barrier([near.found if near else self._node.node]) as barrier:
            # What is announced comes in its order. So a node that answers knows the publishers that
            # were made before, and nothing of the drive is lost on the way.
            there = self._scene.until(lambda: barrier.ready, FIRST_MESSAGE_WITHIN_S)
            if there:
                barrier.send()
                self._scene.until_own(lambda: barrier.is_passed, FIRST_MESSAGE_WITHIN_S)
            self._next_s = time.monotonic()
            for told, after_s in zip(self._drive.told, self._drive.pauses_s, strict=True):
                if not self._scene.arena.all_alive():
                    return True
                self._await(after_s)
                if isinstance(told, Scan):
                    self._tell_scan(told)
                    barrier.send()
                    continue
                self._tell_place(told)
                if there and not self._keeps_up(lambda: barrier.is_passed):
                    return False
        return True

    def _await(self, after_s: float) -> None:
        """So long after the last message: who was late is not made up for."""
        due_s, alive = self._next_s + after_s, self._scene.arena.all_alive
        self._scene.probe.until(
            lambda: time.monotonic() >= due_s or not alive(), due_s - time.monotonic()
        )
        self._next_s = max(due_s, time.monotonic() - MADE_UP_S)

    def _keeps_up(self, passed: Callable[[], bool]) -> bool:
        """Wait until it has handled the last scan; False where one callback takes too long."""
        if passed():
            return True
        alive = self._scene.arena.all_alive
        with accounting(self._scene, HEARS_ON):
            own = OwnTime(self._scene.arena)
            self._scene.probe.until(
                lambda: passed() or own.is_past(BLOCKED_S) or not alive(), BLOCKED_S + PATIENCE_S
            )
        return passed() or not alive()

    def _tell_place(self, told: Odometry) -> None:
        from nav_msgs.msg import Odometry as Message
        from rclpy.duration import Duration

        message = Message(child_frame_id=self._tree.body)
        message.header.frame_id = self._tree.odometry
        _put_stamp(message, self.stamp_ns(told.at_s))
        place, body = message.pose.pose, told.body
        place.position.x, place.position.y = body.x_m, body.y_m
        place.orientation.z = math.sin(body.heading_rad / 2)
        place.orientation.w = math.cos(body.heading_rad / 2)
        motion = self._drive.motion_at(told.at_s)
        message.twist.twist.linear.x = motion.forward_m_s
        message.twist.twist.angular.z = motion.turn_rad_s
        publisher = self._publishers[self._roads.odometry.topic]
        publisher.publish(message)
        if not self._is_confirmed:
            # It holds Python's lock while it waits: so it is asked again and again.
            self._scene.probe.until(lambda: publisher.wait_for_all_acked(Duration()), CONFIRMED_S)
            self._is_confirmed = True

    def _tell_scan(self, told: Scan) -> None:
        from sensor_msgs.msg import LaserScan

        angles = beams_rad(self._drive)
        least_m, most_m = self._drive.limits_m
        message = LaserScan(
            angle_min=float(angles[0]),
            angle_max=float(angles[-1]),
            angle_increment=STEP_RAD,
            scan_time=0.2,
            range_min=least_m,
            range_max=most_m,
            ranges=array.array("f", told.ranges.tolist()),
        )
        message.header.frame_id = self._tree.laser
        _put_stamp(message, self.stamp_ns(told.at_s))
        self._publishers[self._roads.scan.topic].publish(message)


def _put_stamp(message: Any, stamp_ns: int) -> None:
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp_ns, NS_PER_S)


def _stamp_ns(header: Any) -> int:
    return int(header.stamp.sec) * NS_PER_S + int(header.stamp.nanosec)


# --- a drive -----------------------------------------------------------------------------------


def tell_of_a_drive(
    scene: Scene,
    node: NodeContract,
    roads: FrameTopics,
    tree: TreeContract,
    mount: LaserMount,
    heard: HeardOfFrames,
) -> None:
    """Tell the running node of a drive with its laser at `mount`, and write down what it says.

    >>> with hearing(scene, ROADS) as heard, scene.run(FRAMES):
    ...     tell_of_a_drive(scene, FRAMES, ROADS, TREE, LaserMount(), heard)
    """
    drive = drive_in(scene.seed, mount)
    teller = DriveTeller(scene, node, roads, tree, drive)
    seen = FramesDriveSeen(
        seed=drive.room.seed,
        laser_x_m=mount.x_m,
        laser_y_m=mount.y_m,
        laser_yaw_rad=mount.yaw_rad,
        odometry=len(drive.odometry),
    )
    scene.seen.recording(FramesSeen).drive = seen
    seen.heard = teller.is_heard()
    if seen.heard:
        seen.blocked_s = 0.0 if teller.tell_all() else BLOCKED_S
        _await_the_rest(scene, drive, heard)
    with scene.busy():
        _write_steps(scene, heard)
        _Writing(drive, teller, tree, heard, seen).write()
        _write_map(scene, drive, heard, seen)


def _await_the_rest(scene: Scene, drive: Drive, heard: HeardOfFrames) -> None:
    """The last points, and a map that has them."""
    maps, known = heard.maps, sum(scan.part in ("standing", "moving") for scan in drive.scans)
    scene.until_own(lambda: len(heard.walls) >= known, SETTLES_S)
    scene.until_own(lambda: heard.maps > maps, MAP_WITHIN_S if heard.maps else SETTLES_S)


def _write_steps(scene: Scene, heard: HeardOfFrames) -> None:
    """Each once; of what moves, the first."""
    found: dict[tuple[object, ...], StepSeen] = {}
    for source, told in list(heard.steps):
        step = step_seen(source, told)
        key = (source, step.parent, step.child)
        found.setdefault(key if source == "tf" else (*key, step.x_m, step.y_m, step.yaw_rad), step)
    scene.seen.recording(FramesSeen).steps += list(found.values())[:MOST_STEPS]


def step_seen(source: Source, told: Any) -> StepSeen:
    """What is kept of a TransformStamped."""
    place, turn = told.transform.translation, told.transform.rotation
    length = math.hypot(turn.x, turn.y, turn.z, turn.w)
    return StepSeen(
        source=source,
        parent=told.header.frame_id[:LONGEST_NAME],
        child=told.child_frame_id[:LONGEST_NAME],
        x_m=_rounded(place.x),
        y_m=_rounded(place.y),
        yaw_rad=_rounded(_yaw_rad(turn)),
        tilted=_is_tilted(turn),
        length=_rounded(length),
        is_finite=math.isfinite(length + place.x + place.y + place.z),
    )


def _is_tilted(turn: Any) -> bool:
    return bool(max(abs(turn.x), abs(turn.y)) > LEVEL)


def _yaw_rad(turn: Any) -> float:
    """About z, as the quaternion's numbers have it, whatever its length."""
    return wrapped(2 * math.atan2(turn.z, turn.w))


def _rounded(value: float) -> float:
    """0 for inf and NaN: that there was one is kept beside it."""
    return round(float(value), EXACT_DECIMALS) if math.isfinite(value) else 0.0


@dataclass
class _Writing:
    """Holds what was said against the truth, by stamps."""

    drive: Drive
    teller: DriveTeller
    tree: TreeContract
    heard: HeardOfFrames
    seen: FramesDriveSeen

    def write(self) -> None:
        self._write_body()
        self._write_walls()

    def _write_body(self) -> None:
        places = {self.teller.stamp_ns(each.at_s): each.body for each in self.drive.odometry}
        told = Counter[tuple[str, int]]()
        for source, step in list(self.heard.steps):
            if source != "tf":
                continue
            stamp_ns = _stamp_ns(step.header)
            told[step.child_frame_id, stamp_ns] += 1
            self.seen.body.append(body_seen(step, stamp_ns, places.get(stamp_ns)))
        self.seen.told = len({stamp_ns for _, stamp_ns in told} & places.keys())
        self.seen.told_again = told.total() - len(told)

    def _write_walls(self) -> None:
        scans = {self.teller.stamp_ns(each.at_s): each for each in self.drive.scans}
        answers = Counter(_stamp_ns(each.header) for each in self.heard.walls)
        self.seen.scans += [
            ScanSaid(
                part=scan.part,
                turn_rad_s=scan.turn_rad_s,
                answers=answers[stamp_ns],
            )
            for stamp_ns, scan in scans.items()
        ]
        for message in self.heard.walls:
            scan = scans.get(stamp_ns := _stamp_ns(message.header))
            self.seen.walls.append(_walls(self.drive, message, stamp_ns, scan))


def body_seen(step: Any, stamp_ns: int, truth: Pose | None) -> BodySeen:
    """What is kept of a rover's step, beside the truth of its stamp."""
    found, place = step_seen("tf", step), step.transform.translation
    return BodySeen(
        parent=found.parent,
        child=found.child,
        stamp=_kind_of(stamp_ns, truth is not None),
        off_m=_rounded(math.hypot(place.x - truth.x_m, place.y - truth.y_m, place.z))
        if truth
        else 0.0,
        off_rad=_rounded(_off_rad(step.transform.rotation, truth.heading_rad)) if truth else 0.0,
        length=found.length,
        is_finite=found.is_finite,
    )


def _off_rad(turn: Any, heading_rad: float) -> float:
    """The angle between this rotation, whatever its length, and one about z alone."""
    length = math.hypot(turn.x, turn.y, turn.z, turn.w) or 1.0
    along = turn.w * math.cos(heading_rad / 2) + turn.z * math.sin(heading_rad / 2)
    return 2 * math.acos(min(1.0, abs(along) / length))


def _kind_of(stamp_ns: int, known: bool) -> Stamp:
    return "own" if known else "other" if stamp_ns else "zero"


def _walls(drive: Drive, message: Any, stamp_ns: int, scan: Scan | None) -> WallsSeen:
    told = message.polygon.points[:MOST_POINTS]
    points = np.array([(each.x, each.y) for each in told], float).reshape(-1, 2)
    ends = points[np.isfinite(points).all(axis=1)]
    seen = WallsSeen(
        frame=message.header.frame_id[:LONGEST_NAME],
        stamp=_kind_of(stamp_ns, scan is not None),
        part=scan.part if scan else "before",
        distances=int(scan.is_distance.sum()) if scan else 0,
        points=len(message.polygon.points),
        endless=len(points) - len(ends),
    )
    if scan is not None and len(ends):
        seen.off_m = _rounded(off_the_walls_m(drive, ends))
        if seen.off_m > LOOKED_INTO_M:
            seen.like = mistake_in(drive, scan, ends)
    return seen


def _write_map(scene: Scene, drive: Drive, heard: HeardOfFrames, seen: FramesDriveSeen) -> None:
    if (told := heard.map) is None:
        return
    info, values = told.info, np.array(told.data, np.int8)
    corner, turn = info.origin.position, info.origin.orientation
    length = math.hypot(turn.x, turn.y, turn.z, turn.w)
    seen.map, shown = measured(
        drive,
        MapSeen(
            frame=told.header.frame_id[:LONGEST_NAME],
            cell_m=_rounded(info.resolution),
            width=info.width,
            height=info.height,
            cells=len(values),
            x_m=_rounded(corner.x),
            y_m=_rounded(corner.y),
            yaw_rad=_rounded(_yaw_rad(turn)),
            tilted=_is_tilted(turn),
            length=_rounded(length),
            z_m=_rounded(corner.z),
            is_finite=math.isfinite(length + corner.x + corner.y + corner.z),
            values=[int(each) for each in np.unique(values)[:MOST_VALUES]],
        ),
        values,
    )
    scene.seen.recording(FramesSeen).shown = shown

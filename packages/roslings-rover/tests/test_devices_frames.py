"""The rover's frames: what its odometry counts, what is said on /tf, where a scan's walls lie."""

from __future__ import annotations

import io
import math
import statistics
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cached_property
from typing import Any

import pytest
import rclpy
from builtin_interfaces.msg import Time as TimeMessage
from program import until
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time

from ros2_on_pip.domain_lease import leased_domain
from roslings_rover.models.differential_drive import Pose, wrapped
from roslings_rover.rover import Motion, Rover
from roslings_rover.rover.displays import Lines
from roslings_rover.rover.driven import DrivenRover
from roslings_rover.rover.frames import FrameOptions, odom_in_map
from roslings_rover.rover.made import rover_in
from roslings_rover.rover.odometer import Odometer
from roslings_rover.rover.room_markers import markers_of_room
from roslings_rover.rover.room_node import RoomNode, node_for
from roslings_rover.rover.words import at_its_end, beside
from skips import needs

SEED = 5
SLOW_RAD_S = 1e-3
ROUND = Motion(0.2, 1.5)
A_MILLIMETRE = 0.001


# --- the odometer --------------------------------------------------------------------------------


def driven(motion: Motion, seconds: float, drift_percent: float) -> tuple[Rover, Odometer]:
    """A rover after such a drive from a place that is not zero, and its odometer."""
    rover = Rover(pose=Pose(0.5, 1.0, 0.3))
    odometer = Odometer(rover.pose, drift_percent)
    rover.drive(motion)
    for _ in range(round(seconds / 0.02)):
        rover.step(0.02)
        odometer.follow(rover)
    return rover, odometer


@pytest.mark.parametrize("motion", [Motion(0.4), Motion(0.0, 1.0), Motion(0.3, -0.7)])
def test_without_drift_it_is_the_truth(motion: Motion) -> None:
    """To the last digit."""
    rover, odometer = driven(motion, 3.0, 0.0)
    assert (odometer.pose, odometer.motion) == (rover.pose, rover.motion)


@pytest.mark.parametrize("percent", [2.0, 10.0, -5.0])
def test_each_metre_and_each_turn_counts_too_much(percent: float) -> None:
    """By the share that was asked for: the way, the turn, and both speeds."""
    rover, odometer = driven(Motion(0.4), 3.0, percent)
    start = Pose(0.5, 1.0, 0.3)
    scale = 1 + percent / 100
    told, true = (start.seen_from_here(p.x_m, p.y_m) for p in (odometer.pose, rover.pose))
    assert told == pytest.approx((true[0] * scale, 0.0), abs=1e-9)
    assert odometer.motion.forward_m_s == pytest.approx(rover.motion.forward_m_s * scale)
    rover, odometer = driven(Motion(0.0, 1.0), 2.0, percent)
    turned = (each.pose.heading_rad - start.heading_rad for each in (odometer, rover))
    assert next(turned) == pytest.approx(next(turned) * scale)


def test_an_arc_stays_an_arc() -> None:
    """The same curve, further on: its radius is no other."""
    rover, odometer = driven(Motion(0.3, 0.6), 4.0, 10.0)
    centre = Pose(0.5, 1.0, 0.3).ahead(0.0, 0.5)
    away_m = math.hypot(odometer.pose.x_m - centre[0], odometer.pose.y_m - centre[1])
    true_m = math.hypot(rover.pose.x_m - centre[0], rover.pose.y_m - centre[1])
    assert away_m == pytest.approx(true_m, abs=0.003)


@pytest.mark.parametrize("x_m", [-3.0, 0.0, 2.5])
@pytest.mark.parametrize("heading_rad", [-3.0, 0.4, math.pi])
def test_map_to_odom_makes_it_right_again(x_m: float, heading_rad: float) -> None:
    """The believed place, put into the map, is the true one."""
    truth, believed = Pose(x_m, 1.2, heading_rad), Pose(1.0, -x_m, 2.8)
    step = odom_in_map(truth, believed)
    assert step.ahead(believed.x_m, believed.y_m) == pytest.approx((x_m, 1.2))
    turn_rad = step.heading_rad + believed.heading_rad - heading_rad
    assert math.remainder(turn_rad, math.tau) == pytest.approx(0.0, abs=1e-12)


def test_who_drifts_is_told_so() -> None:
    """In words beside the map, and where it believes that it is."""
    node = DrivenRover(Rover(), frames=FrameOptions(drift_percent=2.0))
    assert "drift       2.0 % in /odom" in beside(node)
    assert max(map(len, beside(node))) <= 32
    node.rover.drive(Motion(0.4))
    for _ in range(100):
        node.rover.step(0.02)
        node.odometer.follow(node.rover)
    assert node.believed == node.odometer.pose
    told = [*at_its_end(node, "The")]
    assert told[0].startswith("The rover is at x 0.77 m")
    assert told[1] == "By its odometry it is at x 0.78 m, y 0.00 m, heading 0 degrees."


def test_who_does_not_drift_believes_nothing_else() -> None:
    """No second arrow on the map, and no line about drift."""
    node = DrivenRover(Rover())
    assert node.believed is None
    assert not [line for line in beside(node) if "drift" in line]


@pytest.mark.parametrize(
    ("frames", "frame"),
    [
        (FrameOptions(), "odom"),
        (FrameOptions(drift_percent=2.0), "map"),
        (FrameOptions(map_frame=True), "map"),
    ],
)
def test_a_room_is_told_in_the_frame_where_it_stands(frames: FrameOptions, frame: str) -> None:
    """Where /odom drifts, the walls would wander with it."""
    node = node_for(rover_in(SEED), frames)
    assert isinstance(node, RoomNode) and node._room_frame == frame
    told = markers_of_room(node.rover.world, TimeMessage(), node._room_frame)
    assert {marker.header.frame_id for marker in told.markers} == {frame}


# --- on /tf --------------------------------------------------------------------------------------


class Looker:
    """A node that drives a rover beside it, and listens to its frames."""

    def __init__(self, rover: DrivenRover, context: Any) -> None:
        from geometry_msgs.msg import Twist

        self.rover, self._twist = rover, Twist
        self.node = rclpy.create_node("looker", context=context)
        self._executor = SingleThreadedExecutor(context=context)
        self._executor.add_node(self.node)
        self._commands = self.node.create_publisher(Twist, "cmd_vel", 10)

    @cached_property
    def buffer(self) -> Any:
        """What it knows of the frames since somebody first asked for them."""
        return self.listen()

    def listen(self) -> Any:
        """Somebody who has just come; what they know of the frames."""
        import tf2_ros

        buffer = tf2_ros.Buffer(node=self.node)
        self._listener = tf2_ros.TransformListener(buffer, self.node)
        return buffer

    def until(self, holds: Callable[[], Any], missing: str) -> None:
        """Both do what is due meanwhile. Raises AssertionError where it never holds."""

        def looked() -> bool:
            self.rover.turn(0.005)
            self._executor.spin_once(timeout_sec=0.0)
            return bool(holds())

        until(looked, lambda: missing)

    def place(self, target: str, source: str) -> Pose:
        """The newest step between two frames, as it lies on the floor."""
        asked = target, source, Time()
        self.until(lambda: self.buffer.can_transform(*asked), f"no {source} in {target}")
        found = self.buffer.lookup_transform(*asked).transform
        yaw_rad = 2 * math.atan2(found.rotation.z, found.rotation.w)
        return Pose(found.translation.x, found.translation.y, wrapped(yaw_rad))

    def drive(self, motion: Motion, way_m: float) -> None:
        """Until it has gone so far; then it stands, and its frames are known."""
        rover = self.rover.rover
        self.until(lambda: self._command(motion) or rover.way_m >= way_m, "it does not move")
        self.until(lambda: self._command(Motion()) or self._stands, "it goes on")
        now = self.node.get_clock().now()
        self.until(lambda: self._is_known and self._newest > now, "its frames are old")

    def _command(self, motion: Motion) -> None:
        said = self._twist()
        said.linear.x, said.angular.z = motion.forward_m_s, motion.turn_rad_s
        self._commands.publish(said)

    @property
    def _stands(self) -> bool:
        wheels = self.rover.rover.wheels
        return max(abs(wheels.left_rad_s), abs(wheels.right_rad_s)) < SLOW_RAD_S

    @property
    def _is_known(self) -> bool:
        return bool(self.buffer.can_transform("odom", "base_link", Time()))

    @property
    def _newest(self) -> Any:
        found = self.buffer.lookup_transform("odom", "base_link", Time())
        return Time.from_msg(found.header.stamp)


@contextmanager
def looker_beside(rover: Rover, frames: FrameOptions) -> Iterator[Looker]:
    """Both in a domain of their own."""
    with leased_domain() as domain, pytest.MonkeyPatch.context() as patched:
        patched.setenv("ROS_DOMAIN_ID", str(domain))
        patched.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        context = rclpy.Context()
        rclpy.init(context=context, domain_id=domain)
        with node_for(rover, frames) as node:
            yield Looker(node, context)
        context.try_shutdown()


def same_place(one: Pose, other: Pose) -> None:
    """Within a millimetre, and a thousandth of a radian."""
    assert (one.x_m, one.y_m) == pytest.approx((other.x_m, other.y_m), abs=A_MILLIMETRE)
    turn_rad = math.remainder(one.heading_rad - other.heading_rad, math.tau)
    assert turn_rad == pytest.approx(0.0, abs=A_MILLIMETRE)


@pytest.mark.slow
@needs("module tf2_msgs")
@pytest.mark.parametrize("room", [None, SEED])
def test_the_frames_are_where_the_rover_is(room: int | None) -> None:
    """Body, laser and camera after a drive, in the course's own room and in one of a seed."""
    with looker_beside(rover_in(room), FrameOptions()) as looker:
        looker.drive(ROUND, 0.5)
        truth = looker.rover.rover.pose
        same_place(looker.place("odom", "base_link"), truth)
        same_place(looker.place("odom", "laser"), truth)
        camera = looker.place("odom", "camera_optical")
        assert (camera.x_m, camera.y_m) == pytest.approx(truth.ahead(0.08), abs=A_MILLIMETRE)
        assert not looker.buffer.can_transform("map", "base_link", Time())


@pytest.mark.slow
@needs("module tf2_msgs")
def test_the_camera_looks_ahead_along_z() -> None:
    """A point one metre before the lens, 20 cm to the right and 10 cm down, in the body's axes."""
    import tf2_geometry_msgs
    from geometry_msgs.msg import Point, PointStamped

    with looker_beside(rover_in(None), FrameOptions()) as looker:
        looker.place("base_link", "camera_optical")
        step = looker.buffer.lookup_transform("base_link", "camera_optical", Time())
    point = PointStamped(point=Point(x=0.2, y=0.1, z=1.0))
    found = tf2_geometry_msgs.do_transform_point(point, step).point
    assert (found.x, found.y, found.z) == pytest.approx((1.08, -0.2, 0.05))


@pytest.mark.slow
@needs("module tf2_msgs")
def test_who_comes_late_knows_what_never_moves() -> None:
    """It was said once, before they came."""
    with looker_beside(rover_in(None), FrameOptions()) as looker:
        looker.place("odom", "laser")
        looker.buffer = looker.listen()
        assert not looker.buffer.can_transform("base_link", "laser", Time())
        same_place(looker.place("base_link", "laser"), Pose())
        told = looker.node.get_publishers_info_by_topic("/tf_static")
        assert [each.qos_profile.durability.name for each in told] == ["TRANSIENT_LOCAL"]


@pytest.mark.slow
@needs("module tf2_msgs")
def test_drift_leads_away_and_the_map_back() -> None:
    """By the share that was asked for; /odom and /tf say the same, and the map has the truth."""
    from nav_msgs.msg import Odometry

    heard: list[Any] = []
    frames = FrameOptions(drift_percent=10.0, map_frame=True)
    with looker_beside(rover_in(None), frames) as looker:
        looker.node.create_subscription(Odometry, "odom", heard.append, 10)
        looker.drive(Motion(0.5), 1.0)
        truth = looker.rover.rover.pose
        odom = looker.place("odom", "base_link")
        assert truth.x_m >= 1.0
        same_place(odom, Pose(truth.x_m * 1.1))
        assert heard[-1].pose.pose.position.x == pytest.approx(odom.x_m, abs=A_MILLIMETRE)
        looker.drive(ROUND, truth.x_m + 0.6)
        truth = looker.rover.rover.pose
        same_place(looker.place("map", "base_link"), truth)
        told = looker.place("odom", "base_link")
        assert math.hypot(told.x_m - truth.x_m, told.y_m - truth.y_m) > 0.05


@pytest.mark.slow
@needs("module tf2_msgs")
def test_a_scan_lies_on_the_walls_while_the_rover_turns() -> None:
    """Each scan at its own time, put through the frames. A tenth of a second beside it is seen."""
    from sensor_msgs.msg import LaserScan

    scans: list[Any] = []
    rover = rover_in(SEED)
    with looker_beside(rover, FrameOptions()) as looker:
        looker.node.create_subscription(LaserScan, "scan", scans.append, qos_profile_sensor_data)
        looker.place("odom", "laser")
        spin = Motion(0.0, 2.0)
        looker.until(lambda: looker._command(spin) or len(scans) > 12, "no scans")
        asked = "odom", "laser", Time.from_msg(scans[-1].header.stamp)
        looker.until(lambda: looker.buffer.can_transform(*asked), "no step for the last scan")
    turning = scans[4:]
    assert {scan.header.frame_id for scan in turning} == {"laser"}
    in_time = [away_m(rover, looker.buffer, scan, 0) for scan in turning]
    late = [away_m(rover, looker.buffer, scan, -100_000_000) for scan in turning]
    assert statistics.median(in_time) < 0.01
    assert statistics.median(late) > 0.04


def away_m(rover: Rover, buffer: Any, scan: Any, late_ns: int) -> float:
    """How far a scan's points lie from what stands there: the mean, in metres."""
    at = Time(nanoseconds=Time.from_msg(scan.header.stamp).nanoseconds + late_ns)
    step = buffer.lookup_transform("odom", scan.header.frame_id, at).transform
    yaw_rad = 2 * math.atan2(step.rotation.z, step.rotation.w)
    laser = Pose(step.translation.x, step.translation.y, yaw_rad)
    seen = [
        laser.ahead(range_m * math.cos(angle), range_m * math.sin(angle))
        for index, range_m in enumerate(scan.ranges)
        if math.isfinite(range_m)
        for angle in [scan.angle_min + index * scan.angle_increment]
    ]
    return statistics.fmean(abs(rover.world.room_at(*point)) for point in seen)


@pytest.mark.slow
@needs("module tf2_msgs")
def test_who_wants_no_tf_gets_none() -> None:
    """No topic of it, and no word about it; all else goes on."""
    with looker_beside(rover_in(None), FrameOptions(published=False)) as looker:
        looker.until(lambda: looker.node.count_publishers("/odom"), "no /odom")
        assert not looker.node.count_publishers("/tf")
        assert not looker.node.count_publishers("/tf_static")
        assert not [line for line in beside(looker.rover) if "tf" in line]


@pytest.mark.slow
def test_without_its_type_the_rover_drives_and_tells_how_to_get_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Beside the map, and in a line where there is none."""
    monkeypatch.setitem(sys.modules, "tf2_msgs.msg", None)
    monkeypatch.setitem(sys.modules, "tf2_msgs", None)
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    with looker_beside(rover_in(None), FrameOptions()) as looker:
        looker.until(lambda: looker.node.count_publishers("/odom"), "no /odom")
        assert not looker.rover.publishes_tf and not looker.node.count_publishers("/tf")
        out = io.StringIO()
        Lines(looker.rover, out)
    told = out.getvalue()
    assert "/tf is left out: its type is missing. sudo apt install ros-jazzy-tf2-msgs" in told

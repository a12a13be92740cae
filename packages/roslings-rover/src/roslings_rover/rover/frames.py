"""The rover's frames, on /tf and /tf_static.

From the root down: map, odom, base_link, then laser and camera_optical. A frame has one parent, so
each step is said by one node. The step from map to odom is said when it is asked for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from roslings_rover.models.differential_drive import Pose, wrapped
from roslings_rover.models.pinhole import PinholeCameraModel
from roslings_rover.rover.messages import BODY_FRAME, LASER_FRAME, ODOM_FRAME, turn

MAP_FRAME, CAMERA_FRAME = "map", "camera_optical"
TF, TF_STATIC = "/tf", "/tf_static"
LASER_ON_BODY = Pose()
"""Where the laser sits on the rover, and where its 0 looks: in the middle, and ahead."""
LASER_HEIGHT_M = 0.15
OPTICAL = (-0.5, 0.5, -0.5, 0.5)
"""The axes of a picture, as x, y, z, w: z looks ahead, x to the right, y down (REP 103)."""


@dataclass(frozen=True)
class FrameOptions:
    """What a rover says of its frames, and how well it knows its own place."""

    published: bool = True
    """On /tf and /tf_static, where their type is there."""
    drift_percent: float = 0.0
    """How much too long its odometry counts each metre and each turn."""
    map_frame: bool = False
    """It also says where `odom` is in `map`: there the rover is where it truly is."""


@dataclass(frozen=True)
class FramePublishers:
    """Says where the frames are: what never moves once, on a topic that keeps it."""

    moving: Any
    fixed: Any
    """Kept as long as the frames are said: who comes later asks this publisher."""
    map_frame: bool

    def close(self, node: Any) -> None:
        """Nothing is said any more, and who comes late hears nothing of it."""
        for publisher in (self.moving, self.fixed):
            node.destroy_publisher(publisher)

    def say(self, truth: Pose, believed: Pose, stamp: Any) -> None:
        """The steps that move; `believed` is where /odom says that the rover is."""
        from tf2_msgs.msg import TFMessage

        steps = [step_of(ODOM_FRAME, BODY_FRAME, believed, stamp)]
        if self.map_frame:
            steps.insert(0, step_of(MAP_FRAME, ODOM_FRAME, odom_in_map(truth, believed), stamp))
        self.moving.publish(TFMessage(transforms=steps))


def frame_publishers(node: Any, map_frame: bool) -> FramePublishers | None:
    """Those of a rover's node, which have said what never moves; None where tf2_msgs is not."""
    fixed = _said_once(node, mounted)
    if fixed is None:
        return None
    from tf2_msgs.msg import TFMessage

    return FramePublishers(node.create_publisher(TFMessage, TF, 100), fixed, map_frame)


def camera_publisher(node: Any) -> Any | None:
    """That of a node where another one says the rest; None where tf2_msgs is not."""
    return _said_once(node, lambda stamp: [mounted_camera(stamp)])


def _said_once(node: Any, steps: Callable[[Any], Iterable[Any]]) -> Any | None:
    """A publisher that has said steps, and keeps them; None where tf2_msgs is not."""
    try:
        from tf2_msgs.msg import TFMessage
    except ImportError:
        return None
    from rclpy.qos import DurabilityPolicy, QoSProfile

    kept = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    fixed = node.create_publisher(TFMessage, TF_STATIC, kept)
    fixed.publish(TFMessage(transforms=[*steps(node.get_clock().now().to_msg())]))
    return fixed


def mounted(stamp: Any) -> Iterator[Any]:
    """Where laser and camera sit on the rover: geometry_msgs/msg/TransformStamped."""
    laser = step_of(BODY_FRAME, LASER_FRAME, LASER_ON_BODY, stamp)
    laser.transform.translation.z = LASER_HEIGHT_M
    yield laser
    yield mounted_camera(stamp)


def mounted_camera(stamp: Any) -> Any:
    """Where the camera sits on the rover, and where it looks."""
    model = PinholeCameraModel()
    camera = step_of(BODY_FRAME, CAMERA_FRAME, Pose(model.mounted_ahead_m), stamp)
    camera.transform.translation.z = model.height_m
    facing = camera.transform.rotation
    facing.x, facing.y, facing.z, facing.w = OPTICAL
    return camera


def step_of(parent: str, child: str, place: Pose, stamp: Any) -> Any:
    """A geometry_msgs/msg/TransformStamped: where the child is in its parent, on the floor."""
    from geometry_msgs.msg import TransformStamped

    step = TransformStamped(child_frame_id=child)
    step.header.stamp, step.header.frame_id = stamp, parent
    step.transform.translation.x, step.transform.translation.y = place.x_m, place.y_m
    turn(step.transform.rotation, place.heading_rad)
    return step


def odom_in_map(truth: Pose, believed: Pose) -> Pose:
    """The place of `odom` in `map` from which the believed place is the true one."""
    turned = Pose(heading_rad=wrapped(truth.heading_rad - believed.heading_rad))
    x_m, y_m = turned.ahead(believed.x_m, believed.y_m)
    return Pose(truth.x_m - x_m, truth.y_m - y_m, turned.heading_rad)

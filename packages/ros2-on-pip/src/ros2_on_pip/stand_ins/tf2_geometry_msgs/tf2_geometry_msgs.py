"""How each type is moved by a TransformStamped. The message that is given stays as it is."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import tf2_ros
from geometry_msgs.msg import (
    Point,
    PointStamped,
    Pose,
    PoseStamped,
    PoseWithCovarianceStamped,
    Quaternion,
    Vector3,
    Vector3Stamped,
)

from ros2_on_pip.stand_ins._frames.motion import (
    Matrix,
    RigidTransform,
    apply,
    compose,
    matrix,
    normalized,
    rotate,
)

ROWS = 6
"""Of a covariance: x, y, z, and the turns about them."""


def do_transform_point(point: Any, transform: Any) -> Any:
    """A PointStamped."""
    x, y, z = apply(_motion(transform), _vector(point.point))
    return PointStamped(header=transform.header, point=Point(x=x, y=y, z=z))


def do_transform_vector3(vector3: Any, transform: Any) -> Any:
    """A Vector3Stamped: a direction is turned, and not shifted."""
    x, y, z = rotate(_motion(transform).rotation, _vector(vector3.vector))
    return Vector3Stamped(header=transform.header, vector=Vector3(x=x, y=y, z=z))


def do_transform_pose(pose: Any, transform: Any) -> Any:
    """A Pose, which has no header. A quaternion of zeros is taken for no rotation."""
    turn = pose.orientation
    lies = RigidTransform(_vector(pose.position), normalized((turn.x, turn.y, turn.z, turn.w)))
    (px, py, pz), (x, y, z, w) = compose(_motion(transform), lies)
    sign = 1.0 if w >= 0.0 else -1.0  # of the two that are the same rotation, as geometry2
    return Pose(
        position=Point(x=px, y=py, z=pz),
        orientation=Quaternion(x=sign * x, y=sign * y, z=sign * z, w=sign * w),
    )


def do_transform_pose_stamped(pose: Any, transform: Any) -> Any:
    """A PoseStamped."""
    return PoseStamped(header=transform.header, pose=do_transform_pose(pose.pose, transform))


def do_transform_pose_with_covariance_stamped(pose: Any, transform: Any) -> Any:
    """A PoseWithCovarianceStamped; what is known of the pose is turned too."""
    moved = PoseWithCovarianceStamped(header=transform.header)
    moved.pose.pose = do_transform_pose(pose.pose.pose, transform)
    moved.pose.covariance = transform_covariance(pose.pose.covariance, transform)
    return moved


def transform_covariance(cov_in: Sequence[float], transform: Any) -> list[float]:
    """36 numbers, 6 rows: R C Rt for each of the four blocks of 3 by 3."""
    turned = matrix(_motion(transform).rotation)
    moved = [0.0] * (ROWS * ROWS)
    for row in (0, 3):
        for column in (0, 3):
            _turn_block(cov_in, moved, turned, row * ROWS + column)
    return moved


def _turn_block(given: Sequence[float], moved: list[float], turned: Matrix, corner: int) -> None:
    axes = range(3)
    for i in axes:
        for j in axes:
            moved[corner + i * ROWS + j] = sum(
                turned[i][k] * float(given[corner + k * ROWS + m]) * turned[j][m]
                for k in axes
                for m in axes
            )


def to_msg_msg(msg: Any) -> Any:
    """A message is one already."""
    return msg


def from_msg_msg(msg: Any) -> Any:
    """A message stays one."""
    return msg


def _motion(transform: Any) -> RigidTransform:
    turn = transform.transform.rotation
    rotation = normalized((turn.x, turn.y, turn.z, turn.w))
    return RigidTransform(_vector(transform.transform.translation), rotation)


def _vector(told: Any) -> tuple[float, float, float]:
    return told.x, told.y, told.z


MOVES = {
    PointStamped: do_transform_point,
    Vector3Stamped: do_transform_vector3,
    PoseStamped: do_transform_pose_stamped,
    PoseWithCovarianceStamped: do_transform_pose_with_covariance_stamped,
}
for _type, _move in MOVES.items():
    tf2_ros.TransformRegistration().add(_type, _move)
    tf2_ros.ConvertRegistration().add_to_msg(_type, to_msg_msg)
    tf2_ros.ConvertRegistration().add_from_msg(_type, from_msg_msg)

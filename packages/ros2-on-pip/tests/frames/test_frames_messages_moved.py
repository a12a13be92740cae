"""`tf2_geometry_msgs`, `Buffer.transform` and `tf_transformations`."""

from __future__ import annotations

import math
from typing import Any

import numpy
import pytest
from frame_messages import as_message, at, step
from frame_reference import MOTIONS, TURNS, by_transforms3d, holds_for, w_first
from frame_stand_ins import tf2_geometry_msgs, tf2_ros, tf_transformations
from geometry_msgs.msg import (
    PointStamped,
    Pose,
    PoseStamped,
    PoseWithCovarianceStamped,
    Quaternion,
    TransformStamped,
    Twist,
    Vector3Stamped,
)
from hypothesis import strategies as st
from transforms3d import euler as reference_euler
from transforms3d import quaternions as reference

from ros2_on_pip.stand_ins._frames.buffer_core import stamped
from ros2_on_pip.stand_ins._frames.motion import Quaternion as Turn
from ros2_on_pip.stand_ins._frames.motion import RigidTransform

CLOSE = 1e-12
ANGLES = st.floats(-3.0, 3.0)


def stamped_message(kind: Any) -> Any:
    """In the laser's frame, at 2 s."""
    made = kind()
    made.header.frame_id, made.header.stamp = "laser", as_message(2.0)
    return made


def quarter() -> Any:
    """The laser is one metre ahead, and looks to the left."""
    return step("base_link", "laser", 2.0, x_m=1.0, yaw_rad=math.pi / 2)


def buffer() -> Any:
    """That is all it knows."""
    made = tf2_ros.Buffer()
    made.set_transform_static(quarter(), "test")
    return made


def test_a_point_is_turned_and_shifted() -> None:
    """Two metres ahead of the laser is two metres to the left of its place."""
    point = stamped_message(PointStamped)
    point.point.x = 2.0
    moved = buffer().transform(point, "base_link")
    assert (moved.point.x, moved.point.y) == pytest.approx((1.0, 2.0))
    assert (moved.header.frame_id, moved.header.stamp) == ("base_link", as_message(2.0))
    assert point.point.x == 2.0


def test_a_direction_is_turned_alone() -> None:
    """And the transform stays as it was."""
    vector, transform = stamped_message(Vector3Stamped), quarter()
    vector.vector.x = 2.0
    moved = tf2_geometry_msgs.do_transform_vector3(vector, transform)
    assert (moved.vector.x, moved.vector.y) == pytest.approx((0.0, 2.0))
    assert transform == quarter()


def test_a_pose_is_turned_itself() -> None:
    """With its header and without; a quaternion of zeros is none."""
    pose = stamped_message(PoseStamped)
    pose.pose.position.x = 2.0
    pose.pose.orientation.w = 0.0
    moved = buffer().transform(pose, "base_link")
    assert (moved.pose.position.x, moved.pose.position.y) == pytest.approx((1.0, 2.0))
    assert moved.pose.orientation.z == pytest.approx(math.sin(math.pi / 4))
    assert tf2_geometry_msgs.do_transform_pose(pose.pose, quarter()) == moved.pose


def test_what_is_known_of_a_pose_turns_too() -> None:
    """What was sure ahead of the laser is sure to the left of the robot."""
    pose = stamped_message(PoseWithCovarianceStamped)
    pose.pose.pose.orientation.w = 1.0
    pose.pose.covariance = [float(i == j) * (i + 1) for i in range(6) for j in range(6)]
    moved = buffer().transform(pose, "base_link")
    rows = numpy.array(moved.pose.covariance).reshape(6, 6)
    assert numpy.diag(rows) == pytest.approx([2, 1, 3, 5, 4, 6])
    assert numpy.abs(rows - numpy.diag(numpy.diag(rows))).max() < CLOSE


@holds_for(MOTIONS, MOTIONS)
def test_poses_as_transforms3d(frame: RigidTransform, lies: RigidTransform) -> None:
    """The product of both matrices."""
    made = stamped(lies, "laser", "it", 0).transform
    pose = Pose(orientation=made.rotation)
    pose.position.x, pose.position.y, pose.position.z = lies.shift
    moved = tf2_geometry_msgs.do_transform_pose(pose, stamped(frame, "odom", "laser", 0))
    turn, place = moved.orientation, moved.position
    ours = RigidTransform((place.x, place.y, place.z), (turn.x, turn.y, turn.z, turn.w))
    wanted = by_transforms3d(frame) @ by_transforms3d(lies)
    assert numpy.abs(by_transforms3d(ours) - wanted).max() < CLOSE
    assert turn.w >= 0.0


@holds_for(MOTIONS, st.lists(st.floats(-1, 1), min_size=36, max_size=36))
def test_covariances_as_numpy(frame: RigidTransform, numbers: list[float]) -> None:
    """R C Rt, with R twice on the diagonal."""
    turn = by_transforms3d(frame)[:3, :3]
    both = numpy.kron(numpy.identity(2), turn)
    wanted = both @ numpy.array(numbers).reshape(6, 6) @ both.T
    transform = stamped(frame, "odom", "laser", 0)
    moved = tf2_geometry_msgs.transform_covariance(numbers, transform)
    assert numpy.abs(numpy.array(moved).reshape(6, 6) - wanted).max() < CLOSE


def test_to_another_time() -> None:
    """A point that was seen two seconds ago, for the robot of now."""
    known = tf2_ros.Buffer()
    for time_s in (1.0, 3.0):
        known.set_transform(step("odom", "base_link", time_s, x_m=time_s), "test")
    point = PointStamped()
    point.header.frame_id, point.header.stamp = "base_link", as_message(1.0)
    point.point.x = 5.0
    moved = known.transform_full(point, "base_link", at(3.0), "odom")
    assert moved.point.x == pytest.approx(3.0)


def test_a_type_that_nobody_moves() -> None:
    """In Jazzy's words."""
    with pytest.raises(tf2_ros.TypeException, match="is not loaded or supported"):
        buffer().transform(stamped_message(TransformStamped), "base_link")


def test_a_type_of_ones_own() -> None:
    """Registered by its own function, and converted by another."""
    moves = tf2_ros.TransformRegistration()
    moves.add(TransformStamped, lambda message, transform: transform.child_frame_id)
    assert buffer().transform(stamped_message(TransformStamped), "base_link") == "laser"
    tf2_ros.ConvertRegistration().add_convert((str, int), len)
    made = buffer().transform(stamped_message(TransformStamped), "base_link", new_type=int)
    assert made == len("laser")


def test_converting() -> None:
    """A copy of the same type; another by way of a message; else it is told."""
    point = stamped_message(PointStamped)
    copied = tf2_ros.convert(point, PointStamped)
    assert copied == point and copied is not point
    assert tf2_ros.convert(point, PoseStamped) is point, "each stays the message that it is"
    with pytest.raises(tf2_ros.TypeException, match="Twist"):
        tf2_ros.convert(point, Twist)


def test_a_buffer_of_ones_own_must_look_up() -> None:
    """Its subclass does it."""
    mine = tf2_ros.BufferInterface()
    for ask in (mine.lookup_transform, mine.can_transform):
        with pytest.raises(tf2_ros.NotImplementedException, match="not implemented"):
            ask("odom", "laser", at(1.0))


def test_a_header_is_put_on() -> None:
    """As Stamped does."""
    made = tf2_ros.Stamped(PointStamped(), as_message(1.0), "laser")
    assert (made.header.frame_id, made.header.stamp) == ("laser", as_message(1.0))


# --- tf_transformations ------------------------------------------------------------------------


@holds_for(ANGLES, ANGLES, ANGLES)
def test_roll_pitch_yaw(roll: float, pitch: float, yaw: float) -> None:
    """As transforms3d, which the real package calls; x, y, z, w here, w first there."""
    q = tf_transformations.quaternion_from_euler(roll, pitch, yaw)
    wanted = reference_euler.euler2quat(roll, pitch, yaw)
    assert min(abs(numpy.array(w_first(q)) - s * wanted).max() for s in (1, -1)) < CLOSE
    again = tf_transformations.quaternion_from_euler(*tf_transformations.euler_from_quaternion(q))
    assert abs(abs(numpy.dot(q, again)) - 1.0) < CLOSE


@holds_for(TURNS, TURNS)
def test_products_and_inverses(a: Turn, b: Turn) -> None:
    """As transforms3d."""
    made = tf_transformations.quaternion_multiply(a, b)
    assert w_first(made) == pytest.approx(tuple(reference.qmult(w_first(a), w_first(b))))
    back = tf_transformations.quaternion_inverse(numpy.array(a) * 2)
    assert tf_transformations.quaternion_multiply(numpy.array(a) * 2, back) == pytest.approx(
        (0, 0, 0, 1), abs=CLOSE
    )


@holds_for(TURNS)
def test_matrices(q: Turn) -> None:
    """There and back, and as transforms3d."""
    made = tf_transformations.quaternion_matrix(q)
    assert numpy.abs(made[:3, :3] - reference.quat2mat(w_first(q))).max() < CLOSE
    assert abs(abs(numpy.dot(tf_transformations.quaternion_from_matrix(made), q)) - 1) < CLOSE
    angles = tf_transformations.euler_from_matrix(made)
    assert tf_transformations.is_same_transform(tf_transformations.euler_matrix(*angles), made)


def test_shifts_and_turns_in_a_row() -> None:
    """The last of a product acts first."""
    shift = tf_transformations.translation_matrix((1, 2, 3))
    turn = tf_transformations.rotation_matrix(math.pi / 2, (0, 0, 1))
    both = tf_transformations.concatenate_matrices(shift, turn)
    assert both @ (1, 0, 0, 1) == pytest.approx((1, 3, 3, 1))
    assert tf_transformations.translation_from_matrix(both) == pytest.approx((1, 2, 3))
    composed = tf_transformations.compose_matrix(angles=(0, 0, math.pi / 2), translate=(1, 2, 3))
    assert tf_transformations.is_same_transform(both, composed)
    back = tf_transformations.inverse_matrix(both) @ both
    assert tf_transformations.is_same_transform(back, tf_transformations.identity_matrix())
    assert tf_transformations.is_same_transform(tf_transformations.compose_matrix(), back)


def test_about_an_axis_through_a_point() -> None:
    """The point stays where it is."""
    made = tf_transformations.rotation_matrix(0.7, (1, 2, 3), (4, 5, 6))
    assert made @ (4, 5, 6, 1) == pytest.approx((4, 5, 6, 1))


def test_half_the_way() -> None:
    """Of a quarter turn; other arcs are told."""
    quarter_turn = tf_transformations.quaternion_about_axis(math.pi / 2, (0, 0, 2))
    half = tf_transformations.quaternion_slerp((0, 0, 0, 1), quarter_turn, 0.5)
    assert half == pytest.approx((0, 0, math.sin(math.pi / 8), math.cos(math.pi / 8)))
    with pytest.raises(NotImplementedError):
        tf_transformations.quaternion_slerp((0, 0, 0, 1), quarter_turn, 0.5, spin=1)


def test_random_rotations() -> None:
    """Unit quaternions; the same for the same numbers."""
    assert tf_transformations.vector_norm(tf_transformations.random_quaternion()) == pytest.approx(
        1
    )
    one, two = (tf_transformations.random_rotation_matrix((0.1, 0.2, 0.3)) for _ in range(2))
    assert tf_transformations.is_same_transform(one, two)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: tf_transformations.unit_vector((0, 0, 0)), "zeros has no direction"),
        (lambda: tf_transformations.quaternion_inverse((0, 0, 0, 0)), "has no inverse"),
        (lambda: tf_transformations.quaternion_from_euler(1, 2, 3, "rpy"), "no sequence of axes"),
        (lambda: tf_transformations.euler_from_quaternion((0, 0, 1)), "not enough values"),
    ],
)
def test_bad_numbers(call: Any, says: str) -> None:
    """A ValueError that says which."""
    with pytest.raises(ValueError, match=says):
        call()


def test_a_message_of_ros_is_no_list() -> None:
    """What many write first: four numbers are asked for."""
    with pytest.raises(TypeError):
        tf_transformations.euler_from_quaternion(Quaternion(w=1.0))


@pytest.mark.parametrize(
    ("module", "name", "instead"),
    [
        (tf_transformations, "scale_matrix", "pip install transforms3d"),
        (tf2_ros, "BufferClient", "Buffer and TransformListener"),
    ],
)
def test_what_is_not_here(module: Any, name: str, instead: str) -> None:
    """It says how to get it; other names are nowhere."""
    with pytest.raises(ImportError, match=instead):
        getattr(module, name)
    with pytest.raises(AttributeError, match="has no attribute 'nonsense'"):
        module.nonsense  # noqa: B018

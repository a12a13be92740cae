"""`ros2 run tf2_ros static_transform_publisher`: says where a frame lies that never moves."""

from __future__ import annotations

import argparse
import secrets
import sys
from typing import NoReturn

import rclpy
import tf2_ros
from rclpy.logging import get_logger

from ros2_on_pip.stand_ins._frames.buffer_core import stamped
from ros2_on_pip.stand_ins._frames.euler import from_euler
from ros2_on_pip.stand_ins._frames.motion import NO_ROTATION, Quaternion, RigidTransform
from ros2_on_pip.tf_program import FAILED, run

NAME = "static_transform_publisher"
SHIFT, ANGLES, TURN = ("x", "y", "z"), ("roll", "pitch", "yaw"), ("qx", "qy", "qz", "qw")
OLD_EULER = ("x", "y", "z", "yaw", "pitch", "roll", "frame_id", "child_frame_id")
OLD_TURN = ("x", "y", "z", "qx", "qy", "qz", "qw", "frame_id", "child_frame_id")


class WrongTransformArguments(Exception):
    """What is typed makes no transform; the text is the real program's."""


class StaticTransformParser(argparse.ArgumentParser):
    """One that says what is wrong as the real program does."""

    def error(self, message: str) -> NoReturn:
        """Raises WrongTransformArguments."""
        raise WrongTransformArguments(message)


def parser() -> StaticTransformParser:
    """The words of the real program."""
    made = StaticTransformParser(
        prog=NAME,
        description="A command line utility for manually sending a static transform. "
        "If no translation or orientation is provided, the identity transform will be published.",
    )
    made.add_argument("--frame-id", default="", help="parent frame")
    made.add_argument("--child-frame-id", default="", help="child frame id")
    for name in SHIFT:
        made.add_argument(f"--{name}", type=float, help=f"{name} component of translation, in m")
    for name in TURN:
        made.add_argument(f"--{name}", type=float, help=f"{name[1]} component of the quaternion")
    for name in ANGLES:
        made.add_argument(f"--{name}", type=float, help=f"{name} of the rotation, in rad")
    made.add_argument(
        "old",
        nargs="*",
        help="in the old order: x y z yaw pitch roll, or x y z qx qy qz qw, then both frames",
    )
    return made


def read(words: list[str]) -> argparse.Namespace:
    """What is typed, in the new form. Raises WrongTransformArguments."""
    if not words:
        raise WrongTransformArguments("Not enough arguments to parse")
    options = parser().parse_args(words)
    if options.old:
        _read_old(options)
    for name, what in (("frame_id", "Frame id"), ("child_frame_id", "Child frame id")):
        if not getattr(options, name):
            raise WrongTransformArguments(f"{what} must not be empty")
    if options.frame_id == options.child_frame_id:
        raise WrongTransformArguments("child_frame_id cannot equal frame_id")
    return options


def _read_old(options: argparse.Namespace) -> None:
    order = {len(names): names for names in (OLD_EULER, OLD_TURN)}.get(len(options.old))
    if order is None:
        raise WrongTransformArguments("Extra unparsed arguments on command-line")
    if any(getattr(options, name) not in (None, "") for name in (*OLD_EULER, *OLD_TURN)):
        raise WrongTransformArguments(
            "Cannot specify both new-style (flags) and old-style (arguments)"
        )
    get_logger(NAME).warning(
        "Old-style arguments are deprecated; see --help for new-style arguments"
    )
    for name, word in zip(order, options.old, strict=True):
        setattr(options, name, word if name.endswith("_id") else _number(name, word))


def _number(name: str, word: str) -> float:
    try:
        return float(word)
    except ValueError as error:
        raise WrongTransformArguments(f"Failed to parse {name} argument as float") from error


def motion_from(options: argparse.Namespace) -> RigidTransform:
    """Where the child lies. Raises WrongTransformArguments."""
    given = {name: getattr(options, name) for name in (*SHIFT, *ANGLES, *TURN)}
    by_angles = any(given[name] is not None for name in ANGLES)
    by_turn = any(given[name] is not None for name in TURN)
    if by_angles and by_turn:
        raise WrongTransformArguments("Cannot specify both quaternion and Euler rotations")
    x, y, z, roll, pitch, yaw, qx, qy, qz, qw = (value or 0.0 for value in given.values())
    none = qw if given["qw"] is not None else NO_ROTATION[3]
    turn: Quaternion = from_euler((roll, pitch, yaw)) if by_angles else (qx, qy, qz, none)
    if abs(sum(value * value for value in turn) - 1.0) >= 0.01:
        raise WrongTransformArguments(
            "The quaternion's length is not 1: listeners would leave it aside"
        )
    return RigidTransform((x, y, z), turn)


def publish(options: argparse.Namespace, motion: RigidTransform) -> None:
    """Say it once, and stay: who listens later hears it too."""
    node = rclpy.create_node(f"{NAME}_{secrets.token_hex(8)}")
    broadcaster = tf2_ros.StaticTransformBroadcaster(node)
    now_ns = node.get_clock().now().nanoseconds
    broadcaster.sendTransform(stamped(motion, options.frame_id, options.child_frame_id, now_ns))
    node.get_logger().info(_spinning(options, motion))
    rclpy.spin(node)


def _spinning(options: argparse.Namespace, motion: RigidTransform) -> str:
    shift, turn = (", ".join(f"'{value:f}'" for value in part) for part in motion)
    return (
        f"Spinning until stopped - publishing transform\ntranslation: ({shift})\n"
        f"rotation: ({turn})\nfrom '{options.frame_id}' to '{options.child_frame_id}'"
    )


def main(words: list[str]) -> int:
    """Run until Ctrl-C."""
    try:
        options = read(words)
        motion = motion_from(options)
    except WrongTransformArguments as wrong:
        print(f"error parsing command line arguments: {wrong}", file=sys.stderr)
        print(parser().format_help(), file=sys.stderr)
        return FAILED
    publish(options, motion)
    return 0


if __name__ == "__main__":
    sys.exit(run(main))

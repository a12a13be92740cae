"""What the screen says beside the map."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator

from roslings_rover.models.differential_drive import Pose
from roslings_rover.rover.driven import DrivenRover
from roslings_rover.rover.node import RoverNode

FIRST_COMMAND = 'ros2 topic pub --once /cmd_vel geometry_msgs/msg/Twist "{linear: {x: 0.5}}"'
KEYS_TELL = "Keys: arrow up drives, left and right turn, down goes back, k stops."
KEYS_PACE = "q and z: faster and slower. i, j, l and comma do as the arrows do."
STOPPED = 0.005


def beside(node: DrivenRover) -> list[str]:
    """Where the rover is, and what it hears and says; at most 32 columns."""
    pose, motion = node.rover.pose, node.rover.motion
    return [
        node.title,
        "",
        f"x        {shown(pose.x_m):>6} m",
        f"y        {shown(pose.y_m):>6} m",
        f"heading  {shown(math.degrees(pose.heading_rad), 0):>6} degrees",
        f"speed    {shown(motion.forward_m_s):>6} m/s{_limit(node)}",
        f"turn     {shown(motion.turn_rad_s):>6} rad/s",
        f"way      {node.rover.way_m:6.2f} m",
        *about_drift(node),
        *(f"{name:8} {count:6}" for name, count in node.counted.items()),
        "",
        *(node.about_parts or _topics(node)),
        "",
        "Ctrl-C ends it",
    ]


def _topics(node: DrivenRover) -> list[str]:
    return [
        "hears /cmd_vel",
        *(("      sentences, /motor_state",) if node.listens else ()),
        f"says  {', '.join(said(node))}",
        "      /camera/image_raw",
        *((f"      {', '.join(node.says_besides)}",) if node.says_besides else ()),
        *about_tf(node),
    ]


def shown(value: float, digits: int = 2) -> str:
    """A number as people write it: what rounds to nothing has no minus."""
    return f"{round(value, digits) + 0.0:.{digits}f}"


def _limit(node: RoverNode) -> str:
    most_m_s = node.rover.most_m_s
    return "" if math.isinf(most_m_s) else f"  max {most_m_s:.2f}"


def heard(node: RoverNode) -> str:
    """The sentence that it hears now, as it is shown; empty where there is none."""
    return f'"{node.sentence.text}"' if node.sentence else ""


def about_tf(node: RoverNode) -> tuple[str, ...]:
    """Why there is no /tf where somebody wants it; at most 32 columns each."""
    if not node.lacks_tf:
        return ()
    return ("no /tf: its type is missing.", *(f"  {step}" for step in next_steps()))


def next_steps() -> tuple[str, ...]:
    """How one gets the type of /tf."""
    if os.environ.get("ROS_DISTRO"):
        return ("sudo apt install", "ros-jazzy-tf2-msgs")
    return ("sudo apt install g++", "then start it with --tf")


def about_drift(node: RoverNode) -> tuple[str, ...]:
    """How much too long its odometry counts; at most 32 columns."""
    percent = node.frames.drift_percent
    return (f"drift    {shown(percent, 1):>6} % in /odom",) if percent else ()


def said(node: RoverNode) -> list[str]:
    """The topics that it publishes."""
    return ["/odom", "/scan", *(["/tf"] if node.publishes_tf else [])]


def below(node: DrivenRover) -> list[str]:
    """What to do next; at most 80 columns, always two lines."""
    if told := news(node):
        return told
    if node.rover.touches:
        return ["The rover touches something. Drive it back: a negative linear.x.", ""]
    if node.by_keys:
        return [KEYS_TELL, node.more_keys or KEYS_PACE]
    if node.driver:
        return [f"{node.driver} drives it, by messages on /cmd_vel.", ""]
    if node.commands:
        return ["angular.z turns it, in rad/s; a positive one to the left.", FIRST_COMMAND]
    return ["Make it move. In a second terminal: source setup.bash, then", FIRST_COMMAND]


def news(node: DrivenRover) -> list[str]:
    """What is told wherever the map is shown, in two lines; empty where there is nothing."""
    if node.notice:
        return [node.notice, ""]
    if node.bumped:
        return [node.bumped, ""]
    if node.reached:
        return [f"The rover touches the {node.reached.colour} ball. Well done!", node.next_step]
    return []


def at_its_end(node: DrivenRover, whose: str) -> Iterator[str]:
    """What is said after Ctrl-C: where it is, how far it went, and what was counted."""
    yield f"{whose} rover is at {position(node)}."
    if node.frames.drift_percent:
        yield f"By its odometry it is at {place(node.odometer.pose)}."
    yield f"It went {node.rover.way_m:.2f} m."
    for name, count in node.counted.items():
        yield f"{name.capitalize()}: {count}."


def position(node: RoverNode) -> str:
    """Where it is and how it moves, in one line."""
    pose, motion = node.rover.pose, node.rover.motion
    moves = abs(motion.forward_m_s) > STOPPED or abs(motion.turn_rad_s) > STOPPED
    return f"{place(pose)}, {'moving' if moves else 'standing'}"


def place(pose: Pose) -> str:
    """Where something is, in words."""
    degrees = shown(math.degrees(pose.heading_rad), 0)
    return f"x {shown(pose.x_m)} m, y {shown(pose.y_m)} m, heading {degrees} degrees"

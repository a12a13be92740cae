"""What the screen says beside the map."""

from __future__ import annotations

import math
import os

from roslings_rover.rover.node import RoverNode

FIRST_COMMAND = 'ros2 topic pub --once /cmd_vel geometry_msgs/msg/Twist "{linear: {x: 0.5}}"'
KEYS_TELL = "Keys: i ahead (or arrow up), j and l turn, comma backwards, k stops."
KEYS_PACE = "q and z: faster and slower. u, o, m and . drive a bend."
STOPPED = 0.005


def beside(node: RoverNode) -> list[str]:
    """Where the rover is, and what it hears and says; at most 32 columns."""
    pose, motion = node.rover.pose, node.rover.motion
    return [
        "The rover",
        "",
        f"x        {pose.x_m:6.2f} m",
        f"y        {pose.y_m:6.2f} m",
        f"heading  {math.degrees(pose.heading_rad):6.0f} degrees",
        f"speed    {motion.forward_m_s + 0.0:6.2f} m/s{_limit(node)}",
        f"turn     {motion.turn_rad_s + 0.0:6.2f} rad/s",
        f"way      {node.rover.way_m:6.2f} m",
        "",
        "hears /cmd_vel",
        *(("      sentences, /motor_state",) if node.listens else ()),
        f"says  {', '.join(said(node))}",
        "      /camera/image_raw",
        *about_tf(node),
        "",
        "Ctrl-C ends it",
    ]


def _limit(node: RoverNode) -> str:
    most_m_s = node.rover.most_m_s
    return "" if math.isinf(most_m_s) else f"  max {most_m_s:.2f}"


def heard(node: RoverNode) -> str:
    """The sentence that it hears now, as it is shown; empty where there is none."""
    return f'"{node.sentence.text}"' if node.sentence else ""


def about_tf(node: RoverNode) -> tuple[str, ...]:
    """Why there is no /tf; at most 32 columns each."""
    if node.publishes_tf:
        return ()
    if not node.tf:
        return ("(with /tf: rover --tf)",)
    return ("no /tf: its type is missing.", *(f"  {step}" for step in next_steps()))


def next_steps() -> tuple[str, ...]:
    """How one gets the type of /tf."""
    if os.environ.get("ROS_DISTRO"):
        return ("sudo apt install", "ros-jazzy-tf2-msgs")
    return ("sudo apt install g++", "then start the rover again")


def said(node: RoverNode) -> list[str]:
    """The topics that it publishes."""
    return ["/odom", "/scan", *(["/tf"] if node.publishes_tf else [])]


def below(node: RoverNode) -> list[str]:
    """What to do next; at most 80 columns, always two lines."""
    if node.notice:
        return [node.notice, ""]
    if ball := node.rover.touched_ball:
        return [f"The rover touches the {ball.colour} ball. Well done!", ""]
    if node.rover.touches:
        return ["The rover touches something. Drive it back: a negative linear.x.", ""]
    if node.by_keys:
        return [KEYS_TELL, KEYS_PACE]
    if node.commands:
        return ["angular.z turns it, in rad/s; a positive one to the left.", FIRST_COMMAND]
    return ["Make it move. In a second terminal: source setup.bash, then", FIRST_COMMAND]


def position(node: RoverNode) -> str:
    """Where it is and how it moves, in one line."""
    pose, motion = node.rover.pose, node.rover.motion
    moves = abs(motion.forward_m_s) > STOPPED or abs(motion.turn_rad_s) > STOPPED
    degrees = math.degrees(pose.heading_rad)
    where = f"x {pose.x_m:.2f} m, y {pose.y_m:.2f} m, heading {degrees:.0f} degrees"
    return f"{where}, {'moving' if moves else 'standing'}"

"""Well-known programs that only the full installation has, and what to use here instead.

Guides name them in their first lines, so "not found" alone would leave a beginner stuck.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from ros2_on_pip.handover import hand_over
from ros2_on_pip.words import WRONG_USE


@dataclass(frozen=True)
class AbsentPackage:
    """A package that the wheels do not have."""

    what: str
    instead: str
    apt: str = ""
    """The Ubuntu package, where its name is not made from the ROS package's."""

    def told(self, name: str) -> str:
        """Two lines: what is missing, what to type here, and where the real one is."""
        apt = self.apt or f"ros-jazzy-{name.replace('_', '-')}"
        return (
            f"'{name}' is not here: it {self.what}. Use instead: {instead_here(self.instead)}\n"
            f"The real one needs Ubuntu 24.04: sudo apt install {apt}"
        )


GRAPH = "rqt_graph, or ./roslings graph in the roslings folder"
ROVER = "the rover and its map: ./roslings rover"
DRIVE = "ros2 run teleop_twist_keyboard teleop_twist_keyboard"
PICTURES = "show_image in a notebook (day 7), or ros2 topic hz and echo --no-arr"
TF = "ros2 topic echo /tf, beside ./roslings rover --tf"
TEACHING = "is another guide's example"
DEMO = "ros2 run demo_nodes_py talker"

CAMERA = "./roslings camera, and your node of day 7"
ALONE = {
    GRAPH: "ros2 node info, ros2 topic info -v",
    ROVER: "a robot of your own, and ros2 topic echo",
    PICTURES: "ros2 topic hz and echo --no-arr",
    TF: "ros2 topic echo /tf",
    CAMERA: "a node of your own",
}
"""What needs the roslings course, to what is there without it."""


def instead_here(text: str) -> str:
    """What to use, where this environment is one of the course's, or another one."""
    for in_the_course, alone in () if is_of_the_course() else ALONE.items():
        text = text.replace(in_the_course, alone)
    return text


def is_of_the_course() -> bool:
    """Whether this environment lies in a folder of the roslings course."""
    return (Path(sys.prefix).parent / "roslings").is_file()


ABSENT = {
    "demo_nodes_cpp": AbsentPackage("is compiled", DEMO),
    "examples_rclpy_minimal_publisher": AbsentPackage(TEACHING, DEMO),
    "examples_rclpy_minimal_subscriber": AbsentPackage(TEACHING, "ros2 run demo_nodes_py listener"),
    "image_tools": AbsentPackage("shows pictures in a window", PICTURES),
    "joint_state_publisher_gui": AbsentPackage(
        "opens a window", "ros2 topic pub /joint_states ..."
    ),
    "nav2_bringup": AbsentPackage("drives large robots", ROVER, "ros-jazzy-navigation2"),
    "robot_state_publisher": AbsentPackage("is compiled", TF),
    "ros_gz_sim": AbsentPackage("is a large simulator", ROVER, "ros-jazzy-ros-gz"),
    "rqt": AbsentPackage(
        "opens a window", f"for the graph {GRAPH}; for the rest ros2 topic, node, param"
    ),
    "rqt_console": AbsentPackage("opens a window", "ros2 topic echo /rosout"),
    "rqt_gui": AbsentPackage("opens a window", f"for the graph {GRAPH}", "ros-jazzy-rqt"),
    "rqt_image_view": AbsentPackage("shows pictures in a window", PICTURES),
    "rqt_plot": AbsentPackage("draws curves in a window", "ros2 topic echo TOPIC --field data"),
    "rviz2": AbsentPackage("draws robots in 3D", f"{ROVER}; for numbers ros2 topic echo"),
    "slam_toolbox": AbsentPackage("makes maps of rooms", ROVER),
    "turtlesim": AbsentPackage("opens a window", f"{ROVER}; to drive it, {DRIVE}"),
    "usb_cam": AbsentPackage("reads a real camera", CAMERA),
    "v4l2_camera": AbsentPackage("reads a real camera", CAMERA),
}
"""Name of the package, or of the command, to what is said."""


def main(name: str, argv: Sequence[str]) -> int:
    """Become the real command where there is one, else say what to use."""
    hand_over(name, f"{name}.main", argv)
    print(ABSENT[name].told(name), file=sys.stderr)
    return WRONG_USE


rviz2 = partial(main, "rviz2")
"""Typed without `ros2 run`: an environment has it on its path, as it has `window_commands.py`."""

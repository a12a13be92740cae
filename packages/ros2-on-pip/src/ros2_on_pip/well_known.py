"""More names that other guides type after `ros2 run`, and what to use here instead.

These are windows and tools. What a launch file may name, too, stands in `absent.py`.
"""

from __future__ import annotations

from dataclasses import dataclass

from ros2_on_pip.absent import (
    ABSENT,
    DEMO,
    DRIVE,
    GRAPH,
    ROVER,
    TEACHING,
    TF,
    AbsentPackage,
    instead_here,
)
from ros2_on_pip.packages import packages
from ros2_on_pip.problem import CommandProblem, did_you_mean
from ros2_on_pip.unbuilt import advice

TYPES = "ros2 interface list, show and proto"
JOINTS = "ros2 topic pub /joint_states sensor_msgs/msg/JointState ..."
DIAGNOSTICS = "ros2 topic echo /diagnostics"
WINDOW = "opens a window"


@dataclass(frozen=True)
class OnlyAsSource(AbsentPackage):
    """A package that Ubuntu does not have either."""

    def told(self, name: str) -> str:
        """Two lines, as those of the others."""
        return (
            f"'{name}' is not here: it {self.what}. Use instead: {instead_here(self.instead)}\n"
            "No apt package has it: the real one is built from its source."
        )


WELL_KNOWN: dict[str, AbsentPackage] = {
    "foxglove_bridge": AbsentPackage(
        "is compiled", "a recording, which Foxglove opens as it is: ros2 bag record -a"
    ),
    "joint_state_publisher": AbsentPackage("plays a robot's joints", JOINTS),
    "micro_ros_agent": OnlyAsSource("is compiled", "a serial bridge of your own"),
    "plotjuggler": AbsentPackage(
        "draws curves in a window", "ros2 topic echo TOPIC --field data --csv"
    ),
    "rosbridge_server": AbsentPackage(
        "joins web pages to ROS", "a node with rclpy, and ros2 topic echo"
    ),
    "rqt_action": AbsentPackage(WINDOW, "ros2 action list -t, info and type"),
    "rqt_bag": AbsentPackage(WINDOW, "ros2 bag info, play and record"),
    "rqt_controller_manager": AbsentPackage(WINDOW, "ros2 service list, and call"),
    "rqt_gauges": AbsentPackage(WINDOW, "ros2 topic echo TOPIC --field data"),
    "rqt_graph": AbsentPackage("is a command of its own here", GRAPH),
    "rqt_joint_trajectory_controller": AbsentPackage(WINDOW, JOINTS),
    "rqt_msg": AbsentPackage(WINDOW, TYPES),
    "rqt_publisher": AbsentPackage(WINDOW, "ros2 topic pub TOPIC TYPE VALUES"),
    "rqt_py_console": AbsentPackage(WINDOW, "python3, and import rclpy"),
    "rqt_reconfigure": AbsentPackage(WINDOW, "ros2 param list, and ros2 param set NODE NAME VALUE"),
    "rqt_robot_monitor": AbsentPackage(WINDOW, DIAGNOSTICS),
    "rqt_robot_steering": AbsentPackage(WINDOW, DRIVE),
    "rqt_runtime_monitor": AbsentPackage(WINDOW, DIAGNOSTICS),
    "rqt_service_caller": AbsentPackage(WINDOW, "ros2 service call NAME TYPE VALUES"),
    "rqt_shell": AbsentPackage(WINDOW, "the terminal in which you type this"),
    "rqt_srv": AbsentPackage(WINDOW, TYPES),
    "rqt_tf_tree": AbsentPackage("draws the tree of frames in a window", TF),
    "rqt_topic": AbsentPackage(WINDOW, "ros2 topic list -t, hz, bw and echo"),
    "teleop_twist_joy": AbsentPackage("reads a game pad", DRIVE),
    "xacro": AbsentPackage("writes a long URDF from a short one", "a URDF file without macros"),
}
"""Name of the package to what is said."""

FAMILIES = {
    "demo_nodes_": AbsentPackage(TEACHING, DEMO),
    "examples_rcl": AbsentPackage(TEACHING, DEMO),
    "moveit_": AbsentPackage("plans the ways of a robot arm", JOINTS, "ros-jazzy-moveit"),
    "nav2_": AbsentPackage("drives large robots", ROVER, "ros-jazzy-navigation2"),
    "ros_gz_": AbsentPackage("is part of a large simulator", ROVER, "ros-jazzy-ros-gz"),
    "rqt_": AbsentPackage(
        "is a part of rqt, which opens a window", "ros2 topic, node, param, service"
    ),
    "rviz_": AbsentPackage("is a part of RViz, which draws robots in 3D", ROVER, "ros-jazzy-rviz2"),
    "turtlebot3_": AbsentPackage("is for one kind of robot", ROVER, "ros-jazzy-turtlebot3"),
    "turtlebot4_": AbsentPackage("is for one kind of robot", ROVER, "ros-jazzy-turtlebot4-desktop"),
}
"""How the names of packages begin that are too many for the table above."""


class NotHere(CommandProblem):
    """A package that only the full installation has."""


def answer_for(package: str) -> None:
    """Raise NotHere where `package` is well known, and no slip in the name of another one.

    One's own package, built or not, of such a name is for `packages.py`.
    """
    told = absent(package)
    if told is None or package in ABSENT or advice(package):
        return
    if package in WELL_KNOWN or not did_you_mean(package, packages()):
        raise NotHere(told.told(package))


def absent(name: str) -> AbsentPackage | None:
    """What is said of a package that only the full installation has; None of any other."""
    families = (told for begins, told in FAMILIES.items() if name.startswith(begins))
    return ABSENT.get(name) or WELL_KNOWN.get(name) or next(families, None)

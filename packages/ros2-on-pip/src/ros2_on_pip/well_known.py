"""More names that other guides type after `ros2 run`, and what to use here instead.

These are windows and tools. What a launch file may name, too, stands in `absent.py`.
"""

from __future__ import annotations

from dataclasses import dataclass

from ros2_on_pip.absent import ABSENT, DEMO, DRIVE, GRAPH, ROVER, TEACHING, TF, Absent, instead_here
from ros2_on_pip.packages import packages
from ros2_on_pip.problem import Problem, did_you_mean
from ros2_on_pip.unbuilt import advice

TYPES = "ros2 interface list, show and proto"
JOINTS = "ros2 topic pub /joint_states sensor_msgs/msg/JointState ..."
DIAGNOSTICS = "ros2 topic echo /diagnostics"
WINDOW = "opens a window"


@dataclass(frozen=True)
class OnlyAsSource(Absent):
    """A package that Ubuntu does not have either."""

    def told(self, name: str) -> str:
        """Two lines, as those of the others."""
        return (
            f"'{name}' is not here: it {self.what}. Use instead: {instead_here(self.instead)}\n"
            "No apt package has it: the real one is built from its source."
        )


WELL_KNOWN: dict[str, Absent] = {
    "foxglove_bridge": Absent(
        "is compiled", "a recording, which Foxglove opens as it is: ros2 bag record -a"
    ),
    "joint_state_publisher": Absent("plays a robot's joints", JOINTS),
    "micro_ros_agent": OnlyAsSource("is compiled", "a serial bridge of your own"),
    "plotjuggler": Absent("draws curves in a window", "ros2 topic echo TOPIC --field data --csv"),
    "rosbridge_server": Absent("joins web pages to ROS", "a node with rclpy, and ros2 topic echo"),
    "rqt_action": Absent(WINDOW, "ros2 action list -t, info and type"),
    "rqt_bag": Absent(WINDOW, "ros2 bag info, play and record"),
    "rqt_controller_manager": Absent(WINDOW, "ros2 service list, and call"),
    "rqt_gauges": Absent(WINDOW, "ros2 topic echo TOPIC --field data"),
    "rqt_graph": Absent("is a command of its own here", GRAPH),
    "rqt_joint_trajectory_controller": Absent(WINDOW, JOINTS),
    "rqt_msg": Absent(WINDOW, TYPES),
    "rqt_publisher": Absent(WINDOW, "ros2 topic pub TOPIC TYPE VALUES"),
    "rqt_py_console": Absent(WINDOW, "python3, and import rclpy"),
    "rqt_reconfigure": Absent(WINDOW, "ros2 param list, and ros2 param set NODE NAME VALUE"),
    "rqt_robot_monitor": Absent(WINDOW, DIAGNOSTICS),
    "rqt_robot_steering": Absent(WINDOW, DRIVE),
    "rqt_runtime_monitor": Absent(WINDOW, DIAGNOSTICS),
    "rqt_service_caller": Absent(WINDOW, "ros2 service call NAME TYPE VALUES"),
    "rqt_shell": Absent(WINDOW, "the terminal in which you type this"),
    "rqt_srv": Absent(WINDOW, TYPES),
    "rqt_tf_tree": Absent("draws the tree of frames in a window", TF),
    "rqt_topic": Absent(WINDOW, "ros2 topic list -t, hz, bw and echo"),
    "teleop_twist_joy": Absent("reads a game pad", DRIVE),
    "xacro": Absent("writes a long URDF from a short one", "a URDF file without macros"),
}
"""Name of the package to what is said."""

FAMILIES = {
    "demo_nodes_": Absent(TEACHING, DEMO),
    "examples_rcl": Absent(TEACHING, DEMO),
    "moveit_": Absent("plans the ways of a robot arm", JOINTS, "ros-jazzy-moveit"),
    "nav2_": Absent("drives large robots", ROVER, "ros-jazzy-navigation2"),
    "ros_gz_": Absent("is part of a large simulator", ROVER, "ros-jazzy-ros-gz"),
    "rqt_": Absent("is a part of rqt, which opens a window", "ros2 topic, node, param, service"),
    "rviz_": Absent("is a part of RViz, which draws robots in 3D", ROVER, "ros-jazzy-rviz2"),
    "turtlebot3_": Absent("is for one kind of robot", ROVER, "ros-jazzy-turtlebot3"),
    "turtlebot4_": Absent("is for one kind of robot", ROVER, "ros-jazzy-turtlebot4-desktop"),
}
"""How the names of packages begin that are too many for the table above."""


class NotHere(Problem):
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


def absent(name: str) -> Absent | None:
    """What is said of a package that only the full installation has; None of any other."""
    families = (told for begins, told in FAMILIES.items() if name.startswith(begins))
    return ABSENT.get(name) or WELL_KNOWN.get(name) or next(families, None)

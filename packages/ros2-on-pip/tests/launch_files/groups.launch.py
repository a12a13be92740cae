"""What is set in a group stays in it."""

from launch import LaunchDescription
from launch.actions import GroupAction, SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node, PushRosNamespace, SetParameter, SetRemap


def teller(name: str) -> Node:
    color = LaunchConfiguration("color", default="none")
    return Node(package="mine", executable="teller", name=name, parameters=[{"color": color}])


def generate_launch_description() -> LaunchDescription:
    return LaunchDescription(
        [
            GroupAction(
                [
                    PushRosNamespace("outer"),
                    SetLaunchConfiguration("color", "red"),
                    SetParameter("use_sim_time", True),
                    SetParameter(name="speed", value=2.5),
                    SetRemap("topic", "/news"),
                    teller("first"),
                    GroupAction([PushRosNamespace("inner"), teller("second")]),
                    GroupAction([PushRosNamespace("/away"), teller("third")], forwarding=True),
                ]
            ),
            GroupAction([SetLaunchConfiguration("color", "blue")], scoped=False),
            teller("fourth"),
        ]
    )

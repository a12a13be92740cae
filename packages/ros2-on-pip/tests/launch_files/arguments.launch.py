"""Arguments, and what becomes of their values as parameters."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue


def generate_launch_description() -> LaunchDescription:
    rate = LaunchConfiguration("rate")
    return LaunchDescription(
        [
            DeclareLaunchArgument("rate", default_value="2.5", description="how often"),
            DeclareLaunchArgument("side", default_value="left", choices=["left", "right"]),
            Node(
                package="mine",
                executable="teller",
                parameters=[
                    {
                        "rate": rate,
                        "text": ParameterValue(rate, value_type=str),
                        "literal": "7",
                        "joined": [LaunchConfiguration("side"), "_wheel"],
                    }
                ],
            ),
        ]
    )

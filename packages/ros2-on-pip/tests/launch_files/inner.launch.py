"""Is included: one argument without a default."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    return LaunchDescription(
        [
            DeclareLaunchArgument("who", description="its name"),
            Node(package="mine", executable="teller", name=LaunchConfiguration("who")),
        ]
    )

"""As many nodes as an argument says."""

from __future__ import annotations

from launch import LaunchContext, LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def robots(context: LaunchContext, prefix: str) -> list[Node]:
    count = int(LaunchConfiguration("count").perform(context))
    return [
        Node(package="mine", executable="teller", name=f"{prefix}{number}")
        for number in range(count)
    ]


def generate_launch_description() -> LaunchDescription:
    return LaunchDescription(
        [
            DeclareLaunchArgument("count", default_value="2"),
            OpaqueFunction(function=robots, args=["robot"]),
        ]
    )

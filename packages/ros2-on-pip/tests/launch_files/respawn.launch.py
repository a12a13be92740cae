"""Is started again, twice."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    return LaunchDescription(
        [
            Node(
                package="mine",
                executable="teller",
                arguments=["die"],
                respawn=True,
                respawn_delay=0.1,
                respawn_max_retries=2,
            ),
        ]
    )

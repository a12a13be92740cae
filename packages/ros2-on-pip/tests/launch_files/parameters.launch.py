"""Dictionaries and files, in order; a file with wildcards; every type."""

from launch import LaunchDescription
from launch.substitutions import PathJoinSubstitution, ThisLaunchFileDir
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    file = PathJoinSubstitution([ThisLaunchFileDir(), "numbers.yaml"])
    return LaunchDescription(
        [
            Node(
                package="mine",
                executable="teller",
                name="wheels",
                namespace="left",
                parameters=[
                    file,
                    {
                        "speed": 0.5,
                        "on": True,
                        "pid": {"p": 1.0, "limits": [1, 2]},
                        "mixed": [1, 2.5],
                        "names": ["a", "b"],
                    },
                ],
            ),
        ]
    )

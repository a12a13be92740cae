"""Name, namespace, remappings, words of the node's own and words for ROS."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    return LaunchDescription(
        [
            Node(
                package="mine",
                executable="teller",
                name="ear",
                namespace="/head/left",
                remappings=[("topic", "/news")],
                arguments=["one", "two words"],
                ros_arguments=["--log-level", "debug"],
            ),
            Node(package="mine", executable="teller", namespace="tail"),
            Node(package="mine", executable="teller"),
        ]
    )

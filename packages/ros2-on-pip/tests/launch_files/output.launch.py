"""What of the output is shown: with `log`, the default, standard error alone."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    return LaunchDescription(
        [
            Node(package="mine", executable="teller", name="logs"),
            Node(package="mine", executable="teller", name="shows", output="screen"),
            Node(
                package="mine",
                executable="teller",
                name="both",
                exec_name="other_name",
                output={"both": ["log"]},
                emulate_tty=True,
            ),
        ]
    )

"""A node that all others need, and one that stays until it is told to end."""

from launch import LaunchDescription
from launch.actions import RegisterEventHandler, Shutdown
from launch.event_handlers import OnProcessIO
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    stays = Node(package="mine", executable="teller", name="stays", arguments=["stay"])
    needed = Node(
        package="mine", executable="teller", name="needed", on_exit=Shutdown(reason="it has ended")
    )
    return LaunchDescription(
        [
            stays,
            RegisterEventHandler(OnProcessIO(target_action=stays, on_stderr=lambda event: needed)),
        ]
    )

"""Later, and later still; what would come after the end does not come."""

from launch import LaunchDescription
from launch.actions import EmitEvent, LogInfo, TimerAction
from launch.events import Shutdown
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    return LaunchDescription(
        [
            TimerAction(period=0.4, actions=[EmitEvent(event=Shutdown(reason="time is up"))]),
            TimerAction(period=0.2, actions=[LogInfo(msg="second")]),
            TimerAction(period="0.1", actions=[LogInfo(msg="first")]),
            TimerAction(period=60.0, actions=[LogInfo(msg="never")]),
            Node(package="mine", executable="teller", condition=None, arguments=["stay"]),
        ]
    )

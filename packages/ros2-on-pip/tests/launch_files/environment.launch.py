"""Variables of the environment: for all, for a group, for one node."""

from launch import LaunchDescription
from launch.actions import (
    AppendEnvironmentVariable,
    GroupAction,
    LogInfo,
    SetEnvironmentVariable,
    UnsetEnvironmentVariable,
)
from launch.substitutions import EnvironmentVariable
from launch_ros.actions import Node


def teller(name: str, **more: object) -> Node:
    return Node(package="mine", executable="teller", name=name, **more)


def generate_launch_description() -> LaunchDescription:
    return LaunchDescription(
        [
            LogInfo(msg=["mood: ", EnvironmentVariable("MOOD", default_value="none")]),
            SetEnvironmentVariable("MOOD", "calm"),
            teller("one"),
            GroupAction([SetEnvironmentVariable(name="MOOD", value="gay"), teller("two")]),
            teller("three", additional_env={"MOOD": [EnvironmentVariable("MOOD"), "er"]}),
            AppendEnvironmentVariable("MOOD", "sea", separator=" "),
            teller("four"),
            UnsetEnvironmentVariable("MOOD"),
            teller("five"),
        ]
    )

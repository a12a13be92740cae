"""Texts that are made while the launch runs."""

from launch import LaunchDescription
from launch.actions import LogInfo
from launch.substitutions import (
    AndSubstitution,
    Command,
    FileContent,
    IfElseSubstitution,
    NotSubstitution,
    PathJoinSubstitution,
    PythonExpression,
    TextSubstitution,
    ThisLaunchFile,
    ThisLaunchFileDir,
)
from launch_ros.substitutions import FindPackagePrefix, FindPackageShare


def generate_launch_description() -> LaunchDescription:
    share = FindPackageShare("mine")
    return LaunchDescription(
        [
            LogInfo(msg=[PathJoinSubstitution([share, "config", "a.yaml"])]),
            LogInfo(msg=f"at once {share.find('mine')}"),
            LogInfo(msg=["prefix ", FindPackagePrefix(package="mine")]),
            LogInfo(msg=PythonExpression(["round(", TextSubstitution(text="pi"), ", 3)"])),
            LogInfo(msg=Command(["echo ", "from a command"])),
            LogInfo(msg=ThisLaunchFile()),
            LogInfo(msg=FileContent([ThisLaunchFileDir(), "/note.txt"])),
            LogInfo(
                msg=IfElseSubstitution(
                    AndSubstitution("true", NotSubstitution("false")),
                    if_value="yes",
                    else_value="no",
                )
            ),
        ]
    )

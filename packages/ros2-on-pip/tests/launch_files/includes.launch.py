"""Launch files in all three languages, from one in Python."""

from pathlib import Path

from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import (
    AnyLaunchDescriptionSource,
    PythonLaunchDescriptionSource,
)
from launch.substitutions import PathJoinSubstitution, ThisLaunchFileDir
from launch_xml.launch_description_sources import XMLLaunchDescriptionSource
from launch_yaml.launch_description_sources import YAMLLaunchDescriptionSource

HERE = Path(__file__).parent


def generate_launch_description() -> LaunchDescription:
    return LaunchDescription(
        [
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource([ThisLaunchFileDir(), "/inner.launch.py"]),
                launch_arguments={"who": "one"}.items(),
            ),
            IncludeLaunchDescription(
                XMLLaunchDescriptionSource(str(HERE / "inner.launch.xml")),
                launch_arguments=[("who", "two")],
            ),
            IncludeLaunchDescription(
                YAMLLaunchDescriptionSource(PathJoinSubstitution([HERE, "inner.launch.yaml"])),
                launch_arguments={"who": "three"}.items(),
            ),
            IncludeLaunchDescription(
                AnyLaunchDescriptionSource(str(HERE / "inner.launch.xml")),
                launch_arguments={"who": "four"}.items(),
            ),
        ]
    )

"""Each name from the module that it has to itself, as some guides import them."""

import launch.actions
import launch_ros.actions.node
from launch.actions.declare_launch_argument import DeclareLaunchArgument
from launch.event_handlers.on_process_exit import OnProcessExit
from launch.launch_context import LaunchContext
from launch.launch_description import LaunchDescription
from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitutions.launch_configuration import LaunchConfiguration
from launch.utilities import perform_substitutions
from launch_ros.actions import PushROSNamespace
from launch_ros.actions.push_ros_namespace import PushRosNamespace
from launch_ros.descriptions import ParameterFile, ParameterValue

KNOWN = (LaunchContext, SomeSubstitutionsType, perform_substitutions, ParameterFile, OnProcessExit)


def generate_launch_description() -> LaunchDescription:
    assert PushROSNamespace is PushRosNamespace
    return LaunchDescription(
        [
            DeclareLaunchArgument("depth", default_value="3"),
            PushRosNamespace("deep"),
            launch.actions.LogInfo(msg=f"{len(KNOWN)} more names"),
            launch_ros.actions.node.Node(
                package="mine",
                executable="teller",
                parameters=[
                    {"depth": ParameterValue(LaunchConfiguration("depth"), value_type=float)}
                ],
            ),
        ]
    )

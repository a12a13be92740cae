"""Start the nodes of two rovers, each rover in a namespace of its own."""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node, PushRosNamespace

PACKAGE = 'rover_bringup'
VALUES = str(Path(get_package_share_directory(PACKAGE)) / 'config' / 'rovers.yaml')


def rover(name, condition=None):
    """All nodes of one rover."""
    parameters = [
        LaunchConfiguration('params_file'),
        # Wins: it comes later, and with name=... it counts for the full name.
        {'careful': LaunchConfiguration('careful')},
    ]
    return GroupAction(
        [
            PushRosNamespace(name),
            Node(
                package=PACKAGE,
                executable='speed_limiter',
                name='speed_limiter',
                parameters=parameters,
                respawn=True,
                output='screen',
            ),
            Node(
                package=PACKAGE,
                executable='beacon',
                name='beacon',
                parameters=parameters,
                output='screen',
            ),
        ],
        condition=condition,
    )


def generate_launch_description():
    """Declare the arguments, and start both rovers."""
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'params_file',
                default_value=VALUES,
                description='the YAML file with the values of all parameters',
            ),
            DeclareLaunchArgument(
                'careful',
                default_value='false',
                description='whether slow_speed is the limit',
            ),
            DeclareLaunchArgument(
                'blue',
                default_value='true',
                description='whether the second rover is started',
            ),
            rover('red'),
            rover('blue', condition=IfCondition(LaunchConfiguration('blue'))),
        ]
    )

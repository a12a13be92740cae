"""One command starts the pilot, with the quay on the side that is said."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    """One node."""
    quay = {'quay': LaunchConfiguration('quay')}
    return LaunchDescription(
        [
            DeclareLaunchArgument('quay', default_value='left'),
            Node(package='pilotage', executable='pilot', parameters=[quay]),
        ]
    )

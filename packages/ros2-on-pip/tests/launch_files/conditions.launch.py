"""What is carried out, and what is not."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.conditions import (
    IfCondition,
    LaunchConfigurationEquals,
    LaunchConfigurationNotEquals,
    UnlessCondition,
)
from launch.substitutions import EqualsSubstitution, LaunchConfiguration, PythonExpression


def generate_launch_description() -> LaunchDescription:
    on, speed = LaunchConfiguration("on"), LaunchConfiguration("speed")
    fast = PythonExpression([speed, " > 1.5"])
    return LaunchDescription(
        [
            DeclareLaunchArgument("on", default_value="true"),
            DeclareLaunchArgument("speed", default_value="1.0"),
            LogInfo(msg="it is on", condition=IfCondition(on)),
            LogInfo(msg="it is off", condition=UnlessCondition(on)),
            LogInfo(msg="it is fast", condition=IfCondition(fast)),
            LogInfo(msg="it is slow", condition=UnlessCondition(fast)),
            LogInfo(msg="it is two", condition=LaunchConfigurationEquals("speed", "2.0")),
            LogInfo(msg="it is not two", condition=LaunchConfigurationNotEquals("speed", "2.0")),
            LogInfo(msg="it is one", condition=IfCondition(EqualsSubstitution(speed, "1.0"))),
        ]
    )

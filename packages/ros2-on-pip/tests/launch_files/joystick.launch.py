"""Arguments, texts that are put together, a set of remappings: all by their long names."""

from pathlib import Path

import launch
import launch_ros.actions


def generate_launch_description() -> launch.LaunchDescription:
    side = launch.substitutions.LaunchConfiguration("side")
    return launch.LaunchDescription(
        [
            launch.actions.DeclareLaunchArgument("heard", default_value="news"),
            launch.actions.DeclareLaunchArgument("side", default_value="numbers"),
            launch.actions.DeclareLaunchArgument(
                "file",
                default_value=[
                    launch.substitutions.TextSubstitution(text=f"{Path(__file__).parent}/"),
                    side,
                    launch.substitutions.TextSubstitution(text=".yaml"),
                ],
            ),
            launch_ros.actions.Node(
                package="mine",
                executable="teller",
                name="wheels",
                namespace="left",
                parameters=[launch.substitutions.LaunchConfiguration("file"), {"dead": 0.3}],
                remappings={("topic", launch.substitutions.LaunchConfiguration("heard"))},
                condition=launch.conditions.IfCondition("true"),
            ),
        ]
    )

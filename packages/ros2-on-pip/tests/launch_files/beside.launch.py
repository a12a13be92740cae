"""Two nodes side by side, and the lines of both on the screen."""

import launch
import launch_ros.actions


def generate_launch_description() -> launch.LaunchDescription:
    return launch.LaunchDescription(
        [
            launch_ros.actions.Node(package="mine", executable="teller", name=name, output="screen")
            for name in ("one", "two")
        ]
    )

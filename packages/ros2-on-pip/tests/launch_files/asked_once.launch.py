"""As the demos of ROS have it: one import, and all parts behind it; who is asked ends the rest."""

import launch
import launch_ros.actions


def generate_launch_description() -> launch.LaunchDescription:
    server = launch_ros.actions.Node(
        package="mine", executable="teller", name="server", arguments=["stay"], output="screen"
    )
    client = launch_ros.actions.Node(
        package="mine", executable="teller", name="client", output="screen"
    )
    goes_down = launch.actions.EmitEvent(event=launch.events.Shutdown())
    return launch.LaunchDescription(
        [
            server,
            client,
            launch.actions.RegisterEventHandler(
                event_handler=launch.event_handlers.OnProcessExit(
                    target_action=client, on_exit=[goes_down]
                )
            ),
        ]
    )

"""One thing after another."""

from launch import LaunchDescription
from launch.actions import ExecuteProcess, LogInfo, RegisterEventHandler
from launch.event_handlers import (
    OnExecutionComplete,
    OnProcessExit,
    OnProcessIO,
    OnProcessStart,
    OnShutdown,
)
from launch.substitutions import FindExecutable, LocalSubstitution
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    node = Node(package="mine", executable="teller", name="first")
    spawn = ExecuteProcess(cmd=[[FindExecutable(name="echo"), " spawned"]], shell=True)
    last = Node(package="mine", executable="teller", name="last")
    return LaunchDescription(
        [
            node,
            RegisterEventHandler(
                OnProcessStart(target_action=node, on_start=[LogInfo(msg="it has started"), spawn])
            ),
            RegisterEventHandler(
                OnProcessIO(
                    target_action=spawn,
                    on_stdout=lambda event: LogInfo(msg=f"it says {event.text.decode().strip()}"),
                )
            ),
            RegisterEventHandler(
                OnProcessExit(
                    target_action=node,
                    on_exit=lambda event, context: [
                        LogInfo(msg=f"exit code {event.returncode}"),
                        last,
                    ],
                )
            ),
            RegisterEventHandler(
                OnExecutionComplete(target_action=last, on_completion=[LogInfo(msg="all done")])
            ),
            RegisterEventHandler(
                OnShutdown(on_shutdown=[LogInfo(msg=["end: ", LocalSubstitution("event.reason")])])
            ),
        ]
    )
